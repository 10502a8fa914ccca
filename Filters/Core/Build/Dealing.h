// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Dealing_h
#define isodiamond_Dealing_h

#include "Build/DiamondExchange.h"
#include "Field/Samples.h"
#include "Hierarchy/IsodiamondHierarchy.h"

#include <vector>

namespace isodiamond
{

/**
 * Slabs of samples and portions of the diamonds need not be cut at the same slices: portions have
 * as much of the surface as one another. What a peer finds in its slabs it deals to who has the
 * diamonds. All of them go through all diamonds, some at once: little work beside measuring
 * distances, but it does not get less with more of them.
 */
class Dealing
{
public:
  /** Scales from this on are told of by all peers: their diamonds reach through many slabs, and are
   *  few. */
  static constexpr int FirstCommonScale = 4;

  /** @param members of the portion @param slabs that this process has; all but these must outlive
   * it
   */
  Dealing(const Grid& grid, const PeerPortion& portion, const DiamondSet& members,
    const std::vector<SliceRange>& slabs);

  /** The diamonds that the slabs tell of: of fine scales those with their centre in them. */
  const DiamondSet& OfSlabs() const { return this->Told; }

  /** What peers have encoded of these, as the encoding of the portion. */
  Encoded Deal(Encoded told) const;

  /** Codes of these, 0 where others tell. */
  std::vector<ErrorCode::Type> Deal(const std::vector<ErrorCode::Type>& told) const;

private:
  DiamondExchange Exchange() const;

  const PeerPortion& Portion;
  const DiamondSet& Members;
  DiamondSet Told;
};

}

#endif
