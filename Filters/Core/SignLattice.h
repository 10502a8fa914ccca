// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SignLattice_h
#define isodiamond_SignLattice_h

#include "Parallel.h"
#include "Samples.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The signs of all samples, one bit each, for every scale a lattice of its own: bit (x, y, z) of
 * scale s is the sign of the sample at (x, y, z) << s. It is the one pass over the volume that
 * building from samples needs for classification; all scales together take 1/7 of a byte a sample.
 */
class SignLattice
{
public:
  SignLattice(
    const Grid& grid, const AnySamples& samples, double isovalue, const ParallelFor& parallelFor);

  /** Sign of a sampled position. */
  int Sign(int scale, const Point& position) const
  {
    const Level& level = this->Levels[scale];
    const std::uint64_t word =
      level.Bits[level.RowIndex(position[1], position[2]) + (position[0] >> 6)];
    return static_cast<int>((word >> (position[0] & 63)) & 1U);
  }

  /**
   * Ten signs of a row, positions x0 - 1 .. x0 + 8 (bit 0 is x0 - 1; x0 a multiple of 8), and the
   * mask of those that are sampled. Signs without a sample are 0.
   */
  struct Row
  {
    std::uint32_t Signs = 0;
    std::uint32_t Sampled = 0;
  };
  Row Load(int scale, int x0, int y, int z) const;

private:
  struct Level
  {
    std::array<int, 3> Count{};
    std::int64_t Words = 0; ///< words a row
    std::vector<std::uint64_t> Bits;

    std::int64_t RowIndex(int y, int z) const
    {
      return (std::int64_t{ z } * this->Count[1] + y) * this->Words;
    }
  };

  std::vector<Level> Levels;
};

}

#endif
