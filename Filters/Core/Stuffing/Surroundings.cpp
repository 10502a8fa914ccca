// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Surroundings.h"

#include <algorithm>
#include <unordered_map>

namespace isodiamond
{
Surroundings::Surroundings(
  const LocalMesh& whole, const ImprovementOptions& options, std::uint32_t tetrahedron)
  : TheOptions{ options.WantedAngle, options.SurfaceMove, {}, options.World, options.Axes }
  , TheMesh(this->CopyOf(whole, options, tetrahedron))
{
}

TetrahedronMesh Surroundings::CopyOf(
  const LocalMesh& whole, const ImprovementOptions& options, std::uint32_t tetrahedron)
{
  TetrahedronMesh copy;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers; // by id
  const auto take = [&](std::uint32_t id, int away)
  {
    const auto [at, isNew] = numbers.emplace(id, static_cast<std::uint32_t>(this->TheIds.size()));
    if (isNew)
    {
      this->TheIds.push_back(id);
      this->Away.push_back(away);
      copy.Positions.push_back(whole.At(id));
      copy.Surfaces.push_back(whole.Mesh().Surfaces[id]);
      copy.OnWalls.push_back(whole.Mesh().OnWalls[id]);
    }
    return at->second;
  };

  // From point to point, the nearest first.
  for (const std::uint32_t corner : whole.CornersOf(tetrahedron))
  {
    take(corner, 0);
  }
  std::vector<std::uint32_t> taken;
  for (std::size_t i = 0; i < this->TheIds.size() && this->Away[i] <= Reach; ++i)
  {
    for (const std::uint32_t beside : whole.StarOf(this->TheIds[i]))
    {
      taken.push_back(beside);
      for (const std::uint32_t corner : whole.CornersOf(beside))
      {
        take(corner, this->Away[i] + 1);
      }
    }
  }
  std::sort(taken.begin(), taken.end());
  taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
  for (const std::uint32_t each : taken)
  {
    Corners corners = whole.CornersOf(each);
    std::transform(corners.begin(), corners.end(), corners.begin(),
      [&](std::uint32_t corner) { return numbers.at(corner); });
    copy.Tetrahedra.push_back(corners);
    copy.Origins.push_back(whole.Mesh().Origins[each]);
  }

  // Points that may no longer be in the mesh tell where a surface was.
  const std::size_t points = this->TheIds.size();
  for (std::uint32_t i = 0; i < points; ++i)
  {
    const std::uint32_t source = whole.SourceOf(this->TheIds[i]);
    if (source != this->TheIds[i])
    {
      copy.Blended.push_back({ i, { { take(source, Reach + 1), 1.0 } } });
    }
  }
  for (const std::uint32_t id : this->TheIds)
  {
    if (!options.CutEdges.empty())
    {
      this->TheOptions.CutEdges.push_back(
        id < options.CutEdges.size() ? options.CutEdges[id] : CutSide());
    }
  }
  return copy;
}

bool Surroundings::IsFree(const LocalMesh& mesh, std::uint32_t tetrahedron) const
{
  const Corners& corners = mesh.CornersOf(tetrahedron);
  return std::all_of(corners.begin(), corners.end(),
    [&](std::uint32_t corner)
    { return corner >= this->Away.size() || this->Away[corner] < Reach; }); // new ones are near
}

void Surroundings::DoInWhole(const std::vector<StoredChange>& steps, LocalMesh& whole,
  std::vector<std::uint32_t>& changed) const
{
  const std::size_t first = whole.Mesh().Positions.size(); // of the points that will be new
  for (const StoredChange& step : steps)
  {
    const Change change = step.In(whole,
      [&](std::uint32_t point)
      {
        return point < this->TheIds.size()
          ? this->TheIds[point]
          : static_cast<std::uint32_t>(first + point - this->TheIds.size());
      });
    Do(change, whole, changed);
  }
}

}
