// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/NewLeaves.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** New leaves, the leaves beside them, and so on: holding the outermost vertices has hardly any
 *  effect on the new leaves. */
constexpr int RingsAround = 3;

Point FourTimesMiddle(const CutMesh& mesh, const CutMesh::Tetrahedron& leaf)
{
  Point sum{};
  for (const std::uint32_t vertex : leaf.Vertices)
  {
    sum = sum + mesh.Vertices[vertex].Position;
  }
  return sum;
}

/** Marks the vertices of the leaves whose mark is the given one. */
std::vector<bool> VerticesOf(const CutMesh& mesh, const std::vector<bool>& leaves, bool mark)
{
  std::vector<bool> vertices(mesh.Vertices.size());
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    for (const std::uint32_t vertex : mesh.Tetrahedra[i].Vertices)
    {
      vertices[vertex] = vertices[vertex] || leaves[i] == mark;
    }
  }
  return vertices;
}

/** Also marks the leaves that have a vertex in common with marked ones. */
void AddRing(const CutMesh& mesh, std::vector<bool>& leaves)
{
  const std::vector<bool> vertices = VerticesOf(mesh, leaves, true);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    const auto& corners = mesh.Tetrahedra[i].Vertices;
    leaves[i] = std::any_of(
      corners.begin(), corners.end(), [&](std::uint32_t vertex) { return vertices[vertex]; });
  }
}

}

CutMesh NewLeaves::Find(const CutMesh& mesh)
{
  std::vector<Point> middles;
  std::vector<bool> isTaken;
  for (const CutMesh::Tetrahedron& leaf : mesh.Tetrahedra)
  {
    middles.push_back(FourTimesMiddle(mesh, leaf));
    isTaken.push_back(!std::binary_search(this->Seen.begin(), this->Seen.end(), middles.back()));
  }
  std::sort(middles.begin(), middles.end());
  this->Seen = std::move(middles);
  for (int ring = 0; ring < RingsAround; ++ring)
  {
    AddRing(mesh, isTaken);
  }
  CutMesh part;
  part.Vertices = mesh.Vertices;
  const std::vector<bool> isOutside = VerticesOf(mesh, isTaken, false);
  for (std::size_t vertex = 0; vertex < isOutside.size(); ++vertex)
  {
    part.Vertices[vertex].IsFixed = mesh.Vertices[vertex].IsFixed || isOutside[vertex];
  }
  for (std::size_t i = 0; i < isTaken.size(); ++i)
  {
    if (isTaken[i])
    {
      part.Tetrahedra.push_back(mesh.Tetrahedra[i]);
    }
  }
  return part;
}

}
