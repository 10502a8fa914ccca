// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SameTopology_h
#define isodiamond_SameTopology_h

#include "Simplification/TriangleMesh.h"

namespace isodiamond
{

/**
 * Compares the topology of a surface with that of one made of fewer of its points.
 *
 * The surfaces are homeomorphic, border edges kept as they are, so that what joins them there still
 * fits, if
 *  - every point of the second has triangles in fans as the first has them there: one that is
 *    closed, or from border edge to border edge as before;
 *  - each component of the first has one of the second, with the same border edges and Euler
 * number. (An oriented surface with border is told by its Euler number and its border loops.)
 *
 * @param before,after over the same points; without edges of three triangles
 * @return for each triangle of the first whether something is wrong there: at one of its points, or
 *         with all of its component; empty if nothing is
 */
std::vector<bool> FindOtherTopology(const TriangleMesh& before, const Connectivity& beforeLinks,
  const TriangleMesh& after, const Connectivity& afterLinks);

}

#endif
