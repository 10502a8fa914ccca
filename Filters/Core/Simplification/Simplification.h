// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Simplification_h
#define isodiamond_Simplification_h

#include "Field/Parallel.h"
#include "Simplification/TriangleMesh.h"

#include <functional>

namespace isodiamond
{

/**
 * Makes fewer triangles of a mesh's points, with border edges as they were, and with an error that
 * is about as large as it is told. Nothing of that is relied on but ids being those of points: what
 * it makes is measured.
 */
using Decimation = std::function<std::vector<Triangle>(const TriangleMesh& mesh, double error)>;

/** A mesh, and how far from each triangle another one may be that is made of it. */
struct AllowedMesh
{
  TriangleMesh Mesh;
  std::vector<double> Allowances; ///< by triangle; at least 0
};

/**
 * Makes fewer triangles of a mesh, of some of its points, with a promise: every point of the result
 * is within the allowance of a triangle of the mesh of a point of that triangle, and every point of
 * a triangle within its allowance of the result; both are homeomorphic; border edges stay.
 *
 * Blocks of triangles are decimated on their own, with locked borders, so they still fit; the
 * result is measured against what was there, whole triangles both ways (Covering.h), and its
 * topology compared (SameTopology.h). Triangles where something is wrong are left out of the next
 * trial, and more around them each time. What allowances are left at the end go with the result's
 * triangles, so another pass, with blocks that are cut elsewhere, can use them up where the first
 * ones had borders; promises add up.
 *
 * Blocks are cut by position alone, and done independently: the result does not depend on threads.
 */
AllowedMesh Simplify(
  const AllowedMesh& mesh, const Decimation& decimate, const ParallelFor& parallelFor);

}

#endif
