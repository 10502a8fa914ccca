// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/KnownChanges.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** Changes between two looks at whether to go on. */
constexpr std::size_t ChangesOfStep = 1024;

}

bool KnownChanges::PointPlace::IsThatOf(const PointPlace& other) const
{
  return this->Position == other.Position && this->Surface == other.Surface &&
    this->OnWalls == other.OnWalls;
}

/** Those of all points that are used. */
std::vector<KnownChanges::PointPlace> KnownChanges::PlacesOf(const TetrahedronMesh& mesh)
{
  std::vector<bool> isUsed(mesh.Positions.size());
  for (const Corners& corners : mesh.Tetrahedra)
  {
    for (const std::uint32_t point : corners)
    {
      isUsed[point] = true;
    }
  }
  std::vector<PointPlace> places;
  for (std::uint32_t point = 0; point < isUsed.size(); ++point)
  {
    if (isUsed[point])
    {
      places.push_back({ mesh.Positions[point], mesh.Surfaces[point], mesh.OnWalls[point], point });
    }
  }
  std::sort(places.begin(), places.end(),
    [](const PointPlace& a, const PointPlace& b)
    { return a.Position != b.Position ? a.Position < b.Position : a.Point < b.Point; });
  return places;
}

/** By known point: its id in another mesh, or None. Different points get different ids. */
std::vector<std::uint32_t> KnownChanges::IdsIn(const std::vector<PointPlace>& places) const
{
  std::vector<std::uint32_t> ids;
  auto next = places.begin();
  for (const PointPlace& place : this->Places)
  {
    while (next != places.end() && next->Position < place.Position)
    {
      ++next;
    }
    if (next != places.end() && next->IsThatOf(place))
    {
      ids.resize(
        std::max<std::size_t>(ids.size(), place.Point + std::size_t{ 1 }), LocalMesh::None);
      ids[place.Point] = next->Point;
      ++next;
    }
  }
  return ids;
}

void KnownChanges::DoAgain(LocalMesh& mesh, const Check& mayDo, const ParallelFor& parallelFor)
{
  std::vector<PointPlace> places = PlacesOf(mesh.Mesh());
  std::vector<std::uint32_t> ids = this->IdsIn(places);
  this->Places = std::move(places);
  const auto idOf = [&](std::uint32_t point)
  { return point < ids.size() ? ids[point] : LocalMesh::None; };
  const auto numberOf = [&](Corners corners)
  {
    std::transform(corners.begin(), corners.end(), corners.begin(), idOf);
    const bool areThere =
      std::find(corners.begin(), corners.end(), LocalMesh::None) == corners.end();
    return areThere ? TetrahedronOf(mesh, corners) : LocalMesh::None;
  };
  const std::vector<Known> known = std::exchange(this->Changes, {});
  std::vector<std::uint32_t> changed;
  InSteps(parallelFor, known.size(), ChangesOfStep,
    [&](std::size_t i)
    {
      const auto& [what, bestFor, newPoint] = known[i];
      const std::uint32_t tetrahedron = numberOf(bestFor);
      if (tetrahedron == LocalMesh::None ||
        std::any_of(what.Old.begin(), what.Old.end(),
          [&](const Corners& old) { return numberOf(old) == LocalMesh::None; }))
      {
        return;
      }
      const Change change = what.In(mesh, idOf);
      if (mayDo(change, tetrahedron))
      {
        if (newPoint != LocalMesh::None)
        {
          ids.resize(
            std::max<std::size_t>(ids.size(), newPoint + std::size_t{ 1 }), LocalMesh::None);
          ids[newPoint] = static_cast<std::uint32_t>(mesh.Mesh().Positions.size());
        }
        this->Note(change, tetrahedron, mesh);
        Do(change, mesh, changed);
      }
    });
}

void KnownChanges::Note(const Change& change, std::uint32_t tetrahedron, const LocalMesh& mesh)
{
  const bool addsPoint = change.Kind == Change::Split || change.Kind == Change::Shift;
  this->Changes.push_back({ { change, mesh }, mesh.CornersOf(tetrahedron),
    addsPoint ? static_cast<std::uint32_t>(mesh.Mesh().Positions.size()) : LocalMesh::None });
}

}
