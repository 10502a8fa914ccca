// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IntervalPatches_h
#define isodiamond_IntervalPatches_h

#include <array>
#include <cstdint>
#include <vector>

/**
 * @file IntervalPatches.h
 * What lies between two surfaces in one tetrahedron, as tetrahedra.
 *
 * The four vertices of a tetrahedron of the hierarchy have four different ages (scale, then
 * class); here they are numbered 0 to 3 from the youngest to the oldest. Their signs make 81
 * *cases*. The *points* of a case are its vertices inside, and the isovertices on its edges, up to
 * two on each. They are ordered: vertices by age, then isovertices by younger end, older end,
 * lower surface before upper. On every face of the tetrahedron the part in range is a polygon,
 * triangulated as a fan from its smallest point. Ages, and so the order of the points of a face,
 * are the same seen from both of its sides: neighbours agree by construction.
 *
 * Isovertices can be anywhere on their edges, as long as the lower and the upper one of an edge
 * keep their order. A tetrahedron of points is *safe* if its orientation is the same wherever these
 * are. For every case a search finds a triangulation that consists of safe tetrahedra only and
 * meets the fans; so every tetrahedron of an interval volume has positive volume, a guarantee that
 * ends only where coordinates are rounded. The diagonals of quadrilaterals on the surfaces are
 * free: the search picks them.
 */
namespace isodiamond
{

/** The faces of a positive tetrahedron by the vertices opposite to them, each anticlockwise as seen
 *  from outside. */
inline constexpr std::array<std::array<int, 3>, 4> FacesOfTetrahedron = { { { 1, 2, 3 },
  { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } } };

/** A point of a case: a vertex, or an isovertex by edge and surface. */
class PatchPoint
{
public:
  PatchPoint() = default;
  static constexpr PatchPoint Vertex(int vertex) { return PatchPoint(vertex, vertex, 0); }
  static constexpr PatchPoint Isovertex(int end, int other, int surface)
  {
    return end < other ? PatchPoint(end, other, surface) : PatchPoint(other, end, surface);
  }

  constexpr bool IsVertex() const { return this->Young == this->Old; }
  constexpr int Younger() const { return this->Young; }
  constexpr int Older() const { return this->Old; }
  constexpr int Surface() const { return this->OnSurface; }

  /** The order of the points. */
  constexpr int Rank() const
  {
    return this->IsVertex() ? this->Young : 4 + 2 * (4 * this->Young + this->Old) + this->OnSurface;
  }
  constexpr bool operator==(const PatchPoint& other) const { return this->Rank() == other.Rank(); }
  constexpr bool operator<(const PatchPoint& other) const { return this->Rank() < other.Rank(); }

private:
  constexpr PatchPoint(int younger, int older, int surface)
    : Young(static_cast<std::uint8_t>(younger))
    , Old(static_cast<std::uint8_t>(older))
    , OnSurface(static_cast<std::uint8_t>(surface))
  {
  }

  std::uint8_t Young = 0;
  std::uint8_t Old = 0;
  std::uint8_t OnSurface = 0;
};

/** Oriented like the case's tetrahedron (0, 1, 2, 3). */
using PatchTetrahedron = std::array<PatchPoint, 4>;

/** Signs of the vertices 0 to 3, as Isoregion::SignOf gives them for an isorange. */
using PatchSigns = std::array<int, 4>;

/** Where a vertex is: twice its sign; or an odd number if it has been moved onto a surface. */
enum VertexState : int
{
  BelowLower = 0,
  OnLower = 1,
  BetweenSurfaces = 2,
  OnUpper = 3,
  AboveUpper = 4
};

/** The state of being on a surface. */
inline constexpr int StateOn(int surface)
{
  return 1 + 2 * surface;
}

inline constexpr bool IsInRange(int state)
{
  return state != BelowLower && state != AboveUpper;
}

/** States of the vertices 0 to 3. */
using PatchStates = std::array<int, 4>;

inline constexpr PatchStates StatesOf(const PatchSigns& signs)
{
  return { 2 * signs[0], 2 * signs[1], 2 * signs[2], 2 * signs[3] };
}

inline constexpr int PatchCase(const PatchSigns& signs)
{
  return signs[0] + 3 * (signs[1] + 3 * (signs[2] + 3 * signs[3]));
}

/** The tetrahedra of all 81 cases; the search finds them once. */
const std::array<std::vector<PatchTetrahedron>, 81>& IntervalPatches();

inline constexpr int MovedCase(const PatchStates& states)
{
  return states[0] + 5 * (states[1] + 5 * (states[2] + 5 * states[3]));
}

/**
 * The same where vertices may be on surfaces, for all 625 cases of states: such vertices are points
 * of their surface, which then has no isovertices on their edges. Safe as long as moved vertices
 * leave the tetrahedron positive, and isovertices are on the straight lines between the vertices.
 * Where there is a choice of diagonals on a surface, there is a tetrahedralization for each.
 */
const std::array<std::vector<std::vector<PatchTetrahedron>>, 625>& MovedPatches();

/** The orientation of a tetrahedron of points, relative to (0, 1, 2, 3), if it is the same wherever
 *  the isovertices are: 1 or -1; 0 if it is not. */
int SafeOrientation(const PatchStates& states, const PatchTetrahedron& points);

/** The polygon in range on the face opposite to a vertex, anticlockwise as seen from outside a
 *  positive tetrahedron; empty if nothing is in range. */
std::vector<PatchPoint> FacePolygon(const PatchStates& states, int opposite);

}

#endif
