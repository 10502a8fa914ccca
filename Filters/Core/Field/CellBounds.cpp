// SPDX-License-Identifier: BSD-3-Clause
#include "Field/CellBounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace isodiamond
{
namespace
{

constexpr float Infinite = std::numeric_limits<float>::infinity();

float RoundedDown(double value)
{
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -Infinite) : nearest;
}

float RoundedUp(double value)
{
  return -RoundedDown(-value);
}

/** Half as many on each axis, rounded up. */
std::array<int, 3> Halved(const std::array<int, 3>& size)
{
  return { (size[0] + 1) / 2, (size[1] + 1) / 2, (size[2] + 1) / 2 };
}

/** Calls body(point) for all from low to before high. */
template <typename Body>
void ForEachPoint(const Point& low, const Point& high, Body&& body)
{
  for (int z = low[2]; z < high[2]; ++z)
  {
    for (int y = low[1]; y < high[1]; ++y)
    {
      for (int x = low[0]; x < high[0]; ++x)
      {
        body(Point{ x, y, z });
      }
    }
  }
}

}

CellBounds::Level::Level(const std::array<int, 3>& size)
  : Size(size)
  , Blocks(std::size_t{ 1 } * size[0] * size[1] * size[2],
      Block{ { Infinite, Infinite, Infinite }, { -Infinite, -Infinite, -Infinite } })
{
}

CellBounds::CellBounds(
  const std::array<int, 3>& samples, const std::function<Vector(const Point&)>& positionOf)
  : Cells{ samples[0] - 1, samples[1] - 1, samples[2] - 1 }
  , Origin(positionOf({ 0, 0, 0 }))
{
  const auto include =
    [](Block& block, const std::array<float, 3>& low, const std::array<float, 3>& high)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      block.Low[axis] = std::min(block.Low[axis], low[axis]);
      block.High[axis] = std::max(block.High[axis], high[axis]);
    }
  };
  // Each sample counts for the blocks that have cells on its sides.
  Level finest(Halved(this->Cells));
  ForEachPoint({ 0, 0, 0 }, samples,
    [&](const Point& sample)
    {
      const Vector offset = positionOf(sample) - this->Origin;
      std::array<float, 3> low;
      std::array<float, 3> high;
      Point first{};
      Point end{};
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = RoundedDown(offset[axis]);
        high[axis] = RoundedUp(offset[axis]);
        first[axis] = std::max(sample[axis] - 1, 0) / 2;
        end[axis] = std::min(sample[axis], this->Cells[axis] - 1) / 2 + 1;
      }
      ForEachPoint(first, end, [&](const Point& block) { include(finest.At(block), low, high); });
    });
  this->Levels.push_back(std::move(finest));
  while (this->Levels.back().Blocks.size() > 1)
  {
    const Level& finer = this->Levels.back();
    Level coarser(Halved(finer.Size));
    ForEachPoint({ 0, 0, 0 }, finer.Size,
      [&](const Point& block)
      {
        const Block& half = finer.At(block);
        include(coarser.At({ block[0] / 2, block[1] / 2, block[2] / 2 }), half.Low, half.High);
      });
    this->Levels.push_back(std::move(coarser));
  }
}

Bounds CellBounds::Of(const Point& low, const Point& high) const
{
  // On a level where these are few.
  std::size_t level = 0;
  const auto isLong = [&](int axis) { return (high[axis] - low[axis]) >> (level + 1) > 4; };
  while (level + 1 < this->Levels.size() && (isLong(0) || isLong(1) || isLong(2)))
  {
    ++level;
  }
  Point first{};
  Point end{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = this->Cells[axis] - 1;
    first[axis] = std::clamp(low[axis], 0, last) >> (level + 1);
    end[axis] = (std::clamp(high[axis] - 1, 0, last) >> (level + 1)) + 1;
  }
  Bounds all;
  ForEachPoint(
    first, end, [&](const Point& block) { all.Add(this->Placed(this->Levels[level].At(block))); });
  return all;
}

Bounds CellBounds::IndexBoxOf(const Bounds& box) const
{
  Bounds found;
  this->Look(this->Levels.size() - 1, { 0, 0, 0 }, box, found);
  return found;
}

void CellBounds::Look(std::size_t level, const Point& block, const Bounds& box, Bounds& found) const
{
  Bounds cells;
  for (int axis = 0; axis < 3; ++axis)
  {
    cells.Low[axis] = block[axis] << (level + 1);
    cells.High[axis] = std::min((block[axis] + 1) << (level + 1), this->Cells[axis]);
  }
  if (found.Holds(cells) || !this->Placed(this->Levels[level].At(block)).Meets(box))
  {
    return;
  }
  if (level == 0)
  {
    found.Add(cells);
    return;
  }
  const std::array<int, 3>& size = this->Levels[level - 1].Size;
  const Point first = 2 * block;
  const Point end = { std::min(first[0] + 2, size[0]), std::min(first[1] + 2, size[1]),
    std::min(first[2] + 2, size[2]) };
  ForEachPoint(first, end, [&](const Point& half) { this->Look(level - 1, half, box, found); });
}

Bounds CellBounds::Placed(const Block& block) const
{
  Bounds box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.Low[axis] = this->Origin[axis] + block.Low[axis];
    box.High[axis] = this->Origin[axis] + block.High[axis];
  }
  return box;
}

}
