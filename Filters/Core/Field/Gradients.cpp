// SPDX-License-Identifier: BSD-3-Clause
#include "Field/Gradients.h"

#include "Field/Differences.h"
#include "Field/Trilinear.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace isodiamond
{
namespace
{

/** Central differences in index space at a sample, one-sided on the boundary and beside what is not
 *  finite. @param valueOf (sample) -> the field there */
template <typename T, typename ValueOf>
Vector DifferencesAt(const SampleView<T>& samples, const Point& point, const ValueOf& valueOf)
{
  const std::array<int, 3>& size = samples.Dimensions();
  const std::array<std::int64_t, 3> strides = { 1, size[0], std::int64_t{ 1 } * size[0] * size[1] };
  const T* const at = samples.Pointer() + samples.Index(point);
  const double here = valueOf(*at);
  Vector gradient{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isFirst = point[axis] == 0;
    const bool isLast = point[axis] == size[axis] - 1;
    double before = valueOf(at[isFirst ? 0 : -strides[axis]]);
    double after = valueOf(at[isLast ? 0 : strides[axis]]);
    const bool isOneSided = isFirst || isLast || !std::isfinite(before) || !std::isfinite(after);
    before = std::isfinite(before) ? before : here;
    after = std::isfinite(after) ? after : here;
    gradient[axis] = (isOneSided ? 1.0 : 0.5) * (after - before);
  }
  return gradient;
}

/** The samples of all cells that hold some positions. */
struct SampleBox
{
  Point First{};
  Point Last{};

  SampleBox(const std::vector<Vector>& positions, const std::array<int, 3>& dimensions)
  {
    Vector low = positions.front();
    Vector high = low;
    for (const Vector& position : positions)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], position[axis]);
        high[axis] = std::max(high[axis], position[axis]);
      }
    }
    this->First = CellPosition(low, dimensions).Cell;
    this->Last = CellPosition(high, dimensions).Cell + Point{ 1, 1, 1 };
  }

  std::size_t Count() const
  {
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      count *= this->Last[axis] - this->First[axis] + 1;
    }
    return count;
  }
};

/** Calls body(number, gradient in index space) for some positions: not finite beside samples that
 *  are not. */
template <typename T, typename Body>
void ForEachDifference(
  const SampleView<T>& samples, const std::vector<Vector>& positions, const Body& body)
{
  if (positions.empty())
  {
    return;
  }
  Differences<T> differences(samples);
  const SampleBox around(positions, samples.Dimensions());
  const bool isShared = around.Count() <= 8 * positions.size(); // each cell alone needs eight
  if (isShared)
  {
    differences.Fill(around.First, around.Last);
  }
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const CellPosition position = CellPosition(positions[i], samples.Dimensions()).Clamped();
    if (!isShared)
    {
      differences.Fill(position.Cell, position.Cell + Point{ 1, 1, 1 });
    }
    body(i, differences.At(position));
  }
}

/** Gradients in the world for steps in index space, from the derivatives of the position: the
 *  vectors whose products with these are 1 on their own axis, and 0 on the others. */
std::array<Vector, 3> GradientsOfSteps(const std::array<Vector, 3>& derivatives)
{
  std::array<Vector, 3> gradients = { Cross(derivatives[1], derivatives[2]),
    Cross(derivatives[2], derivatives[0]), Cross(derivatives[0], derivatives[1]) };
  const double volume = Dot(derivatives[0], gradients[0]);
  for (Vector& gradient : gradients)
  {
    gradient = { gradient[0] / volume, gradient[1] / volume, gradient[2] / volume };
  }
  return gradients;
}

/** Converts a gradient in index space to one in the world. */
Vector ToWorld(const std::array<Vector, 3>& ofSteps, const Vector& gradient)
{
  return gradient[0] * ofSteps[0] + gradient[1] * ofSteps[1] + gradient[2] * ofSteps[2];
}

}

Gradients::Gradients(const AnySamples& samples, const GridGeometry& geometry)
  : Samples(samples)
  , Geometry(geometry)
{
  if (geometry.Affine() != nullptr)
  {
    this->OfSteps = GradientsOfSteps(geometry.DerivativesAt({ 0, 0, 0 }));
  }
}

template <typename ValueOf>
Vector Gradients::FromCorners(const Vector& index, const ValueOf& valueOf) const
{
  return std::visit(
    [&](const auto& view)
    {
      Vector sum{};
      CellPosition(index, view.Dimensions())
        .Clamped()
        .ForEachCorner(
          [&](const Point& sample, double weight)
          {
            const Vector gradient = DifferencesAt(view, sample, valueOf);
            sum = sum +
              weight *
                (this->OfSteps
                    ? gradient
                    : ToWorld(GradientsOfSteps(this->Geometry.DerivativesAt(sample)), gradient));
          });
      return this->OfSteps ? ToWorld(*this->OfSteps, sum) : sum;
    },
    this->Samples);
}

void Gradients::Find(const std::vector<Vector>& positions, Vector* gradients) const
{
  const auto value = [](auto sample) { return static_cast<double>(sample); };
  if (!this->OfSteps)
  {
    std::transform(positions.begin(), positions.end(), gradients,
      [&](const Vector& index) { return this->FromCorners(index, value); });
    return;
  }
  std::visit(
    [&](const auto& view)
    {
      ForEachDifference(view, positions,
        [&](std::size_t i, const Vector& gradient)
        {
          gradients[i] = std::isfinite(gradient[0] + gradient[1] + gradient[2])
            ? ToWorld(*this->OfSteps, gradient)
            : this->FromCorners(positions[i], value);
        });
    },
    this->Samples);
}

Vector Gradients::operator()(const Vector& index) const
{
  Vector gradient;
  this->Find({ index }, &gradient);
  return gradient;
}

/** The gradient of a field that is 0 where samples are finite, else -1 or 1. */
Vector Gradients::OfGaps(const Vector& index) const
{
  return this->FromCorners(index,
    [](auto sample)
    {
      const auto value = static_cast<double>(sample);
      return std::isfinite(value) ? 0.0 : value > 0.0 ? 1.0 : -1.0;
    });
}

Vector Gradients::NormalAt(const Vector& index, const Vector& gradient) const
{
  const bool isFinite = std::all_of(
    gradient.begin(), gradient.end(), [](double component) { return std::isfinite(component); });
  return NormalOf(isFinite ? gradient : this->OfGaps(index));
}

Vector NormalOfExtreme(const Vector& gradient)
{
  const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return { 0.0, 0.0, 1.0 };
  }
  return { -gradient[0] / length, -gradient[1] / length, -gradient[2] / length };
}

}
