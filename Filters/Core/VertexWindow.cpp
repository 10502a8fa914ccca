// SPDX-License-Identifier: BSD-3-Clause
#include "VertexWindow.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** The bits of a brick's word whose x and y lie in ranges, ends included. */
std::uint64_t BitsBetween(int firstX, int lastX, int firstY, int lastY)
{
  const std::uint64_t row = (0xffU >> (7 - lastX)) & (0xffU << firstX);
  const std::uint64_t rows =
    (~std::uint64_t{ 0 } >> (8 * (7 - lastY))) & (~std::uint64_t{ 0 } << (8 * firstY));
  return (row * 0x0101010101010101U) & rows;
}

}

VertexWindow::VertexWindow(const ExtractionPasses& passes, std::int64_t number, int maximumStep)
{
  const RefinedBrick brick = passes.BrickAt(number);
  this->First = brick.Origin() + Point{ -1, -1, -1 };
  const int coarsest = passes.Refined().Diamonds().ScaleCount() - 1;
  for (int step = 0; step <= std::min(maximumStep, coarsest - brick.Scale()); ++step)
  {
    this->Fill(passes, brick.Scale() + step, step);
  }
}

/** Adds the diamonds of a scale. @param step that scale minus the brick's */
void VertexWindow::Fill(const ExtractionPasses& passes, int scale, int step)
{
  const BrickLevel& level = passes.Refined().Diamonds().Level(scale);
  Point first{};
  Point last{};
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = (this->First[axis] + (1 << step) - 1) >> step;
    last[axis] = (this->First[axis] + Width - 1) >> step;
  }
  for (int z = first[2] >> 3; z <= last[2] >> 3; ++z)
  {
    for (int y = first[1] >> 3; y <= last[1] >> 3; ++y)
    {
      for (int x = first[0] >> 3; x <= last[0] >> 3; ++x)
      {
        const std::int64_t index = level.Box.Index({ x, y, z });
        if (index >= 0 && level.Lookup[index] >= 0)
        {
          this->FillFrom(passes, { scale, level.Lookup[index] }, 8 * Point{ x, y, z }, step);
        }
      }
    }
  }
}

/** Adds those diamonds of a brick that lie in the window. */
void VertexWindow::FillFrom(
  const ExtractionPasses& passes, const BrickPlace& place, const Point& origin, int step)
{
  const BrickLevel& level = passes.Refined().Diamonds().Level(place.Scale);
  const std::int64_t number = level.FirstNumber + place.Index;
  if (!passes.HasPoints(number))
  {
    return;
  }
  const Brick& brick = level.Bricks[place.Index];
  std::array<int, 3> from{};
  std::array<int, 3> to{};
  for (int axis = 0; axis < 3; ++axis)
  {
    from[axis] = std::max(((this->First[axis] + (1 << step) - 1) >> step) - origin[axis], 0);
    to[axis] = std::min(((this->First[axis] + Width - 1) >> step) - origin[axis], 7);
  }
  const std::uint64_t bits = BitsBetween(from[0], to[0], from[1], to[1]);
  for (int z = from[2]; z <= to[2]; ++z)
  {
    const int start = this->IndexAt((1 << step) * (origin + Point{ 0, 0, z }));
    ForEachBit(brick.Occupancy[z] & bits,
      [&](int bit)
      {
        this->Points[start + ((bit & 7) << step) + ((Width * (bit >> 3)) << step)] =
          passes.PointsOf(number, brick.Rank(z, bit));
      });
  }
}

}
