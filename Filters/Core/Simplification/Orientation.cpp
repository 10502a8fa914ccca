// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/Orientation.h"

#include <cfloat>
#include <cmath>
#include <limits>
#include <utility>

#if defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error "Orientations are exact only if sums are rounded as they are written: no -ffast-math here."
#endif
static_assert(FLT_EVAL_METHOD == 0, "and only if they are rounded to doubles: -mfpmath=sse");

namespace isodiamond
{
namespace
{

/** Half a unit in the last place of 1. */
constexpr double Rounding = 0.5 * std::numeric_limits<double>::epsilon();

///@{
/** How wrong a determinant may be, as a part of the sum of its terms' magnitudes. */
constexpr double PlaneError = (3.0 + 16.0 * Rounding) * Rounding;
constexpr double SpaceError = (7.0 + 56.0 * Rounding) * Rounding;
///@}

int SignOf(double value)
{
  return (value > 0.0 ? 1 : 0) - (value < 0.0 ? 1 : 0);
}

/** What a sum and a product lose when they are rounded. Products are written as fused ones: then no
 *  compiler fuses them with a sum that follows. */
struct Rounded
{
  double Value;
  double Lost;
};
Rounded Sum(double a, double b)
{
  const double sum = a + b;
  const double ofB = sum - a;
  return { sum, (a - (sum - ofB)) + (b - ofB) };
}
Rounded Product(double a, double b)
{
  const double product = std::fma(a, b, 0.0);
  return { product, std::fma(a, b, -product) };
}

/** A sum of numbers as a list of numbers that do not overlap, none of them 0, the greatest last. */
class ExactSum
{
public:
  void Add(double value)
  {
    const int count = std::exchange(this->Count, 0);
    for (int i = 0; i < count; ++i)
    {
      const Rounded sum = Sum(value, this->Parts[i]);
      value = sum.Value;
      this->Append(sum.Lost);
    }
    this->Append(value);
  }

  /** Adds a * b, or a * b * c. */
  void Add(double a, double b)
  {
    const Rounded product = Product(a, b);
    this->Add(product.Lost);
    this->Add(product.Value);
  }
  void Add(double a, double b, double c)
  {
    const Rounded product = Product(a, b);
    this->Add(product.Lost, c);
    this->Add(product.Value, c);
  }

  int Sign() const { return this->Count > 0 ? SignOf(this->Parts[this->Count - 1]) : 0; }

private:
  void Append(double part)
  {
    if (part != 0.0)
    {
      this->Parts[this->Count++] = part;
    }
  }

  /** Each number adds one at most: 24 products of three have 4 each. */
  std::array<double, 96> Parts;
  int Count = 0;
};

/** Adds sign * a . (b x c). */
void AddDeterminant(double sign, const Vector& a, const Vector& b, const Vector& c, ExactSum& sum)
{
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum.Add(sign * a[i], b[j], c[k]);
    sum.Add(-sign * a[i], b[k], c[j]);
  }
}

int ExactOrientation(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  ExactSum sum;
  AddDeterminant(1.0, a, b, c, sum);
  AddDeterminant(-1.0, b, c, d, sum);
  AddDeterminant(1.0, c, d, a, sum);
  AddDeterminant(-1.0, d, a, b, sum);
  return sum.Sign();
}

int ExactOrientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  ExactSum sum;
  const auto add = [&](const PlanePoint& from, const PlanePoint& to)
  {
    sum.Add(from[0], to[1]);
    sum.Add(-from[1], to[0]);
  };
  add(a, b);
  add(b, c);
  add(c, a);
  return sum.Sign();
}

}

int Orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double determinant = left - right;
  const double error = PlaneError * (std::abs(left) + std::abs(right));
  return std::abs(determinant) >= error ? SignOf(determinant) : ExactOrientation(a, b, c);
}

int Orientation(const Vector& a, const Vector& b, const Vector& c, const Vector& d)
{
  const Vector fromA = a - d;
  const Vector fromB = b - d;
  const Vector fromC = c - d;
  double determinant = 0.0;
  double magnitude = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double left = fromB[j] * fromC[k];
    const double right = fromB[k] * fromC[j];
    determinant += fromA[i] * (left - right);
    magnitude += std::abs(fromA[i]) * (std::abs(left) + std::abs(right));
  }
  return std::abs(determinant) >= SpaceError * magnitude ? SignOf(determinant)
                                                         : ExactOrientation(a, b, c, d);
}

}
