// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IdRange_h
#define isodiamond_IdRange_h

#include <cstddef>
#include <cstdint>

namespace isodiamond
{

/** A view of ids that are contiguous in memory. */
struct IdRange
{
  const std::uint32_t* First = nullptr;
  const std::uint32_t* Last = nullptr;

  const std::uint32_t* begin() const { return this->First; }
  const std::uint32_t* end() const { return this->Last; }
  std::size_t size() const { return static_cast<std::size_t>(this->Last - this->First); }
  bool empty() const { return this->First == this->Last; }
  std::uint32_t operator[](std::size_t i) const { return this->First[i]; }
};

}

#endif
