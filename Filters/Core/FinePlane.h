// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FinePlane_h
#define isodiamond_FinePlane_h

#include "Lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** An isovertex in index space, in units of 1/256: exact. */
using FinePosition = std::array<std::int32_t, 3>;
inline constexpr std::int32_t FineUnits = 256;

/** A box of fine positions; empty until one is added. */
struct FineBox
{
  FinePosition Low = { INT32_MAX, INT32_MAX, INT32_MAX };
  FinePosition High = { INT32_MIN, INT32_MIN, INT32_MIN };

  void Add(const FinePosition& position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], position[axis]);
      this->High[axis] = std::max(this->High[axis], position[axis]);
    }
  }
};

/** A plane between lattice points, for exact tests of which side a position is on. */
class FinePlane
{
public:
  FinePlane() = default;

  /** Through a point, spanned by two small offsets. */
  FinePlane(const Point& point, const Point& first, const Point& second)
    : Origin(FineUnits * point)
    , Normal{ std::int64_t{ 1 } * first[1] * second[2] - first[2] * second[1],
      std::int64_t{ 1 } * first[2] * second[0] - first[0] * second[2],
      std::int64_t{ 1 } * first[0] * second[1] - first[1] * second[0] }
  {
  }

  /** Turns its positive side to a lattice point that is not on it. */
  void TurnTo(const Point& point)
  {
    if (this->Side(FineUnits * point) < 0)
    {
      this->Normal = { -this->Normal[0], -this->Normal[1], -this->Normal[2] };
    }
  }

  /** Positive on one side, negative on the other, 0 on the plane. */
  std::int64_t Side(const FinePosition& position) const
  {
    return this->Normal[0] * (position[0] - this->Origin[0]) +
      this->Normal[1] * (position[1] - this->Origin[1]) +
      this->Normal[2] * (position[2] - this->Origin[2]);
  }

  /** The least and the greatest Side() in a box. */
  std::array<std::int64_t, 2> Sides(const FineBox& box) const
  {
    std::array<std::int64_t, 2> sides{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t a = this->Normal[axis] * (box.Low[axis] - this->Origin[axis]);
      const std::int64_t b = this->Normal[axis] * (box.High[axis] - this->Origin[axis]);
      sides[0] += std::min(a, b);
      sides[1] += std::max(a, b);
    }
    return sides;
  }

private:
  FinePosition Origin{};
  std::array<std::int64_t, 3> Normal{};
};

}

#endif
