// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/LinkCondition.h"

#include "Stuffing/LocalMesh.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace isodiamond
{
namespace
{

/** A set of few points: looking at all of them is faster than any order. */
class PointSet
{
public:
  bool Has(std::uint32_t point) const
  {
    return std::find(this->Points.begin(), this->Points.end(), point) != this->Points.end();
  }
  void Add(std::uint32_t point)
  {
    if (!this->Has(point))
    {
      this->Points.push_back(point);
    }
  }

private:
  std::vector<std::uint32_t> Points;
};

/** An edge, seen from its first end. */
class EdgeLink
{
public:
  EdgeLink(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b)
    : Mesh(mesh)
  {
    for (const std::uint32_t tetrahedron : mesh.StarOf(a))
    {
      const Corners& corners = mesh.CornersOf(tetrahedron);
      for (const std::uint32_t point : corners)
      {
        this->Around.Add(point);
      }
      if (Has(corners, b))
      {
        const Edge edge = Without(corners, a, b);
        this->Edges.push_back(SortedEdge(edge[0], edge[1]));
        this->Ring.Add(edge[0]);
        this->Ring.Add(edge[1]);
      }
      else
      {
        this->Apart.push_back(tetrahedron);
      }
    }
  }

  bool IsEmpty() const { return this->Edges.empty(); }

  /** Whether anything of a triangle in the other end's link is also in the first end's link, but
   *  not in the edge's. */
  bool IsMoreInCommon(const Face& face) const
  {
    const std::array<bool, 3> isOnRing = { this->Ring.Has(face[0]), this->Ring.Has(face[1]),
      this->Ring.Has(face[2]) };
    for (int i = 0; i < 3; ++i)
    {
      const int next = (i + 1) % 3;
      const bool isPoint = !isOnRing[i] && this->Around.Has(face[i]);
      const bool isEdge =
        isOnRing[i] && isOnRing[next] && this->HasApart(SortedEdge(face[i], face[next]));
      if (isPoint || isEdge)
      {
        return true;
      }
    }
    return isOnRing[0] && isOnRing[1] && isOnRing[2] && this->IsInOneApart(face);
  }

private:
  /** Whether the first end's link has an edge that is not on the ring. */
  bool HasApart(const Edge& edge) const
  {
    return std::find(this->Edges.begin(), this->Edges.end(), edge) == this->Edges.end() &&
      this->IsInOneApart(edge);
  }
  template <typename Points>
  bool IsInOneApart(const Points& points) const
  {
    return std::any_of(this->Apart.begin(), this->Apart.end(),
      [&](std::uint32_t tetrahedron)
      {
        return std::all_of(points.begin(), points.end(),
          [&](std::uint32_t point) { return Has(this->Mesh.CornersOf(tetrahedron), point); });
      });
  }

  const LocalMesh& Mesh;
  PointSet Around;                  ///< the first end's link, and both ends
  PointSet Ring;                    ///< the edge's link
  std::vector<Edge> Edges;          ///< of the ring, with sorted ends
  std::vector<std::uint32_t> Apart; ///< tetrahedra at the first end that do not have the other
};

/** The edges opposite to a point in the boundary's triangles there: of all edges opposite to it,
 *  those that only one tetrahedron has. */
std::vector<Edge> BoundaryLink(const LocalMesh& mesh, std::uint32_t point)
{
  const LocalMesh::Star star = mesh.StarOf(point);
  std::vector<Edge> all;
  all.reserve(3 * star.size());
  for (const std::uint32_t tetrahedron : star)
  {
    const Face face = Without(mesh.CornersOf(tetrahedron), point);
    for (int i = 0; i < 3; ++i)
    {
      all.push_back(SortedEdge(face[i], face[(i + 1) % 3]));
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<Edge> edges;
  for (auto edge = all.begin(); edge != all.end();)
  {
    const auto next =
      std::find_if(edge, all.end(), [&](const Edge& other) { return other != *edge; });
    if (next - edge == 1)
    {
      edges.push_back(*edge);
    }
    edge = next;
  }
  return edges;
}

/** Sorted, each once. */
std::vector<std::uint32_t> EndsOf(const std::vector<Edge>& edges)
{
  std::vector<std::uint32_t> ends;
  ends.reserve(2 * edges.size());
  for (const Edge& edge : edges)
  {
    ends.insert(ends.end(), edge.begin(), edge.end());
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

std::vector<std::uint32_t> Common(
  const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b)
{
  std::vector<std::uint32_t> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return common;
}

/** Which places of the boundary a point's triangles lie on. */
int PlacesAround(const LocalMesh& mesh, std::uint32_t point, const std::vector<Edge>& link)
{
  int places = 0;
  for (const Edge& edge : link)
  {
    places |= mesh.PlaceOfFace(point, edge[0], edge[1]);
  }
  return places;
}

}

bool HaveOnlyTheirEdgeInCommon(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b)
{
  const EdgeLink edge(mesh, a, b);
  const LocalMesh::Star star = mesh.StarOf(b);
  return !edge.IsEmpty() &&
    std::none_of(star.begin(), star.end(),
      [&](std::uint32_t tetrahedron)
      {
        const Corners& corners = mesh.CornersOf(tetrahedron);
        return !Has(corners, a) && edge.IsMoreInCommon(Without(corners, b));
      });
}

bool HaveOnlyTheirEdgeOnTheBoundary(const LocalMesh& mesh, std::uint32_t from, std::uint32_t to)
{
  const std::vector<Edge> link = BoundaryLink(mesh, from);
  if (link.empty())
  {
    return true;
  }
  std::vector<std::uint32_t> across; // the third points of the edge's triangles
  for (const Edge& edge : link)
  {
    if (edge[0] == to || edge[1] == to)
    {
      across.push_back(edge[0] == to ? edge[1] : edge[0]);
    }
  }
  std::sort(across.begin(), across.end());
  return across.size() == 2 && Common(EndsOf(link), EndsOf(BoundaryLink(mesh, to))) == across &&
    PlacesAround(mesh, from, link) ==
    (mesh.PlaceOfFace(from, to, across[0]) | mesh.PlaceOfFace(from, to, across[1]));
}

}
