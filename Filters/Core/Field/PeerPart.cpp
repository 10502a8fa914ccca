// SPDX-License-Identifier: BSD-3-Clause
#include "Field/PeerPart.h"

namespace isodiamond
{
namespace
{

/** Calls body(scale, index of the brick, mask) for the bricks of a mask, coarse to fine, with what
 *  bitsOf(scale, z) leaves of theirs, and at scale N all: all parts have its corners. */
template <typename BitsOf, typename Body>
void ForEachBrick(const DiamondMask& mask, const BitsOf& bitsOf, const Body& body)
{
  const int last = mask.ScaleCount() - 1;
  for (int scale = last; scale >= 0; --scale)
  {
    const BrickBox& box = mask.Box(scale);
    for (std::int64_t index = 0; index < box.Size(); ++index)
    {
      const BrickMask* found = mask.Find(scale, index);
      if (found == nullptr)
      {
        continue;
      }
      BrickMask some = *found;
      const int first = box.Origin(index)[2];
      for (int z = 0; z < 8 && scale < last; ++z)
      {
        some[z] &= bitsOf(scale, first + z);
      }
      if (some != BrickMask{})
      {
        body(scale, index, some);
      }
    }
  }
}

}

PeerPart::PeerPart(const Grid& grid, const std::vector<int>& begins, DiamondMask all, Peers& peers)
  : Part(begins, peers.Rank())
  , Mask(std::move(all))
  , With(peers)
  , Members(grid)
  , EndsOfScales(grid.Depth() + 1, 0)
{
  ForEachBrick(
    this->Mask, [&](int scale, int z) { return this->Part.Has(scale, z); },
    [&](int scale, std::int64_t index, const BrickMask& mask)
    { this->Members.Append(scale, index, mask); });
  ForEachBrick(
    this->Mask, [&](int scale, int z) { return this->Part.AreCommon(scale, z); },
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
