// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TetrahedronMesh_h
#define isodiamond_TetrahedronMesh_h

#include "Field/Vector.h"
#include "Field/Walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** A tetrahedron by the ids of its points. */
using Corners = std::array<std::uint32_t, 4>;
using Face = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>;

inline bool Has(const Corners& corners, std::uint32_t point)
{
  return std::find(corners.begin(), corners.end(), point) != corners.end();
}

///@{
/** The corners except one, or two, of them, in their order. */
inline Face Without(const Corners& corners, std::uint32_t point)
{
  Face others{};
  std::copy_if(corners.begin(), corners.end(), others.begin(),
    [&](std::uint32_t corner) { return corner != point; });
  return others;
}
inline Edge Without(const Corners& corners, std::uint32_t a, std::uint32_t b)
{
  Edge others{};
  std::copy_if(corners.begin(), corners.end(), others.begin(),
    [&](std::uint32_t corner) { return corner != a && corner != b; });
  return others;
}
///@}

inline Edge SortedEdge(std::uint32_t a, std::uint32_t b)
{
  return { std::min(a, b), std::max(a, b) };
}

/** A part of one point's attributes. */
struct Share
{
  std::uint32_t Point = 0;
  double Part = 0.0;
};

/** A point whose attributes are made up of parts of others'. */
struct BlendedPoint
{
  std::uint32_t Point = 0;
  std::vector<Share> Shares; ///< of points that are not blended
};

/** Positive tetrahedra of points, some of which lie on surfaces. */
struct TetrahedronMesh
{
  std::vector<Vector> Positions;
  std::vector<std::int8_t> Surfaces; ///< by point: -1 on the lower one, 1 on the upper, 0 inside
  std::vector<Walls::Type> OnWalls;  ///< by point
  std::vector<Corners> Tetrahedra;
  std::vector<std::uint32_t> Origins; ///< by tetrahedron: that of the CutMesh that it comes from
  std::vector<BlendedPoint> Blended;  ///< points that were moved or added, by their ids
};

///@{
/** The surface, and the walls, that all points of a face are on; 0 for none. */
inline int SurfaceOfFace(const TetrahedronMesh& mesh, const Face& face)
{
  const std::int8_t surface = mesh.Surfaces[face[0]];
  return surface == mesh.Surfaces[face[1]] && surface == mesh.Surfaces[face[2]] ? surface : 0;
}
inline Walls::Type WallsOfFace(const TetrahedronMesh& mesh, const Face& face)
{
  return mesh.OnWalls[face[0]] & mesh.OnWalls[face[1]] & mesh.OnWalls[face[2]];
}
///@}

/** The smallest sine of the six dihedral angles of (a, b, c, d), from known quantities; never NaN.
 *  @param squaredEdges ab, ac, ad, bc, bd, cd
 *  @param squaredAreas squares of twice the areas of the faces opposite to a, b, c and d */
inline double SmallestSine(double sixVolumes, const std::array<double, 6>& squaredEdges,
  const std::array<double, 4>& squaredAreas)
{
  const auto& [ab, ac, ad, bc, bd, cd] = squaredEdges;
  const auto& [toA, toB, toC, toD] = squaredAreas;
  // At an edge, the sine is its length times six volumes, divided by both doubled areas.
  const double least = std::min({ ab / (toC * toD), ac / (toB * toD), ad / (toB * toC),
    bc / (toA * toD), bd / (toA * toC), cd / (toA * toB) });
  const double sine = sixVolumes * std::sqrt(least);
  return std::isfinite(sine) ? sine : 0.0;
}

/** The smallest sine of the six dihedral angles: large if none is near 0 or 180 degrees. Negative
 *  if the tetrahedron is; never NaN. */
double SmallestSine(const Vector& a, const Vector& b, const Vector& c, const Vector& d);

inline double SmallestSine(const TetrahedronMesh& mesh, const Corners& corners)
{
  return SmallestSine(mesh.Positions[corners[0]], mesh.Positions[corners[1]],
    mesh.Positions[corners[2]], mesh.Positions[corners[3]]);
}

inline double VolumeOf(const TetrahedronMesh& mesh, const Corners& corners)
{
  return SixVolumes(mesh.Positions[corners[0]], mesh.Positions[corners[1]],
           mesh.Positions[corners[2]], mesh.Positions[corners[3]]) /
    6.0;
}

/** Of all tetrahedra. */
inline double VolumeOf(const TetrahedronMesh& mesh)
{
  double volume = 0.0;
  for (const Corners& corners : mesh.Tetrahedra)
  {
    volume += VolumeOf(mesh, corners);
  }
  return volume;
}

/** The smallest and the largest dihedral angle, in degrees. */
std::array<double, 2> DihedralAngles(
  const Vector& a, const Vector& b, const Vector& c, const Vector& d);

/** The same over all tetrahedra of a mesh; 180 and 0 if there are none. */
std::array<double, 2> DihedralAngles(const TetrahedronMesh& mesh);

/** Sorts points into an order unrelated to where they are: those that follow each other are mostly
 *  far apart. */
void Scatter(std::vector<std::uint32_t>& points);

}

#endif
