// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Bounds_h
#define isodiamond_Bounds_h

#include "Field/Vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isodiamond
{

/** What something lies in, in the world or in index space: a closed box along the axes. */
struct Bounds
{
  Vector Low = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vector High = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

  void Add(const Vector& point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], point[axis]);
      this->High[axis] = std::max(this->High[axis], point[axis]);
    }
  }
  void Add(const Bounds& other) // may be empty
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = std::min(this->Low[axis], other.Low[axis]);
      this->High[axis] = std::max(this->High[axis], other.High[axis]);
    }
  }
  /** All that is no farther away along each axis. */
  Bounds Grown(double by) const
  {
    const Vector way = { by, by, by };
    return { this->Low - way, this->High + way };
  }
  /** The axis along which it is longest. */
  std::size_t LongestAxis() const
  {
    const Vector extent = this->High - this->Low;
    return std::max_element(extent.begin(), extent.end()) - extent.begin();
  }
  /** Whether another one lies in it, or touches it from inside. */
  bool Holds(const Bounds& other) const
  {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      holds = holds && this->Low[axis] <= other.Low[axis] && this->High[axis] >= other.High[axis];
    }
    return holds;
  }
  /** Whether they have a point in common. */
  bool Meets(const Bounds& other) const
  {
    // Without branches: which axis tells two apart cannot be foreseen.
    int apart = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      apart |= static_cast<int>(this->Low[axis] > other.High[axis]) |
        static_cast<int>(other.Low[axis] > this->High[axis]);
    }
    return apart == 0;
  }
};

}

#endif
