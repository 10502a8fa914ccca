// SPDX-License-Identifier: BSD-3-Clause
#include "FieldError.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isodiamond
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

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
      summary.Range.Minimum = -Infinity;
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
  int begin = first;
  for (int piece = 0; piece <= count && begin <= last; ++piece)
  {
    const int end = piece < count ? std::min(knots[piece], last) : last;
    if (end < begin)
    {
      continue;
    }
    // The slope as a difference of two values of one piece: exact for integer samples.
    const double start = interpolant({ begin, y, z });
    const double slope = end > begin ? interpolant({ begin + 1, y, z }) - start : 0.0;
    sums.AddLine(centre + begin, end - begin + 1, start, slope);
    begin = end + 1;
  }
}

template <typename T>
DomainSummary Summarize(const Grid& grid, const SampleView<T>& samples, const Place& place)
{
  Interpolant<T> interpolant(grid, samples, place);
  const int half = 1 << place.Scale;
  const Point centre = half * place.Position;
  Accumulator sums;
  for (int z = std::max(-half, -centre[2]); z <= std::min(half, grid.Last(2) - centre[2]); ++z)
  {
    for (int y = std::max(-half, -centre[1]); y <= std::min(half, grid.Last(1) - centre[1]); ++y)
    {
      const int reach = interpolant.Reach(y, z);
      const int first = std::max(-reach, -centre[0]);
      const int last = std::min(reach, grid.Last(0) - centre[0]);
      if (reach >= 0 && first <= last)
      {
        const T* row = samples.Pointer() +
          samples.Index({ centre[0] + first, centre[1] + y, centre[2] + z }) - first;
        AddRow(interpolant, row, y, z, first, last, sums);
      }
    }
  }
  DomainSummary summary = sums.Result();
  if (grid.SticksOut(place.Position, place.Scale))
  {
    summary.Error = Infinity;
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
  return std::visit([&](const auto& view) { return Summarize(grid, view, place); }, samples);
}

}
