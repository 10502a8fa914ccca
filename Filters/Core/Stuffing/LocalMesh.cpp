// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/LocalMesh.h"

#include "Stuffing/LinkCondition.h"

#include <cmath>
#include <utility>

namespace isodiamond
{

LocalMesh::LocalMesh(TetrahedronMesh mesh)
  : TheMesh(std::move(mesh))
  , Stars(TheMesh.Positions.size(), TheMesh.Tetrahedra.size(),
      [&](std::size_t tetrahedron) { return this->TheMesh.Tetrahedra[tetrahedron]; })
  , Changed(TheMesh.Positions.size(), None)
  , BlendOf(TheMesh.Positions.size(), None)
{
  this->Sines.reserve(this->TheMesh.Tetrahedra.size());
  for (const Corners& corners : this->TheMesh.Tetrahedra)
  {
    this->Sines.push_back(this->SineOf(corners));
  }
  for (std::uint32_t i = 0; i < this->TheMesh.Blended.size(); ++i)
  {
    this->BlendOf[this->TheMesh.Blended[i].Point] = i;
  }
}

LocalMesh::Star LocalMesh::StarOf(std::uint32_t point) const
{
  if (this->Changed[point] != None)
  {
    const std::vector<std::uint32_t>& star = this->ChangedStars[this->Changed[point]];
    return { star.data(), star.data() + star.size() };
  }
  return this->Stars[point];
}

std::vector<std::uint32_t>& LocalMesh::OwnStarOf(std::uint32_t point)
{
  if (this->Changed[point] == None)
  {
    const Star star = this->StarOf(point);
    this->Changed[point] = static_cast<std::uint32_t>(this->ChangedStars.size());
    this->ChangedStars.emplace_back(star.begin(), star.end());
  }
  return this->ChangedStars[this->Changed[point]];
}

double LocalMesh::WorstAround(std::uint32_t point) const
{
  double worst = 1.0;
  for (const std::uint32_t tetrahedron : this->StarOf(point))
  {
    worst = std::min(worst, this->Sines[tetrahedron]);
  }
  return worst;
}

bool LocalMesh::HasEdge(std::uint32_t a, std::uint32_t b) const
{
  const Star star = this->StarOf(a);
  return std::any_of(star.begin(), star.end(),
    [&](std::uint32_t tetrahedron) { return Has(this->CornersOf(tetrahedron), b); });
}

int LocalMesh::CountAt(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
{
  const Star star = this->StarOf(a);
  return static_cast<int>(std::count_if(star.begin(), star.end(),
    [&](std::uint32_t tetrahedron)
    { return Has(this->CornersOf(tetrahedron), b) && Has(this->CornersOf(tetrahedron), c); }));
}

int LocalMesh::PlaceOfFace(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
{
  const Face face = { a, b, c };
  const Walls::Type walls = WallsOfFace(this->TheMesh, face);
  const int surface = SurfaceOfFace(this->TheMesh, face);
  if (walls == 0 && surface != 0)
  {
    return surface < 0 ? LowerSurface : UpperSurface;
  }
  return walls;
}

bool LocalMesh::IsAmbiguous(const Corners& corners) const
{
  return std::any_of(corners.begin(), corners.end(),
    [&](std::uint32_t apex)
    {
      const Face face = Without(corners, apex);
      return SurfaceOfFace(this->TheMesh, face) != 0 && WallsOfFace(this->TheMesh, face) != 0;
    });
}

bool LocalMesh::CanCollapse(std::uint32_t from, std::uint32_t to) const
{
  const Walls::Type walls = this->TheMesh.OnWalls[from];
  const std::int8_t surface = this->TheMesh.Surfaces[from];
  if ((walls & Walls::Fixed) != 0 || (walls & ~this->TheMesh.OnWalls[to]) != 0 ||
    (surface != 0 && surface != this->TheMesh.Surfaces[to]))
  {
    return false;
  }
  for (const std::uint32_t tetrahedron : this->StarOf(from))
  {
    Corners fresh = this->CornersOf(tetrahedron);
    if (!Has(fresh, to))
    {
      std::replace(fresh.begin(), fresh.end(), from, to);
      if (this->IsAmbiguous(fresh))
      {
        return false;
      }
    }
  }
  return HaveOnlyTheirEdgeInCommon(*this, from, to) &&
    HaveOnlyTheirEdgeOnTheBoundary(*this, from, to);
}

bool LocalMesh::FindRing(std::uint32_t a, std::uint32_t b, std::size_t most, Ring& ring) const
{
  ring.Points.clear();
  ring.Tetrahedra.clear();
  std::vector<Edge> steps;
  for (const std::uint32_t tetrahedron : this->StarOf(a))
  {
    const Corners& corners = this->CornersOf(tetrahedron);
    if (Has(corners, b))
    {
      Edge step = Without(corners, a, b);
      if (SixVolumes(this->At(a), this->At(b), this->At(step[0]), this->At(step[1])) < 0.0)
      {
        std::swap(step[0], step[1]);
      }
      ring.Tetrahedra.push_back(tetrahedron);
      steps.push_back(step);
    }
  }
  if (steps.empty() || steps.size() > most)
  {
    return false;
  }
  const auto stepTo = [&](std::uint32_t point)
  {
    return std::find_if(
      steps.begin(), steps.end(), [&](const Edge& step) { return step[1] == point; });
  };
  const auto stepFrom = [&](std::uint32_t point)
  {
    return std::find_if(
      steps.begin(), steps.end(), [&](const Edge& step) { return step[0] == point; });
  };
  std::uint32_t at = steps[0][0];
  for (std::size_t i = 0; i < steps.size() && stepTo(at) != steps.end(); ++i)
  {
    at = (*stepTo(at))[0];
  }
  ring.IsClosed = stepTo(at) != steps.end();
  ring.Points = { at };
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const auto step = stepFrom(at);
    if (step == steps.end())
    {
      return false; // several paths
    }
    at = (*step)[1];
    ring.Points.push_back(at);
  }
  if (ring.IsClosed)
  {
    ring.Points.pop_back();
    return at == ring.Points.front();
  }
  return true;
}

/** The points that a point is blended from. */
std::vector<Share> LocalMesh::SharesOf(std::uint32_t point) const
{
  return this->BlendOf[point] == None ? std::vector<Share>{ { point, 1.0 } }
                                      : this->TheMesh.Blended[this->BlendOf[point]].Shares;
}

void LocalMesh::NoteShares(std::uint32_t point, const std::vector<Share>& shares)
{
  std::vector<Share> all;
  for (const Share& share : shares)
  {
    for (const Share& part : this->SharesOf(share.Point))
    {
      all.push_back({ part.Point, share.Part * part.Part });
    }
  }
  // One for each point. There can be hundreds, where points move often.
  std::stable_sort(
    all.begin(), all.end(), [](const Share& a, const Share& b) { return a.Point < b.Point; });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    if (all[i].Point == all[kept].Point)
    {
      all[kept].Part += all[i].Part;
    }
    else
    {
      all[++kept] = all[i];
    }
  }
  all.resize(std::min(kept + 1, all.size()));
  if (this->BlendOf[point] == None)
  {
    this->BlendOf[point] = static_cast<std::uint32_t>(this->TheMesh.Blended.size());
    this->TheMesh.Blended.push_back({ point, {} });
  }
  this->TheMesh.Blended[this->BlendOf[point]].Shares = std::move(all);
}

void LocalMesh::Move(std::uint32_t point, const Vector& to)
{
  // Attributes are those that the tetrahedra around it now have there.
  double best = -HUGE_VAL;
  std::vector<Share> shares;
  for (const std::uint32_t tetrahedron : this->StarOf(point))
  {
    const Corners& corners = this->CornersOf(tetrahedron);
    std::array<Vector, 4> at{};
    std::transform(corners.begin(), corners.end(), at.begin(),
      [&](std::uint32_t corner) { return this->At(corner); });
    const double whole = SixVolumes(at[0], at[1], at[2], at[3]);
    std::vector<Share> parts;
    double least = HUGE_VAL;
    for (int i = 0; i < 4; ++i)
    {
      std::array<Vector, 4> moved = at;
      moved[i] = to;
      parts.push_back({ corners[i], SixVolumes(moved[0], moved[1], moved[2], moved[3]) / whole });
      least = std::min(least, parts.back().Part);
    }
    if (least > best)
    {
      best = least;
      shares = std::move(parts);
    }
  }
  this->NoteShares(point, shares);
  this->TheMesh.Positions[point] = to;
  for (const std::uint32_t tetrahedron : this->StarOf(point))
  {
    this->Sines[tetrahedron] = this->SineOf(this->CornersOf(tetrahedron));
  }
}

void LocalMesh::Add(
  const Corners& corners, std::uint32_t origin, std::vector<std::uint32_t>& changed)
{
  const auto id = static_cast<std::uint32_t>(this->TheMesh.Tetrahedra.size());
  this->TheMesh.Tetrahedra.push_back(corners);
  this->TheMesh.Origins.push_back(origin);
  this->Sines.push_back(this->SineOf(corners));
  for (const std::uint32_t point : corners)
  {
    this->OwnStarOf(point).push_back(id);
  }
  changed.push_back(id);
}

void LocalMesh::Remove(std::uint32_t tetrahedron)
{
  for (const std::uint32_t point : this->CornersOf(tetrahedron))
  {
    std::vector<std::uint32_t>& star = this->OwnStarOf(point);
    star.erase(std::find(star.begin(), star.end(), tetrahedron));
  }
  this->Sines[tetrahedron] = Dead;
}

void LocalMesh::Collapse(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& changed)
{
  const std::vector<std::uint32_t> star(this->StarOf(from).begin(), this->StarOf(from).end());
  for (const std::uint32_t tetrahedron : star)
  {
    Corners corners = this->CornersOf(tetrahedron);
    this->Remove(tetrahedron);
    if (!Has(corners, to))
    {
      std::replace(corners.begin(), corners.end(), from, to);
      this->Add(corners, this->TheMesh.Origins[tetrahedron], changed);
    }
  }
}

void LocalMesh::Replace(const std::vector<std::uint32_t>& old, const std::vector<Corners>& fresh,
  std::vector<std::uint32_t>& changed)
{
  const std::uint32_t origin = this->TheMesh.Origins[old.front()];
  std::for_each(
    old.begin(), old.end(), [&](std::uint32_t tetrahedron) { this->Remove(tetrahedron); });
  std::for_each(fresh.begin(), fresh.end(),
    [&](const Corners& corners) { this->Add(corners, origin, changed); });
}

void LocalMesh::Exchange(
  std::uint32_t point, std::uint32_t other, std::vector<std::uint32_t>& changed)
{
  const std::vector<std::uint32_t> star(this->StarOf(point).begin(), this->StarOf(point).end());
  for (const std::uint32_t tetrahedron : star)
  {
    Corners corners = this->CornersOf(tetrahedron);
    std::replace(corners.begin(), corners.end(), point, other);
    this->Replace({ tetrahedron }, { corners }, changed);
  }
}

void LocalMesh::PutBack(
  const std::vector<std::uint32_t>& old, const std::vector<std::uint32_t>& fresh)
{
  std::for_each(
    fresh.begin(), fresh.end(), [&](std::uint32_t tetrahedron) { this->Remove(tetrahedron); });
  for (const std::uint32_t tetrahedron : old)
  {
    const Corners& corners = this->CornersOf(tetrahedron);
    this->Sines[tetrahedron] = this->SineOf(corners);
    for (const std::uint32_t point : corners)
    {
      this->OwnStarOf(point).push_back(tetrahedron);
    }
  }
}

std::uint32_t LocalMesh::AddPoint(
  const Vector& at, std::int8_t surface, Walls::Type walls, const std::vector<Share>& shares)
{
  const auto point = static_cast<std::uint32_t>(this->TheMesh.Positions.size());
  this->TheMesh.Positions.push_back(at);
  this->TheMesh.Surfaces.push_back(surface);
  this->TheMesh.OnWalls.push_back(walls);
  this->Changed.push_back(static_cast<std::uint32_t>(this->ChangedStars.size()));
  this->ChangedStars.emplace_back();
  this->BlendOf.push_back(None);
  this->NoteShares(point, shares);
  return point;
}

TetrahedronMesh LocalMesh::Take()
{
  TetrahedronMesh mesh = std::move(this->TheMesh);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.Tetrahedra.size(); ++i)
  {
    if (this->Sines[i] != Dead)
    {
      mesh.Tetrahedra[kept] = mesh.Tetrahedra[i];
      mesh.Origins[kept++] = mesh.Origins[i];
    }
  }
  mesh.Tetrahedra.resize(kept);
  mesh.Origins.resize(kept);
  return mesh;
}

}
