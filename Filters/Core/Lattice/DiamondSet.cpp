// SPDX-License-Identifier: BSD-3-Clause
#include "Lattice/DiamondSet.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>

namespace isodiamond
{
namespace
{

/** The masks of a brick and of those behind its faces. */
using Neighbours = std::array<BrickMask, 7>;
constexpr std::array<Point, 7> NeighbourOffsets = { { { 0, 0, 0 }, { -1, 0, 0 }, { 1, 0, 0 },
  { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 } } };

constexpr std::uint64_t OddX = 0xaaaaaaaaaaaaaaaaU;
constexpr std::uint64_t OddY = 0xff00ff00ff00ff00U;
constexpr std::uint64_t FirstX = 0x0101010101010101U;
constexpr std::uint64_t LastX = 0x8080808080808080U;

/** Takes one step both ways from each diamond of a class (1 or 2), on each axis on which its
 *  position is even. */
Neighbours StepOnEvenAxes(const BrickMask& mask, int diamondClass)
{
  const bool oneIsOdd = diamondClass == 2; // otherwise two are
  Neighbours result{};
  for (int z = 0; z < 8; ++z)
  {
    const bool isOdd = (z & 1) != 0;
    // Even on this axis; of the other two, one or both are odd.
    const std::uint64_t onX =
      mask[z] & ~OddX & (isOdd == oneIsOdd ? ~OddY : OddY) & (isOdd || oneIsOdd ? ~0ULL : 0);
    const std::uint64_t onY =
      mask[z] & ~OddY & (isOdd == oneIsOdd ? ~OddX : OddX) & (isOdd || oneIsOdd ? ~0ULL : 0);
    const std::uint64_t onZ = isOdd ? 0 : mask[z] & (oneIsOdd ? OddX ^ OddY : OddX & OddY);
    result[0][z] |= (onX & ~FirstX) >> 1 | (onX & ~LastX) << 1 | onY >> 8 | onY << 8;
    result[1][z] |= (onX & FirstX) << 7;
    result[2][z] |= (onX & LastX) >> 7;
    result[3][z] |= onY << 56;
    result[4][z] |= onY >> 56;
    (z > 0 ? result[0][z - 1] : result[5][7]) |= onZ;
    (z < 7 ? result[0][z + 1] : result[6][0]) |= onZ;
  }
  return result;
}

/** The bits of a brick's mask that are valid positions of the scale. */
BrickMask Within(BrickMask mask, const Point& origin, const std::array<int, 3>& positions)
{
  const std::uint64_t bits = BitsBetween(
    0, std::min(positions[0] - origin[0], 8) - 1, 0, std::min(positions[1] - origin[1], 8) - 1);
  for (int z = 0; z < 8; ++z)
  {
    mask[z] &= origin[2] + z < positions[2] ? bits : 0;
  }
  return mask;
}

}

DiamondMask::DiamondMask(const Grid& grid)
  : Levels(grid.Depth() + 1)
{
  for (int scale = 0; scale <= grid.Depth(); ++scale)
  {
    this->Levels[scale].Box = BrickBox(grid.Positions(scale));
    this->Levels[scale].Lookup.assign(this->Levels[scale].Box.Size(), -1);
  }
}

BrickMask& DiamondMask::BrickAt(Level& level, std::int64_t brickIndex)
{
  std::int32_t& entry = level.Lookup[brickIndex];
  if (entry < 0)
  {
    entry = static_cast<std::int32_t>(level.Masks.size());
    level.Masks.push_back(BrickMask{});
  }
  return level.Masks[entry];
}

/** From the finest scale and the youngest class upward. */
void DiamondMask::CloseOverParents(const Grid& grid)
{
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    this->AddParentsOfScale(grid, scale, 2);
    this->AddParentsOfScale(grid, scale, 1);
    if (scale + 1 < grid.Depth())
    {
      this->AddParentsOfCoarserScale(grid, scale);
    }
  }
}

/** Parents of diamonds of class 2 and 1 are their neighbours on the axes on which they are even. */
void DiamondMask::AddParentsOfScale(const Grid& grid, int scale, int diamondClass)
{
  const BrickBox& box = this->Levels[scale].Box;
  const std::array<int, 3> positions = grid.Positions(scale);
  for (std::int64_t index = 0; index < box.Size(); ++index)
  {
    const BrickMask* found = this->Find(scale, index);
    const Neighbours parents =
      found != nullptr ? StepOnEvenAxes(*found, diamondClass) : Neighbours{};
    for (int i = 0; found != nullptr && i < 7; ++i)
    {
      const Point brick = BrickOf(box.Origin(index)) + NeighbourOffsets[i];
      if (const std::int64_t at = box.Index(brick); at >= 0)
      {
        this->Insert(scale, at, Within(parents[i], 8 * brick, positions));
      }
    }
  }
}

void DiamondMask::AddParentsOfCoarserScale(const Grid& grid, int scale)
{
  this->ForEachOfClass(scale, 0,
    [&](const Place& place)
    {
      const TypeTable& shape = ShapeOf(place.Position);
      for (int i = 0; i < shape.ParentCount; ++i)
      {
        const Place parent = ParentPlace(shape, place, i);
        if (grid.IsValid(parent.Position, parent.Scale))
        {
          this->Insert(parent);
        }
      }
    });
}

std::int64_t DiamondMask::Size() const
{
  std::int64_t size = 0;
  for (const Level& level : this->Levels)
  {
    for (const BrickMask& mask : level.Masks)
    {
      for (const std::uint64_t word : mask)
      {
        size += PopCount(word);
      }
    }
  }
  return size;
}

bool DiamondMask::Insert(const Place& place)
{
  Level& level = this->Levels[place.Scale];
  std::uint64_t& word =
    this->BrickAt(level, level.Box.Index(BrickOf(place.Position)))[place.Position[2] & 7];
  const std::uint64_t bit = std::uint64_t{ 1 } << BitOf(place.Position);
  const bool isNew = (word & bit) == 0;
  word |= bit;
  return isNew;
}

void DiamondMask::Insert(int scale, std::int64_t brickIndex, const BrickMask& mask)
{
  if (mask == BrickMask{})
  {
    return; // only bricks with a bit set are kept
  }
  BrickMask& words = this->BrickAt(this->Levels[scale], brickIndex);
  for (int z = 0; z < 8; ++z)
  {
    words[z] |= mask[z];
  }
}

DiamondSet::DiamondSet(const Grid& grid)
  : Levels(grid.Depth() + 1)
{
  for (int scale = 0; scale <= grid.Depth(); ++scale)
  {
    this->Levels[scale].Box = BrickBox(grid.Positions(scale));
    this->Levels[scale].Lookup.assign(this->Levels[scale].Box.Size(), -1);
  }
}

DiamondSet::DiamondSet(const Grid& grid, const DiamondMask& mask)
  : DiamondSet(grid)
{
  mask.ForEachBrick([&](int scale, std::int64_t index, const BrickMask& words)
    { this->Append(scale, index, words); });
}

void DiamondSet::Append(int scale, std::int64_t brickIndex, const BrickMask& mask)
{
  Brick brick;
  brick.Occupancy = mask;
  brick.First = static_cast<std::uint32_t>(this->Count);
  brick.BoxIndex = static_cast<std::uint32_t>(brickIndex);
  int before = 0;
  for (int z = 0; z < 8; ++z)
  {
    brick.Before[z] = static_cast<std::uint16_t>(before);
    before += PopCount(mask[z]);
  }
  if (before == 0)
  {
    return;
  }
  this->Count += before;
  if (this->Count > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("more than 2^32 - 1 isodiamonds");
  }
  BrickLevel& level = this->Levels[scale];
  assert((level.Bricks.empty() || level.Bricks.back().BoxIndex < brick.BoxIndex) &&
    "bricks of a scale in order");
  assert((scale == 0 || this->Levels[scale - 1].Bricks.empty()) && "scales from coarse to fine");
  level.FirstNumber = level.Bricks.empty() ? this->BrickCount : level.FirstNumber;
  ++this->BrickCount;
  level.Lookup[brickIndex] = static_cast<std::int32_t>(level.Bricks.size());
  level.Bricks.push_back(brick);
}

std::vector<BrickPlace> AllBricks(const DiamondSet& set)
{
  std::vector<BrickPlace> all;
  for (int scale = set.ScaleCount() - 1; scale >= 0; --scale)
  {
    const std::int64_t count = static_cast<std::int64_t>(set.Level(scale).Bricks.size());
    for (std::int64_t index = 0; index < count; ++index)
    {
      all.push_back({ scale, index });
    }
  }
  return all;
}

}
