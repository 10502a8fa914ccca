// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

/** The least cosine between the normals of a triangle at a ridge and of the one replacing it. */
constexpr double LeastCosineAtRidges = 0.25;

}

/** Assigns a sample to what fills a part of the hole. */
void EdgeCollapses::Take(Filling& filling, std::uint32_t sample)
{
  this->Samples[sample].NextOver = filling.FirstSample;
  filling.FirstSample = sample;
}

/** Whether a sample is near enough to what fills the hole; then it is assigned to that. */
bool EdgeCollapses::IsNear(
  const Hole& hole, const Watched& sample, std::uint32_t number, const Hole::Place& place)
{
  int at = 1;
  while (at + 1 < this->FillingCount && this->Fillings[at].IsBeyond(place))
  {
    ++at;
  }
  Filling& filling = this->Fillings[at];
  // Over a closed hole the distance to the plane will do; beside it, or the new border, it would
  // not.
  double distance = 0.0;
  if (hole.IsOpen())
  {
    distance = std::sqrt(filling.Distance.Squared(sample.At()));
  }
  else if (hole.IsOver(at, place))
  {
    distance = Dot(sample.At() - this->Corner, filling.Normal);
  }
  else
  {
    distance = std::sqrt(this->DistanceFrom(at, hole).Squared(sample.At()));
  }
  if (!(std::abs(distance) <= sample.Allowance))
  {
    return false;
  }
  this->Take(filling, number);
  return true;
}

/** Whether no triangle that would fill a hole has a smaller angle than wanted, or than one of those
 *  that it replaces. */
bool EdgeCollapses::KeepsShape(std::uint32_t vertex, const Hole& hole) const
{
  double needed = this->LeastSine;
  for (int i = 0; i < hole.Count && needed > 0.0; ++i)
  {
    if (hole.Triangles[i] != None)
    {
      needed = std::min(
        needed, this->SineOf({ vertex, hole.Points[i], hole.Points[(i + 1) % hole.Count] }));
    }
  }
  for (int i = 1; i + 1 < hole.Count && needed > 0.0; ++i)
  {
    if (this->SineOf({ hole.Points[0], hole.Points[i], hole.Points[i + 1] }) < needed)
    {
      return false;
    }
  }
  return true;
}

/** The distance from a triangle that fills a part of a hole. */
TriangleDistance EdgeCollapses::DistanceFrom(int i, const Hole& hole) const
{
  return { this->Corner, this->Positions[hole.Points[i]], this->Positions[hole.Points[i + 1]] };
}

/** Puts a triangle into a hole. @return whether it faces a direction, by at least a cosine */
bool EdgeCollapses::Put(int i, const Hole& hole, const Vector& direction, double leastCosine)
{
  const Vector across = Cross(this->Positions[hole.Points[i]] - this->Corner,
    this->Positions[hole.Points[i + 1]] - this->Corner);
  const double length = std::sqrt(Dot(across, across));
  this->Fillings[i].Normal = (1.0 / length) * across;
  this->Fillings[i].FirstSample = None;
  return Dot(across, direction) > leastCosine * length;
}

/** Fills a hole with triangles from its first point: the i-th one has the points 0, i and i + 1.
 *  @return whether they are seen from the side that the hole is */
bool EdgeCollapses::Fill(const Hole& hole)
{
  this->FillingCount = hole.Count - 1;
  this->Corner = this->Positions[hole.Points[0]];
  for (int i = 1; i < this->FillingCount; ++i)
  {
    if (!this->Put(i, hole, hole.Normal, hole.LeastCosine))
    {
      return false;
    }
    Filling& filling = this->Fillings[i];
    if (hole.IsOpen())
    {
      filling.Distance = this->DistanceFrom(i, hole);
    }
    filling.Start = hole.Places[0];
    filling.Spoke = { hole.Places[i + 1][0] - hole.Places[0][0],
      hole.Places[i + 1][1] - hole.Places[0][1] };
  }
  return true;
}

/** Whether all samples over a hole are near enough to what fills it as it is seen. */
bool EdgeCollapses::TakesSamples(std::uint32_t vertex, const Hole& hole)
{
  if (!this->IsNear(hole, this->Samples[vertex], vertex, { 0.0, 0.0 }))
  {
    return false;
  }
  const Vector& origin = this->Positions[vertex];
  for (int i = 0; i < hole.Count; ++i)
  {
    const bool isThere = hole.Triangles[i] != None;
    for (std::uint32_t at = isThere ? this->FirstSample[hole.Triangles[i]] : None; at != None;)
    {
      const Watched& sample = this->Samples[at];
      if (!this->IsNear(hole, sample, at, hole.See(sample.At() - origin)))
      {
        return false;
      }
      at = sample.Next;
    }
  }
  return true;
}

/** Whether a sample is near enough to a triangle that fills the hole of a ridge and faces as it
 *  does; then it is assigned to the nearest. @param normal of what it lay over; 0 for the vertex */
bool EdgeCollapses::IsNearRidge(std::uint32_t number, const Vector& normal)
{
  const Watched& sample = this->Samples[number];
  double least = double{ sample.Allowance } * sample.Allowance;
  Filling* nearest = nullptr;
  for (int i = 1; i < this->FillingCount; ++i)
  {
    Filling& filling = this->Fillings[i];
    const double squared = filling.Distance.Squared(sample.At());
    if (squared <= least && Dot(filling.Normal, normal) >= 0.0)
    {
      least = squared;
      nearest = &filling;
    }
  }
  if (nearest != nullptr)
  {
    this->Take(*nearest, number);
  }
  return nearest != nullptr;
}

/** Fills a hole that is not, or hardly, seen as one polygon, as around a vertex on the edge of a
 * thin wall: each triangle has to face nearly as the one that it replaces does.
 *  @return whether all samples over it are near enough to a triangle that faces as they do */
bool EdgeCollapses::FillRidge(std::uint32_t vertex, const Hole& hole)
{
  if (hole.IsOpen())
  {
    return false;
  }
  const int last = hole.Count - 1;
  this->FillingCount = last;
  this->Corner = this->Positions[hole.Points[0]];
  for (int i = 1; i < last; ++i)
  {
    if (!this->Put(i, hole, this->Normals[hole.Triangles[i]], LeastCosineAtRidges))
    {
      return false;
    }
    this->Fillings[i].Distance = this->DistanceFrom(i, hole);
  }
  bool isNear = this->IsNearRidge(vertex, {});
  for (int i = 0; i < hole.Count && isNear; ++i)
  {
    for (std::uint32_t at = this->FirstSample[hole.Triangles[i]]; at != None && isNear;
         at = this->Samples[at].Next)
    {
      isNear = this->IsNearRidge(at, this->Normals[hole.Triangles[i]]);
    }
  }
  return isNear;
}

/** Fills the hole of a vertex that coincides with its target: with triangles where the old ones
 *  were. */
void EdgeCollapses::FillWithTheSame(std::uint32_t vertex, const Hole& hole)
{
  const int last = hole.Count - 1;
  this->FillingCount = last;
  for (int i = 1; i < last; ++i)
  {
    this->Fillings[i].Normal = this->Normals[hole.Triangles[i]];
    this->Fillings[i].FirstSample = None;
  }
  this->Take(this->Fillings[1], vertex);
  for (int i = 0; i < hole.Count; ++i)
  {
    const bool isThere = hole.Triangles[i] != None;
    for (std::uint32_t at = isThere ? this->FirstSample[hole.Triangles[i]] : None; at != None;
         at = this->Samples[at].Next)
    {
      this->Take(this->Fillings[std::clamp(i, 1, last - 1)], at);
    }
  }
}

/** Whether a hole can be filled from its first point with triangles seen, near and shaped as they
 *  have to be; then it is. */
bool EdgeCollapses::CanFill(std::uint32_t vertex, Hole& hole)
{
  if (this->Positions[vertex] == this->Positions[hole.Points[0]])
  {
    this->FillWithTheSame(vertex, hole);
    return true;
  }
  const bool isSeen = hole.SeeFromAbove(this->Positions, this->Normals, vertex);
  const bool isFilled = isSeen && this->Fill(hole);
  const bool isRidge = !isSeen || hole.LeastCosine < Hole::UsualCosine;
  return (isFilled || isRidge) && this->KeepsShape(vertex, hole) &&
    (isFilled ? this->TakesSamples(vertex, hole) : this->FillRidge(vertex, hole)) &&
    !this->MakesCrease(hole);
}

}
