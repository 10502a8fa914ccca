// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceIntervalMesh_h
#define ReferenceIntervalMesh_h

#include "ReferenceInterval.h"
#include "ReferenceMesh.h"

#include <array>
#include <vector>

namespace reference
{

/**
 * A point of an interval volume: a lattice vertex inside the range, or an isovertex on the lower or
 * the upper surface, named by the edge of the hierarchy it lies on.
 */
struct IntervalPoint
{
  /** Both are the same for a lattice vertex. */
  Point Younger;
  Point Older;
  /** -1 on the lower surface, 0 for a lattice vertex, 1 on the upper surface. */
  int Surface = 0;
};

bool operator==(const IntervalPoint& a, const IntervalPoint& b);
/** An arbitrary order, for sorting; the meaningful one is that of ComesBefore(). */
bool operator<(const IntervalPoint& a, const IntervalPoint& b);

/**
 * Where the lower or the upper surface cuts an edge, as Coefficient() of an isosurface: in steps of
 * 1/256 of the edge, counted from the younger end, 1 to 255. Two isovertices on one edge are in
 * order and apart: if rounding brings them together, the one farther from the younger end moves on
 * by one step, or, at 255, the nearer one moves back. 0 for a lattice vertex.
 */
int Coefficient(const ScalarField& field, const Isorange& range, const IntervalPoint& point);
/** The position of a point in index space. */
std::array<double, 3> Position(
  const ScalarField& field, const Isorange& range, const IntervalPoint& point);

/**
 * The order of the points in a tetrahedron, whose vertices all differ in age: lattice vertices come
 * before isovertices, the younger first. Isovertices are ordered by the younger ends of their
 * edges, the younger first, then by the older ends in the same way, then lower before upper
 * surface. On their common face two tetrahedra have the same order.
 */
bool ComesBefore(const Hierarchy& hierarchy, const IntervalPoint& a, const IntervalPoint& b);

/** Corners in cyclic order. */
using IntervalPolygon = std::vector<IntervalPoint>;
using IntervalTriangle = std::array<IntervalPoint, 3>;

/** LeafTetrahedra() that have samples at all four vertices: the interval volume lies in these. */
std::vector<Tetrahedron> SampledLeaves(const Hierarchy& hierarchy, const DiamondSet& subdivided);

/** The level of the diamond that a tetrahedron lies in: 0 for the root, N at full resolution. */
int LevelOf(const Hierarchy& hierarchy, const Tetrahedron& tetrahedron);

/** The signs of the vertices, as the functions below take them. */
std::array<int, 4> SignsOf(
  const ScalarField& field, const Isorange& range, const Tetrahedron& leaf);

/** The distinct points of the interval volume in some tetrahedra, sorted. */
std::vector<IntervalPoint> PointsOf(const Hierarchy& hierarchy, const ScalarField& field,
  const Isorange& range, const std::vector<Tetrahedron>& leaves);

/**
 * The parts of the four faces of a tetrahedron that are inside the range; the face opposite to the
 * first vertex comes first. The first corner of a part is the smallest by ComesBefore(), the others
 * follow anticlockwise as seen from outside the tetrahedron. Empty where nothing of a face is
 * inside.
 */
std::array<IntervalPolygon, 4> InsideFaces(
  const Hierarchy& hierarchy, const Tetrahedron& leaf, const std::array<int, 4>& signs);

/**
 * How the faces are cut into triangles: the part of every face inside the range is a fan around its
 * smallest corner, so the tetrahedra on both sides of a face agree. The triangles have their
 * smallest corner first and are anticlockwise as seen from outside.
 */
std::vector<IntervalTriangle> FaceTriangles(
  const Hierarchy& hierarchy, const Tetrahedron& leaf, const std::array<int, 4>& signs);

/**
 * The piece of the lower (-1) or the upper (1) surface in a tetrahedron: none, three or four
 * points. The smallest corner comes first, the others follow anticlockwise as seen from outside the
 * range.
 */
IntervalPolygon SurfacePolygon(const Hierarchy& hierarchy, const Tetrahedron& leaf,
  const std::array<int, 4>& signs, int surface);

/**
 * Which diagonals cut the pieces of both surfaces into triangles, which matters as the four corners
 * of a piece need not lie in one plane: false for the diagonal from the first corner of
 * SurfacePolygon(), true for the other. Without meaning for pieces that are triangles. If both
 * pieces have four corners, they cut the same edges; then equal choices join the same two edges on
 * both surfaces, and different choices may let the surfaces cross.
 */
struct Diagonals
{
  bool Lower = false;
  bool Upper = false;
};

/**
 * The boundary of the part of a tetrahedron inside the range: its FaceTriangles() and its pieces of
 * both surfaces, anticlockwise as seen from outside.
 */
std::vector<IntervalTriangle> BoundaryTriangles(const Hierarchy& hierarchy, const Tetrahedron& leaf,
  const std::array<int, 4>& signs, const Diagonals& diagonals);

/** The volume of the part of a tetrahedron inside the range, in index space. */
double LeafVolume(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const Tetrahedron& leaf, const Diagonals& diagonals);

/**
 * The smallest and the largest volume that a choice of diagonals gives. If both surfaces have four
 * corners there, the choice is the same for both.
 */
ValueRange LeafVolumes(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const Tetrahedron& leaf);
/** The same for several tetrahedra together. */
ValueRange VolumesOf(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const std::vector<Tetrahedron>& leaves);

/**
 * Into how many tetrahedra the library cuts the part inside the range; this depends only on how
 * many vertices are below, inside and above.
 */
int CountTetrahedra(const std::array<int, 4>& signs);

}

#endif
