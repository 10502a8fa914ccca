// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchDistance_h
#define isodiamond_PatchDistance_h

#include "Patches/SurfacePatch.h"
#include "Patches/WorldLengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace isodiamond
{

/**
 * Squared distances to a triangle.
 *
 * Barycentric coordinates tell where a point lies over the triangle. They come from the normal, so
 * they are right even for thin triangles, where dot products of the sides would cancel.
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
    // The nearest point lies inside, or on a side that is visible from the point.
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

  /** Whether a point is over the triangle, as seen along its normal. */
  bool IsOver(const Vector& point) const
  {
    const Vector p = point - this->Corner;
    return this->IsOver(Dot(p, this->AlongFirst), Dot(p, this->AlongSecond));
  }

  /** A normal of the triangle, not of unit length; zero if the triangle has no area. */
  const Vector& Across() const { return this->Normal; }

  /** The nearest point of the triangle, up to rounding. */
  Vector Nearest(const Vector& point) const
  {
    const Vector p = point - this->Corner;
    const double first = Dot(p, this->AlongFirst);
    const double second = Dot(p, this->AlongSecond);
    if (this->IsOver(first, second))
    {
      return this->Corner + first * this->First + second * this->Second;
    }
    const std::array<Vector, 3> onSides = { PlaceOnSide(p, this->First, this->Inverse[0]),
      PlaceOnSide(p, this->Second, this->Inverse[1]),
      this->First + PlaceOnSide(p - this->First, this->Third, this->Inverse[2]) };
    const Vector& nearest = *std::min_element(onSides.begin(), onSides.end(),
      [&](const Vector& a, const Vector& b) { return Dot(p - a, p - a) < Dot(p - b, p - b); });
    return this->Corner + nearest;
  }

  /** The plane through one of the three sides, perpendicular to the triangle: a point, and the
   *  normal that leads away from the triangle. What is between all three is over the triangle. */
  struct Wall
  {
    Vector Point;
    Vector Outward;
  };
  Wall WallOf(int side) const
  {
    return side == 0 ? Wall{ this->Corner, Cross(this->First, this->Normal) }
      : side == 1    ? Wall{ this->Corner, Cross(this->Normal, this->Second) }
                     : Wall{ this->Corner + this->First, Cross(this->Third, this->Normal) };
  }

private:
  /** By barycentric coordinates. */
  bool IsOver(double first, double second) const
  {
    return !this->IsDegenerate && first >= 0.0 && second >= 0.0 && first + second <= 1.0;
  }
  /** @param inverse of the squared length; infinite if there is none */
  static double SquaredToSide(const Vector& p, const Vector& side, double inverse)
  {
    const Vector rest = p - PlaceOnSide(p, side, inverse);
    return Dot(rest, rest);
  }
  static Vector PlaceOnSide(const Vector& p, const Vector& side, double inverse)
  {
    const double along = Dot(p, side);
    return (along <= 0.0 ? 0.0 : std::min(along * inverse, 1.0)) * side;
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

/** Squared distances to the patch of a tetrahedron. */
class PatchDistance
{
public:
  /** @param cornerAt gives the isovertex on an edge of the patch's half-tetrahedron, in the world
   */
  template <typename CornerAt>
  void Reset(const SurfacePatch& patch, CornerAt&& cornerAt)
  {
    this->Count = patch.TriangleCount;
    std::array<Vector, 6> corners;
    std::uint32_t known = 0; // the edges whose isovertex is in corners
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      for (const std::uint8_t edge : patch.Triangles[i])
      {
        if (((known >> edge) & 1U) == 0)
        {
          known |= 1U << edge;
          corners[edge] = cornerAt(edge);
        }
      }
      const std::array<std::uint8_t, 3>& edges = patch.Triangles[i];
      this->Triangles[i] = { corners[edges[0]], corners[edges[1]], corners[edges[2]] };
    }
  }

  bool IsEmpty() const { return this->Count == 0; }

  /** @pre the patch is not empty */
  double Squared(const Vector& point) const
  {
    const double first = this->Triangles[0].Squared(point);
    return this->Count == 1 ? first : std::min(first, this->Triangles[1].Squared(point));
  }

private:
  int Count = 0;
  std::array<TriangleDistance, 2> Triangles;
};

}

#endif
