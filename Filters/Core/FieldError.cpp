// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError.h"

#include "Interpolant.h"
#include "MidpointOrder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace isodiamond
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

template <typename T>
bool IsNaN(T value)
{
  return value != value;
}

/** Running maxima and minima in four lanes, so that the compiler can use vector instructions. */
class Accumulator
{
public:
  /** Adds samples of a row against the line start + slope * i. */
  template <typename T>
  void AddLine(const T* values, int count, double start, double slope)
  {
    int i = 0;
    for (; i + 4 <= count; i += 4)
    {
      for (int lane = 0; lane < 4; ++lane)
      {
        this->Add(lane, static_cast<double>(values[i + lane]), start + slope * (i + lane));
      }
    }
    for (; i < count; ++i)
    {
      this->Add(0, static_cast<double>(values[i]), start + slope * i);
    }
  }

  DomainSummary Result() const
  {
    DomainSummary summary{ this->Error[0], { this->Low[0], this->High[0] } };
    double invalid = this->Invalid[0];
    for (int lane = 1; lane < 4; ++lane)
    {
      summary.Error = std::max(summary.Error, this->Error[lane]);
      summary.Range.Minimum = std::min(summary.Range.Minimum, this->Low[lane]);
      summary.Range.Maximum = std::max(summary.Range.Maximum, this->High[lane]);
      invalid += this->Invalid[lane];
    }
    if (!(invalid == 0.0)) // infinite samples and NaN leave a NaN here
    {
      summary.Error = Infinity;
    }
    return summary;
  }

private:
  void Add(int lane, double value, double interpolated)
  {
    const double error = std::fabs(value - interpolated);
    this->Error[lane] = error > this->Error[lane] ? error : this->Error[lane];
    this->Low[lane] = value < this->Low[lane] ? value : this->Low[lane];
    this->High[lane] = value > this->High[lane] ? value : this->High[lane];
    this->Invalid[lane] += value - value;
  }

  std::array<double, 4> Error{ 0.0, 0.0, 0.0, 0.0 };
  std::array<double, 4> Low{ Infinity, Infinity, Infinity, Infinity };
  std::array<double, 4> High{ -Infinity, -Infinity, -Infinity, -Infinity };
  std::array<double, 4> Invalid{ 0.0, 0.0, 0.0, 0.0 };
};

/** One row of the domain, cut to [first, last] by the grid and into linear pieces by the knots. */
template <typename T>
void AddRow(Interpolant<T>& interpolant, const T* centre, int y, int z, int first, int last,
  Accumulator& sums)
{
  std::array<int, 3> knots{};
  const int count = interpolant.Knots(y, z, knots);
  // Evaluated once, continued from piece to piece: exact for integer samples.
  double value = interpolant({ first, y, z });
  sums.AddLine(centre + first, 1, value, 0.0);
  int begin = first; // the last sample that was added
  for (int piece = 0; piece <= count && begin < last; ++piece)
  {
    const int end = piece < count ? std::min(knots[piece], last) : last;
    if (end > begin)
    {
      const double slope = interpolant.SlopeAlongX(begin + end, y, z);
      sums.AddLine(centre + begin + 1, end - begin, value + slope, slope);
      value += slope * (end - begin);
      begin = end;
    }
  }
}

/** NaN counts as below every surface: it becomes the minimum, and the maximum if it is alone. */
void CountNaN(ValueRange& range, bool hasNaN)
{
  if (hasNaN)
  {
    const bool alone = range.Minimum > range.Maximum;
    range.Minimum = std::numeric_limits<double>::quiet_NaN();
    range.Maximum = alone ? range.Minimum : range.Maximum;
  }
}

/** Calls body(row, y, z, first, last) for the sampled part of every row of a domain; row[x] is the
 *  sample at an offset (x, y, z) from the centre, first <= x <= last. */
template <typename T, typename Body>
void ForEachRow(const Grid& grid, const SampleView<T>& samples, const Point& centre,
  const Interpolant<T>& interpolant, int half, Body&& body)
{
  for (int z = std::max(-half, -centre[2]); z <= std::min(half, grid.Last(2) - centre[2]); ++z)
  {
    for (int y = std::max(-half, -centre[1]); y <= std::min(half, grid.Last(1) - centre[1]); ++y)
    {
      const int reach = interpolant.Reach(y, z);
      const int first = std::max(-reach, -centre[0]);
      const int last = std::min(reach, grid.Last(0) - centre[0]);
      if (reach >= 0 && first <= last)
      {
        const Point start = { centre[0] + first, centre[1] + y, centre[2] + z };
        body(samples.Pointer() + samples.Index(start) - first, y, z, first, last);
      }
    }
  }
}

/** What is left to do after the sums: NaN, and diamonds without an interpolant. */
template <typename T>
DomainSummary Finish(const Grid& grid, const SampleView<T>& samples, const Place& place,
  const Interpolant<T>& interpolant, DomainSummary summary)
{
  if (summary.Error == Infinity)
  {
    bool hasNaN = false;
    ForEachRow(grid, samples, Centre(place), interpolant, 1 << place.Scale,
      [&](const T* row, int, int, int first, int last)
      { hasNaN = hasNaN || std::any_of(row + first, row + last + 1, IsNaN<T>); });
    CountNaN(summary.Range, hasNaN);
  }
  if (grid.SticksOut(place.Position, place.Scale))
  {
    summary.Error = Infinity;
  }
  return summary;
}

template <typename T>
DomainSummary Summarize(const Grid& grid, const SampleView<T>& samples, const Place& place)
{
  Interpolant<T> interpolant(grid, samples, place);
  Accumulator sums;
  ForEachRow(grid, samples, Centre(place), interpolant, 1 << place.Scale,
    [&](const T* row, int y, int z, int first, int last)
    { AddRow(interpolant, row, y, z, first, last, sums); });
  return Finish(grid, samples, place, interpolant, sums.Result());
}

/**
 * The same with the ranges of blocks, for large domains: a block is visited only if it can raise
 * the error or widen the range.
 */
template <typename T>
class BlockwiseSummary
{
public:
  BlockwiseSummary(
    const Grid& grid, const SampleView<T>& samples, const BlockRanges& ranges, const Place& place)
    : Domain(grid)
    , Samples(samples)
    , Ranges(ranges)
    , Where(place)
    , Middle(Centre(place))
    , Half(1 << place.Scale)
    , Inside(grid, samples, place)
    , Slopes(this->LargestSlopes())
  {
  }

  DomainSummary Run()
  {
    this->FindCandidates();
    std::sort(this->Candidates.begin(), this->Candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.Bound > b.Bound; });
    for (const Candidate& candidate : this->Candidates)
    {
      const ValueRange& range = this->Ranges(candidate.Block);
      const bool widens =
        range.Minimum < this->Summary.Range.Minimum || range.Maximum > this->Summary.Range.Maximum;
      if (widens || candidate.Bound > this->Summary.Error)
      {
        this->Visit(candidate.Block);
      }
    }
    return Finish(this->Domain, this->Samples, this->Where, this->Inside, this->Summary);
  }

private:
  struct Candidate
  {
    Point Block;
    double Bound = 0.0; ///< of the error in the block
  };

  /** Along each axis, the largest slope that the interpolant has in a tetrahedron. */
  std::array<double, 3> LargestSlopes()
  {
    const TypeTable& shape = ShapeOf(this->Where.Position);
    std::array<double, 3> slopes{};
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      // A lattice point well inside of the tetrahedron.
      Point point{ 0, 0, 0 };
      for (const std::uint8_t vertex : shape.HalfTetrahedra[i].Vertices)
      {
        point = point + (this->Half / 4) * shape.Offsets[vertex];
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        Point next = point;
        ++next[axis];
        slopes[axis] = std::max(slopes[axis], std::fabs(this->Inside(next) - this->Inside(point)));
      }
    }
    return slopes;
  }

  void FindCandidates()
  {
    constexpr int size = BlockRanges::Size;
    Point low{};
    Point high{};
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::max(this->Middle[axis] - this->Half, 0) / size;
      high[axis] = std::min(this->Middle[axis] + this->Half, this->Domain.Last(axis)) / size;
    }
    for (Point block = low; block[2] <= high[2]; ++block[2])
    {
      for (block[1] = low[1]; block[1] <= high[1]; ++block[1])
      {
        for (block[0] = low[0]; block[0] <= high[0]; ++block[0])
        {
          this->AddCandidate(block);
        }
      }
    }
  }

  void AddCandidate(const Point& block)
  {
    constexpr int size = BlockRanges::Size;
    const Point first = size * block + -1 * this->Middle;
    if (!this->Meets(first))
    {
      return;
    }
    const ValueRange& range = this->Ranges(block);
    const double interpolated = this->Inside(first + Point{ size / 2, size / 2, size / 2 });
    const double reach = 0.5 * size * (this->Slopes[0] + this->Slopes[1] + this->Slopes[2]);
    const double bound =
      std::max(range.Maximum - interpolated, interpolated - range.Minimum) + reach;
    // More than the arithmetic's rounding, and NaN counts as large.
    this->Candidates.push_back({ block, bound == bound ? bound * (1.0 + 1e-9) : Infinity });
  }

  /** Whether a block has a point in the domain, a cube or a bipyramid. */
  bool Meets(const Point& first) const
  {
    std::array<int, 3> distance{};
    for (int axis = 0; axis < 3; ++axis)
    {
      distance[axis] = std::max({ first[axis], -(first[axis] + BlockRanges::Size - 1), 0 });
    }
    return this->Inside.Holds(distance);
  }

  void Visit(const Point& block)
  {
    constexpr int size = BlockRanges::Size;
    const Point first = size * block + -1 * this->Middle;
    Accumulator sums;
    for (int z = first[2]; z < first[2] + size; ++z)
    {
      for (int y = first[1]; y < first[1] + size; ++y)
      {
        const Point inGrid = this->Middle + Point{ 0, y, z };
        if (inGrid[1] > this->Domain.Last(1) || inGrid[2] > this->Domain.Last(2))
        {
          continue;
        }
        const int reach = this->Inside.Reach(y, z);
        const int begin = std::max(-reach, first[0]);
        const int end =
          std::min({ reach, first[0] + size - 1, this->Domain.Last(0) - this->Middle[0] });
        if (reach >= 0 && std::max(std::abs(y), std::abs(z)) <= this->Half && begin <= end)
        {
          const Point start = { this->Middle[0] + begin, inGrid[1], inGrid[2] };
          AddRow(this->Inside, this->Samples.Pointer() + this->Samples.Index(start) - begin, y, z,
            begin, end, sums);
        }
      }
    }
    const DomainSummary found = sums.Result();
    this->Summary.Error = std::max(this->Summary.Error, found.Error);
    this->Summary.Range.Minimum = std::min(this->Summary.Range.Minimum, found.Range.Minimum);
    this->Summary.Range.Maximum = std::max(this->Summary.Range.Maximum, found.Range.Maximum);
  }

  const Grid& Domain;
  const SampleView<T>& Samples;
  const BlockRanges& Ranges;
  Place Where;
  Point Middle;
  int Half;
  Interpolant<T> Inside;
  std::array<double, 3> Slopes;
  std::vector<Candidate> Candidates;
  DomainSummary Summary{ 0.0, { Infinity, -Infinity } };
};

}

namespace
{

/** The summary of a small diamond that lies inside the grid with all of its vertices. */
template <typename T>
DomainSummary SummarizeSmall(const SampleView<T>& samples, const Place& place)
{
  const MidpointOrder& order = MidpointOrder::Of(place);
  const T* centre = samples.Pointer() + samples.Index(Centre(place));
  const std::int64_t row = samples.Dimensions()[0];
  const std::int64_t slice = row * samples.Dimensions()[1];
  std::array<double, MidpointOrder::MaximumCount> interpolated;
  DomainSummary summary{ 0.0, { Infinity, -Infinity } };
  double invalid = 0.0;
  const auto add = [&](const MidpointOrder::Entry& entry)
  {
    const auto value = static_cast<double>(
      centre[entry.Offset[0] + entry.Offset[1] * row + entry.Offset[2] * slice]);
    summary.Range.Minimum = value < summary.Range.Minimum ? value : summary.Range.Minimum;
    summary.Range.Maximum = value > summary.Range.Maximum ? value : summary.Range.Maximum;
    invalid += value - value;
    return value;
  };
  const std::size_t vertexCount = order.VertexCount();
  for (std::size_t i = 0; i < vertexCount; ++i)
  {
    interpolated[i] = add(order.Entries()[i]);
  }
  const std::size_t count = order.Entries().size();
  for (std::size_t i = vertexCount; i < count; ++i)
  {
    const MidpointOrder::Entry& entry = order.Entries()[i];
    const double mean = 0.5 * (interpolated[entry.Ends[0]] + interpolated[entry.Ends[1]]);
    interpolated[i] = mean;
    const double error = std::fabs(add(entry) - mean);
    summary.Error = error > summary.Error ? error : summary.Error;
  }
  if (!(invalid == 0.0)) // infinite samples and NaN leave a NaN here
  {
    summary.Error = Infinity;
    CountNaN(summary.Range,
      std::any_of(order.Entries().begin(), order.Entries().end(),
        [&](const MidpointOrder::Entry& entry) {
          return IsNaN(centre[entry.Offset[0] + entry.Offset[1] * row + entry.Offset[2] * slice]);
        }));
  }
  return summary;
}

}

bool HasAllVerticesInside(
  const Isoregion& region, const Grid& grid, const AnySamples& samples, const Place& place)
{
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  bool any = false;
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    const Point vertex = (1 << place.Scale) * (place.Position + shape.Offsets[i]);
    if (grid.IsSampled(vertex))
    {
      any = true;
      if (region.SignOf(SampleAt(samples, vertex)) != InsideSign)
      {
        return false;
      }
    }
  }
  return any && region.IsVolume();
}

DomainSummary SummarizeDomain(const Grid& grid, const AnySamples& samples, const Place& place)
{
  const int half = 1 << place.Scale;
  const Point centre = Centre(place);
  const bool isSmall = place.Scale <= MidpointOrder::MaximumScale &&
    grid.IsSampled(centre + Point{ half, half, half }) &&
    grid.IsSampled(centre + Point{ -half, -half, -half });
  return std::visit([&](const auto& view)
    { return isSmall ? SummarizeSmall(view, place) : Summarize(grid, view, place); },
    samples);
}

FieldErrors::FieldErrors(
  const Grid& grid, const AnySamples& samples, const ParallelFor& parallelFor)
  : Domain(grid)
  , Samples(samples)
  , Ranges(samples, parallelFor)
{
}

DomainSummary FieldErrors::Summarize(const Place& place) const
{
  constexpr int blockwise = 6; // the least scale at which looking at blocks pays
  if (place.Scale < blockwise)
  {
    return SummarizeDomain(this->Domain, this->Samples, place);
  }
  return std::visit([&](const auto& view)
    { return BlockwiseSummary(this->Domain, view, this->Ranges, place).Run(); },
    this->Samples);
}

}
