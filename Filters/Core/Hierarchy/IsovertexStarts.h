// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsovertexStarts_h
#define isodiamond_IsovertexStarts_h

#include "Lattice/DiamondTables.h"

#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

namespace isodiamond
{

/**
 * How many isovertices come before those of each diamond, by rank, in 1.5 bytes a diamond: the
 * number before every eighth diamond, and for each how many of its eight come before it.
 */
class IsovertexStarts
{
public:
  void Reserve(std::int64_t diamonds)
  {
    this->BeforeEight.reserve((diamonds + Eight - 1) / Eight);
    this->InEight.reserve(diamonds);
  }

  /** Adds the next diamond. Starts are right while there are fewer than 2^32 isovertices; Total()
   *  always is. @param isovertices that it has */
  void Append(int isovertices)
  {
    if (this->InEight.size() % Eight == 0)
    {
      this->BeforeEight.push_back(static_cast<std::uint32_t>(this->Sum));
    }
    this->InEight.push_back(static_cast<std::uint8_t>(this->Sum - this->BeforeEight.back()));
    this->Sum += isovertices;
  }

  std::int64_t operator[](std::int64_t rank) const
  {
    assert(rank >= 0 && rank < static_cast<std::int64_t>(this->InEight.size()));
    return std::int64_t{ this->BeforeEight[rank / Eight] } + this->InEight[rank];
  }

  /** The isovertices of all diamonds. */
  std::int64_t Total() const { return this->Sum; }

  std::int64_t Bytes() const
  {
    return static_cast<std::int64_t>(4 * this->BeforeEight.size() + this->InEight.size());
  }

private:
  static constexpr int Eight = 8;
  static_assert((Eight - 1) * 2 * MaximumVertices <= std::numeric_limits<std::uint8_t>::max(),
    "what seven diamonds have on both surfaces fits");

  std::vector<std::uint32_t> BeforeEight;
  std::vector<std::uint8_t> InEight;
  std::int64_t Sum = 0;
};

}

#endif
