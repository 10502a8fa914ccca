// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TetrahedronGeneration_h
#define isodiamond_TetrahedronGeneration_h

#include "Lattice/DiamondTetrahedra.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** A tetrahedron with its items, isovertices or parts of clusters, and the diamond that it lies
 *  in. */
struct Holder
{
  HalfPlace Tetrahedron;
  Place Diamond;
  std::uint32_t Rank = 0; ///< of the diamond
  std::size_t Begin = 0;  ///< its items in the generation's
  std::size_t End = 0;
};

/** Tetrahedra of one generation. */
template <typename Item>
struct Generation
{
  std::vector<Holder> Holders;
  std::vector<Item> Items; ///< the first Count; memory that was used once is kept
  std::size_t Count = 0;
  std::vector<std::uint64_t> Order; ///< rank of the diamond, then index of the holder in 32 bits

  /** Makes an order in which the tetrahedra of each diamond are together. */
  void SortByDiamond()
  {
    this->Order.clear();
    for (std::size_t i = 0; i < this->Holders.size(); ++i)
    {
      this->Order.push_back(std::uint64_t{ this->Holders[i].Rank } << 32 | i);
    }
    std::sort(this->Order.begin(), this->Order.end());
  }
  const Holder& At(std::size_t inOrder) const
  {
    return this->Holders[this->Order[inOrder] & 0xffffffffU];
  }

  /** Room for some more items. */
  Item* Room(std::size_t more)
  {
    if (this->Count + more > this->Items.size())
    {
      this->Items.resize(std::max(this->Count + more, 2 * this->Items.size()));
    }
    return this->Items.data() + this->Count;
  }
  void Add(const Item& item)
  {
    *this->Room(1) = item;
    ++this->Count;
  }
  void Clear()
  {
    this->Holders.clear();
    this->Count = 0;
  }
};

}

#endif
