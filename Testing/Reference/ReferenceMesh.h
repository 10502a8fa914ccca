// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceMesh_h
#define ReferenceMesh_h

#include "ReferenceWalk.h"

#include <array>
#include <vector>

namespace reference
{

/**
 * A vertex of the isosurface, named by the edge of the hierarchy it lies on. The diamond centred at
 * the younger end owns it, unless the edge is one of the base cube's own.
 */
struct Isovertex
{
  Point Younger;
  Point Older;
};

bool operator==(const Isovertex& a, const Isovertex& b);
bool operator<(const Isovertex& a, const Isovertex& b);

/**
 * Where the isosurface cuts an edge by linear interpolation, in steps of 1/256 of the edge, counted
 * from the younger end, coded as in the paper except for the bounds: 1 to 255, so that an isovertex
 * is never an end of its edge. 128, the middle, if an end is not finite.
 */
int Coefficient(const ScalarField& field, double isovalue, const Isovertex& isovertex);
/** The position of an isovertex in index space. */
std::array<double, 3> Position(const Isovertex& isovertex, int coefficient);

/**
 * The part of the isosurface in one tetrahedron: a triangle, or a quadrilateral if two vertices lie
 * on each side. The corners are in order, anticlockwise as seen from the lower values, so that
 * normals point towards these. The smallest corner comes first, so that equal patches compare
 * equal.
 */
struct Patch
{
  std::vector<Isovertex> Corners;
  /** Twice the central vertex of the diamond that the tetrahedron lies in. At full resolution it is
   * twice the middle of a voxel, which is no lattice point. */
  Point DoubledCenter;
  /** The level of that diamond: 0 for the root, N at full resolution. */
  int Level = 0;
};

bool operator==(const Patch& a, const Patch& b);
bool operator<(const Patch& a, const Patch& b);

/** The patch for given signs of the vertices; without corners if they are all equal. */
Patch PatchOf(
  const Hierarchy& hierarchy, const Tetrahedron& tetrahedron, const std::array<int, 4>& signs);

/**
 * The tetrahedra of the current diamond mesh: what is left of the base cube if exactly the
 * subdivided diamonds are bisected. Some of them have vertices without a sample.
 */
std::vector<Tetrahedron> LeafTetrahedra(const Hierarchy& hierarchy, const DiamondSet& subdivided);

/** The isosurface in the current diamond mesh, without tetrahedra that lack a sample; sorted. */
std::vector<Patch> LeafPatches(const Hierarchy& hierarchy, const ScalarField& field,
  double isovalue, const DiamondSet& subdivided);

/** The isosurface at full resolution: all diamonds are subdivided. */
std::vector<Patch> FullResolutionPatches(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue);

/** The number of triangles: one for a triangle, two for a quadrilateral. */
int CountTriangles(const std::vector<Patch>& patches);
/** The distinct isovertices in patches, sorted. */
std::vector<Isovertex> IsoverticesOf(const std::vector<Patch>& patches);

}

#endif
