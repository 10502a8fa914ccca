// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FlatPiece_h
#define isodiamond_FlatPiece_h

#include "Field/Vector.h"
#include "Patches/ConvexPolygon.h"
#include "Patches/SurfacePatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

/**
 * @file FlatPiece.h
 * Patches of two triangles, which can be bent, as one piece that is flat or nearly so.
 */
namespace isodiamond
{

/** What is flat, or nearly so. */
struct FlatPiece
{
  ConvexPolygon Polygon;
  Vector Normal{};   ///< of unit length; not a number without area
  double Bend = 0.0; ///< how far what it stands for can be from the polygon
};

/** A vector of length 1 in the same direction; not a number if there is none, so no test holds. */
inline Vector Direction(const Vector& vector)
{
  return (1.0 / std::sqrt(Dot(vector, vector))) * vector;
}

/** The corners of two triangles in order, and whether these share an edge. */
inline std::pair<ConvexPolygon, bool> Join(
  const SurfacePatch& patch, const std::array<Vector, 6>& corners)
{
  const std::array<std::uint8_t, 3>& first = patch.Triangles[0];
  const std::array<std::uint8_t, 3>& second = patch.Triangles[1];
  ConvexPolygon joined;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    const auto has = [](const std::array<std::uint8_t, 3>& edges, std::uint8_t edge)
    { return std::find(edges.begin(), edges.end(), edge) != edges.end(); };
    joined.Add(corners[first[i]]);
    if (has(second, first[i]) && has(second, first[(i + 1) % 3]))
    {
      ++shared;
      const auto other = std::find_if(
        second.begin(), second.end(), [&](std::uint8_t edge) { return !has(first, edge); });
      joined.Add(corners[other != second.end() ? *other : second[0]]);
    }
  }
  return { joined, shared == 1 };
}

/** How far two triangles and whatever else fills the border of both can be from each other, seen
 *  perpendicular to both diagonals; infinite if one triangle covers the other there. */
inline double BendOf(const SurfacePatch& patch, const std::array<Vector, 6>& corners)
{
  const auto [polygon, isOne] = Join(patch, corners);
  const std::array<Vector, ConvexPolygon::MostCorners>& q = polygon.Corners;
  const Vector shared = q[2] - q[0];
  const Vector across = Direction(Cross(shared, q[3] - q[1]));
  const Vector beside = Cross(shared, across);
  const bool isOpen = isOne && Dot(q[1] - q[0], beside) * Dot(q[3] - q[0], beside) < 0.0;
  return isOpen ? std::abs(Dot(q[1] - q[0], across)) : HUGE_VAL;
}

/** Two triangles as one piece; with an infinite bend if that is not convex. */
inline FlatPiece Flatten(const SurfacePatch& patch, const std::array<Vector, 6>& corners)
{
  auto [polygon, isOne] = Join(patch, corners);
  FlatPiece flat{ polygon, {}, HUGE_VAL };
  if (!isOne)
  {
    return flat;
  }
  flat.Normal = Direction(
    Cross(polygon.Corners[2] - polygon.Corners[0], polygon.Corners[3] - polygon.Corners[1]));
  const Vector middle = polygon.Middle();
  double bend = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    const double height = Dot(polygon.Corners[i] - middle, flat.Normal);
    flat.Polygon.Corners[i] = polygon.Corners[i] - height * flat.Normal;
    bend = std::max(bend, std::abs(height));
  }
  bool isConvex = true;
  for (int i = 0; i < 4; ++i)
  {
    const Vector& corner = flat.Polygon.Corners[(i + 1) % 4];
    const Vector turn =
      Cross(corner - flat.Polygon.Corners[i], flat.Polygon.Corners[(i + 2) % 4] - corner);
    isConvex = isConvex && Dot(turn, flat.Normal) > 0.0;
  }
  flat.Bend = isConvex ? bend : HUGE_VAL;
  return flat;
}

}

#endif
