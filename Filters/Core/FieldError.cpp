// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError.h"

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

/**
 * The interpolant of one diamond, piecewise linear over its tetrahedra, in closed form.
 *
 * Offsets are relative to the central vertex. Along every axis it is linear between *knots*,
 * where the axis crosses the planes between the tetrahedra; all knots are lattice points.
 */
template <typename T>
class Interpolant
{
public:
  Interpolant(const Grid& grid, const SampleView<T>& samples, const Place& place)
    : Half(1 << place.Scale)
    , Shape(ShapeOf(place.Position))
  {
    const Point centre = this->Half * place.Position;
    for (int i = 0; i < this->Shape.VertexCount; ++i)
    {
      const Point vertex = centre + this->Half * this->Shape.Offsets[i];
      this->At(this->Shape.Offsets[i]) = grid.IsSampled(vertex) ? samples(vertex) : 0.0;
    }
    this->End = this->Shape.Offsets[this->Shape.Spine[0]];
    this->Middle = 0.5 * (this->At(this->End) + this->At(-1 * this->End));
    this->OddAxes = Parity(place.Position);
    this->SingleAxis = this->FindSingleAxis();
  }

  /** The value at an offset inside the domain. */
  double operator()(const Point& offset)
  {
    switch (this->Shape.DiamondClass)
    {
      case 0:
        return this->InCube(offset);
      case 1:
        return this->InSquareBipyramid(offset);
      default:
        return this->InRingBipyramid(offset);
    }
  }

  /** The slope along x on a piece of a row between two knots. @param doubledX begin + end, twice a
   *  place inside of the piece. */
  double SlopeAlongX(int doubledX, int y, int z)
  {
    switch (this->Shape.DiamondClass)
    {
      case 0:
        return this->SlopeInCube(doubledX, y, z);
      case 1:
        return this->SlopeInSquareBipyramid(doubledX, y, z);
      default:
        return this->SlopeInRingBipyramid(doubledX, y, z);
    }
  }

  /** Half the extent of the domain along x for given y and z offsets; negative if empty. */
  int Reach(int y, int z) const
  {
    if (this->Shape.DiamondClass == 0)
    {
      return this->Half;
    }
    // Bipyramids over a square: height along the single axis, |other two| <= h - |height|.
    switch (this->SingleAxis)
    {
      case 0:
        return this->Half - std::max(std::abs(y), std::abs(z));
      case 1:
        return std::abs(z) > this->Half - std::abs(y) ? -1 : this->Half - std::abs(y);
      default:
        return std::abs(y) > this->Half - std::abs(z) ? -1 : this->Half - std::abs(z);
    }
  }

  /** Inner knots along x for given y and z offsets, ascending. @return their number. */
  int Knots(int y, int z, std::array<int, 3>& knots) const
  {
    switch (this->Shape.DiamondClass)
    {
      case 0: // the planes between the orders of the reflected coordinates
        knots = { this->End[0] * this->End[1] * y, this->End[0] * this->End[2] * z, 0 };
        std::sort(knots.begin(), knots.begin() + 2);
        return 2;
      case 1: // the plane of the square, or the one through the spine
        knots = { 0, 0, 0 };
        if (this->SingleAxis != 0)
        {
          knots[0] = this->SingleAxis == 1 ? this->End[0] * this->End[2] * z
                                           : this->End[0] * this->End[1] * y;
        }
        return 1;
      default: // the planes through the spine
      {
        const int side = std::abs(this->SingleAxis == 1 ? z : y);
        knots = { -side, 0, side };
        return this->SingleAxis == 0 ? 0 : 3;
      }
    }
  }

private:
  double& At(const Point& offset)
  {
    return this->Values[(offset[0] + 1) + 3 * (offset[1] + 1) + 9 * (offset[2] + 1)];
  }

  /** The axis that stands alone: class 1 the even one, class 2 the odd one. */
  int FindSingleAxis() const
  {
    const int single = this->Shape.DiamondClass == 1 ? 7 & ~this->OddAxes : this->OddAxes;
    return single == 1 ? 0 : (single == 2 ? 1 : 2);
  }

  /** Class 0: along the spine coordinates grow from 0 to 2h; sorted, they name the tetrahedron. */
  double InCube(const Point& offset)
  {
    std::array<int, 3> axes = { 0, 1, 2 };
    std::array<int, 3> along{};
    for (int axis = 0; axis < 3; ++axis)
    {
      along[axis] = this->End[axis] * offset[axis] + this->Half;
    }
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return along[a] > along[b]; });
    Point corner = -1 * this->End;
    double sum = (2 * this->Half - along[axes[0]]) * this->At(corner);
    for (int i = 0; i < 3; ++i)
    {
      const int next = i < 2 ? along[axes[i + 1]] : 0;
      corner[axes[i]] = this->End[axes[i]];
      sum += (along[axes[i]] - next) * this->At(corner);
    }
    return sum / (2 * this->Half);
  }

  double SlopeInCube(int doubledX, int y, int z)
  {
    // Over an edge along x, from where the axes that are farther along the spine have moved.
    Point corner = -1 * this->End;
    const int x = this->End[0] * doubledX;
    corner[1] = 2 * this->End[1] * y > x ? this->End[1] : corner[1];
    corner[2] = 2 * this->End[2] * z > x ? this->End[2] : corner[2];
    const double before = this->At(corner);
    corner[0] = this->End[0];
    return this->End[0] * (this->At(corner) - before) / (2 * this->Half);
  }

  /** Class 1: a square cut by the spine into two triangles, and an apex on either side. */
  double InSquareBipyramid(const Point& offset)
  {
    const int a = (this->SingleAxis + 1) % 3;
    const int b = (this->SingleAxis + 2) % 3;
    const int alongA = this->End[a] * offset[a];
    const int alongB = this->End[b] * offset[b];
    Point corner = { 0, 0, 0 };
    corner[a] = alongA >= alongB ? this->End[a] : -this->End[a];
    corner[b] = alongA >= alongB ? -this->End[b] : this->End[b];
    Point apex = { 0, 0, 0 };
    apex[this->SingleAxis] = offset[this->SingleAxis] > 0 ? 1 : -1;
    const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
    const double sum = (alongA + alongB) * spine +
      std::abs(alongA - alongB) * (this->At(corner) - this->Middle) +
      2.0 * std::abs(offset[this->SingleAxis]) * (this->At(apex) - this->Middle);
    return this->Middle + sum / (2 * this->Half);
  }

  double SlopeInSquareBipyramid(int doubledX, int y, int z)
  {
    const int side = doubledX > 0 ? 1 : -1;
    if (this->SingleAxis == 0)
    {
      return side * (this->At({ side, 0, 0 }) - this->Middle) / this->Half;
    }
    const int other = 3 - this->SingleAxis;
    const bool ahead = this->End[0] * doubledX > 2 * this->End[other] * (other == 1 ? y : z);
    Point corner = { ahead ? this->End[0] : -this->End[0], 0, 0 };
    corner[other] = ahead ? -this->End[other] : this->End[other];
    const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
    const double outward = this->At(corner) - this->Middle;
    return this->End[0] * (ahead ? spine + outward : spine - outward) / (2 * this->Half);
  }

  /** Class 2: eight triangles around the spine. */
  double InRingBipyramid(const Point& offset)
  {
    const int a = (this->SingleAxis + 1) % 3;
    const int b = (this->SingleAxis + 2) % 3;
    const bool nearA = std::abs(offset[a]) >= std::abs(offset[b]);
    const int major = nearA ? a : b;
    const int minor = nearA ? b : a;
    Point onAxis = { 0, 0, 0 };
    onAxis[major] = offset[major] > 0 ? 1 : -1;
    Point diagonal = onAxis;
    diagonal[minor] = offset[minor] > 0 ? 1 : -1;
    const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
    const int outward = std::abs(offset[major]);
    const int sideward = std::abs(offset[minor]);
    double sum = this->End[this->SingleAxis] * offset[this->SingleAxis] * spine;
    if (outward > 0)
    {
      sum += (outward - sideward) * (this->At(onAxis) - this->Middle);
    }
    if (sideward > 0)
    {
      sum += sideward * (this->At(diagonal) - this->Middle);
    }
    return this->Middle + sum / this->Half;
  }

  double SlopeInRingBipyramid(int doubledX, int y, int z)
  {
    if (this->SingleAxis == 0)
    {
      const double spine = 0.5 * (this->At(this->End) - this->At(-1 * this->End));
      return this->End[0] * spine / this->Half;
    }
    const int other = 3 - this->SingleAxis;
    const int across = other == 1 ? y : z;
    const int side = doubledX > 0 ? 1 : -1;
    if (std::abs(doubledX) > 2 * std::abs(across))
    {
      return side * (this->At({ side, 0, 0 }) - this->Middle) / this->Half;
    }
    Point onAxis = { 0, 0, 0 };
    onAxis[other] = across > 0 ? 1 : -1;
    const double before = this->At(onAxis);
    onAxis[0] = side;
    return side * (this->At(onAxis) - before) / this->Half;
  }

  int Half;
  const TypeTable& Shape;
  int OddAxes = 0;
  int SingleAxis = 0;
  Point End{};
  double Middle = 0.0;
  std::array<double, 27> Values{};
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

template <typename T>
DomainSummary Summarize(const Grid& grid, const SampleView<T>& samples, const Place& place)
{
  Interpolant<T> interpolant(grid, samples, place);
  const int half = 1 << place.Scale;
  const Point centre = half * place.Position;
  Accumulator sums;
  ForEachRow(grid, samples, centre, interpolant, half,
    [&](const T* row, int y, int z, int first, int last)
    { AddRow(interpolant, row, y, z, first, last, sums); });
  DomainSummary summary = sums.Result();
  if (summary.Error == Infinity)
  {
    bool hasNaN = false;
    ForEachRow(grid, samples, centre, interpolant, half,
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

}

namespace
{

/** A lattice point in the middle of an edge, and the edge's ends, as indices of samples. */
struct EdgeMiddle
{
  std::uint8_t Middle = 0;
  std::array<std::uint8_t, 2> Ends{};
};

/**
 * A diamond of scale 0. Its domain has no lattice points but its vertices, where the interpolant is
 * exact, and the middles of its edges, where it is the mean of the ends. 7 of 8 diamonds are of
 * this scale.
 */
struct FinestShape
{
  std::vector<Point> Points; ///< all lattice points of the domain, as offsets from the centre
  std::vector<EdgeMiddle> Middles;

  FinestShape() = default;
  explicit FinestShape(const TypeTable& type)
  {
    if (!type.Valid)
    {
      return;
    }
    this->Points.assign(type.Offsets.begin(), type.Offsets.begin() + type.VertexCount);
    this->AddEdge(type.Spine[0], type.Spine[1]);
    for (int i = 0; i < type.HalfTetrahedronCount; ++i)
    {
      const std::array<std::uint8_t, 3>& v = type.HalfTetrahedra[i].Vertices;
      this->AddEdge(v[0], v[1]);
      this->AddEdge(v[1], v[2]);
      this->AddEdge(v[2], v[0]);
    }
  }

private:
  void AddEdge(std::uint8_t a, std::uint8_t b)
  {
    const Point sum = this->Points[a] + this->Points[b];
    const Point middle = { sum[0] / 2, sum[1] / 2, sum[2] / 2 };
    const bool isLatticePoint = 2 * middle == sum;
    if (isLatticePoint &&
      std::find(this->Points.begin(), this->Points.end(), middle) == this->Points.end())
    {
      this->Middles.push_back({ static_cast<std::uint8_t>(this->Points.size()), { a, b } });
      this->Points.push_back(middle);
    }
  }
};

const FinestShape& FinestShapeOf(const Point& position)
{
  static const std::array<FinestShape, 64> shapes = []
  {
    std::array<FinestShape, 64> all;
    for (int type = 0; type < 64; ++type)
    {
      all[type] = FinestShape(tables::Types[type]);
    }
    return all;
  }();
  return shapes[TypeOf(position)];
}

/** The summary of a diamond of scale 0 that lies inside the grid with all of its vertices. */
template <typename T>
DomainSummary SummarizeFinest(const SampleView<T>& samples, const Point& centre)
{
  const FinestShape& shape = FinestShapeOf(centre);
  const T* middle = samples.Pointer() + samples.Index(centre);
  const std::int64_t row = samples.Dimensions()[0];
  const std::int64_t slice = row * samples.Dimensions()[1];
  std::array<double, 27> values;
  DomainSummary summary{ 0.0, { Infinity, -Infinity } };
  double invalid = 0.0;
  for (std::size_t i = 0; i < shape.Points.size(); ++i)
  {
    const Point& offset = shape.Points[i];
    const double value =
      static_cast<double>(middle[offset[0] + offset[1] * row + offset[2] * slice]);
    values[i] = value;
    summary.Range.Minimum = value < summary.Range.Minimum ? value : summary.Range.Minimum;
    summary.Range.Maximum = value > summary.Range.Maximum ? value : summary.Range.Maximum;
    invalid += value - value;
  }
  for (const EdgeMiddle& edge : shape.Middles)
  {
    const double mean = 0.5 * (values[edge.Ends[0]] + values[edge.Ends[1]]);
    const double error = std::fabs(values[edge.Middle] - mean);
    summary.Error = error > summary.Error ? error : summary.Error;
  }
  if (!(invalid == 0.0)) // infinite samples and NaN leave a NaN here
  {
    summary.Error = Infinity;
    CountNaN(summary.Range,
      std::any_of(values.begin(), values.begin() + shape.Points.size(), IsNaN<double>));
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
  const bool isFinest = place.Scale == 0 && grid.IsSampled(place.Position + Point{ 1, 1, 1 }) &&
    grid.IsSampled(place.Position + Point{ -1, -1, -1 });
  return std::visit([&](const auto& view)
    { return isFinest ? SummarizeFinest(view, place.Position) : Summarize(grid, view, place); },
    samples);
}

}
