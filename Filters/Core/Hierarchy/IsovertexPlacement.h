// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsovertexPlacement_h
#define isodiamond_IsovertexPlacement_h

#include "Field/SignLattice.h"
#include "Lattice/DiamondSet.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

/**
 * @file IsovertexPlacement.h
 * Where an isovertex lies on its edge: its *coefficient*, the position in 1/256 of the edge from
 * the diamond's centre.
 *
 * A *linear* isovertex (the paper's) lies where the field would cross the isovalue if it were
 * linear along the whole edge. An *exact* one lies on the surface of full resolution: an edge of
 * the hierarchy is a row of edges of the full-resolution mesh, unit steps, on each of which the
 * field is linear; the isovertex is the crossing on these that is nearest to the linear guess or,
 * of two equally near ones, the one nearer to the centre. So every vertex of every level of detail
 * is on the full-resolution surface, to within one step of its edge's coefficient (two where an
 * edge carries both surfaces of an interval volume). On edges of one unit step both are the same.
 *
 * Coefficients are kept in 1..255, so isovertices never coincide with lattice vertices; they are
 * 128 where an end of the edge is not finite.
 *
 * The signs along an edge are those of the values unless small pieces were removed (SmallPieces.h).
 * Then an end can be on the other side from its value: the value says nothing about the way to the
 * surface, and the guess is the middle of the edge. Steps of an exact edge are edges of full
 * resolution, so where their signs differ, those of their values do as well, and each crossing is
 * where it was.
 */
namespace isodiamond
{

/** The samples along an edge, from the diamond's centre to a vertex, as a row of steps. */
template <typename T>
class EdgeSamples
{
public:
  /** @param stride between the samples at the ends of a step */
  EdgeSamples(const T* centre, std::int64_t stride, int steps)
    : Centre(centre)
    , Stride(stride)
    , Count(steps)
  {
  }

  int Steps() const { return this->Count; }
  double operator()(int i) const { return static_cast<double>(this->Centre[i * this->Stride]); }
  bool IsAbove(const Isoregion& region, int surface, int i) const
  {
    return region.IsAbove(surface, (*this)(i));
  }

private:
  const T* Centre;
  std::int64_t Stride;
  int Count;
};

/** The signs along an edge, from a lattice of signs. */
class EdgeSigns
{
public:
  /** @param step between the lattice points at the ends of a step */
  EdgeSigns(const SignLattice& signs, const Point& centre, const Point& step)
    : Signs(signs)
    , CentrePoint(centre)
    , Step(step)
  {
  }

  Point At(int i) const { return this->CentrePoint + i * this->Step; }
  int Sign(int i) const { return this->Signs.Sign(0, this->At(i)); }
  bool IsAbove(const Isoregion& /*region*/, int surface, int i) const
  {
    return this->Sign(i) > surface;
  }

private:
  const SignLattice& Signs;
  Point CentrePoint;
  Point Step;
};

/** The samples along an edge with the signs of a lattice, from which small pieces may have been
 *  removed. */
template <typename T>
class SignedEdgeSamples
  : public EdgeSamples<T>
  , public EdgeSigns
{
public:
  using EdgeSigns::IsAbove;

  SignedEdgeSamples(
    const EdgeSamples<T>& values, const SignLattice& signs, const Point& centre, const Point& step)
    : EdgeSamples<T>(values)
    , EdgeSigns(signs, centre, step)
  {
  }
};

namespace placement
{

/** Whether the values at the ends of a step, or a row of steps, are on the sides the signs say. */
template <typename Edge>
bool IsBracketed(const Edge& edge, const Isoregion& region, int surface, int begin, int end)
{
  return region.IsAbove(surface, edge(begin)) == edge.IsAbove(region, surface, begin) &&
    region.IsAbove(surface, edge(end)) == edge.IsAbove(region, surface, end);
}

/** Where the signs are those of the values, there is nothing to check. */
template <typename T>
constexpr bool IsBracketed(const EdgeSamples<T>& /*edge*/, const Isoregion& /*region*/,
  int /*surface*/, int /*begin*/, int /*end*/)
{
  return true;
}

/** The crossing on the step that begins at sample i, in steps from the centre; in the middle of
 *  the step if an end is not finite. */
template <typename Edge>
double Crossing(const Edge& edge, int i, double isovalue)
{
  const double begin = edge(i);
  const double end = edge(i + 1);
  const double along = (isovalue - begin) / (end - begin);
  return i + (std::isfinite(begin) && std::isfinite(end) && along == along ? along : 0.5);
}

/** A position on an edge, in steps, as a coefficient. */
inline std::uint8_t Code(double position, int steps)
{
  const double code = 256.0 * position / steps + 0.5; // truncating rounds positive values
  return static_cast<std::uint8_t>(std::clamp(code, 1.0, 255.0));
}

template <typename Edge>
bool HasFiniteEnds(const Edge& edge)
{
  return std::isfinite(edge(0)) && std::isfinite(edge(edge.Steps()));
}

/** The coefficient of the isovertex on an edge of several steps, whose ends are finite. */
template <typename Edge>
std::uint8_t CoefficientOfLongEdge(const Edge& edge, const Isoregion& region, int surface)
{
  const int steps = edge.Steps();
  const double isovalue = region.Isovalue(surface);
  const double along = (isovalue - edge(0)) / (edge(steps) - edge(0)); // may overflow to NaN
  const bool isKnown = IsBracketed(edge, region, surface, 0, steps) && along == along;
  const double guess = steps * (isKnown ? along : 0.5);
  constexpr double tie = 1e-9; // equal distances may differ by rounding: the first crossing wins
  double nearest = guess;
  double distance = HUGE_VAL;
  bool above = edge.IsAbove(region, surface, 0);
  for (int i = 0; i < steps; ++i)
  {
    const bool nextAbove = edge.IsAbove(region, surface, i + 1);
    if (above != nextAbove)
    {
      assert(IsBracketed(edge, region, surface, i, i + 1));
      const double crossing = Crossing(edge, i, isovalue);
      if (std::fabs(crossing - guess) < distance - tie)
      {
        nearest = crossing;
        distance = std::fabs(crossing - guess);
      }
    }
    above = nextAbove;
  }
  return Code(nearest, steps);
}

}

/** The coefficient of the isovertex on an edge whose ends lie on opposite sides of one surface. */
template <typename Edge>
std::uint8_t IsovertexCoefficient(const Edge& edge, const Isoregion& region, int surface = 0)
{
  if (!placement::HasFiniteEnds(edge))
  {
    return 128;
  }
  if (edge.Steps() > 1)
  {
    return placement::CoefficientOfLongEdge(edge, region, surface);
  }
  return placement::IsBracketed(edge, region, surface, 0, 1)
    ? placement::Code(placement::Crossing(edge, 0, region.Isovalue(surface)), 1)
    : std::uint8_t{ 128 };
}

/**
 * The coefficients of both isovertices of an edge that leads from below an interval volume to above
 * it, for the lower and the upper surface: seen from the lower end, the first crossing of the upper
 * surface, and the last one of the lower surface before it. They are different, and in that order.
 */
template <typename Edge>
std::array<std::uint8_t, 2> IsovertexCoefficients(const Edge& edge, const Isoregion& region)
{
  const int steps = edge.Steps();
  const bool rising = !edge.IsAbove(region, 0, 0);
  std::array<std::uint8_t, 2> both = { 128, 128 };
  if (placement::HasFiniteEnds(edge))
  {
    const auto isAbove = [&](int surface, int i)
    { return edge.IsAbove(region, surface, rising ? i : steps - i); };
    int upper = 0; // the steps that cross, counted from the lower end
    while (!isAbove(1, upper + 1))
    {
      ++upper;
    }
    int lower = upper;
    while (isAbove(0, lower))
    {
      --lower;
    }
    const auto code = [&](int surface, int stepFromBelow)
    {
      const int step = rising ? stepFromBelow : steps - 1 - stepFromBelow;
      const bool isBracketed = placement::IsBracketed(edge, region, surface, step, step + 1);
      return placement::Code(
        isBracketed ? placement::Crossing(edge, step, region.Isovalue(surface)) : step + 0.5,
        steps);
    };
    both = { code(0, lower), code(1, upper) };
  }
  std::uint8_t& nearer = both[rising ? 0 : 1];
  std::uint8_t& farther = both[rising ? 1 : 0];
  if (farther <= nearer)
  {
    nearer = nearer < 255 ? nearer : std::uint8_t{ 254 };
    farther = static_cast<std::uint8_t>(nearer + 1);
  }
  return both;
}

/** Writes the coefficients of a diamond's isovertices: those on surface 0, then 1.
 *  @param lower, upper masks of the edges that these surfaces cross
 *  @param edgeOf called with a vertex; returns the edge to it @return the end */
template <typename EdgeOf>
std::uint8_t* WriteCoefficients(const Isoregion& region, std::uint32_t lower, std::uint32_t upper,
  const EdgeOf& edgeOf, std::uint8_t* next)
{
  std::uint8_t* nextUpper = next + PopCount(lower);
  ForEachBit(lower | upper,
    [&](int vertex)
    {
      const bool isOnLower = ((lower >> vertex) & 1U) != 0;
      const bool isOnUpper = ((upper >> vertex) & 1U) != 0;
      if (isOnLower && isOnUpper)
      {
        const std::array<std::uint8_t, 2> both = IsovertexCoefficients(edgeOf(vertex), region);
        *next++ = both[0];
        *nextUpper++ = both[1];
      }
      else
      {
        (isOnLower ? *next++ : *nextUpper++) =
          IsovertexCoefficient(edgeOf(vertex), region, isOnLower ? 0 : 1);
      }
    });
  return nextUpper;
}

}

#endif
