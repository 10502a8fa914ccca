// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Walls_h
#define isodiamond_Walls_h

#include "Field/Vector.h"
#include "Lattice/Lattice.h"

#include <cstdint>

namespace isodiamond
{

/** The walls that a point may not leave: bit 2 a is set on the grid's first layer on axis a,
 *  bit 2 a + 1 on its last; Fixed points stay where they are. */
struct Walls
{
  using Type = std::uint8_t;
  static constexpr Type Fixed = 64;

  static constexpr bool OnAxis(Type walls, int axis) { return ((walls >> (2 * axis)) & 3) != 0; }

  /** The walls that a position in index space is on. */
  static Type At(const Vector& index, const Grid& grid)
  {
    int walls = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      walls |= index[axis] == 0.0 ? 1 << (2 * axis) : 0;
      walls |= index[axis] == grid.Last(axis) ? 2 << (2 * axis) : 0;
    }
    return static_cast<Type>(walls);
  }
};

}

#endif
