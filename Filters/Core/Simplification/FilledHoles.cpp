// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{

/** Whether a sample is near enough to what fills the hole; then it goes with that. */
bool EdgeCollapses::IsNear(
  const Hole& hole, Watched& sample, std::uint32_t number, const Hole::Place& place)
{
  int at = 1;
  while (at + 1 < this->FillingCount && this->Fillings[at].IsBeyond(place))
  {
    ++at;
  }
  Filling& filling = this->Fillings[at];
  // Over a hole that is closed the plane's distance will do; beyond the new border it would not.
  const double distance = hole.IsOpen() ? std::sqrt(filling.Distance.Squared(sample.At()))
                                        : Dot(sample.At() - this->Corner, filling.Normal);
  if (!(std::abs(distance) <= sample.Allowance))
  {
    return false;
  }
  sample.NextOver = filling.FirstSample;
  filling.FirstSample = number;
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

/** Fills a hole by triangles from its first point: the i-th one has the points 0, i and i + 1.
 *  @return whether all samples over it are near enough */
bool EdgeCollapses::Fill(std::uint32_t vertex, const Hole& hole)
{
  const int last = hole.Count - 1;
  this->FillingCount = last;
  this->Corner = this->Positions[hole.Points[0]];
  for (int i = 1; i < last; ++i)
  {
    const Vector& second = this->Positions[hole.Points[i]];
    const Vector& third = this->Positions[hole.Points[i + 1]];
    const Vector across = Cross(second - this->Corner, third - this->Corner);
    const double length = std::sqrt(Dot(across, across));
    if (!(Dot(across, hole.Normal) > hole.LeastCosine * length))
    {
      return false;
    }
    Filling& filling = this->Fillings[i];
    filling.Normal = (1.0 / length) * across;
    if (hole.IsOpen())
    {
      filling.Distance = TriangleDistance(this->Corner, second, third);
    }
    filling.Start = hole.Places[0];
    filling.Spoke = { hole.Places[i + 1][0] - hole.Places[0][0],
      hole.Places[i + 1][1] - hole.Places[0][1] };
    filling.FirstSample = None;
  }
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
      Watched& sample = this->Samples[at];
      if (!this->IsNear(hole, sample, at, hole.See(sample.At() - origin)))
      {
        return false;
      }
      at = sample.Next;
    }
  }
  return true;
}

/** Fills the hole of a vertex that is where its target is: by triangles that are where the old ones
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
  const auto put = [&](std::uint32_t sample, int filling)
  {
    this->Samples[sample].NextOver = this->Fillings[filling].FirstSample;
    this->Fillings[filling].FirstSample = sample;
  };
  put(vertex, 1);
  for (int i = 0; i < hole.Count; ++i)
  {
    const bool isThere = hole.Triangles[i] != None;
    for (std::uint32_t at = isThere ? this->FirstSample[hole.Triangles[i]] : None; at != None;
         at = this->Samples[at].Next)
    {
      put(at, std::clamp(i, 1, last - 1));
    }
  }
}

/** Whether a hole can be filled from its first point by what is seen, near and shaped as it has to
 *  be; then it is. */
bool EdgeCollapses::CanFill(std::uint32_t vertex, Hole& hole)
{
  if (this->Positions[vertex] == this->Positions[hole.Points[0]])
  {
    this->FillWithTheSame(vertex, hole);
    return true;
  }
  return hole.SeeFromAbove(this->Positions, this->Normals, vertex) &&
    this->KeepsShape(vertex, hole) && this->Fill(vertex, hole) && !this->MakesCrease(vertex, hole);
}

}
