// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FinePlane_h
#define isodiamond_FinePlane_h

#include "Lattice.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** An isovertex in index space, in units of 1/256: exact. */
using FinePosition = std::array<std::int32_t, 3>;
inline constexpr std::int32_t FineUnits = 256;

/** A plane between lattice points, for exact tests of which side a position is on. */
class FinePlane
{
public:
  /** Through a point, spanned by two small offsets. */
  FinePlane(const Point& point, const Point& first, const Point& second)
    : Origin(FineUnits * point)
    , Normal{ std::int64_t{ 1 } * first[1] * second[2] - first[2] * second[1],
      std::int64_t{ 1 } * first[2] * second[0] - first[0] * second[2],
      std::int64_t{ 1 } * first[0] * second[1] - first[1] * second[0] }
  {
  }

  /** Positive on one side, negative on the other, 0 on the plane. */
  std::int64_t Side(const FinePosition& position) const
  {
    return this->Normal[0] * (position[0] - this->Origin[0]) +
      this->Normal[1] * (position[1] - this->Origin[1]) +
      this->Normal[2] * (position[2] - this->Origin[2]);
  }

private:
  FinePosition Origin;
  std::array<std::int64_t, 3> Normal;
};

}

#endif
