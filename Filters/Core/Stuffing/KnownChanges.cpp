// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/KnownChanges.h"

#include "Stuffing/ChangeNotes.h"
#include "Stuffing/SearchAhead.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** Changes that are looked at at the same time: not many, as those of one place follow each other.
 */
constexpr std::size_t ChangesAtOnce = 32;

/** A known change, as it is in a mesh. */
struct FoundChange
{
  std::uint32_t BestFor = LocalMesh::None; ///< the tetrahedron; None if not all of it is there
  Change What;
  bool MayBeDone = false;
};

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
  const auto find = [&](std::size_t i)
  {
    const auto& [what, bestFor, newPoint] = known[i];
    FoundChange found;
    if (std::none_of(what.Old.begin(), what.Old.end(),
          [&](const Corners& old) { return numberOf(old) == LocalMesh::None; }))
    {
      found.BestFor = numberOf(bestFor);
    }
    if (found.BestFor != LocalMesh::None)
    {
      found.What = what.In(mesh, idOf);
      found.MayBeDone = mayDo(found.What, found.BestFor);
    }
    return found;
  };
  ChangeNotes notes;
  std::vector<std::uint32_t> changed;
  SearchAhead(
    parallelFor, known.size(), ChangesAtOnce, notes.Touched(), find,
    [&](std::size_t /*i*/, const FoundChange& found, int changes)
    {
      return found.BestFor == LocalMesh::None || // may be there by now
        notes.IsTouchedAround(mesh, found.BestFor, changes);
    },
    [&](std::size_t i, const FoundChange& found)
    {
      if (!found.MayBeDone)
      {
        return;
      }
      if (const std::uint32_t newPoint = known[i].NewPoint; newPoint != LocalMesh::None)
      {
        ids.resize(std::max<std::size_t>(ids.size(), newPoint + std::size_t{ 1 }), LocalMesh::None);
        ids[newPoint] = static_cast<std::uint32_t>(mesh.Mesh().Positions.size());
      }
      this->Note(found.What, found.BestFor, mesh);
      notes.Do(found.What, mesh, changed);
    });
}

void KnownChanges::Note(const Change& change, std::uint32_t tetrahedron, const LocalMesh& mesh)
{
  const bool addsPoint = change.Kind == Change::Split || change.Kind == Change::Shift;
  this->Changes.push_back({ { change, mesh }, mesh.CornersOf(tetrahedron),
    addsPoint ? static_cast<std::uint32_t>(mesh.Mesh().Positions.size()) : LocalMesh::None });
}

}
