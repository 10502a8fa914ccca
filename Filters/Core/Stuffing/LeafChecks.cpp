// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/LeafChecks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <stdexcept>

namespace isodiamond
{
namespace
{

/** This many leaves are worth a thread. */
constexpr std::int64_t LeavesOfThread = 2048;

/** Whether two corners of a leaf, or two points of its pieces, are the same. */
bool HasPointTwice(const CutMesh& mesh, const CutMesh::Tetrahedron& leaf)
{
  std::array<std::uint32_t, 16> points{};
  auto end = points.begin();
  for (std::size_t i = 0; i < leaf.Vertices.size(); ++i)
  {
    const std::uint32_t vertex = leaf.Vertices[i];
    if (std::count(leaf.Vertices.begin(), leaf.Vertices.end(), vertex) != 1)
    {
      return true;
    }
    *end++ = mesh.Vertices[vertex].PointId;
  }
  for (const std::array<std::uint32_t, 2>& cuts : leaf.Cuts)
  {
    end = std::copy(cuts.begin(), cuts.end(), end);
  }
  end = std::remove(points.begin(), end, CutMesh::None);
  return std::any_of(points.begin(), end,
    [&](std::uint32_t point) { return std::count(points.begin(), end, point) != 1; });
}

}

void CheckLeaves(const CutMesh& mesh, const ParallelFor& parallelFor)
{
  std::atomic<bool> isDamaged = false;
  ForEachIndex(parallelFor, mesh.Tetrahedra.size(), LeavesOfThread,
    [&](std::int64_t i)
    {
      if (HasPointTwice(mesh, mesh.Tetrahedra[i]))
      {
        isDamaged = true;
      }
    });
  if (isDamaged)
  {
    throw std::invalid_argument(
      "The isodiamond hierarchy is damaged: tetrahedra have a point twice.");
  }
}

}
