// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Surroundings_h
#define isodiamond_Surroundings_h

#include "Stuffing/Change.h"
#include "Stuffing/Improvement.h"

#include <vector>

namespace isodiamond
{

/**
 * A copy of what a mesh has around one of its tetrahedra, with its own ids, to try changes on.
 *
 * How far away a point is counts in edges from the tetrahedron. The copy has all tetrahedra at
 * points at most Reach away; those whose points are all less than Reach away are free. All that
 * BestChange() reads for a free one is there, and remains so when free ones change: a point less
 * than Reach away only gets neighbours all of whose tetrahedra are there.
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

  /** Whether a tetrahedron may be changed, in what the copy has become. */
  bool IsFree(const LocalMesh& mesh, std::uint32_t tetrahedron) const;

  /** Makes changes in the whole, where it is still as it was when copied.
   *  @param steps changes of the copy, and of what it has become
   *  @param changed receives the tetrahedra that are not as they were */
  void DoInWhole(const std::vector<StoredChange>& steps, LocalMesh& whole,
    std::vector<std::uint32_t>& changed) const;

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
