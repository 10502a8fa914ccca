// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Background_h
#define isodiamond_Background_h

#include "Mesh/CutMesh.h"
#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/** The leaves of an interval volume's mesh in the world, and which of them are at each vertex. */
class Background
{
public:
  /**
   * @param cut must outlive it
   * @param positions of the cut mesh's vertices in the world
   * @param walls by vertex
   * @param points of the interval volume's mesh, in the world; must outlive it
   * @param mirrored whether orientation turns around from index space to the world
   */
  Background(const CutMesh& cut, std::vector<Vector> positions, std::vector<Walls::Type> walls,
    const std::vector<Vector>& points, bool mirrored)
    : Cut(cut)
    , VertexPositions(std::move(positions))
    , VertexWalls(std::move(walls))
    , Points(points)
    , IsMirrored(mirrored)
    , First(cut.Vertices.size() + 1)
    , Stars(4 * cut.Tetrahedra.size())
  {
    for (const CutMesh::Tetrahedron& tetrahedron : cut.Tetrahedra)
    {
      for (const std::uint32_t vertex : tetrahedron.Vertices)
      {
        ++this->First[vertex + 1];
      }
    }
    for (std::size_t i = 1; i < this->First.size(); ++i)
    {
      this->First[i] += this->First[i - 1];
    }
    std::vector<std::uint32_t> next(this->First.begin(), this->First.end() - 1);
    for (std::uint32_t i = 0; i < cut.Tetrahedra.size(); ++i)
    {
      for (const std::uint32_t vertex : cut.Tetrahedra[i].Vertices)
      {
        this->Stars[next[vertex]++] = i;
      }
    }
  }

  const CutMesh& Leaves() const { return this->Cut; }
  std::uint32_t VertexCount() const
  {
    return static_cast<std::uint32_t>(this->Cut.Vertices.size());
  }
  const Corners& CornersOf(std::uint32_t tetrahedron) const
  {
    return this->Cut.Tetrahedra[tetrahedron].Vertices;
  }
  /** Whether a leaf is negative in the world, in the order of its vertices. */
  bool IsNegative(std::uint32_t tetrahedron) const
  {
    return this->Cut.Tetrahedra[tetrahedron].IsOdd != this->IsMirrored;
  }

  const Vector& PositionOf(std::uint32_t vertex) const { return this->VertexPositions[vertex]; }
  const Vector& PointAt(std::uint32_t point) const { return this->Points[point]; }
  const std::vector<Vector>& AllPoints() const { return this->Points; }
  Walls::Type WallsOf(std::uint32_t vertex) const { return this->VertexWalls[vertex]; }

  /** Calls body(tetrahedron) for those at a vertex. */
  template <typename Body>
  void ForEachAt(std::uint32_t vertex, Body&& body) const
  {
    for (std::uint32_t i = this->First[vertex]; i < this->First[vertex + 1]; ++i)
    {
      body(this->Stars[i]);
    }
  }

  /** Whether test(tetrahedron) is true for all of those at a vertex. */
  template <typename Test>
  bool AllAt(std::uint32_t vertex, Test&& test) const
  {
    for (std::uint32_t i = this->First[vertex]; i < this->First[vertex + 1]; ++i)
    {
      if (!test(this->Stars[i]))
      {
        return false;
      }
    }
    return true;
  }

private:
  const CutMesh& Cut;
  std::vector<Vector> VertexPositions;
  std::vector<Walls::Type> VertexWalls;
  const std::vector<Vector>& Points;
  bool IsMirrored;
  std::vector<std::uint32_t> First; ///< by vertex, into Stars
  std::vector<std::uint32_t> Stars;
};

}

#endif
