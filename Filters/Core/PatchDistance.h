// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PatchDistance_h
#define isodiamond_PatchDistance_h

#include "SpineNeighbourhood.h"
#include "SurfacePatch.h"
#include "TriangleDistance.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** The isovertex of a stored diamond on one of its subdivision edges. */
inline FinePosition IsovertexAt(const IsodiamondHierarchy& hierarchy, const Place& place,
  std::uint32_t rank, int edge, int surface)
{
  const std::uint32_t lower = hierarchy.Edges(rank);
  const std::uint32_t before = (1U << edge) - 1U;
  const int index = surface == 0 ? PopCount(lower & before)
                                 : PopCount(lower) + PopCount(hierarchy.UpperEdges(rank) & before);
  const std::int32_t along = hierarchy.Isovertices(rank)[index];
  const Point& offset = tables::Parities[Parity(place.Position)].Offsets[edge];
  return (1 << place.Scale) * (FineUnits * place.Position + along * offset);
}

/** Squared distances to the patch of a tetrahedron. */
class PatchDistance
{
public:
  void Reset(const IsodiamondHierarchy& hierarchy, const WorldMetric& metric,
    const HalfPlace& tetrahedron, int surface)
  {
    const SurfacePatch patch = PatchOf(hierarchy, tetrahedron.Rank, *tetrahedron.Half, surface);
    this->Count = patch.TriangleCount;
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      std::array<Vector, 3> corners;
      for (int j = 0; j < 3; ++j)
      {
        corners[j] = metric(Corner(hierarchy, tetrahedron, patch.Triangles[i][j], surface));
      }
      this->Triangles[i] = { corners[0], corners[1], corners[2] };
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
