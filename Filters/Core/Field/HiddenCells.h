// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_HiddenCells_h
#define isodiamond_HiddenCells_h

#include "Lattice/DiamondSet.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The cells of a grid that count as absent: blanked ones, and ghosts.
 *
 * A mesh can only leave out whole tetrahedra, so diamonds that touch a hidden cell and carry
 * something are always subdivided: at full resolution a tetrahedron lies in one cell. Whether a
 * diamond touches one is looked up in a pyramid of blocks, 2^s cells wide at scale s.
 */
class HiddenCells
{
public:
  HiddenCells() = default; ///< none

  /** @param hidden whether each cell is hidden, x fastest @param cells of the grid on each axis */
  HiddenCells(std::vector<std::uint8_t> hidden, const std::array<int, 3>& cells);

  bool Any() const { return !this->Levels.empty(); }

  /** Whether a cell is hidden, by its first sample; cells beyond the grid are not. */
  bool operator()(const Point& cell) const { return this->At(0, cell); }

  /** Whether the box around a diamond holds a hidden cell. */
  bool Touch(const Place& place) const;

private:
  struct Level
  {
    std::vector<std::uint8_t> Hidden;
    std::array<int, 3> Size{};
  };

  bool At(int scale, const Point& block) const;

  std::vector<Level> Levels; ///< by scale
};

}

#endif
