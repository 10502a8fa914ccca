// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TriangleMesh_h
#define isodiamond_TriangleMesh_h

#include "Field/Vector.h"
#include "Simplification/CellsAtPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace isodiamond
{

using Triangle = std::array<std::uint32_t, 3>;

/** Which of a triangle's points a given one is. @pre it is one of them */
inline int PlaceOf(const Triangle& triangle, std::uint32_t point)
{
  return triangle[0] == point ? 0 : triangle[1] == point ? 1 : 2;
}

/** Whether two triangles have the same points in the same direction. */
inline bool AreSame(const Triangle& a, Triangle b)
{
  std::rotate(b.begin(), b.begin() + PlaceOf(b, a[0]), b.end());
  return a == b;
}

/** Normal of a triangle; its length is twice the area. */
inline Vector Across(const std::vector<Vector>& positions, const Triangle& triangle)
{
  const Vector& a = positions[triangle[0]];
  return Cross(positions[triangle[1]] - a, positions[triangle[2]] - a);
}

inline double AreaOf(const std::vector<Vector>& positions, const Triangle& triangle)
{
  const Vector across = Across(positions, triangle);
  return 0.5 * std::sqrt(Dot(across, across));
}

/** A vector of length 1 in the same direction; 0 for one without length. */
inline Vector Unit(const Vector& vector)
{
  const double length = std::sqrt(Dot(vector, vector));
  return length > 0.0 ? (1.0 / length) * vector : Vector{};
}

/** The sine of a triangle's smallest angle, opposite to its shortest side; 0 for a point. */
inline double SmallestSine(const Vector& a, const Vector& b, const Vector& c)
{
  const Vector across = Cross(b - a, c - a);
  std::array<double, 3> sides = { Dot(b - a, b - a), Dot(c - b, c - b), Dot(a - c, a - c) };
  std::sort(sides.begin(), sides.end()); // squared
  return sides[1] > 0.0 ? std::sqrt(Dot(across, across) / (sides[1] * sides[2])) : 0.0;
}

/** Triangles by the ids of their points, consistently oriented. */
struct TriangleMesh
{
  std::vector<Vector> Positions;
  std::vector<Triangle> Triangles;

  Vector Corner(std::size_t triangle, int i) const
  {
    return this->Positions[this->Triangles[triangle][i]];
  }
  std::array<Vector, 3> Corners(std::size_t triangle) const
  {
    return { this->Corner(triangle, 0), this->Corner(triangle, 1), this->Corner(triangle, 2) };
  }
  Vector Middle(std::size_t triangle) const
  {
    const auto [a, b, c] = this->Corners(triangle);
    return (1.0 / 3.0) * (a + b + c);
  }
};

/** No triangle, or no point. */
constexpr std::uint32_t None = 0xffffffff;

/** Triangles, and what is across each of their edges. Edge k of a triangle leads from its point k
 *  to the next one. */
struct LinkedTriangles
{
  std::vector<Triangle> Triangles;  ///< the first point is None if the triangle is gone
  std::vector<Triangle> Neighbours; ///< by triangle and edge; None at the border

  bool IsThere(std::uint32_t triangle) const { return this->Triangles[triangle][0] != None; }
  std::array<Vector, 3> Corners(const std::vector<Vector>& positions, std::uint32_t triangle) const
  {
    const auto [a, b, c] = this->Triangles[triangle];
    return { positions[a], positions[b], positions[c] };
  }
};

/** By point: one of the triangles there, or None. */
std::vector<std::uint32_t> AnyTriangleAt(std::size_t points, const LinkedTriangles& mesh);

/**
 * Which triangles meet at the points and edges of a mesh.
 *
 * Orientation must be consistent: an edge has one triangle, or two that go along it in opposite
 * directions.
 */
class Connectivity
{
public:
  Connectivity(std::size_t pointCount, std::vector<Triangle> triangles);

  /** Where edges begin that more than two triangles have, or two in the same direction, and the
   *  points of triangles that have one twice. Neighbours are meaningful only if there are none. */
  const std::vector<std::uint32_t>& FaultyPoints() const { return this->Faulty; }

  /** The triangles at a point. */
  IdRange At(std::uint32_t point) const { return this->Cells[point]; }

  /** Whether these form more than one fan: sheets meet there. @pre no edge there is faulty */
  bool IsPinched(std::uint32_t point) const;

  /** The mesh's triangles, linked. */
  const LinkedTriangles& Linked() const& { return this->Links; }
  LinkedTriangles Linked() && { return std::move(this->Links); }

private:
  CellsAtPoints Cells;
  LinkedTriangles Links;
  std::vector<std::uint32_t> Faulty;
};

}

#endif
