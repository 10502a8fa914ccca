// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CellCounts_h
#define isodiamond_CellCounts_h

#include "Refinement/RefinedSet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace isodiamond
{

/** The number of triangles, or tetrahedra, in the mesh of a refined set. */
std::int64_t CountCells(const RefinedSet& refined, const ParallelFor& parallelFor);

/**
 * How many triangles, or tetrahedra, the mesh of a hierarchy has at every uniform tolerance, from
 * one pass over the stored diamonds.
 *
 * A half-tetrahedron is in the mesh while the diamond that it halves is refined and its child is
 * not: at all tolerances from the child's threshold up to, but not including, the parent's. So each
 * one adds its cells to an interval of codes, and there are only 2^14 codes.
 */
class CellCounts
{
public:
  /** @param interiorTolerance of the queries, as Query has it */
  CellCounts(const IsodiamondHierarchy& hierarchy, const ParallelFor& parallelFor,
    double interiorTolerance = HUGE_VAL);

  /** The number of cells at a tolerance, including those in hidden cells of the grid. */
  std::int64_t At(double tolerance) const
  {
    const auto after =
      std::upper_bound(this->Counts.begin(), this->Counts.end(), this->Code.Accepted(tolerance),
        [](int code, const CountFrom& count) { return code < count.Code; });
    return after != this->Counts.begin() ? std::prev(after)->Cells : 0;
  }

  /** The codes of the tolerances; the number may change from one to the next. */
  const ErrorCode& Codes() const { return this->Code; }

  /** The memory that this takes. */
  std::int64_t Bytes() const
  {
    return static_cast<std::int64_t>(this->Counts.capacity() * sizeof(CountFrom));
  }

private:
  /** The number of cells from an accepted code on, up to the next one. */
  struct CountFrom
  {
    int Code;
    std::int64_t Cells;
  };

  ErrorCode Code;
  std::vector<CountFrom> Counts; ///< ascending; before the first one there are no cells
};

}

#endif
