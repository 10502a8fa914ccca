// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/ScalarHierarchy.h"

#include "Field/DiamondSigns.h"
#include "FieldError/FieldError.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace isodiamond
{
namespace
{

std::int64_t PositionCount(const Grid& grid, int scale)
{
  const std::array<int, 3> count = grid.Positions(scale);
  return std::int64_t{ 1 } * count[0] * count[1] * count[2];
}

std::int64_t LinearPosition(const Grid& grid, const Place& place)
{
  const std::array<int, 3> count = grid.Positions(place.Scale);
  return (std::int64_t{ place.Position[2] } * count[1] + place.Position[1]) * count[0] +
    place.Position[0];
}

/** A range bound in the samples' type; integers have no infinities. */
template <typename T>
T ToSampleType(double value)
{
  if constexpr (std::is_integral_v<T>)
  {
    constexpr T lowest = std::numeric_limits<T>::lowest();
    constexpr T highest = std::numeric_limits<T>::max();
    return value >= static_cast<double>(highest)
      ? highest
      : (value <= static_cast<double>(lowest) ? lowest : static_cast<T>(value));
  }
  return static_cast<T>(value);
}

/** The queue, front and closure of the paper's top-down refinement. */
class Walk
{
public:
  Walk(const ScalarHierarchy& hierarchy, const Isoregion& region, ErrorCode::Type accepted)
    : Hierarchy(hierarchy)
    , Region(region)
    , Accepted(accepted)
    , Seen(hierarchy.SampleGrid())
    , Result{ DiamondMask(hierarchy.SampleGrid()), 0 }
  {
  }

  /** @param always subdivided in any case; null for none */
  void RefineFront(const DiamondMask* always)
  {
    if (always != nullptr)
    {
      always->ForEach([&](const Place& place) { this->Queue.push_back(place); });
    }
    this->Visit(Place{ this->Hierarchy.SampleGrid().Depth() - 1, { 1, 1, 1 } });
    this->EmptyQueue();
  }

  /** Adds diamonds that have all vertices inside and a greater code, with all ancestors. */
  void RefineInside(ErrorCode::Type accepted)
  {
    this->FollowsFront = false;
    const Grid& grid = this->Hierarchy.SampleGrid();
    for (int scale = grid.Depth() - 1; scale >= 0; --scale)
    {
      const std::array<int, 3> count = grid.Positions(scale);
      for (Point position{}; position[2] < count[2]; ++position[2])
      {
        for (position[1] = 0; position[1] < count[1]; ++position[1])
        {
          for (position[0] = 0; position[0] < count[0]; ++position[0])
          {
            const Place place{ scale, position };
            if (Parity(position) != 0 && this->Hierarchy.Error(place) > accepted &&
              HasAllVerticesInside(this->Region, grid, this->Hierarchy.Samples(), place))
            {
              this->Queue.push_back(place);
            }
          }
        }
      }
    }
    this->Result.Visited = ScalarHierarchy::CodeCount(grid);
    this->EmptyQueue();
  }

  ScalarHierarchy::WalkResult TakeResult() { return std::move(this->Result); }

private:
  void EmptyQueue()
  {
    while (!this->Queue.empty())
    {
      const Place place = this->Queue.back();
      this->Queue.pop_back();
      this->Subdivide(place);
    }
  }

  void Visit(const Place& place)
  {
    const Grid& grid = this->Hierarchy.SampleGrid();
    if (!grid.IsValid(place.Position, place.Scale) || !this->Seen.Insert(place))
    {
      return;
    }
    ++this->Result.Visited;
    if (this->Hierarchy.Error(place) > this->Accepted &&
      OwnErrorCounts(this->Region, grid, this->Hierarchy.Range(place), place))
    {
      this->Queue.push_back(place);
    }
  }

  /** Adds the diamond and its missing ancestors; their children join the front. */
  void Subdivide(const Place& place)
  {
    const Grid& grid = this->Hierarchy.SampleGrid();
    if (!this->Result.Subdivided.Insert(place))
    {
      return;
    }
    const TypeTable& shape = ShapeOf(place.Position);
    for (int i = 0; i < shape.ParentCount; ++i)
    {
      const Place parent = ParentPlace(shape, place, i);
      if (parent.Scale < grid.Depth() && grid.IsValid(parent.Position, parent.Scale) &&
        !this->Result.Subdivided.Contains(parent))
      {
        this->Queue.push_back(parent);
      }
    }
    for (int i = 0; this->FollowsFront && i < shape.ChildCount && place.Scale >= shape.ChildStep;
         ++i)
    {
      this->Visit(ChildPlace(shape, place, i));
    }
  }

  const ScalarHierarchy& Hierarchy;
  const Isoregion& Region;
  ErrorCode::Type Accepted;
  bool FollowsFront = true; ///< whether children of subdivided diamonds are visited
  DiamondMask Seen;
  std::vector<Place> Queue;
  ScalarHierarchy::WalkResult Result;
};

}

ScalarHierarchy::ScalarHierarchy(const AnySamples& samples, double errorScale,
  const ErrorCode::Type* codes, std::int64_t codeCount, const AnySamples& minima,
  const AnySamples& maxima)
  : TheGrid(std::visit([](const auto& view) { return view.Dimensions(); }, samples))
  , Values(samples)
  , Code(errorScale)
  , ErrorCodes(codes)
  , Minima(minima)
  , Maxima(maxima)
  , FirstOfScale(this->TheGrid.Depth() + 1, 0)
{
  if (codeCount != CodeCount(this->TheGrid) || SizeOf(minima) != RangeCount(this->TheGrid) ||
    SizeOf(maxima) != SizeOf(minima) || minima.index() != samples.index() ||
    maxima.index() != samples.index())
  {
    throw std::invalid_argument("the errors or ranges do not match the samples");
  }
  if (std::any_of(
        codes, codes + codeCount, [](ErrorCode::Type code) { return code > ErrorCode::Always; }))
  {
    throw std::invalid_argument("an error has more than 14 bits");
  }
  std::int64_t next = 0;
  for (int scale = this->TheGrid.Depth() - 1; scale >= 0; --scale)
  {
    this->FirstOfScale[scale] = next;
    next += PositionCount(this->TheGrid, scale);
  }
}

std::int64_t ScalarHierarchy::Offset(const Place& place) const
{
  return this->FirstOfScale[place.Scale] + LinearPosition(this->TheGrid, place);
}

std::int64_t ScalarHierarchy::CodeCount(const Grid& grid)
{
  return RangeCount(grid) + PositionCount(grid, 0);
}

std::int64_t ScalarHierarchy::RangeCount(const Grid& grid)
{
  std::int64_t count = 0;
  for (int scale = 1; scale < grid.Depth(); ++scale)
  {
    count += PositionCount(grid, scale);
  }
  return count;
}

ValueRange ScalarHierarchy::Range(const Place& place) const
{
  if (place.Scale == 0)
  {
    return SummarizeSmallDomain(this->TheGrid, SampleSlab{ this->Values, 0 }, place).Range;
  }
  const std::int64_t offset = this->Offset(place);
  const auto read = [offset](const AnySamples& values)
  {
    return std::visit(
      [offset](const auto& view) { return static_cast<double>(view.Pointer()[offset]); }, values);
  };
  return { read(this->Minima), read(this->Maxima) };
}

ScalarHierarchy::WalkResult ScalarHierarchy::Refine(const Isoregion& region,
  ErrorCode::Type accepted, ErrorCode::Type acceptedInside, const DiamondMask* always) const
{
  Walk walk(*this, region, accepted);
  walk.RefineFront(always);
  if (region.IsVolume() && acceptedInside < ErrorCode::Always - 1)
  {
    walk.RefineInside(acceptedInside);
  }
  return walk.TakeResult();
}

double FieldErrorScale(const AnySamples& samples, const ParallelFor& parallelFor)
{
  const ValueRange range = FiniteRange(samples, parallelFor);
  return ErrorCode(range.Maximum - range.Minimum).Scale();
}

ScalarEncoding BuildScalarHierarchy(const AnySamples& samples, const ParallelFor& parallelFor)
{
  const Grid grid(std::visit([](const auto& view) { return view.Dimensions(); }, samples));
  const ErrorCode code(FieldErrorScale(samples, parallelFor));
  const FieldErrors errors(grid, samples, parallelFor);
  ScalarEncoding encoding;
  encoding.ErrorScale = code.Scale();
  encoding.Codes.assign(ScalarHierarchy::CodeCount(grid), 0);
  std::visit(
    [&](const auto& view)
    {
      using T = typename std::decay_t<decltype(view)>::Value;
      std::vector<T> minima(ScalarHierarchy::RangeCount(grid), T{});
      std::vector<T> maxima(minima.size(), T{});
      std::int64_t first = 0;
      for (int scale = grid.Depth() - 1; scale >= 0; --scale)
      {
        const std::array<int, 3> count = grid.Positions(scale);
        parallelFor(std::int64_t{ 1 } * count[1] * count[2], 4,
          [&](std::int64_t begin, std::int64_t end)
          {
            for (std::int64_t i = begin * count[0]; i < end * count[0]; ++i)
            {
              const std::int64_t row = i / count[0];
              const Place place{ scale,
                { static_cast<int>(i % count[0]), static_cast<int>(row % count[1]),
                  static_cast<int>(row / count[1]) } };
              if (Parity(place.Position) != 0)
              {
                const DomainSummary summary = errors.Summarize(place);
                encoding.Codes[first + i] = code.Encode(summary.Error);
                if (scale > 0)
                {
                  minima[first + i] = ToSampleType<T>(summary.Range.Minimum);
                  maxima[first + i] = ToSampleType<T>(summary.Range.Maximum);
                }
              }
            }
          });
        first += PositionCount(grid, scale);
      }
      encoding.Minima = std::move(minima);
      encoding.Maxima = std::move(maxima);
    },
    samples);
  return encoding;
}

}
