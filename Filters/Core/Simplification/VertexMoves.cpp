// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>

namespace isodiamond
{

/** Moves each vertex inside to another of the original's points, if its triangles fit better there.
 *  What is around it may collapse anew. */
void EdgeCollapses::MoveVertices()
{
  for (std::uint32_t vertex = 0; vertex < this->Positions.size(); ++vertex)
  {
    if (this->MayGo(vertex) && !this->IsAtBorder[vertex] && !this->IsSettled[vertex] &&
      this->FindFan(vertex) && this->Around.FindBetter(this->LeastSine) &&
      !this->MakesCrease(this->Around))
    {
      this->Move(vertex, this->Around);
    }
  }
}

/** Finds what lies over the triangles around a vertex.
 *  @return whether they are seen from above, and there are other points */
bool EdgeCollapses::FindFan(std::uint32_t vertex)
{
  const Triangle& points = this->Triangles[this->AnyTriangle[vertex]];
  Hole hole;
  if (!this->FindHole(vertex, points[(PlaceOf(points, vertex) + 1) % 3], hole) ||
    !hole.SeeFromAbove(this->Positions, this->Normals, vertex))
  {
    return false;
  }
  const Vector& origin = this->Positions[vertex];
  Fan::ByTriangle<Vector> ring;
  Fan::ByTriangle<Vector> normals;
  for (int i = 0; i < hole.Count; ++i)
  {
    ring[i] = this->Positions[hole.Points[i]] - origin;
    normals[i] = this->Normals[hole.Triangles[i]];
  }
  this->Around.Begin(hole, ring, normals);
  this->Around.Add({ {}, this->Samples[vertex].Allowance, vertex, 0, false });
  bool hasPoint = false;
  for (int i = 0; i < hole.Count; ++i)
  {
    for (std::uint32_t at = this->FirstSample[hole.Triangles[i]]; at != None;
         at = this->Samples[at].Next)
    {
      const Watched& sample = this->Samples[at];
      const bool isPoint = at < this->Positions.size();
      hasPoint = hasPoint || isPoint;
      this->Around.Add({ sample.At() - origin, sample.Allowance, at, i, isPoint });
    }
  }
  return hasPoint;
}

void EdgeCollapses::Move(std::uint32_t vertex, const Fan& fan)
{
  const Hole& hole = fan.Border();
  const std::uint32_t point = fan.Point();
  this->Note(vertex, hole);
  this->Steps.back().Successor = point;
  this->RemovedIn[point] = None;
  for (int i = 0; i < hole.Count; ++i)
  {
    const std::uint32_t triangle = hole.Triangles[i];
    this->Triangles[triangle][PlaceOf(this->Triangles[triangle], vertex)] = point;
    this->Normals[triangle] = fan.NewNormal(i);
    this->FirstSample[triangle] = None;
  }
  this->Homes[point] = None;
  fan.ForEachSample([&](std::uint32_t sample, int i) { this->PutOver(hole.Triangles[i], sample); });
  this->AnyTriangle[point] = hole.Triangles[0];
  this->AnyTriangle[vertex] = None;
  this->Quadrics[point].Add(this->Quadrics[vertex]);
  ++this->Versions[vertex];
  const auto offer = [&](std::uint32_t other)
  {
    if (this->MayGo(other))
    {
      this->OfferAnew(other);
    }
  };
  offer(point);
  std::for_each(hole.Points.begin(), hole.Points.begin() + hole.Count, offer);
}

void EdgeCollapses::UndoMove(const Step& step)
{
  const std::uint32_t* const triangles = &this->TrianglesOfSteps[step.First];
  for (int i = 0; i < step.Count; ++i)
  {
    Triangle& points = this->Triangles[triangles[i]];
    points[PlaceOf(points, step.Successor)] = step.Vertex;
  }
  this->AnyTriangle[step.Vertex] = triangles[0];
  this->AnyTriangle[step.Successor] = None;
  this->RemovedIn[step.Vertex] = None;
  this->TakeAway(step.Vertex);
  this->PutOver(triangles[0], step.Successor);
  this->GiveBackSamples(step);
}

}
