// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TouchedPoints_h
#define isodiamond_TouchedPoints_h

#include "Simplification/CellsAtPoints.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** When something around each point of a mesh was last changed, counted in changes. */
class TouchedPoints
{
public:
  /** How many changes there have been. */
  int Changes() const { return this->Count; }

  /** Whether a point has been touched since there were so many changes. */
  bool IsTouched(std::uint32_t point, int changes) const
  {
    return point < this->LastChanges.size() && this->LastChanges[point] > changes;
  }

  /** Whether any corner of some tetrahedra has. @param mesh with CornersOf() */
  template <typename Mesh>
  bool AnyIsTouched(const Mesh& mesh, const CellsAtPoints::Cells& tetrahedra, int changes) const
  {
    return std::any_of(tetrahedra.begin(), tetrahedra.end(),
      [&](std::uint32_t tetrahedron)
      {
        const auto& corners = mesh.CornersOf(tetrahedron);
        return std::any_of(corners.begin(), corners.end(),
          [&](std::uint32_t point) { return this->IsTouched(point, changes); });
      });
  }

  /** Another change begins. */
  void BeginChange() { ++this->Count; }

  /** The change touches all corners of some tetrahedra. @param mesh with CornersOf() */
  template <typename Mesh>
  void Touch(const Mesh& mesh, const CellsAtPoints::Cells& tetrahedra)
  {
    for (const std::uint32_t tetrahedron : tetrahedra)
    {
      for (const std::uint32_t point : mesh.CornersOf(tetrahedron))
      {
        if (point >= this->LastChanges.size())
        {
          this->LastChanges.resize(point + point / 2 + 1);
        }
        this->LastChanges[point] = this->Count;
      }
    }
  }

private:
  int Count = 0;
  std::vector<int> LastChanges; ///< by point; 0 if it has never been touched
};

}

#endif
