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
 * @param a,b corners of triangles of some area; if one has none and lies in the other one's plane,
 *        it may be said to touch that
 */
bool Intersect(const std::vector<Vector>& positions, const Triangle& a, const Triangle& b);

}

#endif
