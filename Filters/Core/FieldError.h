// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FieldError_h
#define isodiamond_FieldError_h

#include "DiamondTables.h"
#include "Samples.h"

namespace isodiamond
{

/** What the samples in a diamond's closed domain (the union of its tetrahedra) say. */
struct DomainSummary
{
  /** max |F - linear interpolation| over the lattice points of the domain, in field units;
   *  infinite where the interpolant is undefined: the diamond sticks out of the grid, or a sample
   *  of the domain is not finite. Paper, section 4.2. */
  double Error = 0.0;
  /** Range of the sampled lattice points of the domain. NaN counts as -infinity. */
  ValueRange Range;
};

/** Visits every sampled lattice point of one diamond's domain. */
DomainSummary SummarizeDomain(const Grid& grid, const AnySamples& samples, const Place& place);

}

#endif
