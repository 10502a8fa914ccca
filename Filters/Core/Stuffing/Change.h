// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Change_h
#define isodiamond_Change_h

#include "Stuffing/LocalMesh.h"

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
    Replace,  ///< of Old by Fresh
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

/** Changes a mesh. @param changed receives the tetrahedra that are not as they were */
void Do(const Change& change, LocalMesh& mesh, std::vector<std::uint32_t>& changed);

}

#endif
