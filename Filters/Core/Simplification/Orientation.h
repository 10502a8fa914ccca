// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Orientation_h
#define isodiamond_Orientation_h

#include "Field/Vector.h"

#include <array>

namespace isodiamond
{

/** A place in a plane. */
using PlanePoint = std::array<double, 2>;

///@{
/**
 * The sign of the determinant of a - c and b - c, or of a - d, b - d and c - d: 0 if all points are
 * on one line, or in one plane. Exact, as long as no product of two or three coordinates overflows
 * or underflows: what rounding leaves open is computed without it (Shewchuk, Discrete &
 * Computational Geometry 1997).
 */
int Orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);
int Orientation(const Vector& a, const Vector& b, const Vector& c, const Vector& d);
///@}

}

#endif
