// SPDX-License-Identifier: BSD-3-Clause
#include "Field/Gradients.h"

#include "Field/Trilinear.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** Central differences in index space at a sample. */
template <typename T>
Vector IndexGradientAt(const SampleView<T>& samples, const Point& point)
{
  Vector gradient{};
  for (int axis = 0; axis < 3; ++axis)
  {
    Point before = point;
    Point after = point;
    before[axis] = std::max(point[axis] - 1, 0);
    after[axis] = std::min(point[axis] + 1, samples.Dimensions()[axis] - 1);
    gradient[axis] = (samples(after) - samples(before)) / (after[axis] - before[axis]);
  }
  return gradient;
}

/** The vector whose products with the derivatives of the position are those of the field. */
Vector ToWorld(const std::array<Vector, 3>& derivatives, const Vector& gradient)
{
  Vector world{};
  const std::array<Vector, 3> normals = { Cross(derivatives[1], derivatives[2]),
    Cross(derivatives[2], derivatives[0]), Cross(derivatives[0], derivatives[1]) };
  const double volume = Dot(derivatives[0], normals[0]);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < 3; ++i)
    {
      world[i] += gradient[axis] * normals[axis][i] / volume;
    }
  }
  return world;
}

}

Vector Gradients::operator()(const Vector& index) const
{
  const bool isAffine = this->Geometry.Affine() != nullptr;
  Vector sum{};
  std::visit(
    [&](const auto& view)
    {
      CellPosition(index, view.Dimensions())
        .Clamped()
        .ForEachCorner(
          [&](const Point& sample, double weight)
          {
            Vector gradient = IndexGradientAt(view, sample);
            if (!isAffine)
            {
              gradient = ToWorld(this->Geometry.DerivativesAt(sample), gradient);
            }
            for (int axis = 0; axis < 3; ++axis)
            {
              sum[axis] += weight * gradient[axis];
            }
          });
    },
    this->Samples);
  return isAffine ? ToWorld(this->Geometry.DerivativesAt({ 0, 0, 0 }), sum) : sum;
}

Vector NormalOf(const Vector& gradient)
{
  const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return { 0.0, 0.0, 1.0 };
  }
  return (-1.0 / length) * gradient;
}

}
