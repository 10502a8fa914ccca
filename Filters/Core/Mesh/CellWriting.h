// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CellWriting_h
#define isodiamond_CellWriting_h

#include "Mesh/ExtractionPasses.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/**
 * @file CellWriting.h
 * Writes some cells of a mesh as if there were no others: a process that provides a share of a mesh
 * makes only that share.
 */
namespace isodiamond
{

/**
 * Has each brick write its cells where they belong, in parallel. Bricks without cells in the range
 * are left out.
 *
 * @param range of the mesh's cells
 * @param connectivity receives the point ids, Size for each cell of the range
 * @param levels receives one for each cell of the range
 * @param writeBrick (brick, ids, levels): writes all cells of a brick
 */
template <int Size, typename Id, typename WriteBrick>
void WriteCellsOf(const ExtractionPasses& passes, const CellRange& range, Id* connectivity,
  std::int16_t* levels, WriteBrick&& writeBrick)
{
  passes.ForEachBrickWithCells(range,
    [&](std::int64_t brick, const CellRange& own)
    {
      const CellRange common = { std::max(own.First, range.First), std::min(own.Last, range.Last) };
      Id* const ids = connectivity + Size * (common.First - range.First);
      std::int16_t* const ownLevels = levels + (common.First - range.First);
      if (common.Count() == own.Count())
      {
        writeBrick(brick, ids, ownLevels);
        return;
      }
      // The range begins or ends within the brick, which can only write all its cells at once.
      std::vector<Id> allIds(Size * own.Count());
      std::vector<std::int16_t> allLevels(own.Count());
      writeBrick(brick, allIds.data(), allLevels.data());
      const std::int64_t skipped = common.First - own.First;
      std::copy_n(allIds.begin() + Size * skipped, Size * common.Count(), ids);
      std::copy_n(allLevels.begin() + skipped, common.Count(), ownLevels);
    });
}

}

#endif
