// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceTopology.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace reference
{

namespace
{

using Polygon = std::vector<Isovertex>;
using Edge = std::array<Isovertex, 2>;

std::vector<Polygon> PolygonsIn(const Hierarchy& hierarchy,
  const std::vector<Tetrahedron>& tetrahedra, const SideOfVertex& isAbove)
{
  std::vector<Polygon> polygons;
  for (const Tetrahedron& tetrahedron : tetrahedra)
  {
    std::array<int, 4> signs;
    for (int i = 0; i < 4; ++i)
    {
      signs[i] = isAbove(tetrahedron.Vertices[i]) ? 1 : 0;
    }
    const Patch patch = PatchOf(hierarchy, tetrahedron, signs);
    if (!patch.Corners.empty())
    {
      polygons.push_back(patch.Corners);
    }
  }
  return polygons;
}

/** For every vertex the smallest one that it is connected with; the vertices of a group are
 *  connected. */
std::map<Isovertex, Isovertex> Connect(const std::vector<std::vector<Isovertex>>& groups)
{
  std::map<Isovertex, Isovertex> smallest;
  for (const std::vector<Isovertex>& group : groups)
  {
    for (const Isovertex& vertex : group)
    {
      smallest.emplace(vertex, vertex);
    }
  }
  for (bool changes = true; changes;)
  {
    changes = false;
    for (const std::vector<Isovertex>& group : groups)
    {
      for (const Isovertex& a : group)
      {
        for (const Isovertex& b : group)
        {
          if (smallest[a] < smallest[b])
          {
            smallest[b] = smallest[a];
            changes = true;
          }
        }
      }
    }
  }
  return smallest;
}

/** The edges of polygons, and how many polygons have each. */
std::map<Edge, int> EdgesOf(const std::vector<Polygon>& polygons)
{
  std::map<Edge, int> edges;
  for (const Polygon& polygon : polygons)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      Edge edge = { polygon[i], polygon[(i + 1) % polygon.size()] };
      std::sort(edge.begin(), edge.end());
      ++edges[edge];
    }
  }
  return edges;
}

/** Whether an edge is there before and after bisection of a diamond. */
bool IsOuter(const Diamond& diamond, const Isovertex& edge)
{
  const auto isEnd = [&edge](const Point& point)
  { return edge.Younger == point || edge.Older == point; };
  return !isEnd(diamond.Center) && !(isEnd(diamond.Spine[0]) && isEnd(diamond.Spine[1]));
}

}

bool operator==(const DomainPiece& a, const DomainPiece& b)
{
  return a.EulerNumber == b.EulerNumber && a.BoundaryLoops == b.BoundaryLoops &&
    a.OuterEdges == b.OuterEdges;
}

bool operator<(const DomainPiece& a, const DomainPiece& b)
{
  return std::tie(a.EulerNumber, a.BoundaryLoops, a.OuterEdges) <
    std::tie(b.EulerNumber, b.BoundaryLoops, b.OuterEdges);
}

std::vector<DomainPiece> PiecesInDomain(
  const Hierarchy& hierarchy, int diamond, const SideOfVertex& isAbove, bool isBisected)
{
  std::vector<Tetrahedron> tetrahedra;
  for (const Tetrahedron& tetrahedron : hierarchy.At(diamond).Tetrahedra)
  {
    const std::array<Tetrahedron, 2> halves = Hierarchy::Bisect(tetrahedron);
    tetrahedra.insert(tetrahedra.end(), isBisected ? halves.data() : &tetrahedron,
      isBisected ? halves.data() + 2 : &tetrahedron + 1);
  }
  const std::vector<Polygon> polygons = PolygonsIn(hierarchy, tetrahedra, isAbove);
  std::map<Isovertex, Isovertex> pieceOf = Connect(polygons);
  std::map<Isovertex, DomainPiece> pieces;
  for (const auto& [vertex, piece] : pieceOf)
  {
    ++pieces[piece].EulerNumber;
    if (IsOuter(hierarchy.At(diamond), vertex))
    {
      pieces[piece].OuterEdges.insert(vertex);
    }
  }
  std::vector<std::vector<Isovertex>> boundary;
  for (const auto& [edge, count] : EdgesOf(polygons))
  {
    --pieces[pieceOf[edge[0]]].EulerNumber;
    if (count == 1)
    {
      boundary.push_back({ edge[0], edge[1] });
    }
  }
  for (const Polygon& polygon : polygons)
  {
    ++pieces[pieceOf[polygon[0]]].EulerNumber;
  }
  for (const auto& [vertex, loop] : Connect(boundary))
  {
    pieces[pieceOf[vertex]].BoundaryLoops += vertex == loop ? 1 : 0;
  }
  std::vector<DomainPiece> sorted;
  for (const auto& [vertex, piece] : pieces)
  {
    sorted.push_back(piece);
  }
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

bool IsCritical(const Hierarchy& hierarchy, int diamond, const SideOfVertex& isAbove)
{
  return PiecesInDomain(hierarchy, diamond, isAbove, false) !=
    PiecesInDomain(hierarchy, diamond, isAbove, true);
}

}
