// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError/FieldError.h"

namespace isodiamond
{

FieldErrors::FieldErrors(const Grid& grid, const AnySamples& samples,
  const ParallelFor& parallelFor, const WantedRange& wanted)
  : FieldErrors(grid, SampleSlab{ samples, 0 }, { 0, grid.Dimensions()[2] }, parallelFor, wanted)
{
}

FieldErrors::FieldErrors(const Grid& grid, const SampleSlab& slab, const SliceRange& own,
  const ParallelFor& parallelFor, const WantedRange& wanted)
  : TheGrid(grid)
  , Slab(slab)
  , Wanted(wanted)
  , Small(grid, slab, wanted)
  , Fits(grid.Dimensions(), slab, own, grid.Depth() - MidpointOrder::MaximumScale, parallelFor)
{
  static_assert(
    1 << MidpointOrder::MaximumScale == Overlap, "a slab has the small domains of its own");
}

DomainSummary FieldErrors::Summarize(const Place& place) const
{
  if (IsSmallDomain(place))
  {
    return this->Small.Summarize(place);
  }
  SummaryBuilder sums;
  this->AddPart(
    place, [&](const Point& vertex) { return SampleAt(this->Slab.Samples, vertex); }, sums);
  return sums.Result();
}

}
