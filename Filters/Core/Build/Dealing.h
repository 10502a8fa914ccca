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
 * Slabs of samples and portions of the diamonds need not be cut at the same slices, as all portions
 * have equally much of the surface. What a peer finds in its slabs, it deals to the peers that have
 * the diamonds. All peers go through all diamonds, some at a time: little work next to measuring
 * distances, but no less with more peers.
 */
class Dealing
{
public:
  /** All peers tell of the diamonds of this scale and coarser ones: these reach through many slabs,
   *  and are few. */
  static constexpr int FirstCommonScale = 4;

  /** All arguments but the slabs must outlive it.
   *  @param members of the portion @param slabs that this process has */
  Dealing(const Grid& grid, const PeerPortion& portion, const DiamondSet& members,
    const std::vector<SliceRange>& slabs);

  /** The diamonds that the slabs tell of: at fine scales, those with their centre in them. */
  const DiamondSet& OfSlabs() const { return this->Told; }

  /** Turns what peers have encoded of these into the encoding of the portion. */
  Encoded Deal(Encoded told) const;

  /** The same for codes of these, 0 where other peers tell. */
  std::vector<ErrorCode::Type> Deal(const std::vector<ErrorCode::Type>& told) const;

private:
  DiamondExchange Exchange() const;

  const PeerPortion& Portion;
  const DiamondSet& Members;
  DiamondSet Told;
};

}

#endif
