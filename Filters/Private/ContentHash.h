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

/** 128 bits that stand for the values of an array: equal for equal ones, and by no chance that
 *  matters for others. Not made against anyone who seeks collisions. */
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
