// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ExactPlane_h
#define isodiamond_ExactPlane_h

#include "Lattice/Lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace isodiamond
{

/** An isovertex in index space, in units of 1/256: exact. */
using FinePosition = std::array<std::int32_t, 3>;
inline constexpr std::int32_t FineUnits = 256;

/** A box around fine positions; empty until one is added. */
struct FineBox
{
  FinePosition Low = { INT32_MAX, INT32_MAX, INT32_MAX };
  FinePosition High = { INT32_MIN, INT32_MIN, INT32_MIN };

  bool IsEmpty() const { return this->Low[0] > this->High[0]; }
  void Add(const FinePosition& position)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], position[axis]);
      this->High[axis] = std::max(this->High[axis], position[axis]);
    }
  }
};

/**
 * A plane between lattice points, for exact tests of which side a position is on.
 *
 * Numbers of 32 bits suffice: coordinates are at most 2^28 (a grid's depth is at most 20), those of
 * a normal, the product of two offsets of lattice steps, no more than 4 in sum.
 */
class ExactPlane
{
public:
  ExactPlane() = default;

  /** Through a point, spanned by two small offsets. */
  ExactPlane(const Point& point, const Point& first, const Point& second)
    : Origin(FineUnits * point)
    , Normal{ first[1] * second[2] - first[2] * second[1],
      first[2] * second[0] - first[0] * second[2], first[0] * second[1] - first[1] * second[0] }
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

  /** A point on it, and its normal, which may have any length. */
  const FinePosition& Start() const { return this->Origin; }
  const std::array<std::int32_t, 3>& Across() const { return this->Normal; }

  /** Positive on one side, negative on the other, 0 on the plane. */
  std::int32_t Side(const FinePosition& position) const
  {
    return this->Normal[0] * (position[0] - this->Origin[0]) +
      this->Normal[1] * (position[1] - this->Origin[1]) +
      this->Normal[2] * (position[2] - this->Origin[2]);
  }

  /** The least and the greatest Side() in a box. */
  std::array<std::int32_t, 2> Sides(const FineBox& box) const
  {
    std::array<std::int32_t, 2> sides{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int32_t a = this->Normal[axis] * (box.Low[axis] - this->Origin[axis]);
      const std::int32_t b = this->Normal[axis] * (box.High[axis] - this->Origin[axis]);
      sides[0] += std::min(a, b);
      sides[1] += std::max(a, b);
    }
    return sides;
  }

private:
  FinePosition Origin{};
  std::array<std::int32_t, 3> Normal{};
};

}

#endif
