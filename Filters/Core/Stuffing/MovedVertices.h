// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MovedVertices_h
#define isodiamond_MovedVertices_h

#include "Field/Parallel.h"
#include "Patches/IntervalPatches.h"
#include "Stuffing/Background.h"
#include "Stuffing/SurfaceLinks.h"

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
  void PushAll(double most);

  /** What is in range, as tetrahedra of points. Of several ways to cut a leaf, the one whose worst
   *  piece is best. What was pushed is a new point, blended from the old one: that tells where the
   *  surface was. */
  TetrahedronMesh Cut(const ParallelFor& parallelFor) const;

  /** The interval volume's mesh: each leaf cut in the way that the errors of diamonds are those of.
   *  @pre no vertex has been moved */
  TetrahedronMesh CutAsMeasured() const;

private:
  /** An isovertex that a vertex could move to. */
  struct Goal
  {
    double Distance = 0.0; ///< as a part of the edge
    std::uint32_t Vertex = 0;
    std::uint32_t Point = CutMesh::None;
    int Surface = 0;
  };

  TetrahedronMesh PlacedPoints() const;
  std::vector<std::uint32_t> AddPushed(TetrahedronMesh& mesh) const;
  double SineOf(std::uint32_t tetrahedron, const PatchTetrahedron& piece) const;
  std::uint8_t BestPatch(std::uint32_t tetrahedron) const;
  void AddPieces(std::uint32_t tetrahedron, std::uint8_t patch, TetrahedronMesh& mesh) const;
  Goal NearestTo(std::uint32_t vertex, double most) const;
  Goal NearestToMove(std::uint32_t vertex) const
  {
    return this->NearestTo(vertex, this->Mesh.MostMoveOf(vertex));
  }
  bool TryToMove(const Goal& goal);
  bool HasToStay(std::uint32_t vertex);
  void Push(std::uint32_t point, std::uint32_t from, double most);
  bool AreAllRound(std::uint32_t vertex) const;
  bool IsBent(std::uint32_t tetrahedron) const;
  bool IsPinned(std::uint32_t tetrahedron) const
  {
    return PinsOf(this->Mesh.Leaves(), tetrahedron) > 0;
  }
  bool ArePiecesPositive(std::uint32_t tetrahedron) const;
  std::uint32_t PointOf(std::uint32_t tetrahedron, const PatchPoint& point) const;
  std::uint32_t PointAt(std::uint32_t vertex) const;
  Corners CornersOf(std::uint32_t tetrahedron, const PatchTetrahedron& piece) const;
  const std::vector<std::vector<PatchTetrahedron>>& PatchesOf(std::uint32_t tetrahedron) const;
  bool IsCut(std::uint32_t first, std::uint32_t second, int surface) const;
  std::uint32_t OtherEnd(std::uint32_t point, std::uint32_t vertex) const;
  double PartOfEdge(std::uint32_t point, std::uint32_t vertex) const;

  const Background& Mesh;
  std::vector<std::uint8_t> States; ///< by vertex, see VertexState
  std::vector<std::uint32_t> Goals; ///< by vertex: the point that it was moved to, or None
  std::vector<Vector> Positions;
  std::vector<Vector> Places; ///< by point
  SurfaceLinks Links;
};

}

#endif
