// SPDX-License-Identifier: BSD-3-Clause
#include "PatchPoints.h"

#include "ExtractionPasses.h"
#include "SurfacePatch.h"
#include "VertexWindow.h"

namespace isodiamond
{
namespace
{

PatchPointPlace PlaceOf(const Point& offset, int bit)
{
  PatchPointPlace place;
  place.Distance = static_cast<std::int16_t>(VertexWindow::Distance(offset));
  place.Bit = static_cast<std::int16_t>(bit);
  return place;
}

PatchPointPlaces PlacesOf(const TypeTable& shape, const HalfTetrahedron& half)
{
  PatchPointPlaces places;
  for (int i = 0; i < 3; ++i)
  {
    const OuterEdge& outer = half.OuterEdges[i];
    places.OnEdges[i] = PlaceOf({ 0, 0, 0 }, DiamondPoints::Isovertex(0, half.Vertices[i]));
    places.OnEdges[OwnEdgeCount + i] =
      PlaceOf(shape.Offsets[outer.OwnerVertex], DiamondPoints::Isovertex(0, outer.OwnerEdge));
  }
  places.ByAge[0] = PlaceOf({ 0, 0, 0 }, DiamondPoints::Centre);
  for (int older = 1; older < 4; ++older)
  {
    places.ByAge[older] =
      PlaceOf(shape.Offsets[half.Vertices[half.ByAge[older - 1]]], DiamondPoints::Centre);
    for (int younger = 0; younger < older; ++younger)
    {
      places.ByAge[PatchPointPlaces::EdgeByAge(younger, older)] =
        places.OnEdges[EdgeBetween(half, younger, older)];
    }
  }
  return places;
}

}

const PatchPointTable& PatchPointsOfTypes()
{
  static const PatchPointTable table = []
  {
    PatchPointTable all{};
    for (std::size_t type = 0; type < all.size(); ++type)
    {
      const TypeTable& shape = tables::Types[type];
      for (int half = 0; half < shape.HalfTetrahedronCount; ++half)
      {
        all[type][half] = PlacesOf(shape, shape.HalfTetrahedra[half]);
      }
    }
    return all;
  }();
  return table;
}

}
