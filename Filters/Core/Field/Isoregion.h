// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Isoregion_h
#define isodiamond_Isoregion_h

#include "Field/Samples.h"

#include <array>
#include <cstdint>
#include <stdexcept>

namespace isodiamond
{

/** What is extracted. */
enum class Shape : int
{
  Isosurface = 0,
  IntervalVolume = 1
};

/**
 * The part of a field that a hierarchy represents: the isosurface {F = k} of an isovalue, or the
 * interval volume {a <= F <= b} of an isorange. The former is bounded by one *surface*, numbered 0,
 * the latter by a lower and an upper one, 0 and 1.
 *
 * The *sign* of a value is the number of surfaces that it lies above: for an isovalue 1 where
 * F > k, else 0; for an isorange 0 below a, 1 inside, 2 above b (the paper's -1, 0 and 1). NaN
 * counts as below. (The paper's formula in section 2.1 is misprinted; its text says this.)
 */
class Isoregion
{
public:
  /** The isosurface of an isovalue. */
  Isoregion(double isovalue) // NOLINT(google-explicit-constructor): an isovalue names its surface
    : Limits{ isovalue, isovalue }
  {
  }

  /**
   * The interval volume of an isorange; an infinite end is an open side.
   * @throws std::invalid_argument unless lower < upper
   */
  Isoregion(double lower, double upper)
    : TheShape(Shape::IntervalVolume)
    , Limits{ lower, upper }
  {
    if (!(lower < upper))
    {
      throw std::invalid_argument(
        "The isorange needs a lower end that is less than the upper one.");
    }
  }

  bool operator==(const Isoregion& other) const
  {
    return this->TheShape == other.TheShape && this->Limits == other.Limits;
  }

  bool IsVolume() const { return this->TheShape == Shape::IntervalVolume; }
  int SurfaceCount() const { return this->IsVolume() ? 2 : 1; }

  /** The isovalue of a surface. */
  double Isovalue(int surface = 0) const { return this->Limits[surface]; }

  /** Whether a value lies above a surface. Values on a surface belong to the interval volume, and
   *  lie below an isosurface. */
  bool IsAbove(int surface, double value) const
  {
    return this->IsVolume() && surface == 0 ? value >= this->Limits[0]
                                            : value > this->Limits[surface];
  }

  int SignOf(double value) const
  {
    const int sign = this->IsAbove(0, value) ? 1 : 0;
    return this->IsVolume() && this->IsAbove(1, value) ? sign + 1 : sign;
  }

  /** Whether a surface passes between the values of a range. */
  bool Crosses(const ValueRange& range) const
  {
    return this->SignOf(range.Maximum) > this->SignOf(range.Minimum);
  }

  /** Whether all values of a range lie in the interval volume. */
  bool Holds(const ValueRange& range) const
  {
    return this->IsVolume() && range.Minimum <= range.Maximum && this->SignOf(range.Maximum) == 1 &&
      this->SignOf(range.Minimum) == 1;
  }

private:
  Shape TheShape = Shape::Isosurface;
  std::array<double, 2> Limits{};
};

/** The sign of an interval volume's inside. */
inline constexpr int InsideSign = 1;

}

#endif
