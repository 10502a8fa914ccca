// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SelfIntersections.h"

#include "Simplification/TriangleIntersection.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace isodiamond
{
std::vector<IntersectingPair> IntersectionsOf(const std::vector<Vector>& positions,
  const std::vector<Triangle>& triangles, const ParallelFor& parallelFor)
{
  const BoundsTree tree = TreeOf(positions, triangles);
  constexpr std::size_t groupSize = 4096; // is worth a thread
  std::vector<std::vector<IntersectingPair>> found(triangles.size() / groupSize + 1);
  const auto look = [&](std::uint32_t i)
  {
    tree.ForEachAt(BoundsOf(positions, triangles[i]),
      [&](std::uint32_t other)
      {
        if (other < i && Intersect(positions, triangles[i], triangles[other]))
        {
          found[i / groupSize].emplace_back(i, other);
        }
      });
  };
  ForEachIndex(parallelFor, found.size(), 1,
    [&](std::size_t group)
    {
      const std::size_t end = std::min(triangles.size(), (group + 1) * groupSize);
      for (std::size_t i = group * groupSize; i < end; ++i)
      {
        look(static_cast<std::uint32_t>(i));
      }
    });
  std::vector<IntersectingPair> all;
  for (const std::vector<IntersectingPair>& some : found)
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

SelfIntersections::SelfIntersections(const MeshPart& part)
  : Part(part)
  , Others(TreeOf(part.Positions, part.Others))
{
}

std::vector<IntersectingPair> SelfIntersections::Find(
  const LinkedTriangles& simple, const std::vector<bool>& isTouched) const
{
  const std::vector<Vector>& positions = this->Part.Positions;
  std::vector<std::uint32_t> touched;
  std::vector<Triangle> triangles; // of these
  std::vector<bool> isNew;         // by number: not what it was at the start
  for (std::uint32_t number = 0; number < simple.Triangles.size(); ++number)
  {
    const Triangle& triangle = simple.Triangles[number];
    isNew.push_back(
      simple.IsThere(number) && !AreSame(triangle, this->Part.Simple.Triangles[number]));
    if (isTouched[number] && simple.IsThere(number))
    {
      touched.push_back(number);
      triangles.push_back(triangle);
    }
  }
  const BoundsTree tree = TreeOf(positions, triangles);
  std::vector<IntersectingPair> found;
  for (std::uint32_t number = 0; number < simple.Triangles.size() && !touched.empty(); ++number)
  {
    if (!simple.IsThere(number))
    {
      continue;
    }
    const Triangle& triangle = simple.Triangles[number];
    const Bounds bounds = BoundsOf(positions, triangle);
    tree.ForEachAt(bounds,
      [&](std::uint32_t i)
      {
        const std::uint32_t other = touched[i];
        const bool isInTurn = other < number || !isTouched[number]; // each pair once
        if (isInTurn && (isNew[number] || isNew[other]) &&
          Intersect(positions, triangle, triangles[i]))
        {
          found.emplace_back(number, other);
        }
      });
    if (isNew[number] && isTouched[number])
    {
      this->Others.ForEachAt(bounds,
        [&](std::uint32_t i)
        {
          if (Intersect(positions, triangle, this->Part.Others[i]))
          {
            found.emplace_back(number, None);
          }
        });
    }
  }
  return found;
}

void SelfIntersections::Undo(EdgeCollapses& collapses, std::vector<bool>& isTouched) const
{
  std::vector<bool> isTouchedLast = isTouched;
  for (;;)
  {
    std::vector<std::uint32_t> lastChanged;
    for (const auto& [a, b] : this->Find(collapses.Mesh(), isTouchedLast))
    {
      lastChanged.push_back(collapses.LastChangedOf(a, b));
    }
    if (lastChanged.empty())
    {
      return;
    }
    isTouchedLast = collapses.Undo(lastChanged, {});
    if (std::find(isTouchedLast.begin(), isTouchedLast.end(), true) == isTouchedLast.end())
    {
      throw std::logic_error("Triangles intersect, but are as they were.");
    }
    std::transform(isTouched.begin(), isTouched.end(), isTouchedLast.begin(), isTouched.begin(),
      std::logical_or<>());
  }
}

}
