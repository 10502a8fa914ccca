// SPDX-License-Identifier: BSD-3-Clause
#include "Field/PeerPortion.h"

#include <numeric>

namespace isodiamond
{
namespace
{

/** The slices that portions begin with which have about as many diamonds, those of scale 0. */
std::vector<int> CutEvenly(const DiamondMask& all, int portions)
{
  const BrickBox& box = all.Box(0);
  std::vector<std::int64_t> before(box.Count[2] + 1, 0); // a layer of bricks
  all.ForEachBrick(
    [&](int scale, std::int64_t index, const BrickMask& mask)
    {
      for (int z = 0; z < 8 && scale == 0; ++z)
      {
        before[box.Origin(index)[2] / DiamondPortion::Step + 1] += PopCount(mask[z]);
      }
    });
  std::partial_sum(before.begin(), before.end(), before.begin());
  std::vector<int> begins(portions, 0);
  for (int portion = 1; portion < portions; ++portion)
  {
    // The layer whose begin is nearest to that share.
    const std::int64_t share = before.back() / portions * portion;
    const auto above = std::lower_bound(before.begin(), before.end(), share);
    const bool isBelowNearer =
      above != before.begin() && share - *std::prev(above) < *above - share;
    begins[portion] = DiamondPortion::Step *
      static_cast<int>((isBelowNearer ? std::prev(above) : above) - before.begin());
  }
  return begins;
}

}

PeerPortion::PeerPortion(const Grid& grid, DiamondMask all, Peers& peers)
  : Portion(CutEvenly(all, peers.Count()), peers.Rank())
  , Mask(std::move(all))
  , With(peers)
  , EndsOfScales(grid.Depth() + 1, 0)
{
  // The corners of the base cube are in all portions.
  const auto orCorners = [&](std::uint64_t (DiamondPortion::*bitsOf)(int, int) const)
  {
    return [this, &grid, bitsOf](int scale, int z)
    { return scale == grid.Depth() ? ~std::uint64_t{ 0 } : (this->Portion.*bitsOf)(scale, z); };
  };
  this->Members = DiamondSet(grid, this->Mask, orCorners(&DiamondPortion::Has));
  this->Mask.ForEachBrick(orCorners(&DiamondPortion::AreCommon),
    [&](int scale, std::int64_t index, const BrickMask& mask)
    {
      const BrickLevel& level = this->Members.Level(scale);
      const Point origin = level.Box.Origin(index);
      const Brick* const here = level.Find(index);
      for (int z = 0; z < 8; ++z)
      {
        ForEachBit(mask[z],
          [&](int bit)
          {
            const std::int64_t rank = DiamondSet::RankIn(here, PositionOf(origin, z, bit));
            this->Common.push_back(
              rank == DiamondSet::None ? NotHere : static_cast<std::uint32_t>(rank));
          });
      }
      this->EndsOfScales[scale] = this->Common.size();
    });
  for (int scale = grid.Depth() - 1; scale >= 0; --scale)
  {
    this->EndsOfScales[scale] = std::max(this->EndsOfScales[scale], this->EndsOfScales[scale + 1]);
  }
}

}
