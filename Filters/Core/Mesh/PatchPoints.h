// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchPoints_h
#define isodiamond_PatchPoints_h

#include "Lattice/DiamondTables.h"

#include <array>
#include <cstdint>

/**
 * @file PatchPoints.h
 * Where to find the points of a half-tetrahedron's patch: which diamond each belongs to, and which
 * of its points it is.
 */
namespace isodiamond
{

/** A point at a vertex, or on an edge, of a half-tetrahedron. */
struct PatchPointPlace
{
  std::int8_t Distance = 0; ///< of its diamond from the parent in a VertexWindow
  std::int8_t Bit = 0;      ///< in DiamondPoints; on an edge, of the isovertex on surface 0
};

/** At the corners of the triangles of an isosurface's patch, by the mask of the vertices that do
 * not lie on the centre's side. */
using TrianglePointPlaces = std::array<std::array<std::array<PatchPointPlace, 3>, 2>, 8>;

/** By age; the centre is 0 (see IntervalPatches.h): at the vertices, then on the edges (0, 1),
 *  (0, 2), (0, 3), (1, 2), (1, 3), (2, 3). */
using AgePointPlaces = std::array<PatchPointPlace, 10>;

/** The index in AgePointPlaces of the edge between two vertices. */
inline constexpr int EdgeByAge(int younger, int older)
{
  return 3 + younger + older + (younger > 0 ? 1 : 0);
}

/** By type of the parent and index of the half-tetrahedron. */
template <typename Places>
using PatchPointTable = std::array<std::array<Places, MaximumHalfTetrahedra>, 64>;

const PatchPointTable<TrianglePointPlaces>& PointsOfTriangles();
const PatchPointTable<AgePointPlaces>& PointsByAge();

}

#endif
