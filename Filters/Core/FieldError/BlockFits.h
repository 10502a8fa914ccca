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
  /** A linear function of the offset from the cube's first corner, and the most that the samples
   *  differ from it: infinite if one of them is not finite, void if the cube reaches past the
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
 * Linear fits to the samples in cubes of 8, 16, 32, ... lattice edges: they tell that a part of a
 * domain need not be looked at. A slab has those of its own finest cubes, and of larger ones that
 * hold some of these: unknown, as for samples that are not finite, if it does not have all of their
 * eighths.
 */
class BlockFits
{
public:
  static constexpr int FinestEdge = 8;

  /**
   * @param dimensions of the volume
   * @param slab with all samples of its own cubes
   * @param own slices, end excluded: the slab's own finest cubes begin there
   * @param levels how many sizes of cubes
   */
  BlockFits(const std::array<int, 3>& dimensions, const SampleSlab& slab, const SliceRange& own,
    int levels, const ParallelFor& parallelFor);

  /** Whether any of the finest cubes in a cube are the slab's own. @param z the cube's last
   *  coordinate, divided by its edge */
  bool Has(int level, int z) const
  {
    return z >= this->Levels[level].Slices.Begin && z < this->Levels[level].Slices.End;
  }

  /** @param block coordinates of a cube that meets the grid, divided by its edge; the slab Has() it
   */
  const BlockFit& operator()(int level, const Point& block) const
  {
    return this->Levels[level].Blocks[this->Levels[level].Index(block)];
  }

private:
  struct Level
  {
    Point Count{};     ///< of the volume's blocks
    SliceRange Slices; ///< slices of blocks that there are
    std::vector<BlockFit> Blocks;

    std::int64_t Index(const Point& block) const
    {
      const std::int64_t slice = block[2] - this->Slices.Begin;
      return (slice * this->Count[1] + block[1]) * this->Count[0] + block[0];
    }
  };

  template <typename Fit>
  void AddLevel(const std::array<int, 3>& dimensions, const SliceRange& own, const Fit& fit,
    const ParallelFor& parallelFor);
  BlockFit Merge(int level, const Point& block) const;
  std::vector<Level> Levels;
};

}

#endif
