// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/SelfIntersections.h"

#include "Simplification/TriangleIntersection.h"

namespace isodiamond
{
namespace
{

BoundsTree TreeOf(const std::vector<Vector>& positions, const std::vector<Triangle>& triangles)
{
  std::vector<Bounds> bounds;
  bounds.reserve(triangles.size());
  for (const Triangle& triangle : triangles)
  {
    bounds.push_back(BoundsOf(positions, triangle));
  }
  return BoundsTree(std::move(bounds));
}

}

SelfIntersections::SelfIntersections(const MeshPart& part)
  : Part(part)
  , Others(TreeOf(part.Positions, part.Others))
{
}

std::vector<SelfIntersections::Pair> SelfIntersections::Find(
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
  std::vector<Pair> found;
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

}
