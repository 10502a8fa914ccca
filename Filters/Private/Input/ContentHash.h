// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_ContentHash_h
#define vtkIsodiamond_ContentHash_h

#include "vtkDataArray.h"
#include "vtkWeakPointer.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkDataSet;

namespace vtkIsodiamond
{

/**
 * 128 bits that stand for an array: XXH3 of its blocks, and of their hashes together with its type,
 * components and size. Equal arrays have equal hashes. That others differ rests on XXH3 spreading
 * as evenly as chance, which is tested but not proven: two arrays then collide with a probability
 * of about 2^-127, some two of a million with 2^-88. Not secure against deliberate collisions.
 */
using ContentHash = std::array<std::uint64_t, 2>;

/** The hash of an array's type, components and values; all 0 without an array. Runs in the calling
 *  thread's vtkSMPTools scope. */
ContentHash HashOf(vtkDataArray* array);

/** Hashes of arrays, each made once for as long as the array lives unmodified. */
class ContentHashes
{
public:
  /** @param grid that the array belongs to: who writes into an array may only mark its grid as
   *  modified, and a source that fills the same one again marks neither, but updates the grid */
  ContentHash Of(vtkDataArray* array, vtkDataSet* grid);

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
