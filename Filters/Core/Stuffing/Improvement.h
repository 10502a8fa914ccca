// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Improvement_h
#define isodiamond_Improvement_h

#include "Field/Parallel.h"
#include "Stuffing/SurfaceChanges.h"
#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/** What an improvement may do. */
struct ImprovementOptions
{
  /** The dihedral angle in degrees that all shall have, and by which they shall be less than 180.
   */
  double WantedAngle = 15.0;
  /** How far a surface may get from where it was, at one change. */
  double SurfaceMove = 0.0;
  /** By point: of the edge that a surface cuts there. Points on surfaces move only if these are
   *  known. */
  std::vector<CutSide> CutEdges = {};
  /** The directions in which points on the grid's boundary can move, by axis; 0 for not at all. */
  std::array<Vector, 3> Axes{};
  /** Of what is nearly as good, what leaves fewer tetrahedra, and surfaces as they are: where no
   * one makes the mesh coarser afterwards, which goes better with points that have moved. */
  bool LeavesFewer = false;
};

/** The sine of the angle that is wanted. */
double WantedSine(const ImprovementOptions& options);

/**
 * Improves the worst tetrahedra of a mesh, by changes of their neighbourhood.
 *
 * For a tetrahedron with a bad angle all of these are tried, and what leaves least to be wished for
 * of all the tetrahedra that it touches is done: a point moves, inside or on a wall; an edge
 * shrinks into one of its ends; an edge goes, and what is around it is filled without; two
 * tetrahedra become three around an edge through their common face; and, if none of these helps, an
 * edge gets a point in its middle, which is moved. Nothing is done that makes the worst one worse.
 * Points on surfaces stay where they are, or go, unless all of that fails: where sheets nearly
 * touch there is no room for anything round, so one of them is moved off (SurfaceChanges.h), and is
 * a new point then. What is left in the end needs several changes at once (Detours.h).
 *
 * The worst come first; order and result do not depend on anything but the mesh. Topology is that
 * of before (LocalMesh.h). Klingner & Shewchuk, "Aggressive tetrahedral mesh improvement" (2007),
 * do the same with more of it.
 */
TetrahedronMesh Improve(
  TetrahedronMesh mesh, const ImprovementOptions& options, const ParallelFor& parallelFor);

}

#endif
