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
 * By the signs of a diamond's sampled vertices, never by value ranges: *active* where they
 * differ, *creation* where they lie outside on one side and the central vertex does not. *Members*
 * are these and all of their ancestors; a member that is neither is *relevant*, its vertices all
 * lie outside on one side. Of the diamonds of an interval volume that have all vertices inside,
 * those are active where a surface passes below, and those that stick out of the grid.
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
 * @param keepInside of an interval volume: whether all diamonds that have all vertices inside
 *        count as active, to be refined by their field error
 */
Classification Classify(const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor,
  bool keepInside = false);

}

#endif
