// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Choice_h
#define vtkIsodiamond_Choice_h

#include "Field/Isoregion.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace vtkIsodiamond
{

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
