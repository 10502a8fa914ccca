// SPDX-License-Identifier: BSD-3-Clause
#include "Field/PeerPortion.h"

namespace isodiamond
{
namespace
{

/** How many diamonds of scale 0 each layer of bricks has. */
std::vector<std::int64_t> SizesOfLayers(const DiamondMask& all)
{
  const BrickBox& box = all.Box(0);
  std::vector<std::int64_t> sizes(box.Count[2], 0);
  all.ForEachBrick(
    [&](int scale, std::int64_t index, const BrickMask& mask)
    {
      for (int z = 0; z < 8 && scale == 0; ++z)
      {
        sizes[box.Origin(index)[2] / DiamondPortion::Step] += PopCount(mask[z]);
      }
    });
  return sizes;
}

/** The first slices of portions that have about equally many diamonds. */
std::vector<int> CutEvenly(const DiamondMask& all, int portions)
{
  std::vector<int> begins = EvenCuts(SizesOfLayers(all), portions);
  std::transform(begins.begin(), begins.end(), begins.begin(),
    [](int layer) { return DiamondPortion::Step * layer; });
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
