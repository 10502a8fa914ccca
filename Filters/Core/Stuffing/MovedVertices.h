// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MovedVertices_h
#define isodiamond_MovedVertices_h

#include "Field/Parallel.h"
#include "Stuffing/LeafPieces.h"
#include "Stuffing/TouchedPoints.h"
#include "Stuffing/VertexPlaces.h"

namespace isodiamond
{

/**
 * The vertices of a background mesh, some of which have been moved onto a surface.
 *
 * An isovertex near the end of its edge makes thin tetrahedra. So a vertex that has one nearby
 * moves there, and all others on its edges vanish, as the surface now passes through the vertex
 * (Labelle & Shewchuk, "Isosurface stuffing", SIGGRAPH 2007). The nearest move first; a vertex
 * stays where it is if a tetrahedron around it would get too flat, or the topology would change
 * (SurfaceLinks.h). Isovertices near a vertex that stays, as where two sheets nearly touch or a
 * piece is tiny, are pushed away from it, along their edges: that makes room for good shapes.
 */
class MovedVertices
{
public:
  /** None has been moved yet. @param background must outlive it */
  explicit MovedVertices(const Background& background);

  /** Moves all vertices that can be moved. */
  void MoveAll(const ParallelFor& parallelFor);

  /** Pushes isovertices away from vertices that must not move: those that are pinned, or where the
   *  topology would change. @param most how far, in the world */
  void PushAll(double most, const ParallelFor& parallelFor);

  /** What is in range, cut in the best way. */
  TetrahedronMesh Cut(const ParallelFor& parallelFor) const
  {
    return CutInBestWay(this->Mesh, this->Vertices, this->Points, parallelFor);
  }

private:
  /** An isovertex that a vertex could move to. */
  struct Goal
  {
    double Distance = HUGE_VAL; ///< as a part of the edge
    std::uint32_t Vertex = 0;
    std::uint32_t Point = CutMesh::None;
    int Surface = 0;
  };

  Goal NearestTo(std::uint32_t vertex, double most) const;
  Goal NearestToMove(std::uint32_t vertex) const
  {
    return this->NearestTo(vertex, this->Mesh.MostMoveOf(vertex));
  }
  Goal GoalOf(std::uint32_t vertex) const;
  void MoveTo(const Goal& goal);
  PlacesView Tried(const Goal& goal) const;
  bool CanBeOn(const Goal& goal) const;
  bool IsRoundAround(const Goal& goal) const;
  bool IsBent(const PlacesView& tried, std::uint32_t leaf) const;
  bool HasToStay(std::uint32_t vertex) const;
  void Push(std::uint32_t point, std::uint32_t from, double most);
  std::uint32_t OtherEnd(std::uint32_t point, std::uint32_t vertex) const;
  double PartOfEdge(std::uint32_t point, std::uint32_t vertex) const;

  const Background& Mesh;
  VertexPlaces Vertices;
  std::vector<Vector> Points; ///< where they are
  TouchedPoints Touched;      ///< vertices around those that have moved
};

}

#endif
