// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestAttempt_h
#define isodiamond_BestAttempt_h

#include "Field/Parallel.h"
#include "Stuffing/Background.h"
#include "Stuffing/Coarsening.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/KnownChanges.h"

#include <vector>

namespace isodiamond
{

/**
 * Finds the best that improvement and detours make of a mesh of leaves that have been cut.
 *
 * As cut, surfaces never intersect; but improvement moves them, and where sheets are near to each
 * other they may get through each other. So where they do, surfaces are held: they stay as cut in
 * the leaves there and all around these, and everything is improved again. What that leaves is
 * taken unless more of its angles are bad: in white noise, there is often no room for both, and
 * angles come first.
 */
class BestAttempt
{
public:
  /** All of these must outlive it, except for the options.
   *  @param start improved each time
   *  @param measured what surfaces are measured by, before anything that is long is done; null if
   *         they are not
   *  @param known see Improve() */
  BestAttempt(const Background& background, const TetrahedronMesh& start,
    const ImprovementOptions& options, const CoarseningInput* measured,
    const ParallelFor& parallelFor, KnownChanges* known);

  struct Attempt
  {
    TetrahedronMesh Mesh;
    /** The leaves where it is too far away, if that was found out (Coarsening.h): then the mesh is
     *  not finished. */
    std::vector<std::uint32_t> FarLeaves;
  };
  Attempt Find();

private:
  Attempt Try();
  std::size_t CountBad(const TetrahedronMesh& mesh) const;
  bool HoldIntersecting(const TetrahedronMesh& mesh);

  const Background& Leaves;
  const TetrahedronMesh& Start;
  ImprovementOptions Options;
  const CoarseningInput* Measured;
  const ParallelFor& ForAll;
  KnownChanges* Known;
};

}

#endif
