// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ShadowTest_h
#define isodiamond_ShadowTest_h

#include "Simplification/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * Shows that all of a triangle is near to a mesh, by the shadow that some triangles of the mesh
 * cast on it.
 *
 * Seen along a direction, these cover each place a number of times, where those that face the other
 * way count as -1. That number changes only across the shadow of their border: the edges that only
 * one of them has. So if this shadow does not enter the triangle, and goes around its middle once,
 * all of the triangle is covered; and if they are near to it along the direction wherever they are
 * over it, all of it is near to them. The test takes a few operations per triangle of the mesh, but
 * does not always succeed: the way along the direction may be longer than another one.
 */
class ShadowTest
{
public:
  /** @param positions,mesh,allowances how far from each triangle of the mesh something may be; must
   *         outlive it */
  ShadowTest(const std::vector<Vector>& positions, const LinkedTriangles& mesh,
    const std::vector<double>& allowances);

  /** Whether all of a triangle is shown to be near to the mesh, and to face as the mesh does.
   *  @param direction of unit length @param triangles distinct ones of the mesh, near to it;
   * others are added */
  bool Covers(const std::array<Vector, 3>& corners, const Vector& direction,
    std::vector<std::uint32_t>& triangles);

private:
  using Place = std::array<double, 2>;
  using Clipped = Vector; ///< a place and a height
  /** Each of three cuts adds at most one or, by rounding where they are nearly in line, doubles
   * them. */
  using ClippedCorners = std::array<Clipped, 24>;

  /** How a point of the mesh is seen. */
  struct Shadow
  {
    Place At{};
    double Height = 0.0;
    unsigned Beyond = 0; ///< a bit for each side of the triangle that it is not inside of
    std::uint32_t Test = 0;
  };

  bool Reset(const std::array<Vector, 3>& corners, const Vector& direction);
  const Shadow& Of(std::uint32_t point);
  bool IsLow(std::uint32_t triangle);
  int Clip(int side, ClippedCorners& corners, int count) const;
  bool Enters(const Shadow& a, const Shadow& b) const;
  int CrossesRay(const Shadow& a, const Shadow& b) const;

  const std::vector<Vector>& Positions;
  const LinkedTriangles& Mesh;
  const std::vector<double>& Allowances;
  std::vector<Shadow> Shadows;       ///< by point
  std::vector<std::uint32_t> Chosen; ///< by triangle: the last test that it was chosen for
  std::uint32_t Test = 0;

  // The triangle, seen from above: its first corner is at 0, its first side along x.
  Vector Origin{};
  std::array<Vector, 3> Axes{}; ///< the last one is the normal
  Vector Way{};                 ///< along the direction, as far as 1 along the normal
  double WayLength = 1.0;
  std::array<Place, 3> Corners{};
  std::array<Place, 3> Inward{}; ///< normals to the sides, of unit length
  Place Middle{};
  double Slack = 0.0; ///< a length that is not distinguished from 0
  double Strip = 0.0; ///< how far from the rest what lies that near to a side may be
};

}

#endif
