// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/MeshBlocks.h"

#include "Simplification/BoundsTree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

/** Triangles by their middles. */
class Cuts
{
public:
  Cuts(const std::vector<Vector>& middles, std::size_t most, double part)
    : Middles(middles)
    , Most(most)
    , Part(part)
  {
    this->Blocks.Order.resize(middles.size());
    std::iota(this->Blocks.Order.begin(), this->Blocks.Order.end(), 0U);
  }

  MeshBlocks Run()
  {
    this->Cut(0, this->Middles.size());
    this->Blocks.First.push_back(this->Middles.size());
    return std::move(this->Blocks);
  }

private:
  void Cut(std::size_t first, std::size_t last)
  {
    const auto begin = this->Blocks.Order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = this->Blocks.Order.begin() + static_cast<std::ptrdiff_t>(last);
    if (last - first <= this->Most)
    {
      std::sort(begin, end);
      this->Blocks.First.push_back(first);
      return;
    }
    const std::size_t axis = this->LongestAxis(begin, end);
    const std::size_t middle =
      std::clamp(first + static_cast<std::size_t>(this->Part * static_cast<double>(last - first)),
        first + 1, last - 1);
    std::nth_element(begin, this->Blocks.Order.begin() + static_cast<std::ptrdiff_t>(middle), end,
      [&](std::uint32_t a, std::uint32_t b)
      { return std::pair(this->Middles[a][axis], a) < std::pair(this->Middles[b][axis], b); });
    this->Cut(first, middle);
    this->Cut(middle, last);
  }

  template <typename Iterator>
  std::size_t LongestAxis(Iterator begin, Iterator end) const
  {
    Bounds bounds;
    std::for_each(begin, end, [&](std::uint32_t triangle) { bounds.Add(this->Middles[triangle]); });
    return bounds.LongestAxis();
  }

  const std::vector<Vector>& Middles;
  std::size_t Most;
  double Part;
  MeshBlocks Blocks;
};

}

MeshBlocks CutIntoBlocks(const std::vector<Vector>& middles, std::size_t most, double part)
{
  return Cuts(middles, most, part).Run();
}

}
