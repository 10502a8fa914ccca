// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_StreamedFieldCodes_h
#define isodiamond_StreamedFieldCodes_h

#include "Build/OwnErrors.h"
#include "Hierarchy/GatheredSamples.h"

#include <vector>

namespace isodiamond
{

/**
 * OwnFieldCodes() for a volume that comes in slabs: the same to the bit.
 *
 * Small domains lie in the slab of their centre, including its overlap. Large ones reach through
 * several slabs, each of which adds what it has of them; their vertices are on a coarse lattice,
 * whose samples are gathered beforehand.
 */
class StreamedFieldCodes
{
public:
  /** The samples to be gathered while slabs come for the first time. */
  static GatheredSamples CoarseSamples(const Grid& grid);

  /** All arguments but coarse and codes must outlive it.
   *  @param coarse all of these samples @param codes of field errors */
  StreamedFieldCodes(const Grid& grid, const DiamondSet& members, const FieldMetric& metric,
    const ErrorCode& codes, GatheredSamples coarse, const ParallelFor& parallelFor);

  /** @param slab with FieldErrors::Overlap slices around its own, where there are more
   *  @param own slices @param centres the slices of the centres of small domains */
  void Add(const SampleSlab& slab, const SliceRange& own, const SliceRange& centres);

  /** Merges what peers have added.
   *  @param areSetsOther whether each has members of its own, but the same large domains: then only
   *         these are merged */
  void Merge(Peers& peers, bool areSetsOther);

  /** Once all slabs have been added. */
  DiamondCodes Finish();

private:
  void SetCodes(const Place& place, std::uint32_t rank, const DomainSummary& domain);

  const Grid& TheGrid;
  const DiamondSet& Members;
  FieldMetric Metric;
  ErrorCode Code;
  GatheredSamples Coarse;
  const ParallelFor& For;
  DiamondCodes Codes;
  std::vector<SummaryBuilder> LargeDomains; ///< by rank; the first ranks are theirs
};

}

#endif
