// SPDX-License-Identifier: BSD-3-Clause
// The changes that replace the tetrahedra around an edge or a face.
#include "Stuffing/ChangeSearch.h"
#include "Stuffing/RingFilling.h"
#include "Stuffing/SurfaceChanges.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace isodiamond
{

void ChangeSearch::TryToRemoveEdge(std::uint32_t a, std::uint32_t b)
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
bool ChangeSearch::CanRemoveEdge(
  std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring) const
{
  return ring.Points.size() >= 3 &&
    (ring.IsClosed ||
      CanTurn(this->Mesh, a, b, ring, std::max(this->SurfaceMoveAt(a), this->SurfaceMoveAt(b))));
}

/** Whether a change replaces exactly the tetrahedra around its edge. */
bool ChangeSearch::IsAllAround(const Change& change, LocalMesh::Ring& ring) const
{
  return this->Mesh.FindRing(change.Point, change.Other, MostAround, ring) &&
    std::is_permutation(
      ring.Tetrahedra.begin(), ring.Tetrahedra.end(), change.Old.begin(), change.Old.end());
}

bool ChangeSearch::CanReplace(const Change& change) const
{
  if (!this->Mesh.HasEdge(change.Point, change.Other))
  {
    return true; // the new tetrahedra bring it: there is nothing else to check
  }
  LocalMesh::Ring ring;
  return this->IsAllAround(change, ring) && this->CanRemoveEdge(change.Point, change.Other, ring) &&
    this->AreNew(ring, change.Fresh);
}

/** Whether edges, and a lone triangle, between points around an edge are not in the mesh yet, and
 *  it is clear what is on a surface. */
bool ChangeSearch::AreNew(const LocalMesh::Ring& ring, const std::vector<Corners>& fresh) const
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
        [&](const Corners& corners) { return Has(corners, points[i]) && Has(corners, points[j]); });
      if (!isSide && isUsed && this->Mesh.HasEdge(points[i], points[j]))
      {
        return false;
      }
    }
  }
  return points.size() > 3 || this->Mesh.CountAt(points[0], points[1], points[2]) == 0;
}

/** Turns the two tetrahedra at the face opposite to a point into three. */
void ChangeSearch::TryToRemoveFace(std::uint32_t tetrahedron, std::uint32_t apex)
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

//--- New points ------------------------------------------------------------

/** Puts a point into the middle of an edge, inside or in a wall, and moves it. */
void ChangeSearch::TryToSplit(std::uint32_t a, std::uint32_t b)
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
std::optional<Walls::Type> ChangeSearch::WallsOfMiddle(
  std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring) const
{
  const int place = ring.IsClosed ? 0 : this->Mesh.PlaceOfFace(a, b, ring.Points.front());
  const bool isOneWall =
    place != 0 && place < Walls::Fixed && place == this->Mesh.PlaceOfFace(a, b, ring.Points.back());
  return ring.IsClosed || isOneWall ? std::optional(static_cast<Walls::Type>(place)) : std::nullopt;
}

/** The halves of the tetrahedra around an edge, which have a new point in common.
 *  @param fresh receives them, if not null */
PointStar ChangeSearch::HalvesAround(
  std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring, std::vector<Corners>* fresh) const
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

bool ChangeSearch::CanSplit(const Change& change) const
{
  LocalMesh::Ring ring;
  return this->IsAllAround(change, ring) &&
    this->WallsOfMiddle(change.Point, change.Other, ring) == change.OnWalls &&
    this->IsBetter(this->LackOf(change.Old),
      this->LackAt(this->HalvesAround(change.Point, change.Other, ring), change.Place));
}

}
