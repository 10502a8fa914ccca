// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_NearLists_h
#define isodiamond_NearLists_h

#include "Simplification/IdRange.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** For each triangle of a mesh, those of a simpler one that its pieces were found to be near. */
class NearLists
{
public:
  /** Empty ones. */
  explicit NearLists(std::size_t count)
    : Ranges(count)
  {
  }

  std::size_t Count() const { return this->Ranges.size(); }

  IdRange operator[](std::size_t triangle) const
  {
    const std::uint32_t* const first = this->Items.data() + this->Ranges[triangle].First;
    return { first, first + this->Ranges[triangle].Count };
  }

  /** Begins a new list, to which the items that follow belong. */
  void Begin(std::size_t triangle) { this->Ranges[triangle] = { this->Items.size(), 0 }; }
  void Add(std::size_t triangle, std::uint32_t near)
  {
    this->Items.push_back(near);
    ++this->Ranges[triangle].Count;
  }

private:
  struct Range
  {
    std::size_t First = 0;
    std::size_t Count = 0;
  };
  std::vector<Range> Ranges;
  std::vector<std::uint32_t> Items;
};

}

#endif
