// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Trilinear_h
#define isodiamond_Trilinear_h

#include "Field/Vector.h"
#include "Lattice/Lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** Where a position in index space lies among the samples of a grid: a cell, and how far into it.
 */
struct CellPosition
{
  Point Cell{}; ///< its first sample
  Vector Fraction{};

  /** A position beyond the grid counts as in the outermost cell, with fractions outside [0, 1]. */
  CellPosition(const Vector& index, const std::array<int, 3>& dimensions)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      // Truncating is the same as rounding down, except below 0.
      this->Cell[axis] = std::clamp(static_cast<int>(index[axis]), 0, dimensions[axis] - 2);
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
    // Most positions that come here lie on an edge of the lattice, so most corners have no weight.
    // Which ones is unpredictable: they are sorted out without a branch for each.
    const Vector& far = this->Fraction;
    const Vector near = { 1.0 - far[0], 1.0 - far[1], 1.0 - far[2] };
    const std::array<double, 4> square = { near[0] * near[1], far[0] * near[1], near[0] * far[1],
      far[0] * far[1] };
    std::array<int, 8> corners;
    std::array<double, 8> weights;
    int count = 0;
    for (int corner = 0; corner < 8; ++corner)
    {
      corners[count] = corner;
      weights[count] = square[corner & 3] * (corner < 4 ? near[2] : far[2]);
      count += weights[count] != 0.0 ? 1 : 0;
    }
    for (int i = 0; i < count; ++i)
    {
      const int corner = corners[i];
      body(this->Cell + Point{ corner & 1, (corner >> 1) & 1, corner >> 2 }, weights[i]);
    }
  }
};

}

#endif
