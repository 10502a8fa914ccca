// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Trilinear_h
#define isodiamond_Trilinear_h

#include "Field/Vector.h"
#include "Lattice/Lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace isodiamond
{

/** Where a position in index space lies among the samples of a grid: a cell, and how far into it.
 */
struct CellPosition
{
  Point Cell{}; ///< its first sample
  Vector Fraction{};

  /** The position beyond the grid counts as in the outermost cell, outside of [0, 1]. */
  CellPosition(const Vector& index, const std::array<int, 3>& dimensions)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Cell[axis] =
        std::clamp(static_cast<int>(std::floor(index[axis])), 0, dimensions[axis] - 2);
      this->Fraction[axis] = index[axis] - this->Cell[axis];
    }
  }

  /** The same cell, at the nearest position in it. */
  CellPosition Clamped() const
  {
    CellPosition nearest = *this;
    for (double& fraction : nearest.Fraction)
    {
      fraction = std::clamp(fraction, 0.0, 1.0);
    }
    return nearest;
  }

  /** Calls body(sample, weight) for those of the cell's corners that have a weight. */
  template <typename Body>
  void ForEachCorner(Body&& body) const
  {
    // Most positions that come here lie on an edge of the lattice, so most corners have none.
    const auto weightOf = [&](int axis, int far)
    { return far != 0 ? this->Fraction[axis] : 1.0 - this->Fraction[axis]; };
    for (int z = 0; z < 2; ++z)
    {
      for (int y = 0; y < 2 && weightOf(2, z) != 0.0; ++y)
      {
        for (int x = 0; x < 2 && weightOf(1, y) != 0.0; ++x)
        {
          const double weight = weightOf(0, x) * weightOf(1, y) * weightOf(2, z);
          if (weight != 0.0)
          {
            body(this->Cell + Point{ x, y, z }, weight);
          }
        }
      }
    }
  }
};

}

#endif
