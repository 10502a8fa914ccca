// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Vector_h
#define isodiamond_Vector_h

#include <array>

namespace isodiamond
{

constexpr double DegreesOfRadian = 57.29577951308232;

/** A vector or position of real coordinates. */
using Vector = std::array<double, 3>;

inline Vector operator+(const Vector& a, const Vector& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}
inline Vector operator-(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}
inline Vector operator*(double factor, const Vector& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}
inline Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}
inline double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Six times the volume of a tetrahedron. */
inline double SixVolumes(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  return Dot(Cross(b - a, c - a), d - a);
}

}

#endif
