// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/MeshBlocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace isodiamond
{

MeshBlocks CutIntoBlocks(const TriangleMesh& mesh, double size, double shift)
{
  using Key = std::array<std::int64_t, 3>;
  std::vector<Key> keys(mesh.Triangles.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const Vector middle = (1.0 / 3.0) * (mesh.Corner(i, 0) + mesh.Corner(i, 1) + mesh.Corner(i, 2));
    for (int axis = 0; axis < 3; ++axis)
    {
      keys[i][axis] = static_cast<std::int64_t>(std::floor(middle[axis] / size + shift));
    }
  }
  MeshBlocks blocks;
  blocks.Order.resize(keys.size());
  std::iota(blocks.Order.begin(), blocks.Order.end(), 0U);
  std::sort(blocks.Order.begin(), blocks.Order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return std::tie(keys[a], a) < std::tie(keys[b], b); });
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    if (i == 0 || keys[blocks.Order[i]] != keys[blocks.Order[i - 1]])
    {
      blocks.First.push_back(i);
    }
  }
  blocks.First.push_back(keys.size());
  return blocks;
}

MeshBlocks CutInTwo(const TriangleMesh& mesh)
{
  const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
  Vector low = mesh.Middle(0);
  Vector high = low;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const Vector middle = mesh.Middle(i);
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], middle[axis]);
      high[axis] = std::max(high[axis], middle[axis]);
    }
  }
  const Vector extent = high - low;
  const auto axis = std::max_element(extent.begin(), extent.end()) - extent.begin();
  MeshBlocks halves;
  halves.Order.resize(count);
  std::iota(halves.Order.begin(), halves.Order.end(), 0U);
  const auto half = halves.Order.begin() + count / 2;
  std::nth_element(halves.Order.begin(), half, halves.Order.end(),
    [&](std::uint32_t a, std::uint32_t b)
    { return std::pair(mesh.Middle(a)[axis], a) < std::pair(mesh.Middle(b)[axis], b); });
  std::sort(halves.Order.begin(), half);
  std::sort(half, halves.Order.end());
  halves.First = { 0, count / 2, count };
  return halves;
}

AllowedMesh TakeBlock(const AllowedMesh& mesh, const MeshBlocks& blocks, std::size_t number,
  std::vector<std::uint32_t>& points)
{
  const auto begin = blocks.Order.begin() + static_cast<std::ptrdiff_t>(blocks.First[number]);
  const auto end = blocks.Order.begin() + static_cast<std::ptrdiff_t>(blocks.First[number + 1]);
  for (auto i = begin; i != end; ++i)
  {
    const Triangle& triangle = mesh.Mesh.Triangles[*i];
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  AllowedMesh block;
  for (const std::uint32_t point : points)
  {
    block.Mesh.Positions.push_back(mesh.Mesh.Positions[point]);
  }
  for (auto i = begin; i != end; ++i)
  {
    Triangle triangle = mesh.Mesh.Triangles[*i];
    for (std::uint32_t& point : triangle)
    {
      point = static_cast<std::uint32_t>(
        std::lower_bound(points.begin(), points.end(), point) - points.begin());
    }
    block.Mesh.Triangles.push_back(triangle);
    block.Allowances.push_back(mesh.Allowances[*i]);
  }
  return block;
}

}
