// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchDistance_h
#define isodiamond_PatchDistance_h

#include "IsovertexClusters.h"
#include "SpineNeighbourhood.h"
#include "SurfacePatch.h"
#include "TriangleDistance.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** Squared distances to the patch of a tetrahedron. */
class PatchDistance
{
public:
  void Reset(const IsodiamondHierarchy& hierarchy, const WorldMetric& metric,
    const HalfPlace& tetrahedron, int surface)
  {
    const SurfacePatch patch = PatchOf(hierarchy, tetrahedron.Rank, *tetrahedron.Half, surface);
    this->Count = patch.TriangleCount;
    std::array<Vector, 6> corners;
    std::uint32_t known = 0; // the edges whose isovertex is in corners
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      for (const std::uint8_t edge : patch.Triangles[i])
      {
        if (((known >> edge) & 1U) == 0)
        {
          known |= 1U << edge;
          corners[edge] = metric(Corner(hierarchy, tetrahedron, edge, surface));
        }
      }
      const std::array<std::uint8_t, 3>& edges = patch.Triangles[i];
      this->Triangles[i] = { corners[edges[0]], corners[edges[1]], corners[edges[2]] };
    }
  }

  bool IsEmpty() const { return this->Count == 0; }

  /** @pre the patch is not empty */
  double Squared(const Vector& point) const
  {
    const double first = this->Triangles[0].Squared(point);
    return this->Count == 1 ? first : std::min(first, this->Triangles[1].Squared(point));
  }

private:
  /** The isovertex on an edge of a half-tetrahedron. */
  static FinePosition Corner(const IsodiamondHierarchy& hierarchy, const HalfPlace& tetrahedron,
    std::uint8_t edge, int surface)
  {
    const HalfTetrahedron& half = *tetrahedron.Half;
    if (edge < OwnEdgeCount)
    {
      return IsovertexAt(
        hierarchy, tetrahedron.Parent, tetrahedron.Rank, half.Vertices[edge], surface);
    }
    const OuterEdge& outer = half.OuterEdges[edge - OwnEdgeCount];
    const Point position =
      tetrahedron.Parent.Position + tetrahedron.Shape().Offsets[outer.OwnerVertex];
    const int step = outer.OwnerStep;
    const Place owner{ tetrahedron.Parent.Scale + step,
      { position[0] >> step, position[1] >> step, position[2] >> step } };
    const auto rank = static_cast<std::uint32_t>(hierarchy.Diamonds().Rank(owner));
    return IsovertexAt(hierarchy, owner, rank, outer.OwnerEdge, surface);
  }

  int Count = 0;
  std::array<TriangleDistance, 2> Triangles;
};

}

#endif
