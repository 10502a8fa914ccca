// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondRegion_h
#define vtkIsodiamondRegion_h

#include "RegionOfInterest.h"

#include "vtkIndent.h"
#include "vtkSystemIncludes.h"

#include <array>

/**
 * @file vtkIsodiamondRegion.h
 * The region of interest as the filters' property: (xmin, xmax, ymin, ymax, zmin, zmax).
 */
namespace vtkIsodiamond
{

inline isodiamond::Box RegionBox(const double region[6])
{
  return { { region[0], region[2], region[4] }, { region[1], region[3], region[5] } };
}

/** Puts the lowest corner at a position. @return whether that changes the region */
inline bool MoveRegion(double region[6], const std::array<double, 3>& position)
{
  bool changed = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    double* bounds = region + 2 * axis;
    if (bounds[0] != position[axis])
    {
      bounds[1] = position[axis] + (bounds[1] - bounds[0]);
      bounds[0] = position[axis];
      changed = true;
    }
  }
  return changed;
}

/** Gives the region a size. @return whether that changes it */
inline bool ResizeRegion(double region[6], const std::array<double, 3>& size)
{
  bool changed = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    double* bounds = region + 2 * axis;
    changed = changed || bounds[1] != bounds[0] + size[axis];
    bounds[1] = bounds[0] + size[axis];
  }
  return changed;
}

inline void PrintRegion(
  ostream& os, vtkIndent indent, bool isUsed, const double region[6], double outsideTolerance)
{
  os << indent << "UseRegionOfInterest: " << (isUsed ? "On" : "Off") << "\n";
  os << indent << "RegionOfInterest:";
  for (int i = 0; i < 6; ++i)
  {
    os << " " << region[i];
  }
  os << "\n" << indent << "OutsideErrorTolerance: " << outsideTolerance << "\n";
}

}

#endif
