// SPDX-License-Identifier: BSD-3-Clause
#ifndef RoundNumbers_h
#define RoundNumbers_h

#include <cmath>

/**
 * @file RoundNumbers.h
 * Numbers that a person would type.
 */
namespace RoundNumbers
{

/** The largest of 1, 2 and 5 times a power of ten that is no more than a positive size. */
inline double StepWithin(double size)
{
  const double power = std::pow(10.0, std::floor(std::log10(size)));
  for (const double digit : { 5.0, 2.0 })
  {
    if (digit * power <= size)
    {
      return digit * power;
    }
  }
  return power;
}

/** A multiple of a step; with no more digits than the step has. */
inline double Multiple(double count, double step)
{
  return step < 1.0 ? count / std::round(1.0 / step) : count * step;
}

/** About a part of the way from a minimum to a maximum, to a twentieth of it or better. */
inline double Between(double minimum, double maximum, double part)
{
  const double value = minimum + part * (maximum - minimum);
  if (!(maximum > minimum) || !std::isfinite(maximum - minimum))
  {
    return value;
  }
  const double step = StepWithin((maximum - minimum) / 20.0);
  return Multiple(std::round(value / step), step);
}

/** Not less than a positive size, and not much more. */
inline double AtLeast(double size)
{
  const double step = StepWithin(size / 5.0);
  return Multiple(std::ceil(size / step * (1.0 - 1e-9)), step);
}

}

#endif
