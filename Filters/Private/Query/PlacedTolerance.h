// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_PlacedTolerance_h
#define vtkIsodiamond_PlacedTolerance_h

#include "Private/Query/WorldQuery.h"

#include <algorithm>
#include <cmath>

namespace vtkIsodiamond
{

/** What a query tolerates at a place of the world. */
class PlacedTolerance
{
public:
  PlacedTolerance(
    const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world)
    : Query(query)
    , Outside(OutsideOf(query, measure, world))
  {
  }

  /** The least tolerance in a triangle or tetrahedron, or less: what moves from there by no more
   *  than that does not get to where less is tolerated. */
  double In(const isodiamond::Vector* corners, int count) const
  {
    isodiamond::Vector low = corners[0];
    isodiamond::Vector high = corners[0];
    for (int i = 1; i < count; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], corners[i][axis]);
        high[axis] = std::max(high[axis], corners[i][axis]);
      }
    }
    double tolerance = this->Query.ErrorTolerance;
    if (this->Query.Region)
    {
      const isodiamond::Box& region = *this->Query.Region;
      const double away = Between(low, high, region.Minimum, region.Maximum);
      tolerance = std::min(std::max(tolerance, away), this->Outside);
    }
    if (this->Query.View)
    {
      const isodiamond::Vector& eye = this->Query.View->Position;
      const double slope = this->Query.View->TolerancePerDistance;
      tolerance = std::max(tolerance, slope / (1.0 + slope) * Between(low, high, eye, eye));
    }
    return tolerance;
  }

private:
  /** The distance between two boxes. */
  static double Between(const isodiamond::Vector& low, const isodiamond::Vector& high,
    const isodiamond::Vector& otherLow, const isodiamond::Vector& otherHigh)
  {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double away =
        std::max({ low[axis] - otherHigh[axis], otherLow[axis] - high[axis], 0.0 });
      squared += away * away;
    }
    return std::sqrt(squared);
  }

  const WorldQuery& Query;
  double Outside;
};

}

#endif
