// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{

void EdgeCollapses::Undo(const Step& step)
{
  if (step.Vertex == None)
  {
    this->UndoFlip(step);
  }
  else if (step.Successor != None)
  {
    this->UndoMove(step);
  }
  else
  {
    this->UndoCollapse(step);
  }
}

void EdgeCollapses::UndoCollapse(const Step& step)
{
  const std::uint32_t* triangles = &this->TrianglesOfSteps[step.First];
  const std::uint32_t* points = &this->PointsOfSteps[step.First];
  const auto beyond = [&](int stays, std::uint32_t from)
  { return this->Neighbours[triangles[stays]][PlaceOf(this->Triangles[triangles[stays]], from)]; };
  const int last = step.Count - 1;
  std::array<std::uint32_t, MostNeighbours> outer;
  outer[0] = beyond(1, points[0]);
  outer[last] = beyond(last - 1, points[last]);
  for (int i = 1; i < last; ++i)
  {
    outer[i] = beyond(i, points[i]);
  }
  const auto replace = [&](std::uint32_t triangle, std::uint32_t neighbour, std::uint32_t by)
  {
    if (triangle != None)
    {
      Triangle& all = this->Neighbours[triangle];
      *std::find(all.begin(), all.end(), neighbour) = by;
    }
  };
  replace(outer[0], triangles[1], triangles[0]);
  replace(outer[last], triangles[last - 1], triangles[last]);
  for (int i = 0; i <= last; ++i)
  {
    const int next = i < last ? i + 1 : 0;
    if (triangles[i] == None)
    {
      continue;
    }
    this->Triangles[triangles[i]] = { step.Vertex, points[i], points[next] };
    this->Neighbours[triangles[i]] = { triangles[i > 0 ? i - 1 : last], outer[i], triangles[next] };
    this->AnyTriangle[points[i]] = triangles[i];
    this->AnyTriangle[points[next]] = triangles[i];
  }
  this->AnyTriangle[step.Vertex] = triangles[1]; // is never missing
  this->RemovedIn[step.Vertex] = None;
  this->TakeAway(step.Vertex);
  this->GiveBackSamples(step);
}

void EdgeCollapses::PutOver(std::uint32_t triangle, std::uint32_t sample)
{
  this->Samples[sample].Next = this->FirstSample[triangle];
  this->FirstSample[triangle] = sample;
  this->Homes[sample] = triangle;
}

void EdgeCollapses::TakeAway(std::uint32_t sample)
{
  std::uint32_t* at = &this->FirstSample[this->Homes[sample]];
  while (*at != sample)
  {
    at = &this->Samples[*at].Next;
  }
  *at = this->Samples[sample].Next;
  this->Homes[sample] = None;
}

/** Puts what lies over the triangles that filled a hole over those that are back. */
void EdgeCollapses::GiveBackSamples(const Step& step)
{
  Hole hole;
  hole.Count = step.Count;
  std::vector<std::uint32_t> samples;
  for (int i = 0; i < step.Count; ++i)
  {
    const std::uint32_t triangle = this->TrianglesOfSteps[step.First + i];
    hole.Points[i] = this->PointsOfSteps[step.First + i];
    hole.Triangles[i] = triangle;
    if (triangle == None)
    {
      continue;
    }
    this->Normals[triangle] = Unit(Across(this->Positions, this->Triangles[triangle]));
    const bool wasThere = step.Successor != None || (i > 0 && i < step.Count - 1);
    for (std::uint32_t at = wasThere ? this->FirstSample[triangle] : None; at != None;
         at = this->Samples[at].Next)
    {
      samples.push_back(at);
    }
    this->FirstSample[triangle] = None;
  }
  const bool isSeen = hole.SeeFromAbove(this->Positions, this->Normals, step.Vertex);
  for (const std::uint32_t sample : samples)
  {
    const int at = isSeen
      ? hole.TriangleAt(hole.See(this->Samples[sample].At() - this->Positions[step.Vertex]))
      : this->NearestIn(hole, this->Samples[sample].At());
    this->PutOver(hole.Triangles[at], sample);
  }
}

/** Which of the triangles around a vertex is nearest to a place. */
int EdgeCollapses::NearestIn(const Hole& hole, const Vector& place) const
{
  int nearest = 1; // is never missing
  double least = HUGE_VAL;
  for (int i = 0; i < hole.Count; ++i)
  {
    const std::uint32_t triangle = hole.Triangles[i];
    const auto squared = [&]
    {
      const auto [a, b, c] = this->Links.Corners(this->Positions, triangle);
      return TriangleDistance(a, b, c).Squared(place);
    };
    if (const double distance = triangle == None ? HUGE_VAL : squared(); distance < least)
    {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

std::vector<bool> EdgeCollapses::Undo(
  const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& points)
{
  std::vector<bool> isUndone = this->StepsThatMade(triangles, points);
  if (this->Guard != nullptr)
  {
    this->AskGuard(isUndone);
  }
  // Forwards to find what builds on it; then back.
  std::vector<bool> isTouched(this->Triangles.size());
  for (std::size_t i = 0; i < this->Steps.size(); ++i)
  {
    this->ForEachTriangleOf(this->Steps[i],
      [&](std::uint32_t triangle) { isUndone[i] = isUndone[i] || isTouched[triangle]; });
    if (isUndone[i])
    {
      this->ForEachTriangleOf(
        this->Steps[i], [&](std::uint32_t triangle) { isTouched[triangle] = true; });
    }
  }
  for (std::size_t i = this->Steps.size(); i-- > 0;)
  {
    if (isUndone[i])
    {
      this->Undo(this->Steps[i]);
    }
  }
  this->Forget(isUndone);
  return isTouched;
}

/** By step: whether it was the last one that made one of the triangles what it is, or a triangle
 *  around it if it is as it was; or the one that removed one of the points. */
std::vector<bool> EdgeCollapses::StepsThatMade(
  const std::vector<std::uint32_t>& triangles, const std::vector<std::uint32_t>& points) const
{
  std::vector<bool> isOne(this->Steps.size());
  const auto mark = [&](std::uint32_t step)
  {
    if (step != None)
    {
      isOne[step] = true;
    }
  };
  for (const std::uint32_t triangle : triangles)
  {
    mark(this->LastStep[triangle]);
    if (this->LastStep[triangle] == None)
    {
      for (const std::uint32_t point : this->Triangles[triangle])
      {
        this->ForEachNeighbour(point,
          [&](std::uint32_t, std::uint32_t other)
          { mark(other != None ? this->LastStep[other] : None); });
      }
    }
  }
  for (const std::uint32_t point : points)
  {
    mark(this->RemovedIn[point]);
  }
  return isOne;
}

/** Adds what the guard wants to have undone as well. */
void EdgeCollapses::AskGuard(std::vector<bool>& isUndone)
{
  std::vector<std::uint32_t> vertices;
  for (std::size_t i = 0; i < this->Steps.size(); ++i)
  {
    if (isUndone[i])
    {
      vertices.push_back(this->Steps[i].Vertex);
    }
  }
  for (const std::uint32_t vertex : this->Guard->Undo(vertices))
  {
    if (this->RemovedIn[vertex] != None)
    {
      isUndone[this->RemovedIn[vertex]] = true;
    }
  }
}

/** Gives new numbers to the steps that are left. */
void EdgeCollapses::Forget(const std::vector<bool>& isUndone)
{
  std::size_t kept = 0;
  std::fill(this->LastStep.begin(), this->LastStep.end(), None);
  for (std::size_t i = 0; i < this->Steps.size(); ++i)
  {
    if (!isUndone[i])
    {
      const Step step = this->Steps[i];
      this->Steps[kept] = step;
      if (step.Vertex != None)
      {
        this->RemovedIn[step.Vertex] = static_cast<std::uint32_t>(kept);
      }
      if (step.Successor != None)
      {
        this->RemovedIn[step.Successor] = None;
      }
      this->ForEachTriangleOf(step,
        [&](std::uint32_t triangle)
        { this->LastStep[triangle] = static_cast<std::uint32_t>(kept); });
      ++kept;
    }
  }
  this->Steps.resize(kept);
}

}
