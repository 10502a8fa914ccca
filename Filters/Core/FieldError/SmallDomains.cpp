// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError/SmallDomains.h"

#include <cassert>
#include <limits>
#include <type_traits>

namespace isodiamond
{
namespace
{

/** Whether all lattice points of a domain have samples. */
bool IsWhole(const Grid& grid, const Place& place)
{
  const int half = 1 << place.Scale;
  const Point centre = Centre(place);
  return grid.IsSampled(centre + Point{ half, half, half }) &&
    grid.IsSampled(centre + Point{ -half, -half, -half });
}

/** Visits the samples of a domain. @param isWhole whether all its lattice points have samples */
template <bool isWhole, typename T>
DomainSummary SummarizeInOrder(
  const Grid& grid, const SampleView<T>& samples, int firstSlice, const Place& place)
{
  const MidpointOrder& order = MidpointOrder::Of(MidpointOrder::NumberOf(place));
  const std::vector<MidpointOrder::Entry>& list = order.Entries();
  const Point centre = Centre(place);
  std::array<double, MidpointOrder::MaximumSize> interpolated;
  SummaryBuilder sums;
  for (int i = 0; i < static_cast<int>(list.size()); ++i)
  {
    const bool isVertex = i < order.VertexCount();
    interpolated[i] =
      isVertex ? 0.0 : 0.5 * (interpolated[list[i].Ends[0]] + interpolated[list[i].Ends[1]]);
    const Point point = centre + Point{ list[i].Offset[0], list[i].Offset[1], list[i].Offset[2] };
    if (isWhole || grid.IsSampled(point))
    {
      const T sample = samples.Pointer()[samples.Index(point + Point{ 0, 0, -firstSlice })];
      interpolated[i] = isVertex ? static_cast<double>(sample) : interpolated[i];
      sums.Add(sample, interpolated[i]);
    }
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
  return std::visit(
    [&](const auto& view)
    {
      return IsWhole(grid, place) ? SummarizeInOrder<true>(grid, view, slab.First, place)
                                  : SummarizeInOrder<false>(grid, view, slab.First, place);
    },
    slab.Samples);
}

SmallDomains::SmallDomains(const Grid& grid, const SampleSlab& slab, const WantedRange& wanted)
  : TheGrid(grid)
  , Slab(slab)
  , Wanted(wanted)
{
  constexpr std::int64_t farthest = 1 << MidpointOrder::MaximumScale;
  const std::array<int, 3>& dimensions = grid.Dimensions();
  if (SampleIndex(dimensions, { farthest, farthest, farthest }) >
    std::numeric_limits<std::int32_t>::max())
  {
    return;
  }
  for (int number = 0; number < MidpointOrder::Count; ++number)
  {
    const MidpointOrder& order = MidpointOrder::Of(number);
    Members& members = this->ByNumber[number];
    members.VertexCount = order.VertexCount();
    members.Order = order.Entries().data();
    members.Offsets.reserve(order.Entries().size());
    for (const MidpointOrder::Entry& entry : order.Entries())
    {
      members.Offsets.push_back(static_cast<std::int32_t>(
        SampleIndex(dimensions, { entry.Offset[0], entry.Offset[1], entry.Offset[2] })));
    }
  }
}

DomainSummary SmallDomains::Summarize(const Place& place) const
{
  const std::optional<DomainSummary> finite = std::visit(
    [&](const auto& view)
    {
      const Members& members = this->ByNumber[MidpointOrder::NumberOf(place)];
      if (!members.Offsets.empty() && IsWhole(this->TheGrid, place))
      {
        const Point inSlab = Centre(place) + Point{ 0, 0, -this->Slab.First };
        return this->SummarizeFinite(members, view.Pointer() + view.Index(inSlab));
      }
      return std::optional<DomainSummary>();
    },
    this->Slab.Samples);
  return finite ? *finite : SummarizeSmallDomain(this->TheGrid, this->Slab, place);
}

/** @return nothing if one of the samples, or the sum of all errors, is not finite */
template <typename T>
std::optional<DomainSummary> SmallDomains::SummarizeFinite(
  const Members& members, const T* middle) const
{
  std::array<double, MidpointOrder::MaximumSize> interpolated;
  const std::int32_t* const offsets = members.Offsets.data();
  const MidpointOrder::Entry* const order = members.Order;
  const int count = static_cast<int>(members.Offsets.size());
  assert((count - members.VertexCount) % 2 == 1);
  // By turns: no maximum waits for the one before.
  std::array<FiniteExtremes, 2> turns;
  const auto visit = [&](int i, FiniteExtremes& extremes, auto withRange)
  {
    const auto value = static_cast<double>(middle[offsets[i]]);
    interpolated[i] = 0.5 * (interpolated[order[i].Ends[0]] + interpolated[order[i].Ends[1]]);
    extremes.Add(value, interpolated[i], withRange);
  };
  const auto visitRest = [&](auto withRange)
  {
    // An even number: a domain is symmetric about its centre.
    for (int i = members.VertexCount + 1; i < count; i += 2)
    {
      visit(i, turns[0], withRange);
      visit(i + 1, turns[1], withRange);
    }
  };
  for (int i = 0; i < members.VertexCount; ++i)
  {
    interpolated[i] = static_cast<double>(middle[offsets[i]]);
    turns[0].Add(interpolated[i], interpolated[i], std::true_type());
  }
  visit(members.VertexCount, turns[0], std::true_type()); // the centre: it tells most
  if (this->Wanted.IsEnough(turns[0].Range()))
  {
    visitRest(std::false_type());
  }
  else
  {
    visitRest(std::true_type());
  }
  turns[0].Add(turns[1]);
  return turns[0].AreFinite() ? std::make_optional(turns[0].Summary()) : std::nullopt;
}

}
