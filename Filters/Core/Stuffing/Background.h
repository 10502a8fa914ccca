// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Background_h
#define isodiamond_Background_h

#include "Mesh/CutMesh.h"
#include "Simplification/CellsAtPoints.h"
#include "Stuffing/TetrahedronMesh.h"

#include <cmath>

namespace isodiamond
{

/** A point of the mesh where a surface crosses an edge of leaves. */
struct Crossing
{
  Edge Ends = { CutMesh::None, CutMesh::None }; ///< vertices, the younger one first
  std::int8_t Surface = 0;                      ///< 0 the lower one, 1 the upper

  bool IsThere() const { return this->Ends[0] != CutMesh::None; }
};

/** The leaves of an interval volume's mesh in the world, and what is at each of their vertices. */
class Background
{
public:
  /**
   * @param cut must outlive it
   * @param positions of the cut mesh's vertices in the world; must outlive it
   * @param walls by vertex
   * @param points of the interval volume's mesh, in the world; must outlive it
   * @param mirrored whether orientation is reversed from index space to the world
   * @param mostMoves by vertex: how far it may move, and surfaces between it and others with a
   *        limit; none if there are no limits
   */
  Background(const CutMesh& cut, const std::vector<Vector>& positions,
    std::vector<Walls::Type> walls, const std::vector<Vector>& points, bool mirrored,
    std::vector<double> mostMoves = {})
    : Cut(cut)
    , VertexPositions(positions)
    , VertexWalls(std::move(walls))
    , Points(points)
    , IsMirrored(mirrored)
    , MostMoves(std::move(mostMoves))
    , Stars(cut.Vertices.size(), cut.Tetrahedra.size(),
        [&](std::size_t tetrahedron) { return cut.Tetrahedra[tetrahedron].Vertices; })
    , Crossings(FindCrossings(cut, points.size()))
    , CrossingsOfStars(
        cut.Vertices.size(), points.size(), [&](std::size_t point) { return this->EndsOf(point); })
  {
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
  /** Whether a leaf, with its vertices in their order, is negative in the world. */
  bool IsNegative(std::uint32_t tetrahedron) const
  {
    return this->Cut.Tetrahedra[tetrahedron].IsOdd != this->IsMirrored;
  }

  const Vector& PositionOf(std::uint32_t vertex) const { return this->VertexPositions[vertex]; }
  const Vector& PointAt(std::uint32_t point) const { return this->Points[point]; }
  const std::vector<Vector>& AllPoints() const { return this->Points; }
  Walls::Type WallsOf(std::uint32_t vertex) const { return this->VertexWalls[vertex]; }

  /** How far a vertex may move. */
  double MostMoveOf(std::uint32_t vertex) const
  {
    return this->MostMoves.empty() ? HUGE_VAL : this->MostMoves[vertex];
  }

  /** The leaves at a vertex. */
  CellsAtPoints::Cells StarOf(std::uint32_t vertex) const { return this->Stars[vertex]; }

  /** By point: where a surface crosses an edge; not there for vertices inside. */
  const std::vector<Crossing>& AllCrossings() const { return this->Crossings; }
  /** The points where surfaces cross the edges of a vertex. */
  IdRange CrossingsAt(std::uint32_t vertex) const { return this->CrossingsOfStars[vertex]; }

private:
  static std::vector<Crossing> FindCrossings(const CutMesh& cut, std::size_t pointCount);
  IdRange EndsOf(std::size_t point) const
  {
    const Crossing& crossing = this->Crossings[point];
    const std::uint32_t* const ends = crossing.Ends.data();
    return { ends, ends + (crossing.IsThere() ? 2 : 0) };
  }

  const CutMesh& Cut;
  const std::vector<Vector>& VertexPositions;
  std::vector<Walls::Type> VertexWalls;
  const std::vector<Vector>& Points;
  bool IsMirrored;
  std::vector<double> MostMoves;
  CellsAtPoints Stars;
  std::vector<Crossing> Crossings; ///< by point
  CellsAtPoints CrossingsOfStars;
};

}

#endif
