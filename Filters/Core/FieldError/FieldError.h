// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FieldError_h
#define isodiamond_FieldError_h

#include "Field/Isoregion.h"
#include "FieldError/BlockFits.h"
#include "FieldError/DomainSummary.h"
#include "Lattice/DiamondTables.h"

namespace isodiamond
{

/**
 * Whether a diamond's own error counts: a surface crosses its domain, or it holds volume and
 * sticks out of the grid, so that it must not be a leaf of the mesh.
 */
inline bool OwnErrorCounts(
  const Isoregion& region, const Grid& grid, const ValueRange& range, const Place& place)
{
  return region.Crosses(range) ||
    (region.Holds(range) && grid.SticksOut(place.Position, place.Scale));
}

/** The summary of a diamond of at most MidpointOrder::MaximumScale. */
DomainSummary SummarizeSmallDomain(const Grid& grid, const AnySamples& samples, const Place& place);

/** The summaries of a field's diamonds of all scales. */
class FieldErrors
{
public:
  /** The grid and the samples must outlive it. */
  FieldErrors(const Grid& grid, const AnySamples& samples, const ParallelFor& parallelFor);

  DomainSummary Summarize(const Place& place) const;

private:
  const Grid& TheGrid;
  const AnySamples& Samples;
  BlockFits Fits;
};

}

#endif
