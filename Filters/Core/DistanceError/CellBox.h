// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CellBox_h
#define isodiamond_CellBox_h

#include "Lattice/Lattice.h"

#include <cstdint>

namespace isodiamond
{

/** Cells, each of eight samples, from a first one to just before a last one. */
struct CellBox
{
  Point Low{};
  Point High{};

  bool Holds(const Point& cell) const
  {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      holds = holds && cell[axis] >= this->Low[axis] && cell[axis] < this->High[axis];
    }
    return holds;
  }
  bool Holds(const CellBox& box) const
  {
    return this->Holds(box.Low) && this->Holds(box.High + Point{ -1, -1, -1 });
  }
  std::int64_t Size() const
  {
    const Point size = this->High + -1 * this->Low;
    return std::int64_t{ size[0] } * size[1] * size[2];
  }
};

}

#endif
