// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/PatchPoints.h"

#include "Mesh/ExtractionPasses.h"
#include "Mesh/VertexWindow.h"
#include "Patches/SurfacePatch.h"

namespace isodiamond
{
namespace
{

PatchPointPlace PlaceOf(const Point& offset, int bit)
{
  PatchPointPlace place;
  place.Distance = static_cast<std::int8_t>(VertexWindow::Distance(offset));
  place.Bit = static_cast<std::int8_t>(bit);
  return place;
}

/** Places on the edges of a half-tetrahedron, numbered as in SurfacePatch.h. */
using EdgePointPlaces = std::array<PatchPointPlace, 6>;

EdgePointPlaces PlacesOnEdges(const TypeTable& shape, const HalfTetrahedron& half)
{
  EdgePointPlaces places;
  for (int i = 0; i < 3; ++i)
  {
    const OuterEdge& outer = half.OuterEdges[i];
    places[i] = PlaceOf({ 0, 0, 0 }, DiamondPoints::Isovertex(0, half.Vertices[i]));
    places[OwnEdgeCount + i] =
      PlaceOf(shape.Offsets[outer.OwnerVertex], DiamondPoints::Isovertex(0, outer.OwnerEdge));
  }
  return places;
}

TrianglePointPlaces PlacesOfTriangles(const TypeTable& shape, const HalfTetrahedron& half)
{
  const EdgePointPlaces onEdges = PlacesOnEdges(shape, half);
  TrianglePointPlaces places;
  for (std::size_t differing = 0; differing < places.size(); ++differing)
  {
    const SurfacePatch& patch = tables::IsosurfacePatches[differing];
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        places[differing][i][corner] = onEdges[patch.Triangles[i][corner]];
      }
    }
  }
  return places;
}

AgePointPlaces PlacesByAge(const TypeTable& shape, const HalfTetrahedron& half)
{
  const EdgePointPlaces onEdges = PlacesOnEdges(shape, half);
  AgePointPlaces places;
  places[0] = PlaceOf({ 0, 0, 0 }, DiamondPoints::Centre);
  for (int older = 1; older < 4; ++older)
  {
    const int vertex = half.Vertices[half.ByAge[older - 1]];
    places[older] = PlaceOf(shape.Offsets[vertex], DiamondPoints::Centre);
    for (int younger = 0; younger < older; ++younger)
    {
      places[EdgeByAge(younger, older)] = onEdges[EdgeBetween(half, younger, older)];
    }
  }
  return places;
}

template <typename Places>
PatchPointTable<Places> MakeTable(Places (*placesOf)(const TypeTable&, const HalfTetrahedron&))
{
  PatchPointTable<Places> table{};
  for (std::size_t type = 0; type < table.size(); ++type)
  {
    const TypeTable& shape = tables::Types[type];
    for (int half = 0; half < shape.HalfTetrahedronCount; ++half)
    {
      table[type][half] = placesOf(shape, shape.HalfTetrahedra[half]);
    }
  }
  return table;
}

}

const PatchPointTable<TrianglePointPlaces>& PointsOfTriangles()
{
  static const PatchPointTable<TrianglePointPlaces> table = MakeTable(PlacesOfTriangles);
  return table;
}

const PatchPointTable<AgePointPlaces>& PointsByAge()
{
  static const PatchPointTable<AgePointPlaces> table = MakeTable(PlacesByAge);
  return table;
}

}
