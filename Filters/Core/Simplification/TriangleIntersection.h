// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TriangleIntersection_h
#define isodiamond_TriangleIntersection_h

#include "Simplification/TriangleMesh.h"

#include <vector>

namespace isodiamond
{

/**
 * Whether two triangles cut or touch each other anywhere but in the corners and the edge that they
 * have in common. Exact (Orientation.h); true of those with the same three corners.
 *
 * @param a,b corners of triangles. If one has no area it is its edges, and may be said to touch the
 *        other one if a common corner lies between its other corners, or if they have an edge in
 *        common; if neither has, only what they have in common counts
 */
bool Intersect(const std::vector<Vector>& positions, const Triangle& a, const Triangle& b);

}

#endif
