// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isodiamond
{
namespace
{

/** Sweeps over edges that may be worth a flip; most is done in two. */
constexpr int MostSweeps = 4;

/** A key of an edge, in either direction. */
std::uint64_t KeyOf(std::uint32_t a, std::uint32_t b)
{
  return (std::uint64_t{ std::min(a, b) } << 32U) | std::max(a, b);
}

}

/** Sweeps over the edges of all triangles that have changed or have a corner that is not settled,
 *  and then over those of what has changed. */
void EdgeCollapses::FlipEdges()
{
  std::vector<std::uint32_t> sweep;
  for (std::uint32_t i = 0; i < this->Triangles.size(); ++i)
  {
    const Triangle& points = this->Triangles[i];
    if (this->Links.IsThere(i) &&
      (this->LastStep[i] != None ||
        std::any_of(points.begin(), points.end(),
          [&](std::uint32_t point) { return !this->IsSettled[point]; })))
    {
      sweep.push_back(i);
    }
  }
  for (int i = 0; i < MostSweeps && !sweep.empty(); ++i)
  {
    std::vector<std::uint32_t> changed;
    for (const std::uint32_t triangle : sweep)
    {
      for (int edge = 0; edge < 3; ++edge)
      {
        Flip flip;
        if (this->SeeFlip(triangle, edge, flip) && this->IsWorthIt(flip) && this->IsNewEdge(flip) &&
          !this->MakesCrease(flip))
        {
          this->Do(flip);
          changed.push_back(flip.First);
          changed.push_back(flip.Second);
        }
      }
    }
    sweep = std::move(changed);
  }
}

/** Finds what the flip of an edge would be. @return whether it is allowed: along the mean normal of
 *  both triangles they are still seen as the same polygon, and neither is one that has to stay */
bool EdgeCollapses::SeeFlip(std::uint32_t triangle, int edge, Flip& flip) const
{
  flip.First = triangle;
  flip.Second = this->Neighbours[triangle][edge];
  if (flip.Second == None)
  {
    return false;
  }
  const Triangle& first = this->Triangles[flip.First];
  const Triangle& second = this->Triangles[flip.Second];
  flip.A = first[edge];
  flip.B = first[(edge + 1) % 3];
  flip.C = first[(edge + 2) % 3];
  flip.D = second[(PlaceOf(second, flip.A) + 1) % 3];
  const auto isFixed = [&](std::uint32_t point) { return this->IsFixed[point]; };
  if (std::all_of(first.begin(), first.end(), isFixed) ||
    std::all_of(second.begin(), second.end(), isFixed))
  {
    return false;
  }
  const Vector up = Unit(Across(this->Positions, first) + Across(this->Positions, second));
  const double leastCosine = std::min(
    { Hole::UsualCosine, Dot(up, this->Normals[flip.First]), Dot(up, this->Normals[flip.Second]) });
  const auto turn = [&](const Triangle& points, Vector& normal)
  {
    const Vector across = Across(this->Positions, points);
    const double length = std::sqrt(Dot(across, across));
    normal = (1.0 / length) * across;
    return leastCosine > 0.0 && Dot(across, up) > leastCosine * length;
  };
  const Vector along = this->Positions[flip.C] - this->Positions[flip.D];
  flip.TowardB = Cross(along, up);
  return turn({ flip.A, flip.D, flip.C }, flip.FirstNormal) &&
    turn({ flip.D, flip.B, flip.C }, flip.SecondNormal);
}

/** Whether the triangles fit better after a flip; and each sample is near enough, and no angle less
 *  than wanted, unless one was before. */
bool EdgeCollapses::IsWorthIt(const Flip& flip) const
{
  const auto [first, second, a, b, c, d] = flip.Numbers();
  Fit before;
  Fit after;
  before.Sine = std::min(this->SineOf({ a, b, c }), this->SineOf({ b, a, d }));
  after.Sine = std::min(this->SineOf({ a, d, c }), this->SineOf({ d, b, c }));
  if (after.Sine < std::min(before.Sine, this->LeastSine))
  {
    return false;
  }
  for (const std::uint32_t triangle : { first, second })
  {
    for (std::uint32_t at = this->FirstSample[triangle]; at != None; at = this->Samples[at].Next)
    {
      const Watched& sample = this->Samples[at];
      const Vector fromD = sample.At() - this->Positions[d];
      const double now = Dot(sample.At() - this->Positions[a], this->Normals[triangle]);
      const double then =
        Dot(fromD, Dot(fromD, flip.TowardB) > 0.0 ? flip.SecondNormal : flip.FirstNormal);
      if (!(std::abs(then) <= sample.Allowance))
      {
        return false;
      }
      before.Squares += now * now;
      before.Allowed += double{ sample.Allowance } * sample.Allowance;
      after.Squares += then * then;
    }
  }
  return after.IsBetterThan(before);
}

/** Whether a flip makes an edge that is not there, is not in another part, and would not be there
 *  if another flip were undone. */
bool EdgeCollapses::IsNewEdge(const Flip& flip) const
{
  if ((this->IsFixed[flip.C] && this->IsFixed[flip.D]) || this->IsLeftAlone[flip.C] ||
    this->IsLeftAlone[flip.D] || this->FlippedAway.count(KeyOf(flip.C, flip.D)) > 0)
  {
    return false;
  }
  bool isNew = true;
  this->ForEachNeighbour(flip.C,
    [&](std::uint32_t neighbour, std::uint32_t /*triangle*/)
    { isNew = isNew && neighbour != flip.D; });
  return isNew;
}

void EdgeCollapses::Do(const Flip& flip)
{
  const auto [first, second, a, b, c, d] = flip.Numbers();
  const auto number = static_cast<std::uint32_t>(this->Steps.size());
  this->Steps.push_back({ None, None, this->TrianglesOfSteps.size(), 4 });
  this->TrianglesOfSteps.insert(this->TrianglesOfSteps.end(), { first, second, None, None });
  this->PointsOfSteps.insert(this->PointsOfSteps.end(), { a, b, c, d });
  this->LastStep[first] = number;
  this->LastStep[second] = number;
  this->FlippedAway.insert(KeyOf(a, b));
  this->SetSides(first, second, { d, c, a, b });
  this->Normals[first] = flip.FirstNormal;
  this->Normals[second] = flip.SecondNormal;
  this->ShareSamples(first, second, d, flip.TowardB);
}

void EdgeCollapses::UndoFlip(const Step& step)
{
  const std::uint32_t first = this->TrianglesOfSteps[step.First];
  const std::uint32_t second = this->TrianglesOfSteps[step.First + 1];
  const std::uint32_t* const points = &this->PointsOfSteps[step.First];
  const auto [a, b, c, d] =
    std::array<std::uint32_t, 4>{ points[0], points[1], points[2], points[3] };
  this->SetSides(first, second, { a, b, c, d });
  const Vector firstAcross = Across(this->Positions, this->Triangles[first]);
  const Vector secondAcross = Across(this->Positions, this->Triangles[second]);
  this->Normals[first] = Unit(firstAcross);
  this->Normals[second] = Unit(secondAcross);
  const Vector along = this->Positions[a] - this->Positions[b];
  this->ShareSamples(first, second, a, Cross(firstAcross + secondAcross, along));
}

/** Makes two triangles that share a diagonal of a quadrangle those on both sides of the edge from
 *  its point a to b: (a, b, c) and (b, a, d). @param points a to d */
void EdgeCollapses::SetSides(
  std::uint32_t first, std::uint32_t second, const std::array<std::uint32_t, 4>& points)
{
  const auto [a, b, c, d] = points;
  const auto beyond = [&](std::uint32_t from, std::uint32_t to)
  {
    const Triangle& triangle = this->Triangles[first];
    const int place = PlaceOf(triangle, from);
    const bool isOfFirst = triangle[place] == from && triangle[(place + 1) % 3] == to;
    return isOfFirst ? this->Neighbours[first][place]
                     : this->Neighbours[second][PlaceOf(this->Triangles[second], from)];
  };
  const std::array<std::uint32_t, 4> outer = { beyond(b, c), beyond(c, a), beyond(a, d),
    beyond(d, b) };
  this->Triangles[first] = { a, b, c };
  this->Neighbours[first] = { second, outer[0], outer[1] };
  this->Triangles[second] = { b, a, d };
  this->Neighbours[second] = { first, outer[2], outer[3] };
  const auto link = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t neighbour)
  {
    if (triangle != None)
    {
      this->Neighbours[triangle][PlaceOf(this->Triangles[triangle], from)] = neighbour;
    }
  };
  link(outer[0], c, first);
  link(outer[1], a, first);
  link(outer[2], d, second);
  link(outer[3], b, second);
  this->AnyTriangle[a] = first;
  this->AnyTriangle[c] = first;
  this->AnyTriangle[b] = second;
  this->AnyTriangle[d] = second;
}

/** Puts the samples of two triangles over the one where they are seen: over the second, those that
 *  lie from a point in a direction, across their common edge. */
void EdgeCollapses::ShareSamples(
  std::uint32_t first, std::uint32_t second, std::uint32_t point, const Vector& towardSecond)
{
  for (std::uint32_t at = std::exchange(this->FirstSample[second], None); at != None;)
  {
    const std::uint32_t next = this->Samples[at].Next;
    this->PutOver(first, at);
    at = next;
  }
  for (std::uint32_t at = std::exchange(this->FirstSample[first], None); at != None;)
  {
    const std::uint32_t next = this->Samples[at].Next;
    const Vector from = this->Samples[at].At() - this->Positions[point];
    this->PutOver(Dot(from, towardSecond) > 0.0 ? second : first, at);
    at = next;
  }
}

}
