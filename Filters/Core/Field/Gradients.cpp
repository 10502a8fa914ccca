// SPDX-License-Identifier: BSD-3-Clause
#include "Field/Gradients.h"

#include "Field/Trilinear.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace isodiamond
{
namespace
{

/** Central differences in index space at a sample, one-sided on the boundary and, if there are
 * gaps, beside what is not finite. @param valueOf (sample) -> the field there */
template <bool HasGaps, typename T, typename ValueOf>
Vector DifferencesAt(const SampleView<T>& samples, const Point& point, const ValueOf& valueOf)
{
  const std::array<int, 3>& size = samples.Dimensions();
  const std::array<std::int64_t, 3> strides = { 1, size[0], std::int64_t{ 1 } * size[0] * size[1] };
  const T* const at = samples.Pointer() + samples.Index(point);
  Vector gradient{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isFirst = point[axis] == 0;
    const bool isLast = point[axis] == size[axis] - 1;
    double before = valueOf(at[isFirst ? 0 : -strides[axis]]);
    double after = valueOf(at[isLast ? 0 : strides[axis]]);
    bool isOneSided = isFirst || isLast;
    if (const double here = HasGaps ? valueOf(*at) : HUGE_VAL; std::isfinite(here))
    {
      isOneSided = isOneSided || !std::isfinite(before) || !std::isfinite(after);
      before = std::isfinite(before) ? before : here;
      after = std::isfinite(after) ? after : here;
    }
    gradient[axis] = (isOneSided ? 1.0 : 0.5) * (after - before);
  }
  return gradient;
}

/** The same, minding gaps only where there are any: few samples are beside one. */
template <typename T, typename ValueOf>
Vector IndexGradientAt(const SampleView<T>& samples, const Point& point, const ValueOf& valueOf)
{
  const Vector gradient = DifferencesAt<false>(samples, point, valueOf);
  const bool isKnown =
    !std::is_floating_point_v<T> || std::isfinite(gradient[0] + gradient[1] + gradient[2]);
  return isKnown ? gradient : DifferencesAt<true>(samples, point, valueOf);
}

/** Whether all samples next to a cell's corners exist. */
bool IsInside(const CellPosition& position, const std::array<int, 3>& dimensions)
{
  bool isInside = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    isInside = isInside && position.Cell[axis] > 0 && position.Cell[axis] + 2 < dimensions[axis];
  }
  return isInside;
}

/** The interpolated differences in index space at a position inside, where there are no gaps: most
 *  positions are such, and most of the time for normals is spent here. */
template <typename T, typename ValueOf>
Vector IndexGradientInside(
  const SampleView<T>& samples, const CellPosition& position, const ValueOf& valueOf)
{
  const std::array<int, 3>& size = samples.Dimensions();
  const std::int64_t row = size[0];
  const std::int64_t slice = row * size[1];
  const T* const cell = samples.Pointer() + samples.Index(position.Cell);
  Vector sum{};
  position.ForEachCornerNumber(
    [&](int corner, double weight)
    {
      const T* const at = cell + (corner & 1) + ((corner >> 1) & 1) * row + (corner >> 2) * slice;
      const auto difference = [&](std::int64_t stride)
      { return valueOf(at[stride]) - valueOf(at[-stride]); };
      sum = sum + weight * Vector{ difference(1), difference(row), difference(slice) };
    });
  return 0.5 * sum;
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
Vector Gradients::At(const Vector& index, const ValueOf& valueOf) const
{
  return std::visit(
    [&](const auto& view)
    {
      const CellPosition position(index, view.Dimensions());
      if (this->OfSteps && IsInside(position, view.Dimensions()))
      {
        const Vector gradient = IndexGradientInside(view, position, valueOf);
        if (std::isfinite(gradient[0] + gradient[1] + gradient[2]))
        {
          return ToWorld(*this->OfSteps, gradient);
        }
      }
      Vector sum{};
      position.Clamped().ForEachCorner(
        [&](const Point& sample, double weight)
        {
          const Vector gradient = IndexGradientAt(view, sample, valueOf);
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

Vector Gradients::operator()(const Vector& index) const
{
  return this->At(index, [](auto sample) { return static_cast<double>(sample); });
}

/** The gradient of a field that is 0 where samples are finite, else -1 or 1. */
Vector Gradients::OfGaps(const Vector& index) const
{
  return this->At(index,
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

Vector NormalOf(const Vector& gradient)
{
  const double squared = Dot(gradient, gradient);
  if (squared > 1e-200 && squared < 1e200)
  {
    return (-1.0 / std::sqrt(squared)) * gradient;
  }
  // Too short or too long to be squared, or not a number.
  const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return { 0.0, 0.0, 1.0 };
  }
  return { -gradient[0] / length, -gradient[1] / length, -gradient[2] / length };
}

}
