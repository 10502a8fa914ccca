// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Simplification_h
#define isodiamond_Simplification_h

#include "Field/Parallel.h"
#include "Simplification/AllowedMesh.h"
#include "Simplification/SimplerMesh.h"

#include <cstddef>

namespace isodiamond
{

/** The most triangles of a part that is simplified on its own. */
constexpr std::size_t MostOfPart = 32000;

/**
 * Makes fewer triangles of a mesh, on some of its points, with a promise: every point of the result
 * is within some mesh triangle's allowance of that triangle, and every point of a mesh triangle is
 * within that triangle's allowance of the result; both are homeomorphic; border edges on a wall
 * stay on it, others stay as they are, and nothing is turned over. No two triangles of the result
 * intersect (TriangleIntersection.h), unless both are still what they were in the mesh.
 *
 * Edges collapse in parts of the mesh (SimplifiedMesh.h), as long as samples of the original are
 * near enough (EdgeCollapses.h). Then whole triangles are compared, both ways (PartDistance.h), and
 * with each other (SelfIntersections.h), and what is wrong is undone.
 *
 * Parts are cut by position and simplified independently: the result does not depend on threads.
 *
 * @param mesh stays as it is in parts that have edges of more than two triangles, or of two that go
 *        along them in the same direction
 * @param mostOfPart triangles of a part at most; 1 or more
 * @return triangles on the points of the mesh, and what the points lie over
 */
SimplerMesh Simplify(
  const AllowedMesh& mesh, const ParallelFor& parallelFor, std::size_t mostOfPart = MostOfPart);

}

#endif
