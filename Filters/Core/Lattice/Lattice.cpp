// SPDX-License-Identifier: BSD-3-Clause
#include "Lattice/Lattice.h"

#include <algorithm>
#include <stdexcept>

namespace isodiamond
{

Grid::Grid(const std::array<int, 3>& dimensions)
  : Dims(dimensions)
{
  const int last = *std::max_element(dimensions.begin(), dimensions.end()) - 1;
  if (*std::min_element(dimensions.begin(), dimensions.end()) < 2 || last > (1 << MaximumDepth))
  {
    throw std::invalid_argument("a grid needs 2 to 2^20 + 1 samples on every axis");
  }
  while ((1 << this->N) < last)
  {
    ++this->N;
  }
}

std::array<int, 3> Grid::SampledPositions(int scale) const
{
  return { (this->Last(0) >> scale) + 1, (this->Last(1) >> scale) + 1,
    (this->Last(2) >> scale) + 1 };
}

int Grid::Scale(const Point& point) const
{
  const std::uint32_t bits = static_cast<std::uint32_t>(point[0] | point[1] | point[2]);
  int scale = 0;
  while (scale < this->N && ((bits >> scale) & 1U) == 0)
  {
    ++scale;
  }
  return scale;
}

bool Grid::SticksOut(const Point& position, int scale) const
{
  const int h = 1 << scale;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Every tetrahedron spans both sides of an odd axis, but lies on one side of an even one.
    const int distance = this->Last(axis) - (position[axis] << scale);
    const bool odd = (position[axis] & 1) != 0;
    if (distance > -h && distance < h && (odd || distance != 0))
    {
      return true;
    }
  }
  return false;
}

}
