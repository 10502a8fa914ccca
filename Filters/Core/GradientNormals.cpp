// SPDX-License-Identifier: BSD-3-Clause
#include "GradientNormals.h"

#include "Vector.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** Central differences in index space at a sample. */
template <typename T>
Vector GradientAt(const SampleView<T>& samples, const Point& point)
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

/** The gradient at a point between samples. */
template <typename T>
Vector InterpolatedGradient(const SampleView<T>& samples, const Vector& index)
{
  Point cell{};
  Vector fraction{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = samples.Dimensions()[axis] - 2;
    cell[axis] = std::clamp(static_cast<int>(std::floor(index[axis])), 0, last);
    fraction[axis] = std::clamp(index[axis] - cell[axis], 0.0, 1.0);
  }
  Vector sum{};
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1.0;
    Point point = cell;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool far = ((corner >> axis) & 1) != 0;
      weight *= far ? fraction[axis] : 1.0 - fraction[axis];
      point[axis] += far ? 1 : 0;
    }
    if (weight > 0.0)
    {
      const Vector gradient = GradientAt(samples, point);
      for (int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += weight * gradient[axis];
      }
    }
  }
  return sum;
}

/** The unit normal in the world, toward lower values. */
Vector ToNormal(const AffineMap& world, const Vector& gradient)
{
  const double side = world.Mirrors() ? 1.0 : -1.0;
  Vector normal{};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      normal[i] += side * world.Cofactor(i, j) * gradient[j];
    }
  }
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return { 0.0, 0.0, 1.0 };
  }
  return { normal[0] / length, normal[1] / length, normal[2] / length };
}

}

void WriteGradientNormals(const AnySamples& samples, const AffineMap& world, const float* points,
  std::int64_t count, float* normals, const ParallelFor& parallelFor)
{
  std::visit(
    [&](const auto& view)
    {
      parallelFor(count, 1024,
        [&](std::int64_t begin, std::int64_t end)
        {
          for (std::int64_t i = begin; i < end; ++i)
          {
            const float* p = points + 3 * i;
            const Vector normal =
              ToNormal(world, InterpolatedGradient(view, world.Inverse({ p[0], p[1], p[2] })));
            std::copy(normal.begin(), normal.end(), normals + 3 * i);
          }
        });
    },
    samples);
}

}
