// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceExact.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <vector>

namespace reference
{

namespace
{

/** A surface: the value on it, and whether another value lies above it. */
struct Separator
{
  double Value;
  std::function<bool(double)> IsAbove;
};

Separator SurfaceAt(double isovalue)
{
  return { isovalue, [isovalue](double value) { return SignOf(value, isovalue) > 0; } };
}

Separator SurfaceAt(const Isorange& range, int surface)
{
  if (surface < 0)
  {
    return { range.Lower, [range](double value) { return SignOf(value, range) >= 0; } };
  }
  return { range.Upper, [range](double value) { return SignOf(value, range) > 0; } };
}

/** The samples at all lattice points of an edge, from the younger to the older end. */
std::vector<double> SamplesAlong(const ScalarField& field, const Point& younger, const Point& older)
{
  int steps = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    steps = std::max(steps, std::abs(older[axis] - younger[axis]));
  }
  std::vector<double> samples;
  for (int i = 0; i <= steps; ++i)
  {
    Point point = younger;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int difference = older[axis] - younger[axis];
      if (difference != 0 && std::abs(difference) != steps)
      {
        throw std::invalid_argument("an edge leads along an axis or a diagonal");
      }
      point[axis] += difference < 0 ? -i : difference > 0 ? i : 0;
    }
    samples.push_back(field.At(point));
  }
  return samples;
}

bool AreEndsFinite(const std::vector<double>& samples)
{
  return std::isfinite(samples.front()) && std::isfinite(samples.back());
}

/** Where a surface is crossed on the unit step from sample i to the next, in unit steps. */
double CrossingOnStep(const std::vector<double>& samples, int i, double value)
{
  const double from = samples[i];
  const double to = samples[i + 1];
  const bool isFinite = std::isfinite(from) && std::isfinite(to);
  return i + (isFinite ? (value - from) / (to - from) : 0.5);
}

/** All crossings, from the younger end on. */
std::vector<double> Crossings(const std::vector<double>& samples, const Separator& surface)
{
  std::vector<double> crossings;
  for (int i = 0; i + 1 < static_cast<int>(samples.size()); ++i)
  {
    if (surface.IsAbove(samples[i]) != surface.IsAbove(samples[i + 1]))
    {
      crossings.push_back(CrossingOnStep(samples, i, surface.Value));
    }
  }
  return crossings;
}

/** A position on an edge, given in unit steps, as a coefficient. */
int Coded(const std::vector<double>& samples, double position)
{
  const double steps = static_cast<double>(samples.size() - 1);
  return static_cast<int>(std::clamp(std::floor(256.0 * position / steps + 0.5), 1.0, 255.0));
}

/** The crossing nearest to a position, of several the one nearest to the younger end. */
double NearestCrossing(const std::vector<double>& crossings, double position)
{
  // Two distances may be equal though rounding makes them differ.
  constexpr double Tolerance = 1e-9;
  double nearest = crossings.front();
  for (const double crossing : crossings)
  {
    if (std::abs(crossing - position) < std::abs(nearest - position) - Tolerance)
    {
      nearest = crossing;
    }
  }
  return nearest;
}

/** The coefficient of the crossing nearest to the linear guess. */
int NearestCoefficient(const std::vector<double>& samples, const Separator& surface)
{
  if (surface.IsAbove(samples.front()) == surface.IsAbove(samples.back()))
  {
    throw std::invalid_argument("the surface does not cut this edge");
  }
  if (!AreEndsFinite(samples))
  {
    return 128;
  }
  const double steps = static_cast<double>(samples.size() - 1);
  const double guess =
    steps * (surface.Value - samples.front()) / (samples.back() - samples.front());
  return Coded(samples, NearestCrossing(Crossings(samples, surface), guess));
}

/**
 * The coefficients of both surfaces, the lower one's first, on an edge from below the range to
 * above it, or back. They are in order, but may be equal.
 */
std::array<int, 2> CoefficientsOfBoth(const std::vector<double>& samples, const Isorange& range)
{
  if (!AreEndsFinite(samples))
  {
    return { 128, 128 };
  }
  const int steps = static_cast<int>(samples.size()) - 1;
  const bool isRising = SignOf(samples.front(), range) < 0;
  int lowerStep = -1;
  int upperStep = -1;
  for (int i = 0; i < steps && upperStep < 0; ++i)
  {
    // The unit steps in order from the end below the range to the end above.
    const int step = isRising ? i : steps - 1 - i;
    const int signFrom = SignOf(samples[isRising ? step : step + 1], range);
    const int signTo = SignOf(samples[isRising ? step + 1 : step], range);
    if (signFrom < 0 && signTo >= 0)
    {
      lowerStep = step;
    }
    if (signTo > 0)
    {
      upperStep = step;
    }
  }
  return { Coded(samples, CrossingOnStep(samples, lowerStep, range.Lower)),
    Coded(samples, CrossingOnStep(samples, upperStep, range.Upper)) };
}

/** Moves two coefficients apart if need be; the first is to be nearer to the younger end. */
void Separate(int& first, int& second)
{
  if (second > first)
  {
    return;
  }
  first = std::min(first, 254);
  second = first + 1;
}

}

int ExactCoefficient(const ScalarField& field, double isovalue, const Isovertex& isovertex)
{
  return NearestCoefficient(
    SamplesAlong(field, isovertex.Younger, isovertex.Older), SurfaceAt(isovalue));
}

int ExactCoefficient(const ScalarField& field, const Isorange& range, const IntervalPoint& point)
{
  if (point.Surface == 0)
  {
    return 0;
  }
  const std::vector<double> samples = SamplesAlong(field, point.Younger, point.Older);
  const int signYounger = SignOf(samples.front(), range);
  const int signOlder = SignOf(samples.back(), range);
  if (signYounger * signOlder >= 0)
  {
    return NearestCoefficient(samples, SurfaceAt(range, point.Surface));
  }

  auto [lower, upper] = CoefficientsOfBoth(samples, range);
  if (signYounger < 0)
  {
    Separate(lower, upper);
  }
  else
  {
    Separate(upper, lower);
  }
  return point.Surface < 0 ? lower : upper;
}

std::array<double, 3> ExactPosition(
  const ScalarField& field, double isovalue, const Isovertex& isovertex)
{
  return Position(isovertex, ExactCoefficient(field, isovalue, isovertex));
}

std::array<double, 3> ExactPosition(
  const ScalarField& field, const Isorange& range, const IntervalPoint& point)
{
  return Position(Isovertex{ point.Younger, point.Older }, ExactCoefficient(field, range, point));
}

}
