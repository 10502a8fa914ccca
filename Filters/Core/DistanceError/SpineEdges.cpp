// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/SpineEdges.h"

namespace isodiamond
{
namespace
{

/** The index of an owner, which is added if it is new. */
std::uint8_t AddOwner(const Place& owner, const Point& position, SpineEdges& edges)
{
  const Point offset = Centre(owner) + -1 * position;
  int i = 0;
  while (i < edges.OwnerCount && edges.Owners[i].Offset != offset)
  {
    ++i;
  }
  if (i == edges.OwnerCount)
  {
    edges.Owners[edges.OwnerCount++] = { offset, owner.Scale };
  }
  return static_cast<std::uint8_t>(i);
}

/** The index of an edge, which is added if it is new. */
std::uint8_t AddEdge(std::uint8_t owner, std::uint8_t ownerEdge, SpineEdges& edges)
{
  int i = 0;
  while (
    i < edges.EdgeCount && (edges.Edges[i].Owner != owner || edges.Edges[i].OwnerEdge != ownerEdge))
  {
    ++i;
  }
  if (i == edges.EdgeCount)
  {
    edges.Edges[edges.EdgeCount++] = { owner, ownerEdge };
  }
  return static_cast<std::uint8_t>(i);
}

/** @param position at scale 0, with room for parents */
SpineEdges MakeEdges(const Point& position)
{
  SpineEdges edges;
  ForEachParentHalf({ 0, position },
    [&](int number, const Place& parent, const HalfTetrahedron& half)
    {
      for (int edge = 0; edge < 6; ++edge)
      {
        const OwnedEdge owned = OwnedEdgeOf({ parent, 0, &half }, edge);
        edges.OfTetrahedron[number][edge] =
          AddEdge(AddOwner(owned.Owner, position, edges), owned.Edge, edges);
      }
    });
  return edges;
}

}

const SpineEdges& SpineEdgesOf(const Point& position)
{
  static const auto tables = MakeByType(MakeEdges);
  return tables[TypeOf(position)];
}

}
