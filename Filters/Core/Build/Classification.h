// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Classification_h
#define isodiamond_Classification_h

#include "Field/SignLattice.h"
#include "Lattice/DiamondSet.h"

namespace isodiamond
{

/**
 * The isodiamonds of an isosurface or interval volume by kind (paper, sections 4 and 7).
 *
 * Decided by the signs of a diamond's sampled vertices, never by value ranges: *active* if they
 * differ, *creation* if they lie outside on one side and the central vertex does not. *Members* are
 * these and all of their ancestors; a member that is neither is *relevant*: its vertices all lie
 * outside on one side. Diamonds of an interval volume that have all vertices inside are active if a
 * surface passes through a descendant, or if they stick out of the grid.
 */
struct Classification
{
  DiamondMask Active;
  DiamondMask Creation;
  DiamondMask Members;
};

/**
 * Classifies all diamonds of the grid.
 *
 * @param keepInside for an interval volume: whether all diamonds that have all vertices inside
 *        count as active, to be refined by their field error
 */
Classification Classify(const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor,
  bool keepInside = false);

}

#endif
