// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FieldError_h
#define isodiamond_FieldError_h

#include "Field/Isoregion.h"
#include "FieldError/BlockFits.h"
#include "FieldError/DomainSearch.h"
#include "FieldError/DomainSummary.h"
#include "FieldError/SmallDomains.h"

#include <variant>

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

/**
 * The summaries of a field's diamonds of all scales.
 *
 * If a volume comes in slabs, each slab has a part of a large domain: what begins in its own
 * slices, in cubes of BlockFits. Together the slabs visit all that matters, in any order.
 */
class FieldErrors
{
public:
  /** How many slices a slab needs on both sides of its own, where the volume has them: small
   *  domains lie around their centre, and cubes end there. */
  static constexpr int Overlap = BlockFits::FinestEdge;

  /** The grid and the samples must outlive it.
   *  @param wanted of ranges: summaries have no more of them */
  FieldErrors(const Grid& grid, const AnySamples& samples, const ParallelFor& parallelFor,
    const WantedRange& wanted = {});

  /** @param own the slab's slices without those that overlap */
  FieldErrors(const Grid& grid, const SampleSlab& slab, const SliceRange& own,
    const ParallelFor& parallelFor, const WantedRange& wanted = {});

  /** For the whole volume; for a slab, only small domains around a centre in its own slices. */
  DomainSummary Summarize(const Place& place) const;

  /** Adds what the slab has of a large domain. @param valueAt called with its sampled vertices */
  template <typename ValueAt>
  void AddPart(const Place& place, const ValueAt& valueAt, SummaryBuilder& sums) const
  {
    sums = std::visit(
      [&](const auto& view)
      {
        return DomainSearch(
          this->TheGrid, view, this->Slab.First, this->Fits, this->Wanted, place, valueAt)
          .Run(sums);
      },
      this->Slab.Samples);
  }

private:
  const Grid& TheGrid;
  SampleSlab Slab;
  WantedRange Wanted;
  SmallDomains Small;
  BlockFits Fits;
};

}

#endif
