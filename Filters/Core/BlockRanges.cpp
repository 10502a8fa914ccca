// SPDX-License-Identifier: BSD-3-Clause
#include "BlockRanges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isodiamond
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Widens the ranges of the blocks that a row of samples passes through. */
template <typename T>
void AddRow(const T* row, int count, std::vector<ValueRange>::iterator ranges)
{
  for (int begin = 0; begin < count; begin += BlockRanges::Size, ++ranges)
  {
    double low = Infinity;
    double high = -Infinity;
    double invalid = 0.0;
    for (int x = begin; x < std::min(begin + BlockRanges::Size, count); ++x)
    {
      const auto value = static_cast<double>(row[x]);
      low = value < low ? value : low;
      high = value > high ? value : high;
      invalid += value - value; // NaN for values that are not finite
    }
    ranges->Minimum = std::min(ranges->Minimum, invalid == 0.0 ? low : -Infinity);
    ranges->Maximum = std::max(ranges->Maximum, invalid == 0.0 ? high : Infinity);
  }
}

}

BlockRanges::BlockRanges(const AnySamples& samples, const ParallelFor& parallelFor)
{
  std::visit(
    [&](const auto& view)
    {
      const std::array<int, 3>& dims = view.Dimensions();
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Count[axis] = (dims[axis] + Size - 1) / Size;
      }
      this->Ranges.assign(std::size_t{ 1 } * this->Count[0] * this->Count[1] * this->Count[2],
        { Infinity, -Infinity });
      parallelFor(this->Count[2], 1,
        [&](std::int64_t begin, std::int64_t end)
        {
          const int last = std::min(static_cast<int>(end) * Size, dims[2]);
          for (int z = static_cast<int>(begin) * Size; z < last; ++z)
          {
            for (int y = 0; y < dims[1]; ++y)
            {
              const std::int64_t first =
                (std::int64_t{ z / Size } * this->Count[1] + y / Size) * this->Count[0];
              AddRow(
                view.Pointer() + view.Index({ 0, y, z }), dims[0], this->Ranges.begin() + first);
            }
          }
        });
    },
    samples);
}

}
