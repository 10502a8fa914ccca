// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_PlacedTolerance_h
#define vtkIsodiamond_PlacedTolerance_h

#include "Private/WorldQuery.h"

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

  /** The least tolerance in a triangle or tetrahedron, or less. */
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
      bool touches = true;
      for (int axis = 0; axis < 3; ++axis)
      {
        touches = touches && low[axis] <= this->Query.Region->Maximum[axis] &&
          high[axis] >= this->Query.Region->Minimum[axis];
      }
      tolerance = touches ? std::min(tolerance, this->Outside) : this->Outside;
    }
    if (this->Query.View)
    {
      const isodiamond::Vector& eye = this->Query.View->Position;
      double squared = 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double away = std::max({ low[axis] - eye[axis], eye[axis] - high[axis], 0.0 });
        squared += away * away;
      }
      tolerance = std::max(tolerance, this->Query.View->TolerancePerDistance * std::sqrt(squared));
    }
    return tolerance;
  }

private:
  const WorldQuery& Query;
  double Outside;
};

}

#endif
