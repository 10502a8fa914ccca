// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/VertexWindow.h"

#include <algorithm>

namespace isodiamond
{
VertexWindow::VertexWindow(const ExtractionPasses& passes, std::int64_t number)
{
  const RefinedBrick brick = passes.BrickAt(number);
  this->First = brick.Origin() + Point{ -1, -1, -1 };
  const int coarsest = passes.Refined().Diamonds().ScaleCount() - 1;
  for (int step = 0; step <= std::min(passes.MaximumStep(), coarsest - brick.Scale()); ++step)
  {
    this->Fill(passes, brick.Scale() + step, step);
  }
}

/** Adds the diamonds of a scale. @param step this scale minus the brick's */
void VertexWindow::Fill(const ExtractionPasses& passes, int scale, int step)
{
  const BrickLevel& level = passes.Refined().Diamonds().Level(scale);
  // On axes where a vertex of the diamond's own scale differs from the diamond, it is odd and the
  // diamond even: it lies in the brick or before it.
  const int width = step == 0 ? Width - 1 : Width;
  Point first{};
  Point last{};
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = (this->First[axis] + (1 << step) - 1) >> step;
    last[axis] = (this->First[axis] + width - 1) >> step;
  }
  level.ForEachBrickBetween(first, last,
    [&](std::int64_t index, const Point& origin)
    {
      const std::int64_t number = level.FirstNumber + index;
      if (!passes.HasPoints(number))
      {
        return;
      }
      const Brick& brick = level.Bricks[index];
      ForEachWordBetween(brick.Occupancy, origin, first, last,
        [&](int z, std::uint64_t bits)
        {
          const int start = this->IndexAt((1 << step) * (origin + Point{ 0, 0, z }));
          ForEachBit(bits,
            [&](int bit)
            {
              const int index = start + ((bit & 7) << step) + ((Width * (bit >> 3)) << step);
              assert(Holds(index));
              this->Points[index] = passes.PointsOf(number, brick.Rank(z, bit));
            });
        });
    });
}

}
