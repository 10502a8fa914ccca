// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TriangleDistance_h
#define isodiamond_TriangleDistance_h

#include "WorldMetric.h"

#include <algorithm>

namespace isodiamond
{

/** Squared distances to a triangle. */
class TriangleDistance
{
public:
  TriangleDistance() = default;
  TriangleDistance(const Vector& a, const Vector& b, const Vector& c)
    : Corner(a)
    , First(b - a)
    , Second(c - a)
    , FirstFirst(Dot(this->First, this->First))
    , FirstSecond(Dot(this->First, this->Second))
    , SecondSecond(Dot(this->Second, this->Second))
  {
    const Vector& u = this->First;
    const Vector& v = this->Second;
    const Vector normal = { u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0] };
    const double squaredLength = Dot(normal, normal);
    const double inverse = squaredLength > 0.0 ? 1.0 / squaredLength : 0.0;
    this->InverseArea = inverse;
    const double scale = std::sqrt(inverse);
    this->Normal = { scale * normal[0], scale * normal[1], scale * normal[2] };
  }

  double Squared(const Vector& point) const
  {
    const Vector p = point - this->Corner;
    const double alongFirst = Dot(p, this->First);
    const double alongSecond = Dot(p, this->Second);
    const double s = this->SecondSecond * alongFirst - this->FirstSecond * alongSecond;
    const double t = this->FirstFirst * alongSecond - this->FirstSecond * alongFirst;
    if (s >= 0.0 && t >= 0.0 && (s + t) * this->InverseArea <= 1.0 && this->InverseArea > 0.0)
    {
      const double height = Dot(p, this->Normal);
      return height * height;
    }
    // Outside of the prism over the triangle: to the nearest of its sides.
    const Vector third = this->Second - this->First;
    const double toFirst = SquaredToSide(p, this->First, this->FirstFirst, alongFirst);
    const double toSecond = SquaredToSide(p, this->Second, this->SecondSecond, alongSecond);
    const Vector fromThird = p - this->First;
    const double toThird =
      SquaredToSide(fromThird, third, Dot(third, third), Dot(fromThird, third));
    return std::min(toFirst, std::min(toSecond, toThird));
  }

private:
  static double SquaredToSide(
    const Vector& p, const Vector& side, double squaredLength, double along)
  {
    const double place =
      along <= 0.0 ? 0.0 : (along >= squaredLength ? 1.0 : along / squaredLength);
    const Vector rest = { p[0] - place * side[0], p[1] - place * side[1], p[2] - place * side[2] };
    return Dot(rest, rest);
  }

  Vector Corner{};
  Vector First{};
  Vector Second{};
  Vector Normal{};
  double FirstFirst = 0.0;
  double FirstSecond = 0.0;
  double SecondSecond = 0.0;
  double InverseArea = 0.0; ///< of the squared length of the normal; 0 for a degenerate triangle
};

}

#endif
