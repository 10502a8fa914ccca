// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SystemMemory_h
#define isodiamond_SystemMemory_h

#include <cstddef>
#include <memory>
#include <type_traits>

namespace isodiamond
{

/** Tells the system that all of some fresh memory is going to be used, so that it hands out large
 *  pages if it has them: zeroing memory page by page takes longer than making a mesh in it. */
void PreferLargePages(void* memory, std::size_t bytes);

/** An array whose values are arbitrary until written: the system hands out each part when it is
 *  first written, to each thread its own. */
template <typename T>
class LargeArray
{
public:
  static_assert(std::is_trivial_v<T>);

  LargeArray() = default;
  /** @throws std::bad_alloc */
  explicit LargeArray(std::size_t size)
    : Values(new T[size])
  {
    PreferLargePages(this->Values.get(), size * sizeof(T));
  }

  T& operator[](std::size_t index) { return this->Values[index]; }
  const T& operator[](std::size_t index) const { return this->Values[index]; }

private:
  std::unique_ptr<T[]> Values;
};

/** Gives back to the system what has been freed: after a build that is as much as is left of it. */
void ReturnFreeMemory();

}

#endif
