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
 * order. If a and b are on different sides, the part on either side is a cone, and the surface
 * between them is one disc, before and after. If c is on the same side as both, only the surface's
 * position changes. Otherwise the ring's vertices on the side of c decide. If they form one run,
 * neither none nor all of the ring, c joins them into what they were: one disc. None: a piece comes
 * into being. All: a tube around the spine breaks. Two or more runs: sheets join. So a diamond is
 * critical if a = b != c, unless the sides change exactly twice around the ring.
 *
 * At the grid's boundary the ring is open, a path from boundary to boundary. Mirrored at the
 * boundary it is a ring, for which the same holds: critical unless the sides change exactly once
 * along the path.
 *
 * A refined set that holds all critical diamonds, and so their ancestors, can be completed diamond
 * by diamond from coarse to fine without subdividing a critical one. So its mesh is homeomorphic to
 * that of full resolution. Diamonds that stick out of the grid need no rule: either everything in
 * their tetrahedra that lack samples is on one side of every surface, c and the ends included; or
 * they carry something, and are always subdivided, with all ancestors that hold it.
 *
 * T. Gerstner, R. Pajarola, "Topology preserving and controlled topology simplifying
 * multiresolution isosurface extraction", IEEE Visualization 2000.
 */
DiamondMask CriticalDiamonds(
  const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor);

}

#endif
