// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ConvexPolygon_h
#define isodiamond_ConvexPolygon_h

#include "Field/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isodiamond
{

/** A flat convex polygon: a triangle of a patch, or a piece of one that planes have cut off. */
struct ConvexPolygon
{
  /** Each cut adds a corner; a polygon that has this many is not cut any more. */
  static constexpr int MostCorners = 8;

  int Count = 0;
  std::array<Vector, MostCorners> Corners;

  bool IsEmpty() const { return this->Count < 3; }
  void Add(const Vector& corner) { this->Corners[this->Count++] = corner; }

  Vector Middle() const
  {
    Vector sum{};
    for (int i = 0; i < this->Count; ++i)
    {
      sum = sum + this->Corners[i];
    }
    return (1.0 / this->Count) * sum;
  }

  /** The squared distance from a point to the farthest corner: nothing is farther. */
  double SquaredRadius(const Vector& point) const
  {
    double largest = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      const Vector to = this->Corners[i] - point;
      largest = std::max(largest, Dot(to, to));
    }
    return largest;
  }

  /** The least and greatest dot products of a normal with the corners, relative to a point. */
  std::array<double, 2> Sides(const Vector& point, const Vector& normal) const
  {
    std::array<double, 2> sides = { HUGE_VAL, -HUGE_VAL };
    for (int i = 0; i < this->Count; ++i)
    {
      const double side = Dot(this->Corners[i] - point, normal);
      sides = { std::min(sides[0], side), std::max(sides[1], side) };
    }
    return sides;
  }
};

/** The part of a polygon above the plane through a point. */
inline void KeepAbove(
  const ConvexPolygon& whole, const Vector& point, const Vector& normal, ConvexPolygon& above)
{
  above.Count = 0;
  if (whole.Count == ConvexPolygon::MostCorners)
  {
    above = whole; // keeping more is on the safe side
    return;
  }
  // A polygon in the plane itself has corners on either side by rounding, and may get too many.
  bool isTooMany = false;
  const auto add = [&](const Vector& corner)
  {
    isTooMany = isTooMany || above.Count == ConvexPolygon::MostCorners;
    if (!isTooMany)
    {
      above.Add(corner);
    }
  };
  const double offset = Dot(point, normal);
  double last = Dot(whole.Corners[whole.Count - 1], normal) - offset;
  for (int i = 0; i < whole.Count; ++i)
  {
    const Vector& from = whole.Corners[i == 0 ? whole.Count - 1 : i - 1];
    const Vector& to = whole.Corners[i];
    const double next = Dot(to, normal) - offset;
    if ((last > 0.0 && next < 0.0) || (last < 0.0 && next > 0.0))
    {
      add(from + (last / (last - next)) * (to - from));
    }
    if (next >= 0.0)
    {
      add(to);
    }
    last = next;
  }
  if (isTooMany)
  {
    above = whole;
  }
}

}

#endif
