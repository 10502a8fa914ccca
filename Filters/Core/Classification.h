// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Classification_h
#define isodiamond_Classification_h

#include "DiamondSet.h"
#include "SignLattice.h"

namespace isodiamond
{

/**
 * The isodiamonds of an isosurface by kind (paper, sections 4 and 7).
 *
 * By the signs of a diamond's sampled vertices, never by value ranges: *active* where they
 * differ, *creation* where they agree and the central vertex differs from them. *Members* are
 * these and all of their ancestors; a member that is neither is *relevant*.
 */
struct Classification
{
  DiamondMask Active;
  DiamondMask Creation;
  DiamondMask Members;
};

/** Classifies all diamonds of the grid. */
Classification Classify(const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor);

}

#endif
