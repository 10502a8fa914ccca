// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondEdges_h
#define isodiamond_DiamondEdges_h

#include "Field/DiamondSigns.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/** What the signs of vertices say about the diamonds of a hierarchy, by rank. No encoding holds it:
 *  encoding finds it on the way, otherwise it is derived. */
struct DiamondEdges
{
  /** Mask of the subdivision edges that the isosurface, or the lower surface, crosses; from bit 12
   *  on the kind, and from 14 on the sign of the centre. */
  std::vector<std::uint16_t> LowerAndKinds;
  std::vector<std::uint16_t> Upper; ///< those that the upper one crosses; interval volumes only

  DiamondEdges() = default;
  DiamondEdges(std::int64_t size, const Isoregion& region)
    : LowerAndKinds(size)
    , Upper(region.IsVolume() ? size : 0)
  {
  }

  /** @param sign of the centre, 0 if it has no sample */
  void Set(std::int64_t rank, int sign, const DiamondSigns& signs)
  {
    this->LowerAndKinds[rank] = static_cast<std::uint16_t>(signs.CrossedEdges(0) |
      (static_cast<std::uint32_t>(signs.KindOfDiamond()) << 12) |
      (static_cast<std::uint32_t>(sign) << 14));
    if (!this->Upper.empty())
    {
      this->Upper[rank] = static_cast<std::uint16_t>(signs.CrossedEdges(1));
    }
  }

  std::uint32_t LowerOf(std::int64_t rank) const { return this->LowerAndKinds[rank] & AllEdges; }
  /** None for an isosurface. */
  std::uint32_t UpperOf(std::int64_t rank) const
  {
    return this->Upper.empty() ? 0 : this->Upper[rank];
  }
  Kind KindOf(std::int64_t rank) const
  {
    return static_cast<Kind>((this->LowerAndKinds[rank] >> 12) & 3);
  }
  int SignOf(std::int64_t rank) const { return SignIn(this->LowerAndKinds[rank]); }
  /** The same, in an element of LowerAndKinds. */
  static int SignIn(std::uint16_t element) { return element >> 14; }

  /** How many isovertices a diamond has. */
  int IsovertexCount(std::int64_t rank) const
  {
    return PopCount(this->LowerOf(rank)) + PopCount(this->UpperOf(rank));
  }
  /** Whether its centre lies inside of an interval volume. */
  bool IsInside(std::int64_t rank) const
  {
    return !this->Upper.empty() && this->SignOf(rank) == InsideSign;
  }
};

}

#endif
