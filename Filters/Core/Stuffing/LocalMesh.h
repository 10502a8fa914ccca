// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_LocalMesh_h
#define isodiamond_LocalMesh_h

#include "Simplification/CellsAtPoints.h"
#include "Stuffing/TetrahedronMesh.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{

/**
 * A tetrahedral mesh for local changes: tetrahedra are removed and added, points move.
 *
 * It can tell whether a change leaves a mesh of the same topology, with the same surfaces and
 * walls; whether the mesh gets better, and stays near, is for the caller to check.
 */
class LocalMesh
{
public:
  static constexpr std::uint32_t None = 0xffffffff;

  explicit LocalMesh(TetrahedronMesh mesh);

  const TetrahedronMesh& Mesh() const { return this->TheMesh; }
  const Vector& At(std::uint32_t point) const { return this->TheMesh.Positions[point]; }
  const Corners& CornersOf(std::uint32_t tetrahedron) const
  {
    return this->TheMesh.Tetrahedra[tetrahedron];
  }
  bool IsAlive(std::uint32_t tetrahedron) const { return this->Sines[tetrahedron] != Dead; }
  /** The smallest sine of a tetrahedron that is alive. */
  double SineOf(std::uint32_t tetrahedron) const { return this->Sines[tetrahedron]; }
  double SineOf(const Corners& corners) const { return SmallestSine(this->TheMesh, corners); }

  /** The point that a point has its attributes from; itself, unless it is blended. */
  std::uint32_t SourceOf(std::uint32_t point) const
  {
    return this->BlendOf[point] == None
      ? point
      : this->TheMesh.Blended[this->BlendOf[point]].Shares[0].Point;
  }

  /** The tetrahedra at a point. */
  using Star = CellsAtPoints::Cells;
  Star StarOf(std::uint32_t point) const;
  double WorstAround(std::uint32_t point) const;

  bool HasEdge(std::uint32_t a, std::uint32_t b) const;
  /** How many tetrahedra have this triangle. */
  int CountAt(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /** What a triangle of the boundary lies on: walls, as bits, or one of these. */
  static constexpr int LowerSurface = 128;
  static constexpr int UpperSurface = 256;
  int PlaceOfFace(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  /** Whether a tetrahedron has a face on a wall with all points on one surface: its points cannot
   *  tell which of the two it lies on. */
  bool IsAmbiguous(const Corners& corners) const;

  /** Whether an edge can shrink into one of its ends: the link condition, also for the boundary and
   *  for the curves where a surface meets a wall. */
  bool CanCollapse(std::uint32_t from, std::uint32_t to) const;

  /** The points around an edge, such that (a, b, each, the next) are its tetrahedra. */
  struct Ring
  {
    std::vector<std::uint32_t> Points;
    std::vector<std::uint32_t> Tetrahedra;
    bool IsClosed = false; ///< else it is a path, at the boundary
  };
  /** @return whether there is one with at most that many tetrahedra */
  bool FindRing(std::uint32_t a, std::uint32_t b, std::size_t most, Ring& ring) const;

  ///@{
  /** Changes. */
  void Move(std::uint32_t point, const Vector& to);
  void Collapse(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& changed);
  /** Replaces tetrahedra by others. */
  void Replace(const std::vector<std::uint32_t>& old, const std::vector<Corners>& fresh,
    std::vector<std::uint32_t>& changed);
  /** Puts another point in a point's place. */
  void Exchange(std::uint32_t point, std::uint32_t other, std::vector<std::uint32_t>& changed);
  /** Undoes a change that replaced tetrahedra by others, if these are all still there. */
  void PutBack(const std::vector<std::uint32_t>& old, const std::vector<std::uint32_t>& fresh);
  /** Adds a point. @return its id */
  std::uint32_t AddPoint(
    const Vector& at, std::int8_t surface, Walls::Type walls, const std::vector<Share>& shares);
  ///@}

  /** Takes out what is alive, which leaves the LocalMesh empty. */
  TetrahedronMesh Take();

private:
  static constexpr double Dead = -4.0;

  std::vector<std::uint32_t>& OwnStarOf(std::uint32_t point);
  void Add(const Corners& corners, std::uint32_t origin, std::vector<std::uint32_t>& changed);
  void Remove(std::uint32_t tetrahedron);
  std::vector<Share> SharesOf(std::uint32_t point) const;
  void NoteShares(std::uint32_t point, const std::vector<Share>& shares);

  TetrahedronMesh TheMesh;
  std::vector<double> Sines;          ///< by tetrahedron
  CellsAtPoints Stars;                ///< as they were at first
  std::vector<std::uint32_t> Changed; ///< by point: into ChangedStars, or None
  std::vector<std::vector<std::uint32_t>> ChangedStars;
  std::vector<std::uint32_t> BlendOf; ///< by point: into Blended, or None
};

}

#endif
