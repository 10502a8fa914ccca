// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ActivationThresholds_h
#define isodiamond_ActivationThresholds_h

#include "Field/PeerPortion.h"
#include "Hierarchy/ErrorCode.h"
#include "Lattice/DiamondSet.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The activation thresholds of a closed set of diamonds.
 *
 * The paper refines top-down: a diamond of the front is subdivided if its own error exceeds the
 * tolerance t, or if a diamond that must be subdivided needs it (closure over all parents). The
 * sets R(t) that this reaches are nested, so every diamond has a *threshold* theta with
 * R(t) = {theta > t}. They are the least solution of
 *
 *   theta(root) = own(root),
 *   theta(d) = max(min(own(d), max of theta over parents), max of theta over children).
 *
 * (Paper, sections 4.2 and 7.3; theta retains the relevant diamonds' part in closure when MI drops
 * them.)
 *
 * @param members a set that holds all ancestors of each of its diamonds (below scale N)
 * @param own by rank, the code of a diamond's own error; 0 where only closure subdivides it
 * @param portion of the hierarchy that the members make up: all peers together find the thresholds
 *        of the whole, in rounds. Null if the members are the whole
 * @return by rank, the threshold's code; 0 for diamonds never reached (none, if the members
 *         are the ancestors of diamonds with an own error that counts)
 */
std::vector<ErrorCode::Type> ActivationThresholds(const Grid& grid, const DiamondSet& members,
  std::vector<ErrorCode::Type> own, const ParallelFor& parallelFor,
  const PeerPortion* portion = nullptr);

/**
 * The *followers*: diamonds whose own error exceeds their threshold. No parent of such a diamond is
 * subdivided at the tolerances between the two, or the diamond would be, too. But where something
 * else subdivides a parent, it can become a leaf with an error that is not tolerated: it has to
 * follow.
 *
 * @param own,thresholds by rank, before and after ActivationThresholds()
 * @return ranks, ascending
 */
std::vector<std::uint32_t> FindFollowers(
  const std::vector<ErrorCode::Type>& own, const std::vector<ErrorCode::Type>& thresholds);

/**
 * Raises errors, where there are any, to the thresholds due to them. Neither these nor the
 * followers change: a threshold is never above the greatest of the parents', so what it is due to
 * itself stays the least of that and the error.
 *
 * @param own by rank, a diamond's own error; 0 for none, which stays so
 * @param grid, members, portion as above
 */
void RaiseToThresholds(const Grid& grid, const DiamondSet& members,
  std::vector<ErrorCode::Type>& own, const ParallelFor& parallelFor,
  const PeerPortion* portion = nullptr);

/**
 * Raises codes to the greatest of their descendants', and those of followers to the greatest of
 * their parents': each diamond is subdivided where any of these is. The least solution, as above.
 *
 * @param members, codes, portion as above
 * @param followers ranks
 */
std::vector<ErrorCode::Type> SaturateUpward(const Grid& grid, const DiamondSet& members,
  const std::vector<ErrorCode::Type>& codes, const std::vector<std::uint32_t>& followers,
  const ParallelFor& parallelFor, const PeerPortion* portion = nullptr);

}

#endif
