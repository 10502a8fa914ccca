// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError/FieldError.h"

#include "FieldError/DomainSearch.h"
#include "FieldError/MidpointOrder.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Visits the samples of a domain. @param isWhole whether all its lattice points have one */
template <bool isWhole, typename T>
DomainSummary SummarizeInOrder(const Grid& grid, const SampleView<T>& samples, const Place& place)
{
  const MidpointOrder& order = MidpointOrder::Of(place);
  const Point centre = Centre(place);
  const T* middle = samples.Pointer() + samples.Index(centre);
  const std::int64_t row = samples.Dimensions()[0];
  const std::int64_t slice = row * samples.Dimensions()[1];
  std::array<double, MidpointOrder::MaximumSize> interpolated;
  SummaryBuilder sums;
  const MidpointOrder::Entry* list = order.Entries().data();
  const int count = static_cast<int>(order.Entries().size());
  const int vertexCount = order.VertexCount();
  const auto visit = [&](int i, bool isVertex)
  {
    const Point offset = Point{ list[i].Offset[0], list[i].Offset[1], list[i].Offset[2] };
    if (isWhole || grid.IsSampled(centre + offset))
    {
      const T sample = middle[offset[0] + offset[1] * row + offset[2] * slice];
      interpolated[i] = isVertex ? static_cast<double>(sample) : interpolated[i];
      sums.Add(sample, interpolated[i]);
    }
  };
  for (int i = 0; i < vertexCount; ++i)
  {
    interpolated[i] = 0.0;
    visit(i, true);
  }
  for (int i = vertexCount; i < count; ++i)
  {
    interpolated[i] = 0.5 * (interpolated[list[i].Ends[0]] + interpolated[list[i].Ends[1]]);
    visit(i, false);
  }
  DomainSummary summary = sums.Result();
  if (!isWhole && grid.SticksOut(place.Position, place.Scale))
  {
    summary.Error = SummaryBuilder::Infinity;
  }
  return summary;
}

}

DomainSummary SummarizeSmallDomain(const Grid& grid, const AnySamples& samples, const Place& place)
{
  const int half = 1 << place.Scale;
  const Point centre = Centre(place);
  const bool isWhole = grid.IsSampled(centre + Point{ half, half, half }) &&
    grid.IsSampled(centre + Point{ -half, -half, -half });
  return std::visit(
    [&](const auto& view)
    {
      return isWhole ? SummarizeInOrder<true>(grid, view, place)
                     : SummarizeInOrder<false>(grid, view, place);
    },
    samples);
}

FieldErrors::FieldErrors(
  const Grid& grid, const AnySamples& samples, const ParallelFor& parallelFor)
  : TheGrid(grid)
  , Samples(samples)
  , Fits(samples, grid.Depth() - MidpointOrder::MaximumScale, parallelFor)
{
}

DomainSummary FieldErrors::Summarize(const Place& place) const
{
  if (place.Scale <= MidpointOrder::MaximumScale)
  {
    return SummarizeSmallDomain(this->TheGrid, this->Samples, place);
  }
  return std::visit([&](const auto& view)
    { return DomainSearch(this->TheGrid, view, this->Fits, place).Run(); },
    this->Samples);
}

}
