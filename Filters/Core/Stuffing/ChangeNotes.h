// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ChangeNotes_h
#define isodiamond_ChangeNotes_h

#include "Stuffing/Change.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{

/** Which tetrahedra of a mesh improvement has been tried for, and what has changed since. */
class ChangeNotes
{
public:
  /** How many changes there have been. */
  int Count() const { return this->Changes; }

  /** Whether anything has changed around a tetrahedron since it was tried. */
  bool IsWorthATry(const LocalMesh& mesh, std::uint32_t tetrahedron) const
  {
    const int tried = NotedAt(this->Tried, tetrahedron);
    const Corners& corners = mesh.CornersOf(tetrahedron);
    return tried == Never ||
      std::any_of(corners.begin(), corners.end(),
        [&](std::uint32_t point) { return this->IsTouched(point, tried); });
  }

  /** Whether anything that BestChange() reads has changed since there were so many changes. */
  bool IsTouchedAround(const LocalMesh& mesh, std::uint32_t tetrahedron, int changes) const
  {
    const Corners& corners = mesh.CornersOf(tetrahedron);
    return std::any_of(corners.begin(), corners.end(),
      [&](std::uint32_t corner)
      {
        const LocalMesh::Star star = mesh.StarOf(corner);
        return std::any_of(star.begin(), star.end(),
          [&](std::uint32_t beside)
          {
            const Corners& points = mesh.CornersOf(beside);
            return std::any_of(points.begin(), points.end(),
              [&](std::uint32_t point) { return this->IsTouched(point, changes); });
          });
      });
  }

  void NoteTry(std::uint32_t tetrahedron) { Note(this->Tried, tetrahedron, this->Changes); }

  /** Changes a mesh. @param changed receives the tetrahedra that are not as they were */
  void Do(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed)
  {
    ++this->Changes;
    if (change.Kind == Change::Collapse)
    {
      this->Touch(mesh, mesh.StarOf(change.Point)); // nothing replaces some of it
    }
    const std::size_t first = changed.size();
    isodiamond::Do(change, mesh, changed);
    this->Touch(mesh, { changed.data() + first, changed.data() + changed.size() });
  }

private:
  static constexpr int Never = -1;

  /** How many changes there were when a point or tetrahedron, possibly a new one, was last noted;
   *  less than any number of changes if it never was. */
  static int NotedAt(const std::vector<int>& notes, std::uint32_t number)
  {
    return number < notes.size() ? notes[number] : Never;
  }
  static void Note(std::vector<int>& notes, std::uint32_t number, int changes)
  {
    if (number >= notes.size())
    {
      notes.resize(number + number / 2 + 1, Never);
    }
    notes[number] = changes;
  }

  /** Whether a point has been touched since there were so many changes. */
  bool IsTouched(std::uint32_t point, int changes) const
  {
    return NotedAt(this->Touched, point) > changes;
  }
  void Touch(const LocalMesh& mesh, const LocalMesh::Star& tetrahedra)
  {
    for (const std::uint32_t tetrahedron : tetrahedra)
    {
      for (const std::uint32_t point : mesh.CornersOf(tetrahedron))
      {
        Note(this->Touched, point, this->Changes);
      }
    }
  }

  int Changes = 0;
  std::vector<int> Tried;   ///< by tetrahedron: how many changes there were at the last try
  std::vector<int> Touched; ///< by point, likewise
};

}

#endif
