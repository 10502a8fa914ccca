// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Quadric_h
#define isodiamond_Quadric_h

#include "Field/Vector.h"

#include <array>

namespace isodiamond
{

/** The weighted sum of squared distances from planes, as a function of position (Garland and
 *  Heckbert, SIGGRAPH 1997). */
class Quadric
{
public:
  Quadric() = default;

  /** @param normal of unit length */
  Quadric(const Vector& point, const Vector& normal, double weight)
    : Squares{ weight * normal[0] * normal[0], weight * normal[1] * normal[1],
      weight * normal[2] * normal[2] }
    , Products{ weight * normal[1] * normal[2], weight * normal[2] * normal[0],
      weight * normal[0] * normal[1] }
  {
    const double height = -Dot(point, normal);
    this->Linear = (weight * height) * normal;
    this->Constant = weight * height * height;
  }

  void Add(const Quadric& other)
  {
    this->Squares = this->Squares + other.Squares;
    this->Products = this->Products + other.Products;
    this->Linear = this->Linear + other.Linear;
    this->Constant += other.Constant;
  }

  double At(const Vector& p) const
  {
    return this->Squares[0] * p[0] * p[0] + this->Squares[1] * p[1] * p[1] +
      this->Squares[2] * p[2] * p[2] + this->Constant +
      2.0 *
      (this->Products[0] * p[1] * p[2] + this->Products[1] * p[2] * p[0] +
        this->Products[2] * p[0] * p[1] + Dot(this->Linear, p));
  }

private:
  Vector Squares{};
  Vector Products{};
  Vector Linear{};
  double Constant = 0.0;
};

}

#endif
