// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/BestChange.h"

#include "Stuffing/BestPlace.h"
#include "Stuffing/RingFilling.h"
#include "Stuffing/Shortfall.h"
#include "Stuffing/SurfaceChanges.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace isodiamond
{
namespace
{

/** Gaining less than this part of what a tetrahedron lacks is no improvement. */
constexpr double LeastGain = 0.01;
/** How far a point on a surface may move, as a part of its edge. */
constexpr double MostOfEdge = 0.25;

/** Random changes leave tetrahedra with at least this part of the wanted sine. */
constexpr double LeastPartByChance = 0.1;

/** Tries all changes around one tetrahedron after the other. */
class ChangeSearch
{
public:
  /** @param chance picks any change instead of the best one, if not null */
  ChangeSearch(
    const LocalMesh& mesh, const ImprovementOptions& options, std::minstd_rand* chance = nullptr)
    : Mesh(mesh)
    , Options(options)
    , Chance(chance)
    , Wanted(WantedSine(options))
  {
  }

  /** Tries all in random order, until one can be done. */
  Change FindAny(std::uint32_t tetrahedron)
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

  Change FindBest(std::uint32_t tetrahedron)
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

  bool Helps(const Change& change, std::uint32_t tetrahedron)
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

private:
  double GainWanted(std::uint32_t tetrahedron) const
  {
    return LeastGain * ShortfallOf(this->Mesh.SineOf(tetrahedron), this->Wanted);
  }

  template <typename Body>
  static void ForEachEdge(const Corners& corners, Body&& body)
  {
    for (int i = 0; i < 4; ++i)
    {
      for (int j = i + 1; j < 4; ++j)
      {
        body(corners[i], corners[j]);
      }
    }
  }

  template <typename Tetrahedra>
  Shortfall LackOf(const Tetrahedra& tetrahedra) const
  {
    Shortfall sum(this->Wanted);
    for (const auto& tetrahedron : tetrahedra)
    {
      sum.Add(this->Mesh.SineOf(tetrahedron));
    }
    return sum;
  }

  /** What the tetrahedra of a star lack with its point at a place. */
  Shortfall LackAt(const PointStar& star, const Vector& place) const
  {
    Shortfall sum(this->Wanted);
    star.ForEachSine(place, [&](double sine) { sum.Add(sine); });
    return sum;
  }

  bool IsBetterAt(std::uint32_t point, const Vector& place) const
  {
    return this->IsBetter(
      this->LackOf(this->Mesh.StarOf(point)), this->LackAt(FacesAround(this->Mesh, point), place));
  }

  /** Whether a change would be the best one so far: the worst gets no worse, and all together
   *  better. If chance picks, whether it could be done. */
  bool IsBetter(const Shortfall& before, const Shortfall& after) const
  {
    return this->Chance == nullptr
      ? after.Worst >= before.Worst && before.Sum - after.Sum > this->Best.Gain
      : after.Worst >= LeastPartByChance * this->Wanted;
  }
  /** Begins a new best change. */
  Change& Take(Change::Kinds kind, const Shortfall& before, const Shortfall& after)
  {
    this->Best = Change();
    this->Best.Kind = kind;
    this->Best.Gain = before.Sum - after.Sum;
    return this->Best;
  }

  //--- Moves ------------------------------------------------------------------

  void TryToMove(std::uint32_t point)
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
    const PlacedPoint best = BestPlace(star, this->Mesh.At(point), this->Mesh.Mesh().OnWalls[point],
      this->Options.Axes, this->Wanted);
    const Shortfall after = this->LackAt(star, best.Place);
    if (this->IsBetter(before, after))
    {
      Change& move = this->Take(Change::Move, before, after);
      move.Point = point;
      move.Place = best.Place;
    }
  }

  //--- Edges that shrink ------------------------------------------------------

  void TryToCollapse(std::uint32_t from, std::uint32_t to)
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

  //--- Edges and faces that go ------------------------------------------------

  void TryToRemoveEdge(std::uint32_t a, std::uint32_t b)
  {
    LocalMesh::Ring ring;
    if (!this->Mesh.FindRing(a, b, MostAround, ring) || !this->CanRemoveEdge(a, b, ring))
    {
      return;
    }
    const Shortfall before = this->LackOf(ring.Tetrahedra);
    std::vector<Corners> fresh;
    FillRing(this->Mesh, a, b, ring.Points, fresh);
    const Shortfall after = this->LackOf(fresh);
    if (this->IsBetter(before, after) && this->AreNew(ring, fresh))
    {
      Change& replace = this->Take(Change::Replace, before, after);
      replace.Point = a;
      replace.Other = b;
      replace.Old = ring.Tetrahedra;
      replace.Fresh = std::move(fresh);
    }
  }

  /** Whether an edge can go. */
  bool CanRemoveEdge(std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring) const
  {
    return ring.Points.size() >= 3 &&
      (ring.IsClosed ||
        CanTurn(this->Mesh, a, b, ring, std::max(this->SurfaceMoveAt(a), this->SurfaceMoveAt(b))));
  }

  /** Whether a change replaces exactly the tetrahedra around its edge. */
  bool IsAllAround(const Change& change, LocalMesh::Ring& ring) const
  {
    return this->Mesh.FindRing(change.Point, change.Other, MostAround, ring) &&
      std::is_permutation(
        ring.Tetrahedra.begin(), ring.Tetrahedra.end(), change.Old.begin(), change.Old.end());
  }

  bool CanReplace(const Change& change) const
  {
    if (!this->Mesh.HasEdge(change.Point, change.Other))
    {
      return true; // the new tetrahedra bring it: there is nothing else to check
    }
    LocalMesh::Ring ring;
    return this->IsAllAround(change, ring) &&
      this->CanRemoveEdge(change.Point, change.Other, ring) && this->AreNew(ring, change.Fresh);
  }

  /** Whether edges, and a lone triangle, between points around an edge are not in the mesh yet, and
   *  it is clear what is on a surface. */
  bool AreNew(const LocalMesh::Ring& ring, const std::vector<Corners>& fresh) const
  {
    const std::vector<std::uint32_t>& points = ring.Points;
    if (std::any_of(fresh.begin(), fresh.end(),
          [&](const Corners& corners) { return this->Mesh.IsAmbiguous(corners); }))
    {
      return false;
    }
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      for (std::size_t j = i + 2; j < points.size(); ++j)
      {
        const bool isSide = ring.IsClosed && i == 0 && j + 1 == points.size();
        const bool isUsed = std::any_of(fresh.begin(), fresh.end(),
          [&](const Corners& corners)
          { return Has(corners, points[i]) && Has(corners, points[j]); });
        if (!isSide && isUsed && this->Mesh.HasEdge(points[i], points[j]))
        {
          return false;
        }
      }
    }
    return points.size() > 3 || this->Mesh.CountAt(points[0], points[1], points[2]) == 0;
  }

  /** Turns the two tetrahedra at the face opposite to a point into three. */
  void TryToRemoveFace(std::uint32_t tetrahedron, std::uint32_t apex)
  {
    const Corners& corners = this->Mesh.CornersOf(tetrahedron);
    Face face = Without(corners, apex);
    const LocalMesh::Star star = this->Mesh.StarOf(face[0]);
    const auto other = std::find_if(star.begin(), star.end(),
      [&](std::uint32_t candidate)
      {
        const Corners& points = this->Mesh.CornersOf(candidate);
        return candidate != tetrahedron && Has(points, face[1]) && Has(points, face[2]);
      });
    if (other == star.end())
    {
      return;
    }
    const Corners& beyond = this->Mesh.CornersOf(*other);
    const std::uint32_t far = *std::find_if(beyond.begin(), beyond.end(),
      [&](std::uint32_t corner)
      { return std::find(face.begin(), face.end(), corner) == face.end(); });
    if (SixVolumes(this->Mesh.At(face[0]), this->Mesh.At(face[1]), this->Mesh.At(face[2]),
          this->Mesh.At(apex)) < 0.0)
    {
      std::swap(face[1], face[2]);
    }
    std::vector<Corners> fresh = { { far, apex, face[0], face[1] }, { far, apex, face[1], face[2] },
      { far, apex, face[2], face[0] } };
    std::vector<std::uint32_t> old = { tetrahedron, *other };
    const Shortfall before = this->LackOf(old);
    const Shortfall after = this->LackOf(fresh);
    if (this->IsBetter(before, after) && !this->Mesh.HasEdge(apex, far))
    {
      Change& replace = this->Take(Change::Replace, before, after);
      replace.Point = apex;
      replace.Other = far;
      replace.Old = std::move(old);
      replace.Fresh = std::move(fresh);
    }
  }

  //--- New points -------------------------------------------------------------

  /** Puts a point into the middle of an edge, inside or in a wall, and moves it. */
  void TryToSplit(std::uint32_t a, std::uint32_t b)
  {
    LocalMesh::Ring ring;
    if (!this->Mesh.FindRing(a, b, MostAround, ring))
    {
      return;
    }
    const std::optional<Walls::Type> walls = this->WallsOfMiddle(a, b, ring);
    if (!walls)
    {
      return;
    }
    std::vector<Corners> fresh;
    PointStar star = this->HalvesAround(a, b, ring, &fresh);
    const PlacedPoint best = BestPlace(
      star, 0.5 * (this->Mesh.At(a) + this->Mesh.At(b)), *walls, this->Options.Axes, this->Wanted);
    const Shortfall before = this->LackOf(ring.Tetrahedra);
    const Shortfall after = this->LackAt(star, best.Place);
    if (this->IsBetter(before, after))
    {
      Change& split = this->Take(Change::Split, before, after);
      split.Point = a;
      split.Other = b;
      split.Place = best.Place;
      split.OnWalls = *walls;
      split.Old = ring.Tetrahedra;
      split.Fresh = std::move(fresh);
    }
  }

  /** The walls that a new point in the middle of an edge is on; none if no point may be put there:
   *  the edge lies on a surface, or where two walls meet. */
  std::optional<Walls::Type> WallsOfMiddle(
    std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring) const
  {
    const int place = ring.IsClosed ? 0 : this->Mesh.PlaceOfFace(a, b, ring.Points.front());
    const bool isOneWall = place != 0 && place < Walls::Fixed &&
      place == this->Mesh.PlaceOfFace(a, b, ring.Points.back());
    return ring.IsClosed || isOneWall ? std::optional(static_cast<Walls::Type>(place))
                                      : std::nullopt;
  }

  /** The halves of the tetrahedra around an edge, which have a new point in common.
   *  @param fresh receives them, if not null */
  PointStar HalvesAround(std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring,
    std::vector<Corners>* fresh = nullptr) const
  {
    PointStar star;
    for (const std::uint32_t tetrahedron : ring.Tetrahedra)
    {
      for (const std::uint32_t end : { a, b })
      {
        Corners corners = this->Mesh.CornersOf(tetrahedron);
        star.Add(this->Mesh.Mesh(), corners, end);
        if (fresh != nullptr)
        {
          std::replace(corners.begin(), corners.end(), end, Change::NewPoint);
          fresh->push_back(corners);
        }
      }
    }
    return star;
  }

  bool CanSplit(const Change& change) const
  {
    LocalMesh::Ring ring;
    return this->IsAllAround(change, ring) &&
      this->WallsOfMiddle(change.Point, change.Other, ring) == change.OnWalls &&
      this->IsBetter(this->LackOf(change.Old),
        this->LackAt(this->HalvesAround(change.Point, change.Other, ring), change.Place));
  }

  //--- Points on surfaces -----------------------------------------------------

  /** How far a surface may get from where it was, at a point on it. */
  double SurfaceMoveAt(std::uint32_t point) const
  {
    const std::uint32_t source = this->Mesh.SourceOf(point);
    const double most =
      source < this->Options.CutEdges.size() ? this->Options.CutEdges[source].MostMove : HUGE_VAL;
    return std::min(this->Options.SurfaceMove, most);
  }

  /** How far a point on a surface may move; 0 for not at all. */
  double MostShift(std::uint32_t point) const
  {
    const std::uint32_t source = this->Mesh.SourceOf(point); // where the surface is
    if (this->Mesh.Mesh().Surfaces[point] == 0 || source >= this->Options.CutEdges.size())
    {
      return 0.0;
    }
    return std::min(this->SurfaceMoveAt(point), MostOfEdge * this->Options.CutEdges[source].Length);
  }
  bool MayShift(std::uint32_t point, const Vector& place) const
  {
    const double most = this->MostShift(point);
    const std::uint32_t source = this->Mesh.SourceOf(point);
    const Vector& from = this->Mesh.At(source);
    return most > 0.0 && Dot(place - from, place - from) <= most * most &&
      IsBeside(this->Options.CutEdges[source], this->InLattice(from), this->InLattice(place));
  }
  /** A place where cut edges are. */
  Vector InLattice(const Vector& place) const
  {
    return this->Options.World != nullptr ? this->Options.World->IndexAt(place) : place;
  }

  void TryToShift(std::uint32_t point)
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

  const LocalMesh& Mesh;
  const ImprovementOptions& Options;
  std::minstd_rand* Chance;
  double Wanted; ///< sine
  Change Best;
};

}

Change BestChange(
  const LocalMesh& mesh, const ImprovementOptions& options, std::uint32_t tetrahedron)
{
  return ChangeSearch(mesh, options).FindBest(tetrahedron);
}

bool Helps(const Change& change, const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron)
{
  return ChangeSearch(mesh, options).Helps(change, tetrahedron);
}

Change AnyChange(const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron, std::minstd_rand& random)
{
  return ChangeSearch(mesh, options, &random).FindAny(tetrahedron);
}

}
