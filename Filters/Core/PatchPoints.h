// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchPoints_h
#define isodiamond_PatchPoints_h

#include "DiamondTables.h"

#include <array>
#include <cstdint>

/**
 * @file PatchPoints.h
 * Where the points of a half-tetrahedron's patch are: which diamond they belong to, and which of
 * its points they are.
 */
namespace isodiamond
{

/** A point at a vertex, or on an edge, of a half-tetrahedron. */
struct PatchPointPlace
{
  std::int16_t Distance = 0; ///< of its diamond from the parent in a VertexWindow
  std::int16_t Bit = 0;      ///< in DiamondPoints; on an edge, of the isovertex on surface 0
};

/** All of a half-tetrahedron. */
struct PatchPointPlaces
{
  std::array<PatchPointPlace, 6> OnEdges{}; ///< numbered as SurfacePatch.h does

  /** By age, the centre is 0 (see IntervalPatches.h): the vertices, then the edges (0, 1), (0, 2),
   *  (0, 3), (1, 2), (1, 3), (2, 3). */
  std::array<PatchPointPlace, 10> ByAge{};

  /** The index in ByAge of the edge between two vertices. */
  static constexpr int EdgeByAge(int younger, int older)
  {
    return 3 + younger + older + (younger > 0 ? 1 : 0);
  }
};

/** By type of the parent and index of the half-tetrahedron. */
using PatchPointTable = std::array<std::array<PatchPointPlaces, MaximumHalfTetrahedra>, 64>;

const PatchPointTable& PatchPointsOfTypes();

}

#endif
