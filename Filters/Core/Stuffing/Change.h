// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Change_h
#define isodiamond_Change_h

#include "Stuffing/LocalMesh.h"

#include <algorithm>
#include <vector>

namespace isodiamond
{

/** A local change of a mesh. */
struct Change
{
  enum Kinds
  {
    None,
    Move,     ///< of Point to Place
    Collapse, ///< of the edge from Point to Other into Other
    Replace,  ///< of Old by Fresh, which removes the edge from Point to Other, or adds it
    Split,    ///< as Replace, with Fresh around a new point, written as NewPoint, at Place
    Shift     ///< of Point, on a surface, which a new point at Place replaces
  };
  static constexpr std::uint32_t NewPoint = LocalMesh::None;

  Kinds Kind = None;
  double Gain = 0.0; ///< in the shortfall of all tetrahedra that it touches
  std::uint32_t Point = 0;
  std::uint32_t Other = 0;
  Vector Place{};
  Walls::Type OnWalls = 0;
  std::vector<std::uint32_t> Old;
  std::vector<Corners> Fresh;
};

/** The tetrahedron of a mesh with these corners, in any order; LocalMesh::None if it is not there.
 */
std::uint32_t TetrahedronOf(const LocalMesh& mesh, const Corners& corners);

/** A change that can also be done in another mesh, in which the same has other numbers. */
struct StoredChange
{
  /** @param mesh that the change is of, before it is done */
  StoredChange(Change change, const LocalMesh& mesh);

  /** @param idOf (point) -> its id in the other mesh, where all that the change concerns is */
  template <typename IdOf>
  Change In(const LocalMesh& other, IdOf&& idOf) const
  {
    const auto idsOf = [&](Corners corners)
    {
      std::transform(corners.begin(), corners.end(), corners.begin(),
        [&](std::uint32_t corner) { return corner == Change::NewPoint ? corner : idOf(corner); });
      return corners;
    };
    Change change = this->Way;
    change.Point = idOf(change.Point);
    change.Other = idOf(change.Other);
    std::transform(change.Fresh.begin(), change.Fresh.end(), change.Fresh.begin(), idsOf);
    std::transform(this->Old.begin(), this->Old.end(), change.Old.begin(),
      [&](const Corners& corners) { return TetrahedronOf(other, idsOf(corners)); });
    return change;
  }

  Change Way;
  std::vector<Corners> Old; ///< of what it replaces
};

/** Changes a mesh. @param changed receives the tetrahedra that are not as they were */
void Do(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed);

}

#endif
