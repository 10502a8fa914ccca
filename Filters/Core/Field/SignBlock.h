// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SignBlock_h
#define isodiamond_SignBlock_h

#include "Field/SignLattice.h"
#include "Lattice/DiamondSet.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** The signs of a brick and of one layer around it: what the kinds of its diamonds depend on. */
struct SignBlock
{
  std::array<std::array<SignLattice::Row, 10>, 10> Rows; ///< [z + 1][y + 1]
  /** The signs that occur: bit i for sign i. */
  std::uint32_t Signs = 0;

  SignBlock(const SignLattice& signs, int scale, const Point& origin)
  {
    std::uint32_t below = 0;
    std::uint32_t between = 0;
    std::uint32_t above = 0;
    const int top = signs.SurfaceCount() - 1;
    for (int z = 0; z < 10; ++z)
    {
      for (int y = 0; y < 10; ++y)
      {
        const SignLattice::Row row =
          signs.Load(scale, origin[0], origin[1] + y - 1, origin[2] + z - 1);
        this->Rows[z][y] = row;
        below |= row.Below(0);
        between |= row.Above[0] & row.Below(top);
        above |= row.Above[top];
      }
    }
    this->Signs =
      (below != 0 ? 1U : 0U) | (between != 0 ? 2U : 0U) | (above != 0 ? 1U << (top + 1) : 0U);
  }

  /** Whether a surface passes between any of them. */
  bool IsMixed() const { return (this->Signs & (this->Signs - 1)) != 0; }

  /** The row of a position's neighbours at an offset: bit x + 1 + offset[0] is that of x. */
  const SignLattice::Row& RowAt(int y, int z, const Point& offset) const
  {
    return this->Rows[z + 1 + offset[2]][y + 1 + offset[1]];
  }
};

/**
 * Finds something in each brick of a scale: find(index, list) appends to the list. Rows of bricks
 * are independent, each with its own list; the lists are in the order of the rows.
 */
template <typename Found, typename Find>
std::vector<std::vector<Found>> FindInRows(
  const BrickBox& box, const ParallelFor& parallelFor, const Find& find)
{
  const std::int64_t rows = std::int64_t{ 1 } * box.Count[1] * box.Count[2];
  std::vector<std::vector<Found>> found(rows);
  parallelFor(rows, 4,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t index = begin * box.Count[0]; index < end * box.Count[0]; ++index)
      {
        find(index, found[index / box.Count[0]]);
      }
    });
  return found;
}

}

#endif
