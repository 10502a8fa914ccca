// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceDistance_h
#define ReferenceDistance_h

#include "ReferenceMesh.h"

#include <array>
#include <vector>

namespace reference
{

/** A triangle of the isosurface; its corners are coded positions of isovertices, in index space. */
struct SurfaceTriangle
{
  std::array<std::array<double, 3>, 3> Corners;
};

/**
 * The triangles of the isosurface in a tetrahedron: none, one or two. None if a vertex has no
 * sample. If two vertices lie on each side, the four isovertices need not lie in one plane, so it
 * matters which diagonal separates the triangles. It starts at one of the two isovertices next to
 * the youngest vertex of the tetrahedron; orientation tells which. As all four ages differ, no
 * choice is left.
 * @param exact true if isovertices are at their ExactPosition(), false if they are where linear
 * interpolation puts them
 */
std::vector<SurfaceTriangle> TrianglesOf(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const Tetrahedron& tetrahedron, bool exact);

/**
 * The distance of a point from a triangle, in world units. Both are given in a space that the
 * spacing scales to the world: in index space, where coordinates are multiples of 1/256, or, with a
 * spacing of 1, in the world itself.
 */
double Distance(const std::array<double, 3>& point, const SurfaceTriangle& triangle,
  const std::array<double, 3>& spacing);
/** The distance from the nearest of several triangles; infinite if there is none. */
double Distance(const std::array<double, 3>& point, const std::vector<SurfaceTriangle>& triangles,
  const std::array<double, 3>& spacing);

/**
 * The distance errors of all diamonds by themselves, whatever their descendants' errors, in world
 * units. If in a closed mesh all diamonds on the front have errors of at most t, then no isovertex
 * of full resolution is farther than t from the isosurface in the mesh.
 *
 * The error of a diamond D is the largest distance error of any isovertex of full resolution, seen
 * from any closed tetrahedron T of D that holds it. This distance error is the smallest distance
 * that is certain in every mesh with T as a leaf, given what surrounds the spine of D there:
 *  - T itself;
 *  - the tetrahedra of D that the same parent made, since one bisection makes them all;
 *  - for any other tetrahedron of D, itself or one of those it was bisected from, as far up as they
 *    have the spine as an edge and samples at all vertices; one of them is a leaf, so the farthest
 *    one counts.
 * The distance from a tetrahedron without triangles is infinite.
 *
 * -Infinity for diamonds whose domain holds no isovertex of full resolution. Infinity for those
 * that are always to be subdivided:
 *  - diamonds that hold one and stick out of the grid, or have a vertex that is not finite,
 *  - diamonds that hold one on an edge with an end that is not finite,
 *  - diamonds with an isovertex whose distance error is infinite, if features are to be preserved.
 * If features are not preserved, the last get their diameter instead: the largest distance between
 * two of their vertices. This is less than a promise.
 */
std::vector<double> OwnDistanceErrors(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const std::array<double, 3>& spacing, bool exact, bool preserveFeatures = true);

/** A coordinate for each sample on each axis. */
using Coordinates = std::array<std::vector<double>, 3>;

/** The world position of a point of the grid in index space: linear from sample to sample. */
std::array<double, 3> PlaceByCoordinates(
  const std::array<double, 3>& point, const Coordinates& coordinates);

/** The same errors if samples have coordinates instead of a spacing. Isovertices are moved to the
 *  world, where edges between them are straight and triangles flat. */
std::vector<double> OwnDistanceErrors(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const Coordinates& coordinates, bool exact, bool preserveFeatures = true);

/** A place in the world for each sample, x fastest. */
struct SamplePlaces
{
  std::array<int, 3> Dims{};
  std::vector<double> Coordinates; ///< three for each sample
};

/** The same errors if each sample has a place of its own: in a cell each coordinate is trilinear.
 */
std::vector<double> OwnDistanceErrors(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const SamplePlaces& places, bool exact, bool preserveFeatures = true);

}

#endif
