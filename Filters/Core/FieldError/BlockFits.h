// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BlockFits_h
#define isodiamond_BlockFits_h

#include "Field/Parallel.h"
#include "Field/Samples.h"

#include <cmath>
#include <vector>

namespace isodiamond
{

/** What is known of the samples in a closed cube of the lattice. */
struct BlockFit
{
  ValueRange Range; ///< of the samples; infinite if one of them is not finite
  /** A linear function of the distance from the cube's first corner, and how far from it the
   *  samples lie at most: infinite if one of them is not finite, void if the cube reaches past the
   *  grid. */
  float Value = 0.0F;
  std::array<float, 3> Slopes{};
  float Residual = 0.0F;

  double At(const Point& offset) const
  {
    return double{ this->Value } + double{ this->Slopes[0] } * offset[0] +
      double{ this->Slopes[1] } * offset[1] + double{ this->Slopes[2] } * offset[2];
  }
  bool IsFinite() const { return this->Residual < HUGE_VALF; }
};

/**
 * Linear fits to the samples in cubes of 8, 16, 32, ... lattice edges: what tells that a part of a
 * domain need not be looked at.
 */
class BlockFits
{
public:
  static constexpr int FinestEdge = 8;

  /** @param levels how many sizes of cubes */
  BlockFits(const AnySamples& samples, int levels, const ParallelFor& parallelFor);

  /** @param block coordinates of a cube that meets the grid, divided by its edge */
  const BlockFit& operator()(int level, const Point& block) const
  {
    return this->Levels[level].Blocks[this->Levels[level].Index(block)];
  }

private:
  struct Level
  {
    std::array<int, 3> Count{};
    std::vector<BlockFit> Blocks;

    std::int64_t Index(const Point& block) const
    {
      return (std::int64_t{ block[2] } * this->Count[1] + block[1]) * this->Count[0] + block[0];
    }
  };

  template <typename Fit>
  void AddLevel(
    const std::array<int, 3>& dimensions, const Fit& fit, const ParallelFor& parallelFor);
  BlockFit Merge(int level, const Point& block) const;

  std::vector<Level> Levels;
};

}

#endif
