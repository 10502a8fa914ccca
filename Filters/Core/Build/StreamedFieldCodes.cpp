// SPDX-License-Identifier: BSD-3-Clause
#include "Build/StreamedFieldCodes.h"

#include <utility>

namespace isodiamond
{
namespace
{

/** Vertices of large domains are at multiples of this. */
constexpr int CoarseStep = 2 * FieldErrors::Overlap;

/** How many members have large domains; their ranks come first. */
std::int64_t CountLarge(const DiamondSet& members)
{
  std::int64_t count = 0;
  for (int scale = 0; scale < members.ScaleCount(); ++scale)
  {
    for (const Brick& brick : members.Level(scale).Bricks)
    {
      count += IsSmallDomain({ scale, {} }) ? 0 : brick.Size();
    }
  }
  return count;
}

}

GatheredSamples StreamedFieldCodes::CoarseSamples(const Grid& grid)
{
  std::vector<std::int64_t> indices;
  for (Point point{}; point[2] <= grid.Last(2); point[2] += CoarseStep)
  {
    for (point[1] = 0; point[1] <= grid.Last(1); point[1] += CoarseStep)
    {
      for (point[0] = 0; point[0] <= grid.Last(0); point[0] += CoarseStep)
      {
        indices.push_back(SampleIndex(grid.Dimensions(), point));
      }
    }
  }
  return { grid.Dimensions(), std::move(indices) };
}

StreamedFieldCodes::StreamedFieldCodes(const Grid& grid, const DiamondSet& members,
  const FieldMetric& metric, const ErrorCode& codes, GatheredSamples coarse,
  const ParallelFor& parallelFor)
  : TheGrid(grid)
  , Members(members)
  , Metric(metric)
  , Code(codes)
  , Coarse(std::move(coarse))
  , For(parallelFor)
  , Codes(members.Size(), metric.RefineInterior)
  , LargeDomains(CountLarge(members))
{
}

void StreamedFieldCodes::Add(
  const SampleSlab& slab, const SliceRange& own, const SliceRange& centres)
{
  const FieldErrors errors(this->TheGrid, slab, own, this->For, WantedRange(this->Metric.Region));
  ForEachMember(this->Members, this->For,
    [&](const Place& place, std::uint32_t rank)
    {
      const int slice = Centre(place)[2];
      if (!IsSmallDomain(place))
      {
        const int half = 1 << place.Scale;
        if (slice + half >= own.Begin && slice - half < own.End + FieldErrors::Overlap)
        {
          errors.AddPart(place, this->Coarse, this->LargeDomains[rank]);
        }
      }
      else if (slice >= centres.Begin && slice < centres.End)
      {
        this->SetCodes(place, rank, errors.Summarize(place));
      }
    });
}

void StreamedFieldCodes::SetCodes(
  const Place& place, std::uint32_t rank, const DomainSummary& domain)
{
  this->Metric.SetCodes(place, rank, this->Code.Encode(domain.Error), domain.Range, this->Codes);
}

void StreamedFieldCodes::Merge(Peers& peers, bool areSetsOther)
{
  if (!areSetsOther)
  {
    peers.Max(this->Codes.Surface.data(), this->Codes.Surface.size());
    peers.Max(this->Codes.Interior.data(), this->Codes.Interior.size());
  }
  std::vector<double> known;
  for (const SummaryBuilder& domain : this->LargeDomains)
  {
    const std::array<double, 4> values = domain.AsMaxima();
    known.insert(known.end(), values.begin(), values.end());
  }
  peers.Max(known.data(), known.size());
  auto values = known.cbegin();
  for (SummaryBuilder& domain : this->LargeDomains)
  {
    domain = SummaryBuilder::OfMaxima({ values[0], values[1], values[2], values[3] });
    values += 4;
  }
}

DiamondCodes StreamedFieldCodes::Finish()
{
  ForEachMember(this->Members, this->For,
    [&](const Place& place, std::uint32_t rank)
    {
      if (!IsSmallDomain(place))
      {
        this->SetCodes(place, rank, this->LargeDomains[rank].Result());
      }
    });
  return std::move(this->Codes);
}

}
