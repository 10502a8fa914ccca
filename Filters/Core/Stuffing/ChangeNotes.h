// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ChangeNotes_h
#define isodiamond_ChangeNotes_h

#include "Stuffing/Change.h"
#include "Stuffing/TouchedPoints.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{

/** Which tetrahedra of a mesh improvement has been tried for, and what has changed since. */
class ChangeNotes
{
public:
  const TouchedPoints& Touched() const { return this->TouchedByChanges; }

  /** Whether anything has changed around a tetrahedron since it was tried. */
  bool IsWorthATry(const LocalMesh& mesh, std::uint32_t tetrahedron) const
  {
    const int tried = tetrahedron < this->Tried.size() ? this->Tried[tetrahedron] : Never;
    const Corners& corners = mesh.CornersOf(tetrahedron);
    return tried == Never ||
      std::any_of(corners.begin(), corners.end(),
        [&](std::uint32_t point) { return this->TouchedByChanges.IsTouched(point, tried); });
  }

  /** Whether anything that BestChange() reads has changed since there were so many changes. */
  bool IsTouchedAround(const LocalMesh& mesh, std::uint32_t tetrahedron, int changes) const
  {
    const Corners& corners = mesh.CornersOf(tetrahedron);
    return std::any_of(corners.begin(), corners.end(),
      [&](std::uint32_t corner)
      { return this->TouchedByChanges.AnyIsTouched(mesh, mesh.StarOf(corner), changes); });
  }

  void NoteTry(std::uint32_t tetrahedron)
  {
    if (tetrahedron >= this->Tried.size())
    {
      this->Tried.resize(tetrahedron + tetrahedron / 2 + 1, Never);
    }
    this->Tried[tetrahedron] = this->TouchedByChanges.Changes();
  }

  /** Changes a mesh. @param changed receives the tetrahedra that are not as they were */
  void Do(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed)
  {
    this->TouchedByChanges.BeginChange();
    if (change.Kind == Change::Collapse)
    {
      this->TouchedByChanges.Touch(mesh, mesh.StarOf(change.Point)); // nothing replaces some of it
    }
    const std::size_t first = changed.size();
    isodiamond::Do(change, mesh, changed);
    this->TouchedByChanges.Touch(mesh, { changed.data() + first, changed.data() + changed.size() });
  }

private:
  static constexpr int Never = -1;

  TouchedPoints TouchedByChanges;
  std::vector<int> Tried; ///< by tetrahedron: how many changes there were at the last try, or Never
};

}

#endif
