// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError/FieldError.h"

#include "FieldError/MidpointOrder.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Visits the samples of a domain. @param isWhole whether all its lattice points have samples */
template <bool isWhole, typename T>
DomainSummary SummarizeInOrder(
  const Grid& grid, const SampleView<T>& samples, int firstSlice, const Place& place)
{
  const MidpointOrder& order = MidpointOrder::Of(place);
  const Point centre = Centre(place);
  const T* middle = samples.Pointer() + samples.Index(centre + Point{ 0, 0, -firstSlice });
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

bool IsSmallDomain(const Place& place)
{
  return place.Scale <= MidpointOrder::MaximumScale;
}

DomainSummary SummarizeSmallDomain(const Grid& grid, const SampleSlab& slab, const Place& place)
{
  const int half = 1 << place.Scale;
  const Point centre = Centre(place);
  const bool isWhole = grid.IsSampled(centre + Point{ half, half, half }) &&
    grid.IsSampled(centre + Point{ -half, -half, -half });
  return std::visit(
    [&](const auto& view)
    {
      return isWhole ? SummarizeInOrder<true>(grid, view, slab.First, place)
                     : SummarizeInOrder<false>(grid, view, slab.First, place);
    },
    slab.Samples);
}

FieldErrors::FieldErrors(
  const Grid& grid, const AnySamples& samples, const ParallelFor& parallelFor)
  : FieldErrors(grid, SampleSlab{ samples, 0 }, { 0, grid.Dimensions()[2] }, parallelFor)
{
}

FieldErrors::FieldErrors(
  const Grid& grid, const SampleSlab& slab, const SliceRange& own, const ParallelFor& parallelFor)
  : TheGrid(grid)
  , Slab(slab)
  , Fits(grid.Dimensions(), slab, own, grid.Depth() - MidpointOrder::MaximumScale, parallelFor)
{
  static_assert(
    1 << MidpointOrder::MaximumScale == Overlap, "a slab has the small domains of its own");
}

DomainSummary FieldErrors::Summarize(const Place& place) const
{
  if (IsSmallDomain(place))
  {
    return SummarizeSmallDomain(this->TheGrid, this->Slab, place);
  }
  SummaryBuilder sums;
  this->AddPart(
    place, [&](const Point& vertex) { return SampleAt(this->Slab.Samples, vertex); }, sums);
  return sums.Result();
}

}
