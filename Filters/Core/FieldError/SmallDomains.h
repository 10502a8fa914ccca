// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SmallDomains_h
#define isodiamond_SmallDomains_h

#include "FieldError/DomainSummary.h"
#include "FieldError/MidpointOrder.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace isodiamond
{

/** Whether a diamond has so few samples that all are visited: up to MidpointOrder::MaximumScale. */
bool IsSmallDomain(const Place& place);

/** The summary of one such diamond. @param slab that has its domain, as far as it is sampled */
DomainSummary SummarizeSmallDomain(const Grid& grid, const SampleSlab& slab, const Place& place);

/**
 * The summaries of many such diamonds. Where a domain's samples lie in memory, relative to the
 * central vertex, depends on the diamond's type and scale alone, and is found once.
 */
class SmallDomains
{
public:
  /** The grid, and the slab's samples, must outlive it.
   *  @param wanted of ranges */
  SmallDomains(const Grid& grid, const SampleSlab& slab, const WantedRange& wanted);

  /** @param place of a diamond whose domain the slab has, as far as it is sampled */
  DomainSummary Summarize(const Place& place) const;

private:
  /** The samples of domains of one type and scale, in a MidpointOrder. */
  struct Members
  {
    int VertexCount = 0;
    std::vector<std::int32_t> Offsets; ///< from the central vertex, in samples
    const MidpointOrder::Entry* Order = nullptr;
  };

  template <typename T>
  std::optional<DomainSummary> SummarizeFinite(const Members& members, const T* middle) const;

  const Grid& TheGrid;
  SampleSlab Slab;
  WantedRange Wanted;
  std::array<Members, MidpointOrder::Count> ByNumber; ///< without offsets if these are too large
};

}

#endif
