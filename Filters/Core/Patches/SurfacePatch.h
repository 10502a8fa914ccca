// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfacePatch_h
#define isodiamond_SurfacePatch_h

#include "Hierarchy/IsodiamondHierarchy.h"

#include <array>
#include <cstdint>

/**
 * @file SurfacePatch.h
 * The *patch* of a half-tetrahedron: a surface's triangles in it.
 *
 * Its corners are isovertices, named by the six edges of the half-tetrahedron: 0 to 2 lead from the
 * diamond's centre to vertex 0 to 2, 3 to 5 are the outer edges opposite to vertex 0 to 2.
 */
namespace isodiamond
{

/** Number of the edges that belong to the diamond, and index of the first of the others. */
inline constexpr int OwnEdgeCount = 3;

/** Up to two triangles, whose corners are given by edges. */
struct SurfacePatch
{
  int TriangleCount = 0;
  std::array<std::array<std::uint8_t, 3>, 2> Triangles{};
};

namespace tables
{

/** @param differing the vertices whose sign is not the centre's, as a mask of three bits */
inline constexpr SurfacePatch MakeIsosurfacePatch(int differing)
{
  SurfacePatch patch;
  int count = 0;
  for (int i = 0; i < 3; ++i)
  {
    count += (differing >> i) & 1;
  }
  if (count == 3)
  {
    patch.TriangleCount = 1;
    patch.Triangles[0] = { 0, 1, 2 };
  }
  for (std::uint8_t i = 0; i < 3 && (count == 1 || count == 2); ++i)
  {
    // Rotated so that the vertices that differ come first: i, or i and j.
    const auto j = static_cast<std::uint8_t>((i + 1) % 3);
    const auto k = static_cast<std::uint8_t>((i + 2) % 3);
    const auto outer = [](std::uint8_t opposite)
    { return static_cast<std::uint8_t>(OwnEdgeCount + opposite); };
    if (count == 1 && ((differing >> i) & 1) != 0)
    {
      patch.TriangleCount = 1;
      patch.Triangles[0] = { i, outer(k), outer(j) };
    }
    else if (count == 2 && ((differing >> k) & 1) == 0)
    {
      patch.TriangleCount = 2;
      patch.Triangles[0] = { i, j, outer(i) };
      patch.Triangles[1] = { i, outer(i), outer(j) };
    }
  }
  return patch;
}

inline constexpr std::array<SurfacePatch, 8> MakeIsosurfacePatches()
{
  std::array<SurfacePatch, 8> all{};
  for (int differing = 0; differing < 8; ++differing)
  {
    all[differing] = MakeIsosurfacePatch(differing);
  }
  return all;
}

/** The patches of an isosurface. Triangles are wound so that in a positively oriented
 *  half-tetrahedron, seen against their normals, the centre lies behind them. */
inline constexpr std::array<SurfacePatch, 8> IsosurfacePatches = MakeIsosurfacePatches();

}

/** The patch of an isosurface in a half-tetrahedron. @param edges the diamond's Edges() */
inline const SurfacePatch& IsosurfacePatch(const HalfTetrahedron& half, std::uint32_t edges)
{
  const std::array<std::uint8_t, 3>& v = half.Vertices;
  return tables::IsosurfacePatches[((edges >> v[0]) & 1U) | (((edges >> v[1]) & 1U) << 1) |
    (((edges >> v[2]) & 1U) << 2)];
}

/** The edge of a half-tetrahedron between two of its vertices, by age; the centre is 0. */
inline std::uint8_t EdgeBetween(const HalfTetrahedron& half, int younger, int older)
{
  if (younger == 0)
  {
    return half.ByAge[older - 1];
  }
  // An outer edge lies opposite to the outer vertex that is not one of its ends.
  return static_cast<std::uint8_t>(OwnEdgeCount + half.ByAge[6 - younger - older - 1]);
}

/**
 * The patch of any surface in a half-tetrahedron of the diamond with a given rank, as extraction
 * makes it; without an orientation if the surface is an interval volume's.
 */
SurfacePatch PatchOf(const IsodiamondHierarchy& hierarchy, std::uint32_t rank,
  const HalfTetrahedron& half, int surface);

}

#endif
