// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CellsAtPoints_h
#define isodiamond_CellsAtPoints_h

#include "Simplification/IdRange.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace isodiamond
{

/** The cells at each point of a mesh, ascending. */
class CellsAtPoints
{
public:
  using Cells = IdRange;

  CellsAtPoints() = default;

  /** @param pointsOf (cell) -> its points, a range
   *  @throws std::length_error if they are more than 2^32 - 1 */
  template <typename PointsOf>
  CellsAtPoints(std::size_t pointCount, std::size_t cellCount, PointsOf&& pointsOf)
    : First(pointCount + 1)
  {
    // Count, sum up, fill in.
    std::uint64_t total = 0;
    for (std::size_t cell = 0; cell < cellCount; ++cell)
    {
      for (const std::uint32_t point : pointsOf(cell))
      {
        ++this->First[point + 1];
        ++total;
      }
    }
    if (total > std::numeric_limits<std::uint32_t>::max())
    {
      throw std::length_error("A mesh for this may have 2^32 - 1 corners of cells at most.");
    }
    for (std::size_t i = 1; i < this->First.size(); ++i)
    {
      this->First[i] += this->First[i - 1];
    }
    this->Items.resize(this->First.back());
    std::vector<std::uint32_t> next(this->First.begin(), this->First.end() - 1);
    for (std::size_t cell = 0; cell < cellCount; ++cell)
    {
      for (const std::uint32_t point : pointsOf(cell))
      {
        this->Items[next[point]++] = static_cast<std::uint32_t>(cell);
      }
    }
  }

  Cells operator[](std::uint32_t point) const
  {
    return { this->Items.data() + this->First[point], this->Items.data() + this->First[point + 1] };
  }

private:
  std::vector<std::uint32_t> First; ///< by point, into the items
  std::vector<std::uint32_t> Items;
};

}

#endif
