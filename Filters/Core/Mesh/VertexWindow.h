// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_VertexWindow_h
#define isodiamond_VertexWindow_h

#include "Mesh/ExtractionPasses.h"

#include <array>
#include <cassert>

namespace isodiamond
{

/**
 * The points that belong to all vertices of a brick's diamonds: a dense array of the 10 x 10 x 10
 * lattice points in and next to the brick.
 *
 * Every lattice point is the centre of one diamond; where its position is even on all axes, of one
 * of a coarser scale. So the points on any edge, or at any vertex, of the brick's leaves are found
 * at a fixed distance in the array from the leaf's parent, whatever their owner's scale. Where a
 * lattice point has no refined diamond, there are no points; leaves ask for such points only if a
 * file is damaged.
 */
class VertexWindow
{
public:
  VertexWindow(const ExtractionPasses& passes, std::int64_t brick);

  /** The points of the diamond at a position of the brick; those of other vertices are at a
   *  Distance() from there. */
  const DiamondPoints* At(const Point& position) const
  {
    const int index = this->IndexAt(position);
    assert(this->Holds(index));
    return &this->Points[index];
  }

  /** @param offset of a vertex from a diamond's position */
  static constexpr int Distance(const Point& offset)
  {
    return offset[0] + Width * (offset[1] + Width * offset[2]);
  }

private:
  static constexpr int Width = 10;

  /** Valid for the start of a row, too, which may lie before the window. */
  int IndexAt(const Point& position) const { return Distance(position) - Distance(this->First); }
  static bool Holds(int index) { return index >= 0 && index < Width * Width * Width; }
  void Fill(const ExtractionPasses& passes, int scale, int step);

  Point First; ///< the first position
  std::array<DiamondPoints, Width * Width * Width> Points{};
};

}

#endif
