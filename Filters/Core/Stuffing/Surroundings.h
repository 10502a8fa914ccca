// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Surroundings_h
#define isodiamond_Surroundings_h

#include "Stuffing/Change.h"
#include "Stuffing/Improvement.h"

#include <vector>

namespace isodiamond
{

/**
 * A copy of what a mesh has around one of its tetrahedra, with ids of its own, to try changes on.
 *
 * Its points are some edges away from the tetrahedron. It has all tetrahedra at points that are no
 * more than Reach away; free are those with no point as far away as that. All that BestChange()
 * reads of a free one is there, and stays so when free ones change: a point that is less than Reach
 * away only gets neighbours of which all tetrahedra are there.
 */
class Surroundings
{
public:
  Surroundings(
    const LocalMesh& whole, const ImprovementOptions& options, std::uint32_t tetrahedron);

  /** As it was copied. */
  const LocalMesh& Mesh() const { return this->TheMesh; }
  /** What may be done to it. */
  const ImprovementOptions& Options() const { return this->TheOptions; }
  /** By point: its id in the whole. */
  const std::vector<std::uint32_t>& Ids() const { return this->TheIds; }

  /** Whether a tetrahedron of what has become of the copy may be changed. */
  bool IsFree(const LocalMesh& mesh, std::uint32_t tetrahedron) const;

  /** A change of the copy, or of what has become of it. */
  struct Step
  {
    Step(Change change, const LocalMesh& mesh);

    Change Way;
    std::vector<Corners> Old; ///< of what it replaces, as the whole has other numbers for that
  };
  /** Does changes to the whole, where that is still as it was when it was copied.
   *  @param changed gets the tetrahedra that are not as they were */
  void DoInWhole(
    const std::vector<Step>& steps, LocalMesh& whole, std::vector<std::uint32_t>& changed) const;

private:
  static constexpr int Reach = 3;

  TetrahedronMesh CopyOf(
    const LocalMesh& whole, const ImprovementOptions& options, std::uint32_t tetrahedron);

  std::vector<std::uint32_t> TheIds;
  std::vector<int> Away; ///< by point: how many edges from the tetrahedron
  ImprovementOptions TheOptions;
  LocalMesh TheMesh;
};

}

#endif
