// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Differences_h
#define isodiamond_Differences_h

#include "Field/Samples.h"
#include "Field/Trilinear.h"
#include "Field/Vector.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The gradients in index space at all samples of a box: central differences, one-sided on the
 * grid's boundary; those along an axis are not finite next to a sample on it that is not. They are
 * found once, row by row, for all positions between these samples.
 */
template <typename T>
class Differences
{
public:
  /** @param samples must outlive it */
  explicit Differences(const SampleView<T>& samples)
    : Samples(samples)
  {
  }

  /** Finds those of a box in the grid, which has two samples or more on each axis.
   *  @param first,last its corners, both included */
  void Fill(const Point& first, const Point& last)
  {
    this->First = first;
    this->Width = last[0] - first[0] + 1;
    this->Rows = last[1] - first[1] + 1;
    this->Values.resize(std::size_t{ 3 } * this->Width * this->Rows * (last[2] - first[2] + 1));
    double* next = this->Values.data();
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        this->FillAlongX({ first[0], y, z }, next);
        this->FillAcross({ first[0], y, z }, 1, next + this->Width);
        this->FillAcross({ first[0], y, z }, 2, next + 2 * this->Width);
        next += 3 * this->Width;
      }
    }
  }

  /** The interpolated gradient at a position in a cell whose corners are all in the box. */
  Vector At(const CellPosition& position) const
  {
    const Point cell = position.Cell + -1 * this->First;
    assert(cell[0] >= 0 && cell[0] + 1 < this->Width && cell[1] >= 0 && cell[1] + 1 < this->Rows);
    const std::int64_t row = 3 * this->Width;
    const double* const values =
      this->Values.data() + (std::int64_t{ cell[2] } * this->Rows + cell[1]) * row + cell[0];
    const Vector& far = position.Fraction;
    // By axis, at the cell's two sides along x, whose differences lie side by side in memory.
    std::array<std::array<double, 2>, 3> sums{};
    for (int edge = 0; edge < 4; ++edge)
    {
      const bool isFarY = (edge & 1) != 0;
      const bool isFarZ = (edge & 2) != 0;
      const double weight = (isFarY ? far[1] : 1.0 - far[1]) * (isFarZ ? far[2] : 1.0 - far[2]);
      const double* const at = values + ((isFarZ ? this->Rows : 0) + (isFarY ? 1 : 0)) * row;
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int side = 0; side < 2; ++side)
        {
          sums[axis][side] += weight * at[axis * this->Width + side];
        }
      }
    }
    Vector gradient;
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] = (1.0 - far[0]) * sums[axis][0] + far[0] * sums[axis][1];
    }
    return gradient;
  }

private:
  /** Differences along x of a row of the box. */
  void FillAlongX(const Point& begin, double* differences) const
  {
    const T* const row = this->Samples.Pointer() + this->Samples.Index(begin);
    const int last = this->Samples.Dimensions()[0] - 1 - begin[0]; // the grid's, from here
    const int from = begin[0] == 0 ? 1 : 0;
    const int end = std::min(this->Width, last);
    for (int i = from; i < end; ++i)
    {
      differences[i] = Difference(0.5, row[i - 1], row[i + 1]);
    }
    if (from == 1)
    {
      differences[0] = Difference(1.0, row[0], row[1]);
    }
    if (end < this->Width)
    {
      differences[end] = Difference(1.0, row[end - 1], row[end]);
    }
  }

  /** The same along another axis. */
  void FillAcross(const Point& begin, int axis, double* differences) const
  {
    const int last = this->Samples.Dimensions()[axis] - 1;
    Point before = begin;
    Point after = begin;
    before[axis] = std::max(before[axis] - 1, 0);
    after[axis] = std::min(after[axis] + 1, last);
    const double factor = after[axis] - before[axis] == 2 ? 0.5 : 1.0;
    const T* const rowBefore = this->Samples.Pointer() + this->Samples.Index(before);
    const T* const rowAfter = this->Samples.Pointer() + this->Samples.Index(after);
    for (int i = 0; i < this->Width; ++i)
    {
      differences[i] = Difference(factor, rowBefore[i], rowAfter[i]);
    }
  }

  static double Difference(double factor, T before, T after)
  {
    return factor * (static_cast<double>(after) - static_cast<double>(before));
  }

  SampleView<T> Samples;
  Point First{};
  int Width = 0;              ///< of the box, in samples
  int Rows = 0;               ///< of each of its slices
  std::vector<double> Values; ///< for each row: along x, along y, along z
};

}

#endif
