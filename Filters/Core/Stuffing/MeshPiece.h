// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshPiece_h
#define isodiamond_MeshPiece_h

#include "Stuffing/Change.h"
#include "Stuffing/Improvement.h"

#include <vector>

namespace isodiamond
{

/**
 * A piece of a mesh around one of its tetrahedra, with ids of its own, to try changes on.
 *
 * Its points are some edges away from the tetrahedron. The piece has all tetrahedra at points that
 * are no more than Reach away; free are those with no point as far away as that. All that
 * BestChange() reads of a free one is in the piece, and stays so when free ones change: a point
 * that is less than Reach away only gets neighbours of which the piece has all tetrahedra.
 */
class MeshPiece
{
public:
  MeshPiece(const LocalMesh& whole, const ImprovementOptions& options, std::uint32_t tetrahedron);

  /** As it was cut out. */
  const LocalMesh& Mesh() const { return this->TheMesh; }
  /** What may be done to it. */
  const ImprovementOptions& Options() const { return this->TheOptions; }
  /** By point: its id in the whole. */
  const std::vector<std::uint32_t>& Ids() const { return this->TheIds; }

  /** Whether a tetrahedron of what the piece has become may be changed. */
  bool IsFree(const LocalMesh& mesh, std::uint32_t tetrahedron) const;

  /** A change of the piece, or of what it has become. */
  struct Step
  {
    Step(Change change, const LocalMesh& mesh);

    Change Way;
    std::vector<Corners> Old; ///< of what it replaces, as the whole has other numbers for that
  };
  /** Does changes to the whole, where that is still as it was when the piece was cut out.
   *  @param changed gets the tetrahedra that are not as they were */
  void DoInWhole(
    const std::vector<Step>& steps, LocalMesh& whole, std::vector<std::uint32_t>& changed) const;

private:
  static constexpr int Reach = 3;

  TetrahedronMesh CutOut(
    const LocalMesh& whole, const ImprovementOptions& options, std::uint32_t tetrahedron);

  std::vector<std::uint32_t> TheIds;
  std::vector<int> Away; ///< by point: how many edges from the tetrahedron
  ImprovementOptions TheOptions;
  LocalMesh TheMesh;
};

}

#endif
