// SPDX-License-Identifier: BSD-3-Clause
#include "Field/SystemMemory.h"

#include <cstdint>
#ifdef __linux__
#include <sys/mman.h>
#endif
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace isodiamond
{

void PreferLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  constexpr std::size_t page = std::size_t{ 1 } << 21;
  const std::size_t toFirst = (page - reinterpret_cast<std::uintptr_t>(memory) % page) % page;
  if (bytes >= toFirst + page)
  {
    // Advice only: if it is not taken, nothing is lost.
    madvise(static_cast<char*>(memory) + toFirst, (bytes - toFirst) / page * page, MADV_HUGEPAGE);
  }
#endif
}

void ReturnFreeMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}
