// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CellBounds_h
#define isodiamond_CellBounds_h

#include "Field/Bounds.h"
#include "Field/Samples.h"
#include "Field/Vector.h"
#include "Lattice/Lattice.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace isodiamond
{

/**
 * Where the cells of a curvilinear grid are in the world: boxes around blocks of two cells on each
 * axis, around blocks of two of these, and so on, up to one around all.
 *
 * Positions in a cell are trilinear, so each part of it lies between the part's own corners. What
 * is near in index space is near in the world, but not always the other way round: the two ends of
 * a grid around a pipe may meet.
 */
class CellBounds
{
public:
  /** @param samples on each axis, at least 2
   *  @param positionOf gives a sample's position in the world, which has to be finite */
  CellBounds(
    const std::array<int, 3>& samples, const std::function<Vector(const Point&)>& positionOf);

  /** Around all cells. */
  Bounds OfAll() const { return this->Placed(this->Levels.back().Blocks[0]); }

  /** A box that holds the cells between two lattice points: the nearest ones, if the grid has none
   *  there. It may be larger by a block on each side. */
  Bounds Of(const Point& low, const Point& high) const;

  /** A box in index space that holds all cells that may touch a box in the world; empty if there
   *  are none. */
  Bounds IndexBoxOf(const Bounds& box) const;

private:
  struct Block
  {
    std::array<float, 3> Low{};
    std::array<float, 3> High{};
  };
  /** Blocks of 2^(i + 1) cells on each axis, for level i. */
  struct Level
  {
    std::array<int, 3> Size{};
    std::vector<Block> Blocks;

    explicit Level(const std::array<int, 3>& size);
    Block& At(const Point& block) { return this->Blocks[SampleIndex(this->Size, block)]; }
    const Block& At(const Point& block) const
    {
      return this->Blocks[SampleIndex(this->Size, block)];
    }
  };

  Bounds Placed(const Block& block) const;
  void Look(std::size_t level, const Point& block, const Bounds& box, Bounds& found) const;

  std::array<int, 3> Cells{};
  Vector Origin{}; ///< blocks' numbers of 32 bits are offsets from here
  std::vector<Level> Levels;
};

}

#endif
