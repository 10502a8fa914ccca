// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceError.h"

#include <cmath>

namespace reference
{
namespace
{

/** The first code for which something holds; it must hold for all later ones, too. */
template <typename Predicate>
int FirstCode(const Predicate& holds)
{
  int first = 1;
  for (int count = ErrorCodes::Infinite - 1; count > 0;)
  {
    const int half = count / 2;
    if (holds(first + half))
    {
      count = half;
    }
    else
    {
      first += half + 1;
      count -= half + 1;
    }
  }
  return first;
}

}

ErrorCodes::ErrorCodes(double scale)
  : Scale(scale)
{
}

double ErrorCodes::ErrorOf(int code) const
{
  const int part = code % 512;
  const int exponent = code / 512 - 31;
  // Scaling by a power of two rounds nothing.
  return code == Infinite ? HUGE_VAL : std::ldexp(this->Scale * (512 + part), exponent - 9);
}

int ErrorCodes::CodeOf(double error) const
{
  if (!(error <= 1.5 * this->Scale))
  {
    return Infinite;
  }
  return FirstCode([&](int code) { return this->ErrorOf(code) >= error; });
}

int ErrorCodes::LastWithin(double tolerance) const
{
  return FirstCode([&](int code) { return !(this->ErrorOf(code) <= tolerance); }) - 1;
}

}
