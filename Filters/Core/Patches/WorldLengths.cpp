// SPDX-License-Identifier: BSD-3-Clause
#include "Patches/WorldLengths.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace isodiamond
{
namespace
{

/** Whether coordinates are finite and rise, or fall, at every step, by what can be measured. */
bool AreStrictlyMonotone(const std::vector<double>& coordinates)
{
  const bool rise = coordinates.back() > coordinates.front();
  for (std::size_t i = 1; i < coordinates.size(); ++i)
  {
    const double step =
      rise ? coordinates[i] - coordinates[i - 1] : coordinates[i - 1] - coordinates[i];
    if (!(step >= ShortestStep && step <= LongestStep))
    {
      return false;
    }
  }
  return true;
}

/** What no distance in a grid exceeds that is a box, or a sheared one, whatever its steps. */
template <typename Lengths>
double DiagonalOf(const Lengths& lengths, const Point& last)
{
  const Vector diagonal = lengths.Between({ 0, 0, 0 }, last);
  return std::sqrt(Dot(diagonal, diagonal));
}

}

AffineLengths::AffineLengths(const AffineMap& world)
{
  // Gram-Schmidt on the columns.
  auto& factor = this->Triangular;
  std::array<Vector, 3> directions{};
  for (int j = 0; j < 3; ++j)
  {
    Vector rest = { world.Rows[0][j], world.Rows[1][j], world.Rows[2][j] };
    for (int i = 0; i < j; ++i)
    {
      factor[i][j] = Dot(directions[i], rest);
      rest = rest - factor[i][j] * directions[i];
    }
    factor[j][j] = std::hypot(rest[0], rest[1], rest[2]);
    directions[j] = { rest[0] / factor[j][j], rest[1] / factor[j][j], rest[2] / factor[j][j] };
  }
  auto& inverse = this->Inverse;
  for (int i = 0; i < 3; ++i)
  {
    inverse[i][i] = 1.0 / factor[i][i];
  }
  inverse[0][1] = -factor[0][1] * inverse[0][0] * inverse[1][1];
  inverse[1][2] = -factor[1][2] * inverse[1][1] * inverse[2][2];
  inverse[0][2] = -(factor[0][1] * inverse[1][2] + factor[0][2] * inverse[2][2]) * inverse[0][0];
}

bool AffineLengths::IsValid() const
{
  const auto areBelow = [](const std::array<Vector, 3>& factor, double most)
  {
    return std::all_of(factor.begin(), factor.end(),
      [=](const Vector& row)
      {
        return std::all_of(
          row.begin(), row.end(), [=](double value) { return std::abs(value) <= most; });
      });
  };
  const auto& f = this->Triangular;
  return std::min({ f[0][0], f[1][1], f[2][2] }) >= ShortestStep && areBelow(f, LongestStep) &&
    areBelow(this->Inverse, 1.0 / ShortestStep);
}

double AffineLengths::SquaredRadius(const FineBox& box, const FinePosition& middle) const
{
  std::array<double, 3> half{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int longer = std::max(middle[axis] - box.Low[axis], box.High[axis] - middle[axis]);
    half[axis] = 1.0 / FineUnits * longer;
  }
  double squared = 0.0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const Vector reach = this->Mapped(
      (corner & 1) != 0 ? -half[0] : half[0], (corner & 2) != 0 ? -half[1] : half[1], half[2]);
    squared = std::max(squared, Dot(reach, reach));
  }
  return squared;
}

Bounds AffineLengths::IndexBox(const Vector& point, double radius) const
{
  Bounds box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector row = this->Inverse[axis];
    const double reach = radius * std::sqrt(Dot(row, row));
    box.Low[axis] = Dot(row, point) - reach;
    box.High[axis] = Dot(row, point) + reach;
  }
  return box;
}

Bounds AffineLengths::IndexBoxAround(const Vector* corners, int count) const
{
  const auto& inverse = this->Inverse;
  Bounds box;
  for (int i = 0; i < count; ++i)
  {
    box.Add(Vector{
      Dot(inverse[0], corners[i]), Dot(inverse[1], corners[i]), Dot(inverse[2], corners[i]) });
  }
  return box;
}

double AffineLengths::LongestDistance(const Point& last) const
{
  return DiagonalOf(*this, last);
}

double AffineLengths::TypicalStep() const
{
  const auto& f = this->Triangular;
  return std::max({ f[0][0], f[1][1], f[2][2] });
}

AxesLengths::AxesLengths(AxisCoordinates coordinates, int padding)
  : Coordinates(std::move(coordinates))
  , Padding(padding)
{
  for (std::vector<double>& axis : this->Coordinates)
  {
    // Otherwise a grid far from the origin would lose digits.
    const double first = axis.front();
    std::transform(axis.begin(), axis.end(), axis.begin(), [=](double c) { return c - first; });
    this->AbsoluteError += 1e-14 * std::abs(axis.back());
  }
}

bool AxesLengths::IsValid() const
{
  return std::all_of(this->Coordinates.begin(), this->Coordinates.end(), AreStrictlyMonotone);
}

double AxesLengths::Along(int axis, std::int32_t position) const
{
  const std::vector<double>& coordinates = this->Coordinates[axis];
  const std::int32_t inGrid = position - FineUnits * this->Padding;
  const int last = static_cast<int>(coordinates.size()) - 2;
  const int cell = std::clamp(inGrid / FineUnits, 0, last); // also takes negative ones to 0
  const double part = 1.0 / FineUnits * (inGrid - FineUnits * cell);
  return coordinates[cell] + part * (coordinates[cell + 1] - coordinates[cell]);
}

double AxesLengths::SquaredRadius(const FineBox& box, const FinePosition& middle) const
{
  const Vector centre = (*this)(middle);
  const Vector below = centre - (*this)(box.Low);
  const Vector above = (*this)(box.High) - centre;
  Vector reach{};
  for (int axis = 0; axis < 3; ++axis)
  {
    reach[axis] = std::max(std::abs(below[axis]), std::abs(above[axis]));
  }
  return Dot(reach, reach);
}

Bounds AxesLengths::IndexBox(const Vector& point, double radius) const
{
  Bounds box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = this->IndexAlong(axis, point[axis] - radius);
    const double b = this->IndexAlong(axis, point[axis] + radius);
    box.Low[axis] = std::min(a, b);
    box.High[axis] = std::max(a, b);
  }
  return box;
}

double AxesLengths::IndexAlong(int axis, double place) const
{
  const std::vector<double>& coordinates = this->Coordinates[axis];
  const bool isRising = coordinates.back() > coordinates.front();
  const auto next = std::upper_bound(coordinates.begin() + 1, coordinates.end() - 1, place,
    [=](double a, double b) { return isRising ? a < b : a > b; });
  const auto last = next - 1;
  return this->Padding + static_cast<double>(last - coordinates.begin()) +
    (place - *last) / (*next - *last);
}

Bounds AxesLengths::IndexBoxAround(const Vector* corners, int count) const
{
  Bounds box;
  for (int i = 0; i < count; ++i)
  {
    box.Add(Vector{ this->IndexAlong(0, corners[i][0]), this->IndexAlong(1, corners[i][1]),
      this->IndexAlong(2, corners[i][2]) });
  }
  return box;
}

double AxesLengths::StepIn(const Point& cell) const
{
  const Vector size = this->Between(cell, cell + Point{ 1, 1, 1 });
  return std::min({ std::abs(size[0]), std::abs(size[1]), std::abs(size[2]) });
}

double AxesLengths::LongestDistance(const Point& last) const
{
  return DiagonalOf(*this, last);
}

double AxesLengths::TypicalStep() const
{
  double longest = 0.0;
  for (const std::vector<double>& axis : this->Coordinates)
  {
    longest = std::max(longest, std::abs(axis.back()) / static_cast<double>(axis.size() - 1));
  }
  return longest;
}

std::string FaultOfLengths(const GridGeometry& world)
{
  if (const AffineMap* map = world.Affine())
  {
    return AffineLengths(*map).IsValid() ? "" : "Distances need a spacing between 1e-35 and 1e35.";
  }
  if (const AxisCoordinates* axes = world.Axes())
  {
    return AxesLengths(*axes, 0).IsValid()
      ? ""
      : "The distance metric needs coordinates that are finite and rise, or fall, at every sample "
        "of an axis, by 1e-35 to 1e35; on others use the field metric.";
  }
  return CurvedLengths::CanBeMeasured(world) ? ""
                                             : "The distance metric needs positions that are "
                                               "finite, and from 1e-35 to 1e35 apart; on others "
                                               "use the field metric.";
}

WorldLengths WorldLengthsOf(const GridGeometry& world)
{
  const std::string fault = FaultOfLengths(world);
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
  if (const AffineMap* map = world.Affine())
  {
    return AffineLengths(*map);
  }
  if (const AxisCoordinates* axes = world.Axes())
  {
    return AxesLengths(*axes, world.Padding());
  }
  return CurvedLengths(world);
}

}
