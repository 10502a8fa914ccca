// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/ChangeSearch.h"

#include "Stuffing/SurfaceChanges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace isodiamond
{
namespace
{

/** How far a point on a surface may move, as a part of its edge. */
constexpr double MostOfEdge = 0.25;

}

Change ChangeSearch::FindAny(std::uint32_t tetrahedron)
{
  const Corners corners = this->Mesh.CornersOf(tetrahedron);
  using Try = std::function<void()>;
  std::vector<Try> tries;
  for (const std::uint32_t point : corners)
  {
    tries.emplace_back([=] { this->TryToMove(point); });
    tries.emplace_back([=] { this->TryToShift(point); });
    tries.emplace_back([=] { this->TryToRemoveFace(tetrahedron, point); });
  }
  this->ForEachEdge(corners,
    [&](std::uint32_t a, std::uint32_t b)
    {
      tries.emplace_back([=] { this->TryToCollapse(a, b); });
      tries.emplace_back([=] { this->TryToCollapse(b, a); });
      tries.emplace_back([=] { this->TryToRemoveEdge(a, b); });
      tries.emplace_back([=] { this->TryToSplit(a, b); });
    });
  for (; !tries.empty() && this->Best.Kind == Change::None; tries.pop_back())
  {
    std::swap(tries[(*this->Chance)() % tries.size()], tries.back());
    tries.back()();
  }
  return std::move(this->Best);
}

Change ChangeSearch::FindBest(std::uint32_t tetrahedron)
{
  const Corners corners = this->Mesh.CornersOf(tetrahedron);
  this->Best.Gain = this->GainWanted(tetrahedron);
  for (const std::uint32_t point : corners)
  {
    this->TryToMove(point);
  }
  this->ForEachEdge(corners,
    [&](std::uint32_t a, std::uint32_t b)
    {
      this->TryToCollapse(a, b);
      this->TryToCollapse(b, a);
    });
  this->ForEachEdge(
    corners, [&](std::uint32_t a, std::uint32_t b) { this->TryToRemoveEdge(a, b); });
  for (const std::uint32_t point : corners)
  {
    this->TryToRemoveFace(tetrahedron, point);
  }
  if (this->Best.Kind == Change::None)
  {
    this->ForEachEdge(corners, [&](std::uint32_t a, std::uint32_t b) { this->TryToSplit(a, b); });
  }
  for (const std::uint32_t point : corners)
  {
    if (this->Best.Kind == Change::None || this->Best.Kind == Change::Shift)
    {
      this->TryToShift(point);
    }
  }
  return std::move(this->Best);
}

bool ChangeSearch::Helps(const Change& change, std::uint32_t tetrahedron)
{
  this->Best.Gain = this->GainWanted(tetrahedron);
  switch (change.Kind)
  {
    case Change::None:
      return false;
    case Change::Move:
      return this->IsBetterAt(change.Point, change.Place);
    case Change::Collapse:
      this->TryToCollapse(change.Point, change.Other);
      return this->Best.Kind == Change::Collapse;
    case Change::Replace:
      return this->IsBetter(this->LackOf(change.Old), this->LackOf(change.Fresh)) &&
        this->CanReplace(change);
    case Change::Split:
      return this->CanSplit(change);
    case Change::Shift:
      return this->MayShift(change.Point, change.Place) &&
        this->IsBetterAt(change.Point, change.Place) &&
        CanShift(this->Mesh, change.Point, change.Place);
  }
  return false;
}

//--- Moves -----------------------------------------------------------------

void ChangeSearch::TryToMove(std::uint32_t point)
{
  if (this->Mesh.Mesh().Surfaces[point] != 0)
  {
    return;
  }
  const Shortfall before = this->LackOf(this->Mesh.StarOf(point));
  if (this->Chance == nullptr && !(before.Sum > this->Best.Gain))
  {
    return;
  }
  PointStar star = FacesAround(this->Mesh, point);
  const PlacedPoint best = BestPlace(
    star, this->Mesh.At(point), this->Mesh.Mesh().OnWalls[point], this->Options.Axes, this->Wanted);
  const Shortfall after = this->LackAt(star, best.Place);
  if (this->IsBetter(before, after))
  {
    Change& move = this->Take(Change::Move, before, after);
    move.Point = point;
    move.Place = best.Place;
  }
}

//--- Edges that shrink -----------------------------------------------------

void ChangeSearch::TryToCollapse(std::uint32_t from, std::uint32_t to)
{
  const Shortfall before = this->LackOf(this->Mesh.StarOf(from));
  Shortfall after(this->Wanted);
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(from))
  {
    Corners corners = this->Mesh.CornersOf(tetrahedron);
    if (!Has(corners, to))
    {
      std::replace(corners.begin(), corners.end(), from, to);
      after.Add(this->Mesh.SineOf(corners));
      if (!this->IsBetter(before, after))
      {
        return;
      }
    }
  }
  if (this->IsBetter(before, after) && this->Mesh.CanCollapse(from, to) &&
    StaysNear(this->Mesh, from, to, this->SurfaceMoveAt(from)))
  {
    Change& collapse = this->Take(Change::Collapse, before, after);
    collapse.Point = from;
    collapse.Other = to;
  }
}

//--- Points on surfaces ----------------------------------------------------

/** How far a surface may get from where it was, at a point on it. */
double ChangeSearch::SurfaceMoveAt(std::uint32_t point) const
{
  const std::uint32_t source = this->Mesh.SourceOf(point);
  const double most =
    source < this->Options.CutEdges.size() ? this->Options.CutEdges[source].MostMove : HUGE_VAL;
  return std::min(this->Options.SurfaceMove, most);
}

/** How far a point on a surface may move; 0 for not at all. */
double ChangeSearch::MostShift(std::uint32_t point) const
{
  const std::uint32_t source = this->Mesh.SourceOf(point); // where the surface is
  if (this->Mesh.Mesh().Surfaces[point] == 0 || source >= this->Options.CutEdges.size())
  {
    return 0.0;
  }
  return std::min(this->SurfaceMoveAt(point), MostOfEdge * this->Options.CutEdges[source].Length);
}

bool ChangeSearch::MayShift(std::uint32_t point, const Vector& place) const
{
  const double most = this->MostShift(point);
  const std::uint32_t source = this->Mesh.SourceOf(point);
  const Vector& from = this->Mesh.At(source);
  return most > 0.0 && Dot(place - from, place - from) <= most * most &&
    IsBeside(this->Options.CutEdges[source], this->InLattice(from), this->InLattice(place));
}

/** A place where cut edges are. */
Vector ChangeSearch::InLattice(const Vector& place) const
{
  return this->Options.World != nullptr ? this->Options.World->IndexAt(place) : place;
}

void ChangeSearch::TryToShift(std::uint32_t point)
{
  const double most = this->MostShift(point);
  if (!(most > 0.0))
  {
    return;
  }
  const Reach reach{ 0.5 * most,
    [&](const Vector& place) { return this->MayShift(point, place); } };
  PointStar star = FacesAround(this->Mesh, point);
  const Shortfall before = this->LackOf(this->Mesh.StarOf(point));
  const PlacedPoint best = BestPlace(star, this->Mesh.At(point), this->Mesh.Mesh().OnWalls[point],
    this->Options.Axes, this->Wanted, reach);
  const Shortfall after = this->LackAt(star, best.Place);
  if (this->IsBetter(before, after) && CanShift(this->Mesh, point, best.Place))
  {
    Change& shift = this->Take(Change::Shift, before, after);
    shift.Point = point;
    shift.Place = best.Place;
  }
}

}
