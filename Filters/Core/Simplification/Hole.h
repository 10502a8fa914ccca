// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Hole_h
#define isodiamond_Hole_h

#include "Simplification/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The hole that a vertex leaves when its triangles go, seen from above: along the mean normal of
 * the triangles, which is the same for all that fills the hole. That of a vertex at the border is
 * open: between two of the points there was no triangle, and what fills it ends at a line from one
 * to the other.
 */
struct Hole
{
  /** Vertices with more neighbours leave none. */
  static constexpr int MostPoints = 32;

  /** No triangle may lean more from the mean normal than to this cosine, unless one did before. */
  static constexpr double UsualCosine = 0.2;

  /** As it is seen: the vertex is at 0. */
  using Place = std::array<double, 2>;

  int Count = 0;
  std::array<std::uint32_t, MostPoints> Points;    ///< around the vertex
  std::array<std::uint32_t, MostPoints> Triangles; ///< from each point to the next one; None beside
                                                   ///< a vertex at the border
  Vector Normal{};
  Vector AxisX{};
  Vector AxisY{};
  std::array<Place, MostPoints> Places; ///< of the points
  double LeastCosine = 0.0; ///< that new normals must have with the mean one: less if one had

  /** Finds how points and triangles are seen.
   *  @param normals of the triangles, of unit length, or 0 of those without area, which are seen
   *         from anywhere
   *  @return whether each triangle is seen from its front */
  bool SeeFromAbove(
    const std::vector<Vector>& positions, const std::vector<Vector>& normals, std::uint32_t vertex);

  /** How something beside the vertex is seen. */
  Place See(const Vector& fromVertex) const
  {
    return { Dot(fromVertex, this->AxisX), Dot(fromVertex, this->AxisY) };
  }

  bool IsOpen() const
  {
    return this->Triangles[0] == None || this->Triangles[this->Count - 1] == None;
  }

  /** The triangle that is seen at a place; any if none is. */
  int TriangleAt(const Place& place) const;

  /** Whether a place is seen over the triangle from the first point to one and the next one. */
  bool IsOver(int point, const Place& place) const;
};

/** More than 0 if the second is on the left of the first. */
inline double Cross2(const Hole::Place& a, const Hole::Place& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

}

#endif
