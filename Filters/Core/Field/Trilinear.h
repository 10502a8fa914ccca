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
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      Point sample = this->Cell;
      for (int axis = 0; axis < 3; ++axis)
      {
        const bool far = ((corner >> axis) & 1) != 0;
        weight *= far ? this->Fraction[axis] : 1.0 - this->Fraction[axis];
        sample[axis] += far ? 1 : 0;
      }
      if (weight != 0.0)
      {
        body(sample, weight);
      }
    }
  }
};

}

#endif
