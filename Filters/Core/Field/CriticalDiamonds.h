// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CriticalDiamonds_h
#define isodiamond_CriticalDiamonds_h

#include "Field/SignLattice.h"
#include "Lattice/DiamondSet.h"

namespace isodiamond
{

/**
 * The *critical* diamonds: those whose subdivision changes the topology of a surface in their
 * domain.
 *
 * Let a and b be the ends of the spine, c the centre, and the ring the other vertices in cyclic
 * order. If a and b are on different sides, the side of either is a cone, and the surface between
 * is one disc, before and after. If c is on the side of both, nothing changes but the place. Else
 * the ring's vertices on the side of c decide. In one run, neither none nor all of the ring, they
 * are joined by c into what they were: one disc. None: a piece comes into being. All: a tube
 * around the spine breaks. Two and more runs: sheets join. So a diamond is critical if
 * a = b != c, unless the sides change exactly twice around the ring.
 *
 * At the grid's boundary the ring is open, a path from boundary to boundary. Mirrored in the
 * boundary it is a ring, of which the same holds: critical unless the sides change exactly once
 * along the path.
 *
 * A refined set that holds all critical diamonds, and so their ancestors, can be completed diamond
 * by diamond from coarse to fine without one of them. So its mesh is homeomorphic to that of full
 * resolution. Diamonds that stick out of the grid need no rule: either what lies in their
 * tetrahedra without all samples is one side of every surface, c and the ends included; or they
 * carry something, and always are subdivided, with all ancestors that hold it.
 *
 * T. Gerstner, R. Pajarola, "Topology preserving and controlled topology simplifying
 * multiresolution isosurface extraction", IEEE Visualization 2000.
 */
DiamondMask CriticalDiamonds(
  const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor);

}

#endif
