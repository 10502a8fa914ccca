// SPDX-License-Identifier: BSD-3-Clause
#include "Field/CriticalDiamonds.h"

#include "Field/SignBlock.h"
#include "Lattice/SpineRing.h"

namespace isodiamond
{
namespace
{

struct CriticalBrick
{
  std::int64_t Index = 0;
  BrickMask Critical{};
};

/** The critical diamonds of one brick and surface. */
class BrickOfSurface
{
public:
  BrickOfSurface(const SignBlock& block, int surface)
    : Block(block)
    , Surface(surface)
  {
  }

  /** The critical ones of eight positions along x. */
  std::uint64_t CriticalOfRow(int y, int z) const
  {
    std::uint64_t critical = 0;
    ForEachBit(std::uint64_t{ this->Candidates(y, z) },
      [&](int x) {
        critical |= std::uint64_t{ this->IsCritical({ x, y, z }) ? 1U : 0U } << x;
      });
    return critical;
  }

private:
  /** Positions whose spine has both ends on the side where the centre is not. */
  std::uint32_t Candidates(int y, int z) const
  {
    const SignLattice::Row& centre = this->Block.RowAt(y, z, { 0, 0, 0 });
    const std::uint32_t above = centre.Above[this->Surface] >> 1;
    const std::uint32_t below = centre.Below(this->Surface) >> 1;
    std::uint32_t candidates = 0;
    for (int type = 0; type < 4; ++type) // whether x is odd, and x >> 1
    {
      const int odd = type & 1;
      const int high = type >> 1;
      const int parity = odd | ((y & 1) << 1) | ((z & 1) << 2);
      if (parity == 0)
      {
        continue;
      }
      const std::uint32_t positions = (odd != 0 ? 0xaaU : 0x55U) & (high != 0 ? 0xccU : 0x33U);
      const Point end = tables::SpineEnd(parity, high | (y & 2) | ((z & 2) << 1));
      const SignLattice::Row& first = this->Block.RowAt(y, z, end);
      const SignLattice::Row& second = this->Block.RowAt(y, z, -1 * end);
      const std::uint32_t endsAbove = (first.Above[this->Surface] >> (1 + end[0])) &
        (second.Above[this->Surface] >> (1 - end[0]));
      const std::uint32_t endsBelow = (first.Below(this->Surface) >> (1 + end[0])) &
        (second.Below(this->Surface) >> (1 - end[0]));
      candidates |= positions & ((above & endsBelow) | (below & endsAbove));
    }
    return candidates;
  }

  /** Whether the sides change otherwise than they should along the ring of a candidate. */
  bool IsCritical(const Point& position) const
  {
    const SpineRing& ring = RingOf(position);
    const TypeTable& shape = ShapeOf(position);
    const auto signsOf = [&](int i) // 0 below, 1 above, -1 without a sample
    {
      const Point& offset = shape.Offsets[ring.Vertices[i]];
      const SignLattice::Row& row = this->Block.RowAt(position[1], position[2], offset);
      const int bit = position[0] + 1 + offset[0];
      const bool isSampled = ((row.Sampled >> bit) & 1U) != 0;
      return isSampled ? static_cast<int>((row.Above[this->Surface] >> bit) & 1U) : -1;
    };
    int changes = 0;
    bool isOpen = false;
    int last = signsOf(ring.Count - 1);
    for (int i = 0; i < ring.Count; ++i)
    {
      const int next = signsOf(i);
      isOpen = isOpen || next < 0;
      changes += last >= 0 && next >= 0 && last != next ? 1 : 0;
      last = next;
    }
    return changes != (isOpen ? 1 : 2);
  }

  const SignBlock& Block;
  int Surface;
};

CriticalBrick FindInBrick(const SignBlock& block, int surfaces, std::int64_t index)
{
  CriticalBrick brick{ index };
  for (int surface = 0; surface < surfaces; ++surface)
  {
    const BrickOfSurface rows(block, surface);
    for (int z = 0; z < 8; ++z)
    {
      for (int y = 0; y < 8; ++y)
      {
        brick.Critical[z] |= rows.CriticalOfRow(y, z) << (8 * y);
      }
    }
  }
  return brick;
}

}

DiamondMask CriticalDiamonds(
  const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor)
{
  DiamondMask result(grid);
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    const BrickBox& box = result.Box(scale);
    const auto find = [&](std::int64_t index, std::vector<CriticalBrick>& list)
    {
      if (signs.AreEqualAround(scale, box.Origin(index)))
      {
        return;
      }
      const SignBlock block(signs, scale, box.Origin(index));
      if (block.IsMixed())
      {
        const CriticalBrick brick = FindInBrick(block, signs.SurfaceCount(), index);
        if (brick.Critical != BrickMask{})
        {
          list.push_back(brick);
        }
      }
    };
    for (const auto& row : FindInRows<CriticalBrick>(box, parallelFor, find))
    {
      for (const CriticalBrick& brick : row)
      {
        result.Insert(scale, brick.Index, brick.Critical);
      }
    }
  }
  return result;
}

}
