// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TriangleDistance_h
#define isodiamond_TriangleDistance_h

#include "WorldMetric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace isodiamond
{

/**
 * Squared distances to a triangle.
 *
 * Where a point lies over the triangle is told by its barycentric coordinates, which come from the
 * normal: so they are right for thin triangles too, where dot products of the sides would cancel.
 */
class TriangleDistance
{
public:
  TriangleDistance() = default;
  TriangleDistance(const Vector& a, const Vector& b, const Vector& c)
    : Corner(a)
    , First(b - a)
    , Second(c - a)
    , Third(c - b)
    , Normal(Cross(this->First, this->Second))
    , Inverse{ 1.0 / Dot(this->First, this->First), 1.0 / Dot(this->Second, this->Second),
      1.0 / Dot(this->Third, this->Third), 1.0 / Dot(this->Normal, this->Normal) }
    , AlongFirst(this->Inverse[3] * Cross(this->Second, this->Normal))
    , AlongSecond(this->Inverse[3] * Cross(this->Normal, this->First))
    , IsDegenerate(!std::isfinite(this->Inverse[3]))
  {
  }

  double Squared(const Vector& point) const
  {
    const Vector p = point - this->Corner;
    const double first = Dot(p, this->AlongFirst);
    const double second = Dot(p, this->AlongSecond);
    // The nearest point lies on a side that is seen from the point, or inside.
    const bool seesFirst = second < 0.0 || this->IsDegenerate;
    const bool seesSecond = first < 0.0 || this->IsDegenerate;
    const bool seesThird = first + second > 1.0 || this->IsDegenerate;
    if (!(seesFirst || seesSecond || seesThird))
    {
      const double height = Dot(p, this->Normal);
      return height * height * this->Inverse[3];
    }
    double squared = std::numeric_limits<double>::infinity();
    if (seesFirst)
    {
      squared = SquaredToSide(p, this->First, this->Inverse[0]);
    }
    if (seesSecond)
    {
      squared = std::min(squared, SquaredToSide(p, this->Second, this->Inverse[1]));
    }
    if (seesThird)
    {
      squared = std::min(squared, SquaredToSide(p - this->First, this->Third, this->Inverse[2]));
    }
    return squared;
  }

private:
  /** @param inverse of the squared length; infinite if there is none */
  static double SquaredToSide(const Vector& p, const Vector& side, double inverse)
  {
    const double along = Dot(p, side);
    const double place = along <= 0.0 ? 0.0 : std::min(along * inverse, 1.0);
    const Vector rest = p - place * side;
    return Dot(rest, rest);
  }

  Vector Corner{};
  Vector First{};
  Vector Second{};
  Vector Third{};
  Vector Normal{};                 ///< not of unit length
  std::array<double, 4> Inverse{}; ///< of the squared lengths of the sides and the normal
  Vector AlongFirst{};             ///< barycentric coordinates as dot products
  Vector AlongSecond{};
  bool IsDegenerate = true;
};

}

#endif
