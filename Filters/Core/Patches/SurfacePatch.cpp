// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/SurfacePatch.h"

#include "Patches/IntervalCases.h"
#include "Patches/IntervalPatches.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{
namespace
{

using Triangle = std::array<PatchPoint, 3>;

/** The triangles of a case's tetrahedra whose corners all lie on a surface. Inner faces belong to
 *  two tetrahedra; the others form the surface. */
std::vector<Triangle> TrianglesOnSurface(
  const std::vector<PatchTetrahedron>& tetrahedra, int surface)
{
  std::vector<Triangle> triangles;
  for (const PatchTetrahedron& tetrahedron : tetrahedra)
  {
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      Triangle face;
      std::copy_if(tetrahedron.begin(), tetrahedron.end(), face.begin(),
        [&](const PatchPoint& point) { return !(point == tetrahedron[opposite]); });
      std::sort(face.begin(), face.end());
      const bool onSurface = std::all_of(face.begin(), face.end(),
        [&](const PatchPoint& point) { return !point.IsVertex() && point.Surface() == surface; });
      const auto twin = std::find(triangles.begin(), triangles.end(), face);
      if (onSurface && twin == triangles.end())
      {
        triangles.push_back(face);
      }
      else if (onSurface)
      {
        triangles.erase(twin);
      }
    }
  }
  return triangles;
}

/** By case and surface. */
using CaseTriangles = std::array<std::array<std::vector<Triangle>, 2>, 81>;

const CaseTriangles& AllTriangles()
{
  static const CaseTriangles triangles = []
  {
    CaseTriangles all;
    for (int code = 0; code < 81; ++code)
    {
      for (int surface = 0; surface < 2; ++surface)
      {
        all[code][surface] = TrianglesOnSurface(IntervalPatches()[code], surface);
      }
    }
    return all;
  }();
  return triangles;
}

}

SurfacePatch PatchOf(const IsodiamondHierarchy& hierarchy, std::uint32_t rank,
  const HalfTetrahedron& half, int surface)
{
  if (!hierarchy.Region().IsVolume())
  {
    return IsosurfacePatch(half, hierarchy.Edges(rank));
  }
  SurfacePatch patch;
  for (const Triangle& triangle : AllTriangles()[IntervalCase(hierarchy, rank, half)][surface])
  {
    std::array<std::uint8_t, 3>& corners = patch.Triangles[patch.TriangleCount++];
    for (int i = 0; i < 3; ++i)
    {
      corners[i] = EdgeBetween(half, triangle[i].Younger(), triangle[i].Older());
    }
  }
  return patch;
}

}
