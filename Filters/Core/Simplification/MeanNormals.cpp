// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/MeanNormals.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace isodiamond
{
namespace
{

/** The areas of the triangles at each point. */
std::vector<double> AreasAround(const TriangleMesh& mesh)
{
  std::vector<double> areas(mesh.Positions.size());
  for (const Triangle& triangle : mesh.Triangles)
  {
    const double area = AreaOf(mesh.Positions, triangle);
    for (const std::uint32_t point : triangle)
    {
      areas[point] += area;
    }
  }
  return areas;
}

/** How much of a place belongs to each corner of a triangle: its barycentric coordinates, seen from
 *  above; beside the triangle, only those that are not negative. */
std::array<double, 3> SharesOf(const Vector& place, const std::array<Vector, 3>& corners)
{
  const Vector across = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  std::array<double, 3> shares;
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const Vector next = corners[(k + 1) % 3] - place;
    const Vector last = corners[(k + 2) % 3] - place;
    shares[k] = std::max(Dot(Cross(next, last), across), 0.0);
    sum += shares[k];
  }
  for (double& share : shares)
  {
    share = sum > 0.0 ? share / sum : 1.0 / 3.0;
  }
  return shares;
}

}

void TakeMeanNormals(const TriangleMesh& original, const SimplerMesh& simpler, float* normals)
{
  const std::vector<double> areas = AreasAround(original);
  const auto normalOf = [&](std::size_t point) -> Vector {
    return { normals[3 * point], normals[3 * point + 1], normals[3 * point + 2] };
  };
  std::vector<Vector> sums(areas.size());
  for (std::size_t point = 0; point < areas.size(); ++point)
  {
    const Vector part = areas[point] * normalOf(point);
    const std::uint32_t home = simpler.Homes[point];
    if (home == None)
    {
      sums[point] = sums[point] + part;
    }
    else
    {
      const std::array<double, 3> shares =
        SharesOf(original.Positions[point], simpler.Corners(home));
      for (int k = 0; k < 3; ++k)
      {
        Vector& sum = sums[simpler.Triangles[home][k]];
        sum = sum + shares[k] * part;
      }
    }
  }
  for (std::size_t point = 0; point < areas.size(); ++point)
  {
    const Vector mean = Unit(sums[point]);
    if (simpler.Homes[point] == None && Dot(mean, mean) > 0.0)
    {
      std::copy(mean.begin(), mean.end(), normals + 3 * point);
    }
  }
}

}
