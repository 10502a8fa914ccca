// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ToleratedSet_h
#define isodiamond_ToleratedSet_h

#include "DistanceError/DistanceTests.h"
#include "Field/Peers.h"
#include "Hierarchy/IsodiamondHierarchy.h"

#include <functional>
#include <vector>

namespace isodiamond
{

/** What one mesh goes by: the same for all peers, whenever it is asked. */
struct ToleratedBy
{
  /** The greatest code that is tolerated of a diamond. */
  std::function<ErrorCode::Type(const Place&)> Accepted;
  /** Whether a diamond is subdivided wherever it is met, whatever its error. */
  std::function<bool(const Place&, std::uint32_t rank)> IsAlways;
};

/**
 * The diamonds that a mesh is subdivided at: the smallest closed set such that no diamond with a
 * parent in the set, and not in it itself, exceeds what is tolerated of it.
 *
 * From coarse to fine, in rounds: those that have a subdivided parent and have not been looked at
 * are tested; who exceeds is subdivided, with all ancestors. The rest is never looked at, most of
 * all scales below the mesh's own.
 *
 * @param relevant an RI, whatever its error codes
 * @return codes by rank, as of thresholds: Always, or Least
 */
std::vector<ErrorCode::Type> ToleratedSet(const IsodiamondHierarchy& relevant,
  const DistanceTests& tests, const ToleratedBy& by, const Loops& loops, Peers* peers);

}

#endif
