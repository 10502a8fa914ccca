// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Change.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isodiamond
{
namespace
{

void Split(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed)
{
  const std::uint32_t point = mesh.AddPoint(0.5 * (mesh.At(change.Point) + mesh.At(change.Other)),
    0, change.OnWalls, { { change.Point, 0.5 }, { change.Other, 0.5 } });
  std::vector<Corners> fresh = change.Fresh;
  for (Corners& corners : fresh)
  {
    std::replace(corners.begin(), corners.end(), Change::NewPoint, point);
  }
  mesh.Replace(change.Old, fresh, changed);
  mesh.Move(point, change.Place);
}

/** The old point stays known: it tells where the surface was. Attributes stay as they were. */
void Shift(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed)
{
  const std::uint32_t old = change.Point;
  const std::uint32_t point = mesh.AddPoint(
    change.Place, mesh.Mesh().Surfaces[old], mesh.Mesh().OnWalls[old], { { old, 1.0 } });
  mesh.Exchange(old, point, changed);
}

}

std::uint32_t TetrahedronOf(const LocalMesh& mesh, const Corners& corners)
{
  const LocalMesh::Star star = mesh.StarOf(corners[0]);
  const auto found = std::find_if(star.begin(), star.end(),
    [&](std::uint32_t tetrahedron)
    {
      return std::all_of(corners.begin(), corners.end(),
        [&](std::uint32_t corner) { return Has(mesh.CornersOf(tetrahedron), corner); });
    });
  return found != star.end() ? *found : LocalMesh::None;
}

StoredChange::StoredChange(Change change, const LocalMesh& mesh)
  : Way(std::move(change))
{
  std::transform(this->Way.Old.begin(), this->Way.Old.end(), std::back_inserter(this->Old),
    [&](std::uint32_t tetrahedron) { return mesh.CornersOf(tetrahedron); });
}

void Do(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed)
{
  switch (change.Kind)
  {
    case Change::None:
      break;
    case Change::Move:
      mesh.Move(change.Point, change.Place);
      changed.insert(
        changed.end(), mesh.StarOf(change.Point).begin(), mesh.StarOf(change.Point).end());
      break;
    case Change::Collapse:
      mesh.Collapse(change.Point, change.Other, changed);
      break;
    case Change::Replace:
      mesh.Replace(change.Old, change.Fresh, changed);
      break;
    case Change::Split:
      Split(change, mesh, changed);
      break;
    case Change::Shift:
      Shift(change, mesh, changed);
      break;
  }
}

}
