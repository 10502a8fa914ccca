// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FieldError_h
#define isodiamond_FieldError_h

#include "BlockRanges.h"
#include "DiamondTables.h"
#include "Isoregion.h"

namespace isodiamond
{

/** What the samples in a diamond's closed domain (the union of its tetrahedra) say. */
struct DomainSummary
{
  /** max |F - linear interpolation| over the lattice points of the domain, in field units;
   *  infinite where the interpolant is undefined: the diamond sticks out of the grid, or a sample
   *  of the domain is not finite. Paper, section 4.2. */
  double Error = 0.0;
  /** Range of the sampled lattice points of the domain; the minimum is NaN if one of them is.
   *  Without any the minimum is the greater one. */
  ValueRange Range;
};

/**
 * Whether a diamond's own error counts: a surface crosses its domain, or it holds volume and
 * sticks out of the grid, so that it must not be a leaf of the mesh.
 */
inline bool IsTriggered(
  const Isoregion& region, const Grid& grid, const ValueRange& range, const Place& place)
{
  return region.Crosses(range) ||
    (region.Holds(range) && grid.SticksOut(place.Position, place.Scale));
}

/** Whether all sampled vertices of a diamond, at least one, lie in the interval volume. */
bool HasAllVerticesInside(
  const Isoregion& region, const Grid& grid, const AnySamples& samples, const Place& place);

/** Visits every sampled lattice point of one diamond's domain. */
DomainSummary SummarizeDomain(const Grid& grid, const AnySamples& samples, const Place& place);

/** The same for many diamonds of one field, without visiting what cannot matter. */
class FieldErrors
{
public:
  /** The grid and the samples must outlive it. */
  FieldErrors(const Grid& grid, const AnySamples& samples, const ParallelFor& parallelFor);

  DomainSummary Summarize(const Place& place) const;

private:
  const Grid& Domain;
  const AnySamples& Samples;
  BlockRanges Ranges;
};

}

#endif
