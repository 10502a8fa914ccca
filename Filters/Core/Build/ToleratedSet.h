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

/** What one mesh goes by; its answers are the same for all peers, whenever it is asked. */
struct ToleratedBy
{
  /** The greatest code that is tolerated of a diamond. */
  std::function<ErrorCode::Type(const Place&)> Accepted;
  /** Whether a diamond is subdivided whenever it is reached, whatever its error. */
  std::function<bool(const Place&, std::uint32_t rank)> IsAlways;
};

/**
 * The diamonds that a mesh subdivides: the smallest closed set such that no diamond outside it, but
 * with a parent in it, exceeds what is tolerated of that diamond.
 *
 * From coarse to fine, in rounds: diamonds that have a subdivided parent and have not been looked
 * at are tested; those that exceed what is tolerated are subdivided, with all ancestors. The rest,
 * above all the scales below the mesh's own, are never looked at.
 *
 * @param relevant an RI, whatever its error codes
 * @return codes by rank, like those of thresholds: Always, or Least
 */
std::vector<ErrorCode::Type> ToleratedSet(const IsodiamondHierarchy& relevant,
  const DistanceTests& tests, const ToleratedBy& by, const Loops& loops, Peers* peers);

}

#endif
