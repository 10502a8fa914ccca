// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BlockRanges_h
#define isodiamond_BlockRanges_h

#include "Parallel.h"
#include "Samples.h"

#include <array>
#include <vector>

namespace isodiamond
{

/**
 * The value ranges of blocks of 8 x 8 x 8 samples, the last ones smaller: what tells that a block
 * need not be looked at. Blocks with a sample that is not finite have an infinite range.
 */
class BlockRanges
{
public:
  static constexpr int Size = 8;

  BlockRanges(const AnySamples& samples, const ParallelFor& parallelFor);

  /** @param block coordinates of its first sample, divided by Size */
  const ValueRange& operator()(const Point& block) const
  {
    return this
      ->Ranges[(std::int64_t{ block[2] } * this->Count[1] + block[1]) * this->Count[0] + block[0]];
  }

private:
  std::array<int, 3> Count{};
  std::vector<ValueRange> Ranges;
};

}

#endif
