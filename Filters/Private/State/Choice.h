// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Choice_h
#define vtkIsodiamond_Choice_h

#include "Field/Isoregion.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace vtkIsodiamond
{

/** A value as people would type it: properties of ParaView's panel start at 1e-300 where it would
 *  take 0 for not given, and stay there if it knows no input, or where all processes run a script.
 */
inline double AsTyped(double value)
{
  return std::abs(value) < 1e-299 ? 0.0 : value;
}

/** What a user chose to extract: a shape, and the values of both shapes. */
struct Choice
{
  isodiamond::Shape Shape = isodiamond::Shape::Isosurface;
  double Isovalue = 0.0;
  std::array<double, 2> Isorange = { 0.0, 1.0 };

  /** The chosen part of the field. @throws std::invalid_argument saying what is wrong with it */
  isodiamond::Isoregion Region() const
  {
    if (this->Shape == isodiamond::Shape::IntervalVolume)
    {
      return { this->Isorange[0], this->Isorange[1] };
    }
    if (!std::isfinite(this->Isovalue))
    {
      throw std::invalid_argument("The isovalue is not a finite number.");
    }
    return this->Isovalue;
  }
};

}

#endif
