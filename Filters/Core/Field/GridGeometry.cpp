// SPDX-License-Identifier: BSD-3-Clause
#include "Field/GridGeometry.h"

#include "Field/Trilinear.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

namespace isodiamond
{
namespace
{

/** Each coordinate depends on the index on its own axis only, rounding included. */
Vector AlongAxes(const AxisCoordinates& coordinates, const CellPosition& position)
{
  Vector along{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* from = coordinates[axis].data() + position.Cell[axis];
    const double fraction = position.Fraction[axis];
    // What has no weight does not count, even if it is not a number.
    along[axis] = (fraction != 1.0 ? (1.0 - fraction) * from[0] : 0.0) +
      (fraction != 0.0 ? fraction * from[1] : 0.0);
  }
  return along;
}

/** The index at which an axis has a coordinate. @param coordinates that rise or fall */
double IndexOn(const std::vector<double>& coordinates, double coordinate)
{
  const bool falls = coordinates.front() > coordinates.back();
  const auto next = std::lower_bound(coordinates.begin() + 1, coordinates.end() - 1, coordinate,
    [falls](double a, double b) { return falls ? a > b : a < b; });
  const double before = *(next - 1);
  return static_cast<double>(next - 1 - coordinates.begin()) +
    (coordinate - before) / (*next - before);
}

/** The mean distance between neighbouring samples, on the axis where it is least: of some samples
 *  that are spread over the grid. */
double MeanStepOf(const GridGeometry& world)
{
  constexpr int some = 16; // on each axis
  const std::array<int, 3> size = world.Dimensions();
  double least = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis)
  {
    Point count{};
    for (int i = 0; i < 3; ++i)
    {
      count[i] = std::min(some, size[i] - (i == axis ? 1 : 0));
    }
    double sum = 0.0;
    for (int i = 0; i < count[0] * count[1] * count[2]; ++i)
    {
      const Point which = { i % count[0], i / count[0] % count[1], i / (count[0] * count[1]) };
      Point sample{};
      for (int j = 0; j < 3; ++j)
      {
        const std::int64_t places = size[j] - (j == axis ? 1 : 0);
        sample[j] = static_cast<int>(which[j] * places / count[j]);
      }
      Point next = sample;
      ++next[axis];
      const Vector step = world.SampleAt(next) - world.SampleAt(sample);
      sum += std::hypot(step[0], step[1], step[2]);
    }
    least = std::min(least, sum / (count[0] * count[1] * count[2]));
  }
  return std::isfinite(least) ? least : 0.0;
}

}

struct GridGeometry::OfCells
{
  std::once_flag Once;
  std::optional<CellBounds> Bounds;
};

GridGeometry::GridGeometry(const SamplePositions& positions, int shift)
  : Map(positions)
  , Shift(shift)
  , MeanStep(MeanStepOf(*this))
  , Cells(std::make_shared<OfCells>())
{
}

const CellBounds& GridGeometry::CellsInWorld() const
{
  std::call_once(this->Cells->Once,
    [&]
    {
      std::array<int, 3> samples = this->Dimensions();
      for (int& count : samples)
      {
        count += 2 * this->Shift;
      }
      this->Cells->Bounds.emplace(
        samples, [&](const Point& point) { return this->PaddedAt(point); });
    });
  return *this->Cells->Bounds;
}

std::array<int, 3> GridGeometry::Dimensions() const
{
  if (const auto* axes = std::get_if<AxisCoordinates>(&this->Map))
  {
    return { static_cast<int>((*axes)[0].size()), static_cast<int>((*axes)[1].size()),
      static_cast<int>((*axes)[2].size()) };
  }
  return std::get<SamplePositions>(this->Map).Dimensions;
}

Vector GridGeometry::SampleAt(const Point& sample) const
{
  if (const auto* axes = std::get_if<AxisCoordinates>(&this->Map))
  {
    return { (*axes)[0][sample[0]], (*axes)[1][sample[1]], (*axes)[2][sample[2]] };
  }
  const auto& positions = std::get<SamplePositions>(this->Map);
  const std::array<int, 3>& size = positions.Dimensions;
  const std::int64_t at =
    3 * ((std::int64_t{ sample[2] } * size[1] + sample[1]) * size[0] + sample[0]);
  return std::visit(
    [at](const auto* coordinates) -> Vector
    {
      return { static_cast<double>(coordinates[at]), static_cast<double>(coordinates[at + 1]),
        static_cast<double>(coordinates[at + 2]) };
    },
    positions.Coordinates);
}

Vector GridGeometry::PaddedAt(const Point& point) const
{
  const Point sample = point + Point{ -this->Shift, -this->Shift, -this->Shift };
  const std::array<int, 3> size = this->Dimensions();
  bool isSample = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isSample = isSample && sample[axis] >= 0 && sample[axis] < size[axis];
  }
  return isSample ? this->SampleAt(sample)
                  : (*this)(Vector{ 1.0 * point[0], 1.0 * point[1], 1.0 * point[2] });
}

Vector GridGeometry::operator()(const Vector& index) const
{
  if (const AffineMap* map = this->Affine())
  {
    return (*map)(index[0], index[1], index[2]);
  }
  const double shift = this->Shift;
  const CellPosition cell(
    { index[0] - shift, index[1] - shift, index[2] - shift }, this->Dimensions());
  if (const AxisCoordinates* axes = this->Axes())
  {
    return AlongAxes(*axes, cell);
  }
  Vector position{};
  cell.ForEachCorner(
    [&](const Point& sample, double weight)
    {
      const Vector corner = this->SampleAt(sample);
      for (int axis = 0; axis < 3; ++axis)
      {
        position[axis] += weight * corner[axis];
      }
    });
  return position;
}

Vector GridGeometry::IndexAt(const Vector& position) const
{
  if (const AffineMap* map = this->Affine())
  {
    return map->Inverse(position);
  }
  const auto& axes = std::get<AxisCoordinates>(this->Map);
  Vector index{};
  for (int axis = 0; axis < 3; ++axis)
  {
    index[axis] = this->Shift + IndexOn(axes[axis], position[axis]);
  }
  return index;
}

std::array<Vector, 3> GridGeometry::DerivativesAt(const Point& sample) const
{
  std::array<Vector, 3> derivatives{};
  const AffineMap* map = this->Affine();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (map != nullptr)
    {
      derivatives[axis] = { map->Rows[0][axis], map->Rows[1][axis], map->Rows[2][axis] };
      continue;
    }
    const std::array<int, 3> size = this->Dimensions();
    Point middle = sample;
    for (int i = 0; i < 3; ++i)
    {
      middle[i] = std::clamp(sample[i] - this->Shift, 0, size[i] - 1);
    }
    Point before = middle;
    Point after = middle;
    before[axis] = std::max(middle[axis] - 1, 0);
    after[axis] = std::min(middle[axis] + 1, size[axis] - 1);
    derivatives[axis] =
      (1.0 / (after[axis] - before[axis])) * (this->SampleAt(after) - this->SampleAt(before));
  }
  return derivatives;
}

double GridGeometry::SmallestStep() const
{
  if (this->Positions() != nullptr)
  {
    return this->MeanStep;
  }
  double least = HUGE_VAL;
  const AxisCoordinates* axes = this->Axes();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (axes != nullptr)
    {
      const std::vector<double>& places = (*axes)[axis];
      for (std::size_t i = 1; i < places.size(); ++i)
      {
        least = std::min(least, std::abs(places[i] - places[i - 1]));
      }
    }
    else
    {
      const Vector step = this->DerivativesAt({})[axis];
      least = std::min(least, std::sqrt(Dot(step, step)));
    }
  }
  return std::isfinite(least) ? least : 0.0;
}

bool GridGeometry::FitsFloats(const Point& last) const
{
  if (const auto* positions = std::get_if<SamplePositions>(&this->Map))
  {
    return std::holds_alternative<const float*>(positions->Coordinates);
  }
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    Vector index{};
    for (int axis = 0; axis < 3; ++axis)
    {
      index[axis] = ((corner >> axis) & 1) != 0 ? last[axis] : 0.0;
    }
    const Vector place = (*this)(index);
    for (const double coordinate : place)
    {
      largest = std::max(largest, std::abs(coordinate));
    }
  }
  if (!(largest < std::numeric_limits<float>::max()))
  {
    return false;
  }
  const auto nearest = static_cast<float>(largest);
  const double spacing = std::nextafter(nearest, HUGE_VALF) - nearest;
  return 1024.0 * spacing <= this->SmallestStep();
}

bool GridGeometry::Mirrors() const
{
  if (const AffineMap* map = this->Affine())
  {
    return map->Mirrors();
  }
  const std::array<int, 3> size = this->Dimensions();
  const std::array<Vector, 3> d = this->DerivativesAt(
    { size[0] / 2 + this->Shift, size[1] / 2 + this->Shift, size[2] / 2 + this->Shift });
  return Dot(d[0], Cross(d[1], d[2])) < 0.0;
}

}
