// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_LinkCondition_h
#define isodiamond_LinkCondition_h

#include <cstdint>

/**
 * @file LinkCondition.h
 * Whether an edge of a mesh can shrink into a point without a change of topology.
 *
 * The link of a point is what its tetrahedra have opposite to it: triangles, their edges and
 * points. That of an edge is a ring around it, or a path at the boundary. The links of both ends
 * must have the edge's link in common, and nothing else (Dey, Edelsbrunner, Guha and Nekhayev,
 * "Topology preserving edge contraction", 1999); and the same must hold on the boundary.
 */
namespace isodiamond
{

class LocalMesh;

/** Whether two points have an edge, and their links nothing but its link in common. */
bool HaveOnlyTheirEdgeInCommon(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b);

/** The same on the boundary, if the first of two points is on it: then their edge is on it, too,
 *  and lies on every surface and wall that the first point has triangles on. */
bool HaveOnlyTheirEdgeOnTheBoundary(const LocalMesh& mesh, std::uint32_t from, std::uint32_t to);

}

#endif
