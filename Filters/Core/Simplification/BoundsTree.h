// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BoundsTree_h
#define isodiamond_BoundsTree_h

#include "Field/Bounds.h"
#include "Simplification/TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace isodiamond
{

inline Bounds BoundsOf(const std::vector<Vector>& positions, const Triangle& triangle)
{
  Bounds bounds;
  for (const std::uint32_t point : triangle)
  {
    bounds.Add(positions[point]);
  }
  return bounds;
}

/** Bounds of many things, by where they are: a binary tree of bounds around them. */
class BoundsTree
{
public:
  explicit BoundsTree(std::vector<Bounds> all)
    : All(std::move(all))
    , Order(this->All.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), 0U);
    if (!this->All.empty())
    {
      this->Divide(0, static_cast<std::uint32_t>(this->All.size()));
    }
  }

  /** Calls visit(number) for all that meet given ones. */
  template <typename Visit>
  void ForEachAt(const Bounds& given, Visit&& visit) const
  {
    for (std::uint32_t at = 0; at < this->Nodes.size();)
    {
      const Node& node = this->Nodes[at];
      const bool doesMeet = node.Around.Meets(given);
      for (std::uint32_t i = node.First; doesMeet && i < node.Last; ++i)
      {
        if (this->All[this->Order[i]].Meets(given))
        {
          visit(this->Order[i]);
        }
      }
      at = doesMeet ? at + 1 : node.Next;
    }
  }

private:
  static constexpr std::uint32_t MostOfLeaf = 4;

  /** The two parts of a node follow it. */
  struct Node
  {
    Bounds Around{};
    std::uint32_t First = 0; ///< of a leaf, in the order
    std::uint32_t Last = 0;
    std::uint32_t Next = 0; ///< the first node after it and all below it
  };

  /** Twice as far from the origin. */
  Vector Middle(std::uint32_t number) const
  {
    return this->All[number].Low + this->All[number].High;
  }

  void Divide(std::uint32_t first, std::uint32_t last)
  {
    const std::size_t number = this->Nodes.size();
    Node& node = this->Nodes.emplace_back();
    Bounds middles;
    for (std::uint32_t i = first; i < last; ++i)
    {
      node.Around.Add(this->All[this->Order[i]]);
      middles.Add(this->Middle(this->Order[i]));
    }
    if (last - first <= MostOfLeaf)
    {
      node.First = first;
      node.Last = last;
    }
    else
    {
      const std::uint32_t second = this->Cut(first, last, middles);
      this->Divide(first, second);
      this->Divide(second, last);
    }
    this->Nodes[number].Next = static_cast<std::uint32_t>(this->Nodes.size());
  }

  /** Puts what lies in the lower half first. @return where the rest begins; half way if all is in
   *  one half */
  std::uint32_t Cut(std::uint32_t first, std::uint32_t last, const Bounds& middles)
  {
    const std::size_t axis = middles.LongestAxis();
    const double at = middles.Low[axis] + 0.5 * (middles.High[axis] - middles.Low[axis]);
    const auto begin = this->Order.begin();
    const auto cut = std::partition(begin + first, begin + last,
      [&](std::uint32_t each) { return this->Middle(each)[axis] < at; });
    const auto second = static_cast<std::uint32_t>(cut - begin);
    return second > first && second < last ? second : first + (last - first) / 2;
  }

  std::vector<Bounds> All;
  std::vector<std::uint32_t> Order;
  std::vector<Node> Nodes;
};

/** Around all triangles of a mesh.
 *  @param reaches by triangle: how far beyond it its bounds reach; 0 if there are none */
inline BoundsTree TreeOf(const std::vector<Vector>& positions,
  const std::vector<Triangle>& triangles, const std::vector<double>& reaches = {})
{
  std::vector<Bounds> bounds;
  bounds.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    bounds.push_back(BoundsOf(positions, triangles[i]).Grown(reaches.empty() ? 0.0 : reaches[i]));
  }
  return BoundsTree(std::move(bounds));
}

}

#endif
