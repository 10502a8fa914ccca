// SPDX-License-Identifier: BSD-3-Clause
#include "Simplification/EdgeCollapses.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isodiamond
{

EdgeCollapses::EdgeCollapses(const MeshPart& part, double usedPart, CollapseGuard* guard)
  : Guard(guard)
  , LeastSine(part.LeastSine)
  , Positions(part.Positions)
  , Links(part.Simple)
  , Triangles(this->Links.Triangles)
  , Neighbours(this->Links.Neighbours)
  , Normals(this->Triangles.size())
  , FirstSample(this->Triangles.size(), None)
  , Homes(part.Samples.size(), None)
  , AnyTriangle(this->Positions.size(), None)
  , IsFixed(part.IsFixed)
  , IsSettled(part.IsSettled)
  , IsAtBorder(this->Positions.size())
  , OnWalls(part.OnWalls)
  , IsLeftAlone(this->Positions.size())
  , Quadrics(this->Positions.size())
  , Best(this->Positions.size())
  , Versions(this->Positions.size())
  , Marks(this->Positions.size())
  , LastStep(this->Triangles.size(), None)
  , RemovedIn(this->Positions.size(), None)
{
  const Vector origin = part.Positions.empty() ? Vector{} : part.Positions.front();
  for (Vector& position : this->Positions)
  {
    position = position - origin;
  }
  this->AddTriangles();
  this->AddSamples(part.Samples, origin, usedPart);
}

/** Finds what triangles tell of their points, and whether those at a point are one fan. */
void EdgeCollapses::AddTriangles()
{
  std::vector<int> counts(this->Positions.size());
  for (std::uint32_t i = 0; i < this->Triangles.size(); ++i)
  {
    if (!this->Links.IsThere(i))
    {
      continue;
    }
    const Triangle& triangle = this->Triangles[i];
    const Vector across = Across(this->Positions, triangle);
    this->Normals[i] = Unit(across);
    const double area = 0.5 * std::sqrt(Dot(across, across));
    const Quadric plane(this->Positions[triangle[0]], this->Normals[i], area);
    for (int k = 0; k < 3; ++k)
    {
      this->AnyTriangle[triangle[k]] = i;
      this->Quadrics[triangle[k]].Add(plane);
      ++counts[triangle[k]];
      if (this->Neighbours[i][k] == None)
      {
        this->AddBorder(triangle[k], triangle[(k + 1) % 3], this->Normals[i]);
      }
    }
  }
  for (std::uint32_t point = 0; point < this->Positions.size(); ++point)
  {
    if (this->AnyTriangle[point] != None)
    {
      int seen = 0;
      this->ForEachNeighbour(
        point, [&](std::uint32_t, std::uint32_t triangle) { seen += triangle != None ? 1 : 0; });
      this->IsLeftAlone[point] = seen != counts[point];
    }
  }
}

/** @param origin of this mesh */
void EdgeCollapses::AddSamples(
  const std::vector<SurfaceSample>& samples, const Vector& origin, double usedPart)
{
  this->Samples.reserve(samples.size());
  for (const SurfaceSample& sample : samples)
  {
    const Vector place = sample.Position - origin;
    const auto number = static_cast<std::uint32_t>(this->Samples.size());
    this->Samples.push_back({ { static_cast<float>(place[0]), static_cast<float>(place[1]),
                                static_cast<float>(place[2]) },
      static_cast<float>(usedPart * sample.Allowance), None, None });
    if (sample.Home != None)
    {
      this->PutOver(sample.Home, number);
    }
  }
}

/** What moves along the border is to stay near its line: near the upright plane through it. */
void EdgeCollapses::AddBorder(std::uint32_t from, std::uint32_t to, const Vector& normal)
{
  const Vector along = this->Positions[to] - this->Positions[from];
  const Quadric plane(this->Positions[from], Unit(Cross(along, normal)), Dot(along, along));
  for (const std::uint32_t point : { from, to })
  {
    this->IsAtBorder[point] = true;
    this->Quadrics[point].Add(plane);
  }
}

/** @param first one of the two neighbours at the border
 *  @return whether there is one, and both edges at the border are on one wall */
bool EdgeCollapses::FindOpenHole(std::uint32_t vertex, std::uint32_t first, Hole& hole) const
{
  hole.Count = 0;
  bool isWhole = true;
  this->ForEachNeighbour(vertex,
    [&](std::uint32_t neighbour, std::uint32_t triangle)
    {
      isWhole = isWhole && hole.Count < MostNeighbours;
      if (isWhole)
      {
        hole.Points[hole.Count] = neighbour;
        hole.Triangles[hole.Count] = triangle;
        ++hole.Count;
      }
    });
  const int walls = this->OnWalls[vertex] & this->OnWalls[hole.Points[0]] &
    this->OnWalls[hole.Points[hole.Count - 1]];
  if (walls == 0 || !isWhole)
  {
    return false;
  }
  if (hole.Points[0] != first)
  {
    const auto turn = [&](auto& items)
    { std::rotate(items.begin(), items.begin() + hole.Count - 1, items.begin() + hole.Count); };
    turn(hole.Points);
    turn(hole.Triangles);
  }
  return hole.Points[0] == first && hole.Count > 2;
}

/** @param first the neighbour to begin with */
bool EdgeCollapses::FindHole(std::uint32_t vertex, std::uint32_t first, Hole& hole) const
{
  if (this->IsAtBorder[vertex])
  {
    return this->FindOpenHole(vertex, first, hole);
  }
  std::uint32_t start = this->AnyTriangle[vertex];
  for (int i = 0;
       this->Triangles[start][(PlaceOf(this->Triangles[start], vertex) + 1) % 3] != first; ++i)
  {
    if (i == MostNeighbours)
    {
      return false;
    }
    start = this->Neighbours[start][(PlaceOf(this->Triangles[start], vertex) + 2) % 3];
  }
  hole.Count = 0;
  std::uint32_t at = start;
  do
  {
    if (hole.Count == MostNeighbours)
    {
      return false;
    }
    const int place = PlaceOf(this->Triangles[at], vertex);
    hole.Points[hole.Count] = this->Triangles[at][(place + 1) % 3];
    hole.Triangles[hole.Count] = at;
    ++hole.Count;
    at = this->Neighbours[at][(place + 2) % 3];
  } while (at != start);
  return hole.Count > 2;
}

/** Checks the link condition, and that nothing new is between fixed vertices. The hole is filled
 *  from its first point. */
bool EdgeCollapses::KeepsTopology(const Hole& hole)
{
  const std::uint32_t target = hole.Points[0];
  if (hole.Count == 3 && !hole.IsOpen())
  {
    // The one new triangle must not exist on the other side, which may belong to another part.
    const std::uint32_t opposite = hole.Triangles[1];
    const std::uint32_t beyond =
      this->Neighbours[opposite][PlaceOf(this->Triangles[opposite], hole.Points[1])];
    const bool isThere = beyond == None
      ? std::all_of(hole.Points.begin(), hole.Points.begin() + hole.Count,
          [&](std::uint32_t point) { return this->IsFixed[point]; })
      : std::find(this->Triangles[beyond].begin(), this->Triangles[beyond].end(), target) !=
        this->Triangles[beyond].end();
    if (isThere)
    {
      return false;
    }
  }
  ++this->Mark;
  const int firstNew = hole.Triangles[0] == None ? 1 : 2;
  const int lastNew = hole.Count - (hole.Triangles[hole.Count - 1] == None ? 1 : 2);
  for (int i = firstNew; i <= lastNew; ++i)
  {
    if (this->IsFixed[target] && this->IsFixed[hole.Points[i]])
    {
      return false;
    }
    this->Marks[hole.Points[i]] = this->Mark;
  }
  bool isNew = true;
  this->ForEachNeighbour(target,
    [&](std::uint32_t neighbour, std::uint32_t /*triangle*/)
    { isNew = isNew && this->Marks[neighbour] != this->Mark; });
  return isNew;
}

void EdgeCollapses::Offer(std::uint32_t vertex, double cost, std::uint32_t target)
{
  // The next candidate after the one that was refused.
  Candidate best{ HUGE_VAL, vertex, None, this->Versions[vertex] };
  const Quadric& quadric = this->Quadrics[vertex];
  const bool isAtBorder = this->IsAtBorder[vertex];
  bool isFirst = true;
  this->ForEachNeighbour(vertex,
    [&](std::uint32_t neighbour, std::uint32_t triangle)
    {
      const bool isInside = isAtBorder && !std::exchange(isFirst, false) && triangle != None;
      if (isInside || this->IsLeftAlone[neighbour])
      {
        return;
      }
      const double price = quadric.At(this->Positions[neighbour]);
      const bool isLater = price > cost || (price == cost && neighbour > target);
      if (isLater && (price < best.Cost || (price == best.Cost && neighbour < best.Target)))
      {
        best.Cost = price;
        best.Target = neighbour;
      }
    });
  this->Best[vertex] = { best.Cost, best.Target, cost > -HUGE_VAL };
  if (best.Target != None)
  {
    this->Queue.push(best);
  }
  else if (this->Guard != nullptr)
  {
    this->Guard->NoteRefusal(vertex);
  }
}

/** Offers a vertex's best collapse, in place of what has been offered so far. */
void EdgeCollapses::OfferAnew(std::uint32_t vertex)
{
  ++this->Versions[vertex];
  this->Offer(vertex, -HUGE_VAL, 0);
}

/** The best collapse of a vertex may be another one after a neighbour collapsed into a target. */
void EdgeCollapses::OfferAgain(std::uint32_t vertex, std::uint32_t gone, std::uint32_t target)
{
  Price& best = this->Best[vertex];
  if (best.Target == None || best.WasRefused ||
    (vertex != target && this->Quadrics[vertex].At(this->Positions[target]) < best.Cost))
  {
    this->OfferAnew(vertex);
  }
  else if (vertex == target || best.Target == gone)
  {
    best.IsOld = true; // most likely not cheaper: seen to in its turn
  }
}

void EdgeCollapses::Collapse(std::uint32_t vertex, const Hole& hole)
{
  this->Note(vertex, hole);
  const int last = hole.Count - 1;
  const std::uint32_t target = hole.Points[0];
  const auto placeIn = [&](std::uint32_t triangle)
  { return PlaceOf(this->Triangles[triangle], vertex); };
  const std::uint32_t first = hole.Triangles[1];
  const std::uint32_t beforeLast = hole.Triangles[last - 1];
  this->Close(vertex, hole.Triangles[0], first, placeIn(first));
  this->Close(vertex, hole.Triangles[last], beforeLast, (placeIn(beforeLast) + 2) % 3);
  for (int i = 1; i < last; ++i)
  {
    const std::uint32_t triangle = hole.Triangles[i];
    this->Triangles[triangle][placeIn(triangle)] = target;
    this->Normals[triangle] = this->Fillings[i].Normal;
    this->FirstSample[triangle] = this->Fillings[i].FirstSample;
    for (std::uint32_t at = this->FirstSample[triangle]; at != None; at = this->Samples[at].Next)
    {
      this->Samples[at].Next = this->Samples[at].NextOver;
      this->Homes[at] = triangle;
    }
    this->AnyTriangle[hole.Points[i]] = triangle;
  }
  this->AnyTriangle[target] = first;
  this->AnyTriangle[hole.Points[last]] = beforeLast;
  this->AnyTriangle[vertex] = None;
  this->Quadrics[target].Add(this->Quadrics[vertex]);
  ++this->Versions[vertex];
  for (int i = 0; i < hole.Count; ++i)
  {
    const std::uint32_t point = hole.Points[i];
    if (this->MayGo(point))
    {
      this->OfferAgain(point, vertex, target);
    }
  }
}

/** Notes that a vertex is about to be removed, or moved. */
void EdgeCollapses::Note(std::uint32_t vertex, const Hole& hole)
{
  const auto number = static_cast<std::uint32_t>(this->Steps.size());
  this->Steps.push_back({ vertex, None, this->TrianglesOfSteps.size(), hole.Count });
  this->RemovedIn[vertex] = number;
  for (int i = 0; i < hole.Count; ++i)
  {
    this->TrianglesOfSteps.push_back(hole.Triangles[i]);
    this->PointsOfSteps.push_back(hole.Points[i]);
  }
  this->ForEachTriangleOf(
    this->Steps.back(), [&](std::uint32_t triangle) { this->LastStep[triangle] = number; });
}

/** Removes a triangle beside the edge that collapses, if there is one there: what is beyond it
 *  becomes the neighbour of one that stays. */
void EdgeCollapses::Close(std::uint32_t vertex, std::uint32_t gone, std::uint32_t stays, int edge)
{
  std::uint32_t beyond = None;
  if (gone != None)
  {
    beyond = this->Neighbours[gone][(PlaceOf(this->Triangles[gone], vertex) + 1) % 3];
    this->Triangles[gone][0] = None;
  }
  this->Neighbours[stays][edge] = beyond;
  if (beyond != None)
  {
    this->Neighbours[beyond][PlaceOf(this->Neighbours[beyond], gone)] = stays;
  }
}

bool EdgeCollapses::IsWorthATry(std::uint32_t vertex) const
{
  return !this->IsSettled[vertex] && (this->Guard == nullptr || this->Guard->IsWorthATry(vertex));
}

std::vector<bool> EdgeCollapses::Run()
{
  for (std::uint32_t point = 0; point < this->Positions.size(); ++point)
  {
    if (this->MayGo(point) && this->IsWorthATry(point))
    {
      this->Offer(point, -HUGE_VAL, 0);
    }
  }
  this->CollapseAll();
  if (this->Guard == nullptr)
  {
    this->MoveVertices();
    this->CollapseAll();
    this->FlipEdges();
  }
  std::vector<bool> isChanged(this->Triangles.size());
  for (const std::uint32_t triangle : this->TrianglesOfSteps)
  {
    if (triangle != None)
    {
      isChanged[triangle] = true;
    }
  }
  return isChanged;
}

/** Makes all collapses that are offered, and those that become possible, the cheapest first. */
void EdgeCollapses::CollapseAll()
{
  Hole hole;
  while (!this->Queue.empty())
  {
    const Candidate at = this->Queue.top();
    this->Queue.pop();
    if (at.Version != this->Versions[at.Vertex])
    {
      continue;
    }
    if (this->Best[at.Vertex].IsOld)
    {
      this->Offer(at.Vertex, -HUGE_VAL, 0);
    }
    else if (this->FindHole(at.Vertex, at.Target, hole) && this->KeepsTopology(hole) &&
      this->CanFill(at.Vertex, hole) &&
      (this->Guard == nullptr || this->Guard->Allows(at.Vertex, at.Target)))
    {
      if (this->Guard != nullptr)
      {
        this->Guard->Collapse(at.Vertex, at.Target);
      }
      this->Collapse(at.Vertex, hole);
    }
    else
    {
      this->Offer(at.Vertex, at.Cost, at.Target);
    }
  }
}

}
