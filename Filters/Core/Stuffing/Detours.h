// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Detours_h
#define isodiamond_Detours_h

#include "Field/Parallel.h"
#include "Stuffing/Improvement.h"

namespace isodiamond
{

/**
 * Improves the bad tetrahedra of a mesh that no single change improves, by several changes, the
 * first of which make things worse.
 *
 * On a copy of what is around a bad one, one to three random changes are made, and then those that
 * Improvement.h would make next, until it finds no more. The best of many such attempts, each from
 * the best one before, is applied to the mesh if it reduces the shortfall and leaves the worst
 * tetrahedron no worse. The search ends when attempts have not helped for too long. The random
 * numbers are the same each time: the result depends on nothing but the mesh.
 */
TetrahedronMesh TakeDetours(
  TetrahedronMesh mesh, const ImprovementOptions& options, const ParallelFor& parallelFor);

}

#endif
