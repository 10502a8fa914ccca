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
    , Lengths{ Dot(this->First, this->First), Dot(this->Second, this->Second),
      Dot(this->Third, this->Third) }
  {
    const Vector normal = Cross(this->First, this->Second);
    const double squaredLength = Dot(normal, normal);
    this->IsDegenerate = !(squaredLength > 0.0);
    if (!this->IsDegenerate)
    {
      const double inverse = 1.0 / squaredLength;
      this->Normal = std::sqrt(inverse) * normal;
      this->AlongFirst = inverse * Cross(this->Second, normal);
      this->AlongSecond = inverse * Cross(normal, this->First);
    }
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
      return height * height;
    }
    double squared = std::numeric_limits<double>::infinity();
    if (seesFirst)
    {
      squared = SquaredToSide(p, this->First, this->Lengths[0]);
    }
    if (seesSecond)
    {
      squared = std::min(squared, SquaredToSide(p, this->Second, this->Lengths[1]));
    }
    if (seesThird)
    {
      squared = std::min(squared, SquaredToSide(p - this->First, this->Third, this->Lengths[2]));
    }
    return squared;
  }

private:
  static double SquaredToSide(const Vector& p, const Vector& side, double squaredLength)
  {
    const double along = Dot(p, side);
    const double place =
      along <= 0.0 ? 0.0 : (along >= squaredLength ? 1.0 : along / squaredLength);
    const Vector rest = p - place * side;
    return Dot(rest, rest);
  }

  Vector Corner{};
  Vector First{};
  Vector Second{};
  Vector Third{};
  std::array<double, 3> Lengths{}; ///< of the sides, squared
  Vector Normal{};
  Vector AlongFirst{}; ///< barycentric coordinates as dot products
  Vector AlongSecond{};
  bool IsDegenerate = true;
};

}

#endif
