// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_ContentHash_h
#define vtkIsodiamond_ContentHash_h

#include "vtkDataArray.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vtkIsodiamond
{

/**
 * 128 bits that stand for an array: XXH3 of its blocks, and of their hashes together with its type,
 * components and size. Equal arrays have equal ones. That others differ rests on XXH3 spreading as
 * evenly as chance, which is tested and not proven: two arrays then collide with a probability of
 * about 2^-127, any two of a million with 2^-88. Not made against anyone who seeks collisions.
 */
using ContentHash = std::array<std::uint64_t, 2>;

/** Of an array's type, components and values; all 0 without one. Runs in the calling thread's
 *  vtkSMPTools scope. */
ContentHash HashOf(vtkDataArray* array);

/** Hashes of arrays, made once for each while it lives and is not modified. */
class ContentHashes
{
public:
  ContentHash Of(vtkDataArray* array);

private:
  struct Known
  {
    vtkWeakPointer<vtkDataArray> Array;
    vtkMTimeType Time = 0;
    ContentHash Hash{};
  };
  std::vector<Known> All;
};

}

#endif
