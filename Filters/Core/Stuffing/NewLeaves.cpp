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

/** By vertex or by leaf. Not vector<bool>: there are many looks at it. */
using Marks = std::vector<std::uint8_t>;

/** Marks the vertices of the leaves whose mark is the given one. */
Marks VerticesOf(const CutMesh& mesh, const Marks& leaves, bool mark)
{
  Marks vertices(mesh.Vertices.size());
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    if ((leaves[i] != 0) == mark)
    {
      for (const std::uint32_t vertex : mesh.Tetrahedra[i].Vertices)
      {
        vertices[vertex] = 1;
      }
    }
  }
  return vertices;
}

/** Also marks the leaves that have a vertex in common with marked ones. */
void AddRing(const CutMesh& mesh, Marks& leaves)
{
  const Marks vertices = VerticesOf(mesh, leaves, true);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    const auto [a, b, c, d] = mesh.Tetrahedra[i].Vertices;
    leaves[i] = vertices[a] | vertices[b] | vertices[c] | vertices[d];
  }
}

/** The youngest vertices of leaves, as numbers, sorted. */
std::vector<std::uint64_t> YoungestOf(const CutMesh& mesh)
{
  Marks isYoungest(mesh.Vertices.size());
  for (const CutMesh::Tetrahedron& leaf : mesh.Tetrahedra)
  {
    isYoungest[leaf.Vertices[0]] = 1;
  }
  std::vector<std::uint64_t> youngest;
  for (std::size_t vertex = 0; vertex < isYoungest.size(); ++vertex)
  {
    if (isYoungest[vertex] != 0)
    {
      youngest.push_back(PackedPoint(mesh.Vertices[vertex].Position));
    }
  }
  std::sort(youngest.begin(), youngest.end());
  return youngest;
}

}

CutMesh NewLeaves::Find(const CutMesh& mesh)
{
  Marks isNew(mesh.Vertices.size());
  for (std::size_t vertex = 0; vertex < isNew.size(); ++vertex)
  {
    const std::uint64_t number = PackedPoint(mesh.Vertices[vertex].Position);
    isNew[vertex] = std::binary_search(this->Seen.begin(), this->Seen.end(), number) ? 0 : 1;
  }
  Marks isTaken;
  isTaken.reserve(mesh.Tetrahedra.size());
  for (const CutMesh::Tetrahedron& leaf : mesh.Tetrahedra)
  {
    isTaken.push_back(isNew[leaf.Vertices[0]]);
  }
  this->Seen = YoungestOf(mesh);
  for (int ring = 0; ring < RingsAround; ++ring)
  {
    AddRing(mesh, isTaken);
  }
  CutMesh part;
  part.Vertices = mesh.Vertices;
  const Marks isOutside = VerticesOf(mesh, isTaken, false);
  for (std::size_t vertex = 0; vertex < isOutside.size(); ++vertex)
  {
    part.Vertices[vertex].IsFixed = mesh.Vertices[vertex].IsFixed || isOutside[vertex] != 0;
  }
  for (std::size_t i = 0; i < isTaken.size(); ++i)
  {
    if (isTaken[i] != 0)
    {
      part.Tetrahedra.push_back(mesh.Tetrahedra[i]);
    }
  }
  return part;
}

}
