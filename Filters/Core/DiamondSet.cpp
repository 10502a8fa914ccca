// SPDX-License-Identifier: BSD-3-Clause
#include "DiamondSet.h"

#include <limits>
#include <stdexcept>

namespace isodiamond
{

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

void DiamondMask::CloseOverParents(const Grid& grid)
{
  // From the finest scale and the youngest class upward.
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (int diamondClass = 2; diamondClass >= 0; --diamondClass)
    {
      this->ForEachOfClass(scale, diamondClass,
        [&](const Place& place)
        {
          const TypeTable& shape = ShapeOf(place.Position);
          for (int i = 0; i < shape.ParentCount; ++i)
          {
            const Place parent = ParentPlace(shape, place, i);
            if (parent.Scale < grid.Depth() && grid.IsValid(parent.Position, parent.Scale))
            {
              this->Insert(parent);
            }
          }
        });
    }
  }
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
  for (int scale = grid.Depth(); scale >= 0; --scale)
  {
    for (std::int64_t index = 0; index < this->Levels[scale].Box.Size(); ++index)
    {
      if (const BrickMask* words = mask.Find(scale, index))
      {
        this->Append(scale, index, *words);
      }
    }
  }
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
