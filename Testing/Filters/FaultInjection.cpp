// SPDX-License-Identifier: BSD-3-Clause
#include "FaultInjection.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string_view>

#include <execinfo.h>
#include <link.h>

// glibc's own malloc and realloc.
extern "C"
{
  void* __libc_malloc(std::size_t size);                // NOLINT
  void* __libc_realloc(void* memory, std::size_t size); // NOLINT
}

namespace test
{

Fault OfNew;
Fault OfMalloc;

}

using test::OfMalloc;
using test::OfNew;

namespace
{

/** The code of a program or library in memory. */
struct Code
{
  std::uintptr_t Begin = 0;
  std::uintptr_t End = 0;

  bool Holds(const void* address) const
  {
    const auto value = reinterpret_cast<std::uintptr_t>(address);
    return this->Begin <= value && value < this->End;
  }
};

/** Tells calls by the filters from those by VTK. */
class Callers
{
public:
  Callers()
  {
    dl_iterate_phdr(&Callers::Visit, this);
    void* frame = nullptr;
    backtrace(&frame, 1); // its first call allocates
  }

  bool AreKnown() const { return this->Filters.Begin != 0 && this->Program.Begin != 0; }

  /** Whether the filters are calling. An instance of a template may lie in their library and yet be
   *  called by VTK, as the linker keeps one of several: so this looks at more than one caller. */
  bool AreFilters() const
  {
    constexpr int deep = 3;
    std::array<void*, deep + 4> frames{};
    const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
    int at = 0;
    while (at < count && this->Program.Holds(frames[at])) // operator new
    {
      ++at;
    }
    if (at + deep > count || !this->Filters.Holds(frames[at]))
    {
      return false;
    }
    return std::all_of(frames.begin() + at, frames.begin() + at + deep,
      [this](void* frame) { return this->Filters.Holds(frame) || this->Program.Holds(frame); });
  }

private:
  static int Visit(dl_phdr_info* library, std::size_t /*size*/, void* data)
  {
    auto* self = static_cast<Callers*>(data);
    const std::string_view name = library->dlpi_name;
    Code code;
    for (int i = 0; i < library->dlpi_phnum; ++i)
    {
      const auto& segment = library->dlpi_phdr[i];
      if (segment.p_type == PT_LOAD && (segment.p_flags & PF_X) != 0)
      {
        code.Begin = library->dlpi_addr + segment.p_vaddr;
        code.End = code.Begin + segment.p_memsz;
      }
    }
    if (name.find("IsodiamondFilters") != std::string_view::npos)
    {
      self->Filters = code;
    }
    else if (name.empty() && self->Program.Begin == 0) // the program comes first
    {
      self->Program = code;
    }
    return 0;
  }

  Code Filters;
  Code Program;
};
const Callers TheCallers;

constexpr std::size_t ManyBytes = 1000;

void* AllocateOrNull(std::size_t size, std::size_t alignment)
{
  if (OfNew.IsArmed() && TheCallers.AreFilters() && OfNew.FailsNext())
  {
    return nullptr;
  }
  size = size > 0 ? size : 1;
  if (alignment <= alignof(std::max_align_t))
  {
    return __libc_malloc(size);
  }
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* AllocateOrThrow(std::size_t size, std::size_t alignment)
{
  void* memory = AllocateOrNull(size, alignment);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

constexpr std::size_t Usual = alignof(std::max_align_t);

}

// VTK's arrays use these. The rest of the family need not be replaced, as the heap is the same.
extern "C"
{
  void* malloc(std::size_t size)
  {
    return size >= ManyBytes && OfMalloc.FailsNext() ? nullptr : __libc_malloc(size);
  }

  void* realloc(void* memory, std::size_t size)
  {
    return size >= ManyBytes && OfMalloc.FailsNext() ? nullptr : __libc_realloc(memory, size);
  }
}

void* operator new(std::size_t size)
{
  return AllocateOrThrow(size, Usual);
}
void* operator new[](std::size_t size)
{
  return AllocateOrThrow(size, Usual);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return AllocateOrThrow(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment)
{
  return AllocateOrThrow(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  return AllocateOrNull(size, Usual);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept
{
  return AllocateOrNull(size, Usual);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
  return AllocateOrNull(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
  return AllocateOrNull(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete[](void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

bool test::KnowsFilters()
{
  return TheCallers.AreKnown();
}
