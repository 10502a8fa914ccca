// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/TetrahedronCollapses.h"

#include "Stuffing/Relaxation.h"
#include "Stuffing/SearchAhead.h"

#include <algorithm>
#include <cmath>

namespace isodiamond
{
namespace
{

///@{
/** How long an edge may get, in times the longest edge that one of its ends had, by where the
 * vertex that goes is: a solution needs cells inside, a flat surface hardly any. */
constexpr double MostTimesInside = 1.25;
constexpr double MostTimesOnSurfaces = 2.0;
///@}

/** The part of the volume that may come or go. */
constexpr double MostOfVolume = 0.005;

/** A point stays where it is if all angles around it are at least this many degrees. */
constexpr double RelaxedAngle = 30.0;

/** Vertices whose edges are looked at at the same time: few of them are neighbours. */
constexpr std::size_t TriesAtOnce = 64;

}

TetrahedronCollapses::TetrahedronCollapses(
  TetrahedronMesh mesh, double leastAngle, const VolumeRange& wanted)
  : Mesh(std::move(mesh))
  , LeastSine(std::sin(leastAngle / DegreesOfRadian))
  , WantedVolume(wanted)
  , Volume(VolumeOf(this->Mesh.Mesh()))
  , MostOutside(std::max(MostOfVolume * wanted.Most, wanted.Outside(this->Volume)))
  , Longest(this->Mesh.Mesh().Positions.size())
  , IsTried(this->Longest.size())
  , IsShortOfVolume(this->Longest.size())
{
  for (const Corners& corners : this->Mesh.Mesh().Tetrahedra)
  {
    for (const std::uint32_t a : corners)
    {
      for (const std::uint32_t b : corners)
      {
        const Vector edge = this->Mesh.At(b) - this->Mesh.At(a);
        this->Longest[a] = std::max(this->Longest[a], Dot(edge, edge));
      }
    }
  }
}

/** How long an edge may get, squared. @param mostTimes as long as the longest one around was */
double TetrahedronCollapses::MostLength(std::uint32_t a, std::uint32_t b, double mostTimes) const
{
  return mostTimes * mostTimes * std::max(this->Longest[a], this->Longest[b]);
}

/** Whether an edge would be too long. */
bool TetrahedronCollapses::IsLong(std::uint32_t a, std::uint32_t b, double mostTimes) const
{
  const Vector edge = this->Mesh.At(b) - this->Mesh.At(a);
  return Dot(edge, edge) > this->MostLength(a, b, mostTimes);
}

/** Whether each edge of a point would be short enough at a place, or no longer than it is now. */
bool TetrahedronCollapses::KeepsEdgesShort(std::uint32_t point, const Vector& place) const
{
  const LocalMesh::Star star = this->Mesh.StarOf(point);
  return std::all_of(star.begin(), star.end(),
    [&](std::uint32_t tetrahedron)
    {
      const Corners& corners = this->Mesh.CornersOf(tetrahedron);
      return std::all_of(corners.begin(), corners.end(),
        [&](std::uint32_t corner)
        {
          const Vector now = this->Mesh.At(corner) - this->Mesh.At(point);
          const Vector then = this->Mesh.At(corner) - place;
          return corner == point ||
            Dot(then, then) <=
            std::max(Dot(now, now), this->MostLength(point, corner, MostTimesInside));
        });
    });
}

double TetrahedronCollapses::SineNeeded(std::uint32_t vertex) const
{
  return std::min(this->LeastSine, this->Mesh.WorstAround(vertex));
}

/** The smallest sine after a collapse; if less than needed, or if an edge is too long, any value
 *  less than needed. */
double TetrahedronCollapses::SineAfter(
  std::uint32_t vertex, std::uint32_t target, double needed) const
{
  const double mostTimes =
    this->Mesh.Mesh().Surfaces[vertex] == 0 ? MostTimesInside : MostTimesOnSurfaces;
  double sine = 1.0;
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    Corners corners = this->Mesh.CornersOf(tetrahedron);
    if (Has(corners, target))
    {
      continue;
    }
    std::replace(corners.begin(), corners.end(), vertex, target);
    sine = std::min(sine, this->Mesh.SineOf(corners));
    if (sine < needed ||
      std::any_of(corners.begin(), corners.end(),
        [&](std::uint32_t corner) { return this->IsLong(corner, target, mostTimes); }))
    {
      return -1.0;
    }
  }
  return sine;
}

/** How much volume a collapse adds. */
double TetrahedronCollapses::GainOf(std::uint32_t vertex, std::uint32_t target) const
{
  if (this->Mesh.Mesh().Surfaces[vertex] == 0)
  {
    return 0.0; // on boundaries of the grid at most, along which it goes
  }
  double gain = 0.0;
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    Corners corners = this->Mesh.CornersOf(tetrahedron);
    gain -= VolumeOf(this->Mesh.Mesh(), corners);
    std::replace(corners.begin(), corners.end(), vertex, target);
    gain += VolumeOf(this->Mesh.Mesh(), corners);
  }
  return gain;
}

bool TetrahedronCollapses::KeepsVolume(double gain) const
{
  const double before = this->WantedVolume.Outside(this->Volume);
  const double after = this->WantedVolume.Outside(this->Volume + gain);
  return after <= std::max(before, this->MostOutside); // undoing may have led beyond
}

bool TetrahedronCollapses::Allows(std::uint32_t vertex, std::uint32_t target)
{
  const double needed = this->SineNeeded(vertex);
  if (this->SineAfter(vertex, target, needed) < needed)
  {
    return false;
  }
  if (!this->KeepsVolume(this->GainOf(vertex, target)))
  {
    this->IsShortOfVolume[vertex] = true;
    return false;
  }
  return this->Mesh.CanCollapse(vertex, target);
}

void TetrahedronCollapses::Collapse(std::uint32_t vertex, std::uint32_t target)
{
  const LocalMesh::Star star = this->Mesh.StarOf(vertex);
  Step step{ vertex, target, this->GainOf(vertex, target), { star.begin(), star.end() }, {} };
  this->Volume += step.Gain;
  this->Mesh.Collapse(vertex, target, step.Fresh);
  this->LookAgainAround({ step.Old.data(), step.Old.data() + step.Old.size() });
  this->Steps.push_back(std::move(step));
}

void TetrahedronCollapses::LookAgainAround(const LocalMesh::Star& changed)
{
  this->Touched.BeginChange();
  this->Touched.Touch(this->Mesh, changed);
  for (const std::uint32_t tetrahedron : changed)
  {
    for (const std::uint32_t point : this->Mesh.CornersOf(tetrahedron))
    {
      this->IsTried[point] = false;
    }
  }
}

/** What was refused because of the whole volume may soon be allowed, whatever is around it. */
void TetrahedronCollapses::NoteRefusal(std::uint32_t vertex)
{
  this->IsTried[vertex] = !this->IsShortOfVolume[vertex];
  this->IsShortOfVolume[vertex] = false;
}

/** The best of the other ends of a vertex's edges, of those into which it can go; LocalMesh::None
 * if there is none. */
std::uint32_t TetrahedronCollapses::BestTarget(std::uint32_t vertex) const
{
  const double needed = this->SineNeeded(vertex);
  std::vector<std::pair<double, std::uint32_t>> targets; // by sine, negated: the best comes first
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    for (const std::uint32_t target : this->Mesh.CornersOf(tetrahedron))
    {
      if (target != vertex &&
        std::none_of(targets.begin(), targets.end(),
          [&](const auto& known) { return known.second == target; }))
      {
        targets.emplace_back(0.0, target);
      }
    }
  }
  for (auto& [sine, target] : targets)
  {
    sine = -this->SineAfter(vertex, target, needed);
  }
  std::sort(targets.begin(), targets.end());
  const auto found = std::find_if(targets.begin(), targets.end(),
    [&](const auto& target)
    { return -target.first < needed || this->Mesh.CanCollapse(vertex, target.second); });
  return found != targets.end() && -found->first >= needed ? found->second : LocalMesh::None;
}

void TetrahedronCollapses::CollapseInside(const ParallelFor& parallelFor)
{
  // Scattered: otherwise one after the other would go into one vertex.
  std::vector<std::uint32_t> order;
  const TetrahedronMesh& mesh = this->Mesh.Mesh();
  for (std::uint32_t point = 0; point < mesh.Positions.size(); ++point)
  {
    if (mesh.Surfaces[point] == 0 && !this->IsTried[point])
    {
      order.push_back(point);
    }
  }
  Scatter(order);
  SearchAhead(
    parallelFor, order.size(), TriesAtOnce, this->Touched,
    [&](std::size_t i) { return this->BestTarget(order[i]); },
    [&](std::size_t i, std::uint32_t /*target*/, int changes)
    { return this->Touched.AnyIsTouched(this->Mesh, this->Mesh.StarOf(order[i]), changes); },
    [&](std::size_t i, std::uint32_t target)
    {
      this->IsTried[order[i]] = true;
      if (target != LocalMesh::None)
      {
        this->Collapse(order[i], target);
      }
    });
}

void TetrahedronCollapses::RelaxInside(
  const std::array<Vector, 3>& axes, const ParallelFor& parallelFor)
{
  const RelaxationOptions options{ std::sin(RelaxedAngle / DegreesOfRadian), axes,
    [this](std::uint32_t point, const Vector& place)
    { return this->KeepsEdgesShort(point, place); } };
  for (const std::uint32_t point : isodiamond::RelaxInside(this->Mesh, options, parallelFor))
  {
    this->LookAgainAround(this->Mesh.StarOf(point));
  }
  this->Steps.clear();
}

std::vector<std::uint32_t> TetrahedronCollapses::Undo(const std::vector<std::uint32_t>& vertices)
{
  std::vector<bool> isAsked(this->IsTried.size());
  for (const std::uint32_t vertex : vertices)
  {
    isAsked[vertex] = true;
  }
  // Forwards to find what builds on it: where the mesh at an end of its edge differed. Then back.
  std::vector<bool> isUndone(this->Steps.size());
  std::vector<bool> isChanged(this->IsTried.size());
  std::vector<std::uint32_t> back;
  for (std::size_t i = 0; i < this->Steps.size(); ++i)
  {
    const Step& step = this->Steps[i];
    isUndone[i] = isAsked[step.Vertex] || isChanged[step.Vertex] || isChanged[step.Target];
    if (isUndone[i])
    {
      for (const std::uint32_t tetrahedron : step.Old)
      {
        for (const std::uint32_t point : this->Mesh.CornersOf(tetrahedron))
        {
          isChanged[point] = true;
        }
      }
      back.push_back(step.Vertex);
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = this->Steps.size(); i-- > 0;)
  {
    if (isUndone[i])
    {
      this->Mesh.PutBack(this->Steps[i].Old, this->Steps[i].Fresh);
      this->Volume -= this->Steps[i].Gain;
    }
  }
  for (std::size_t i = 0; i < this->Steps.size(); ++i)
  {
    if (!isUndone[i])
    {
      std::swap(this->Steps[kept++], this->Steps[i]);
    }
  }
  this->Steps.resize(kept);
  for (std::size_t point = 0; point < isChanged.size(); ++point)
  {
    this->IsTried[point] = this->IsTried[point] && !isChanged[point];
  }
  return back;
}

}
