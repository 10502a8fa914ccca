// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestChange_h
#define isodiamond_BestChange_h

#include "Stuffing/Improvement.h"
#include "Stuffing/LocalMesh.h"

#include <vector>

namespace isodiamond
{

/** A change of a mesh's neighbourhood. */
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
  double Gain = 0.0; ///< of what all tetrahedra lack that it touches
  std::uint32_t Point = 0;
  std::uint32_t Other = 0;
  Vector Place{};
  Walls::Type OnWalls = 0;
  std::vector<std::uint32_t> Old;
  std::vector<Corners> Fresh;
};

/**
 * Finds what would be best for a bad tetrahedron: what leaves least to be wished for of all the
 * tetrahedra that it touches, and makes the worst of these no worse. See Improvement.h for what is
 * tried.
 *
 * It only reads the mesh, and of that the tetrahedra at the tetrahedron's points, and at points
 * that have an edge to one of these.
 *
 * @return a change of no kind if there is none
 */
Change BestChange(
  const LocalMesh& mesh, const ImprovementOptions& options, std::uint32_t tetrahedron);

}

#endif
