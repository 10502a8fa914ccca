// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Improvement_h
#define isodiamond_Improvement_h

#include "Field/GridGeometry.h"
#include "Field/Parallel.h"
#include "Stuffing/KnownChanges.h"
#include "Stuffing/SurfaceChanges.h"
#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/** What an improvement may do. */
struct ImprovementOptions
{
  /** In degrees: all dihedral angles should be at least this, and at most 180 less this. */
  double WantedAngle = 15.0;
  /** How far a surface may get from where it was, in one change. */
  double SurfaceMove = 0.0;
  /** By point: the edge that a surface cuts there. Points on surfaces move only if these are known.
   */
  std::vector<CutSide> CutEdges = {};
  /** From index space, where cut edges are, to the world; null if that is where they are. */
  const GridGeometry* World = nullptr;
  /** The directions in which points on the grid's boundary can move, by axis; 0 for not at all. */
  std::array<Vector, 3> Axes{};
};

/** The sine of the wanted angle. */
double WantedSine(const ImprovementOptions& options);

/**
 * Improves the worst tetrahedra of a mesh by changes of their neighbourhood.
 *
 * For a tetrahedron with a bad angle all of these changes are tried, and the one that leaves the
 * smallest shortfall in all the tetrahedra that it touches is made: a point moves, inside or on a
 * wall; an edge shrinks into one of its ends; an edge is removed, and the space around it filled
 * without it; two tetrahedra become three around an edge through their common face; and, if none of
 * these helps, an edge gets a point in its middle, which is moved. No change makes the worst one
 * worse. Points on surfaces stay where they are, or are removed, unless all of that fails: where
 * sheets nearly touch there is no room for good shapes, so such a point is moved off its surface
 * (SurfaceChanges.h), as a new point. What is left in the end needs several changes at once, which
 * Detours.h looks for.
 *
 * Known changes come first, in their order, then the worst tetrahedra; the result depends on
 * nothing but the mesh and what is known. The topology is kept
 * (LocalMesh.h). Klingner & Shewchuk, "Aggressive tetrahedral mesh improvement" (2007), do the same
 * more extensively.
 *
 * @param known changes of a similar mesh, tried before any search; afterwards those of this mesh.
 *        If null, none are tried or noted.
 */
TetrahedronMesh Improve(TetrahedronMesh mesh, const ImprovementOptions& options,
  const ParallelFor& parallelFor, KnownChanges* known = nullptr);

}

#endif
