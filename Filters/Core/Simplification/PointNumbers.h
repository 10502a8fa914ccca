// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PointNumbers_h
#define isodiamond_PointNumbers_h

#include "Simplification/TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** The points that some triangles of a mesh use, ascending, and the number of each among them. */
class PointNumbers
{
public:
  /** @param forEach calls its argument for each of the triangles */
  template <typename ForEach>
  explicit PointNumbers(const ForEach& forEach)
  {
    std::uint32_t last = 0;
    this->First = None;
    forEach(
      [&](const Triangle& triangle)
      {
        const auto [low, high] = std::minmax_element(triangle.begin(), triangle.end());
        this->First = std::min(this->First, *low);
        last = std::max(last, *high);
      });
    this->Numbers.assign(this->First == None ? 0 : last - this->First + 1, None);
    forEach(
      [&](const Triangle& triangle)
      {
        for (const std::uint32_t point : triangle)
        {
          this->Numbers[point - this->First] = 0;
        }
      });
    for (std::uint32_t i = 0; i < this->Numbers.size(); ++i)
    {
      if (this->Numbers[i] != None)
      {
        this->Numbers[i] = static_cast<std::uint32_t>(this->Used.size());
        this->Used.push_back(this->First + i);
      }
    }
  }

  const std::vector<std::uint32_t>& Points() const { return this->Used; }

  bool Has(std::uint32_t point) const
  {
    return point >= this->First && point - this->First < this->Numbers.size() &&
      this->Numbers[point - this->First] != None;
  }

  /** A triangle by the numbers of its points. */
  Triangle Of(const Triangle& triangle) const
  {
    return { this->Numbers[triangle[0] - this->First], this->Numbers[triangle[1] - this->First],
      this->Numbers[triangle[2] - this->First] };
  }

private:
  std::uint32_t First = 0;
  std::vector<std::uint32_t> Numbers; ///< of points from the first one on; None for others
  std::vector<std::uint32_t> Used;
};

}

#endif
