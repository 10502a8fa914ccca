// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceLinearVolume.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace reference
{

namespace
{

/**
 * The fraction of a tetrahedron where the interpolation is below a limit. The values ascend, and
 * the limit is strictly between the first and the last.
 */
double FractionBelow(const std::array<double, 4>& values, double limit)
{
  // How far along the edge between two vertices on different sides of the limit it is reached.
  const auto cut = [&](int from, int to)
  { return (limit - values[from]) / (values[to] - values[from]); };
  if (limit < values[1])
  {
    // The corner at vertex 0 is cut off: the tetrahedron, shrunk along three of its edges.
    return cut(0, 1) * cut(0, 2) * cut(0, 3);
  }
  if (limit >= values[2])
  {
    // What remains if the corner at vertex 3 is cut off.
    return 1.0 - cut(3, 0) * cut(3, 1) * cut(3, 2);
  }
  // Vertices 0 and 1 are cut off together. With ij the point on the edge from i to j, the wedge
  // consists of the tetrahedra (0, 1, 02, 03), (1, 02, 03, 13) and (1, 02, 12, 13), whose sizes are
  // determinants of barycentric coordinates.
  return cut(0, 2) * cut(0, 3) + cut(0, 2) * (1.0 - cut(0, 3)) * cut(1, 3) +
    (1.0 - cut(0, 2)) * cut(1, 2) * cut(1, 3);
}

}

std::array<Tetrahedron, 6> VoxelTetrahedra(const Point& voxel)
{
  Point even;
  for (int axis = 0; axis < 3; ++axis)
  {
    even[axis] = voxel[axis] + voxel[axis] % 2;
  }
  // Every order of the three axes gives a path along the voxel's edges.
  std::array<Tetrahedron, 6> tetrahedra;
  std::array<int, 3> axes{ 0, 1, 2 };
  for (Tetrahedron& tetrahedron : tetrahedra)
  {
    Point corner = even;
    tetrahedron.Vertices[0] = corner;
    for (int step = 0; step < 3; ++step)
    {
      const int axis = axes[step];
      corner[axis] = 2 * voxel[axis] + 1 - even[axis];
      tetrahedron.Vertices[step + 1] = corner;
    }
    std::next_permutation(axes.begin(), axes.end());
  }
  return tetrahedra;
}

double FractionInside(const std::array<double, 4>& values, const Isorange& range)
{
  std::array<double, 4> ascending = values;
  std::sort(ascending.begin(), ascending.end());
  // A tetrahedron with a single value is inside as a whole or not at all. Elsewhere the level sets
  // have no volume, so it does not matter whether the bounds are included.
  if (ascending[0] == ascending[3])
  {
    return SignOf(ascending[0], range) == 0 ? 1.0 : 0.0;
  }
  const auto below = [&ascending](double limit)
  {
    if (limit <= ascending[0])
    {
      return 0.0;
    }
    return limit >= ascending[3] ? 1.0 : FractionBelow(ascending, limit);
  };
  return below(range.Upper) - below(range.Lower);
}

double LinearVolume(const ScalarField& field, const Isorange& range)
{
  if (!std::all_of(field.Samples.begin(), field.Samples.end(),
        [](double sample) { return std::isfinite(sample); }))
  {
    throw std::invalid_argument("samples that are not finite cannot be interpolated");
  }

  double fractions = 0.0;
  for (int z = 0; z + 1 < field.Dims[2]; ++z)
  {
    for (int y = 0; y + 1 < field.Dims[1]; ++y)
    {
      for (int x = 0; x + 1 < field.Dims[0]; ++x)
      {
        for (const Tetrahedron& tetrahedron : VoxelTetrahedra({ x, y, z }))
        {
          std::array<double, 4> values;
          for (int i = 0; i < 4; ++i)
          {
            values[i] = field.At(tetrahedron.Vertices[i]);
          }
          fractions += FractionInside(values, range);
        }
      }
    }
  }
  return fractions / 6.0;
}

}
