// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SmallPieces_h
#define isodiamond_SmallPieces_h

#include "Field/Parallel.h"

#include <array>
#include <cstdint>

/**
 * @file SmallPieces.h
 * Removes what is too small to be wanted in a surface: noise has thousands of specks around the one
 * thing that is looked for.
 *
 * A *piece* is a connected set of samples on one side of a surface: a *solid* above it, a *cavity*
 * below. Samples are connected as by the edges of the full-resolution mesh, so pieces are exactly
 * what its surface separates: p and p + d, with d in {-1, 0, 1}^3, have an edge if the coordinates
 * of p on the axes with d != 0 are all even or all odd.
 *
 * Solids of fewer samples than a minimum get the sign below, all at once; then cavities that are
 * too small by then get the sign above: samples of removed solids count with the cavity that they
 * are in. The boundary of the grid bounds pieces, too. In a grid of fewer samples than the minimum
 * no piece may stay, not even the last one: all of it lies above in the end.
 *
 * Otherwise no piece of fewer samples is left, and a second removal would find none: a cavity that
 * becomes solid has a solid next to it, and joins it. Whatever lies above a second, higher surface
 * afterwards lies above the first one, too, if both are treated alike: both steps are increasing,
 * as a larger set of samples has larger pieces. So the surfaces of an interval volume stay nested.
 *
 * Where an edge of full resolution joins samples on two sides afterwards, their values put them on
 * these sides: all neighbours of a removed solid are below with it, in one cavity, and share its
 * fate; all neighbours of a removed cavity are above.
 */
namespace isodiamond
{

/** Rows of signs along x, a bit each, set above the surface; whole words, zero beyond the row. */
struct SignRows
{
  std::uint64_t* Bits = nullptr;
  std::array<int, 3> Count{};
  std::int64_t Words = 0; ///< per row

  std::int64_t RowCount() const { return std::int64_t{ 1 } * this->Count[1] * this->Count[2]; }
};

/**
 * Removes the pieces of fewer samples than a minimum. Takes memory in proportion to the runs of
 * equal signs in rows.
 *
 * @return how many were removed, solids and cavities
 * @throws std::length_error if there are more than 2^32 - 1 runs
 */
std::int64_t RemoveSmallPieces(
  const SignRows& rows, std::int64_t minimumSize, const ParallelFor& parallelFor);

}

#endif
