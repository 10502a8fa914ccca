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
 * The hole that a vertex leaves when its triangles are removed, seen from above: along the mean
 * normal of the triangles, which is the same for anything that fills the hole. The hole of a vertex
 * at the border is open: between two of the points there was no triangle, and what fills it ends at
 * a line from one to the other.
 */
struct Hole
{
  /** Vertices with more neighbours leave no hole. */
  static constexpr int MostPoints = 32;

  /** The least cosine of a triangle's normal with the mean one, unless one had less before. */
  static constexpr double UsualCosine = 0.2;

  /** A position as seen from above, with the vertex at 0. */
  using Place = std::array<double, 2>;

  int Count = 0;
  std::array<std::uint32_t, MostPoints> Points;    ///< around the vertex
  std::array<std::uint32_t, MostPoints> Triangles; ///< from each point to the next one; None beside
                                                   ///< a vertex at the border
  Vector Normal{};
  Vector AxisX{};
  Vector AxisY{};
  std::array<Place, MostPoints> Places; ///< of the points
  double LeastCosine = 0.0; ///< of new normals with the mean one; less if an old one had less

  /** Finds how points and triangles are seen.
   *  @param normals of the triangles, of unit length, or 0 for those without area, which count as
   *         seen from anywhere
   *  @return whether each triangle is seen from its front */
  bool SeeFromAbove(
    const std::vector<Vector>& positions, const std::vector<Vector>& normals, std::uint32_t vertex);

  /** Where something is seen, relative to the vertex. */
  Place See(const Vector& fromVertex) const
  {
    return { Dot(fromVertex, this->AxisX), Dot(fromVertex, this->AxisY) };
  }

  bool IsOpen() const
  {
    return this->Triangles[0] == None || this->Triangles[this->Count - 1] == None;
  }

  /** The triangle that is seen at a place; any one if none is. */
  int TriangleAt(const Place& place) const;

  /** Whether a place is seen over the triangle of the first point, this point and the next. */
  bool IsOver(int point, const Place& place) const;
};

/** Positive if the second is to the left of the first. */
inline double Cross2(const Hole::Place& a, const Hole::Place& b)
{
  return a[0] * b[1] - a[1] * b[0];
}

}

#endif
