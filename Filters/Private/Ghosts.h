// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Ghosts_h
#define vtkIsodiamond_Ghosts_h

#include "Mesh/ExtractionPasses.h"

#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vtkIsodiamond
{

/** Cells of other shares of a mesh that are wanted beside one's own: those that share a point with
 *  it, and, level by level, with these. */
struct Ghosts
{
  std::vector<vtkIdType> Cells;    ///< their ids in the whole mesh
  std::vector<vtkIdType> Corners;  ///< of each, as ids of points of the whole mesh
  std::vector<std::int8_t> Levels; ///< as they were read, one a cell
  std::vector<bool> ArePointsOwn;  ///< of the whole mesh: the share has it, and no share before
};

/** Cells of a mesh, as they are told apart here. */
struct MeshCells
{
  std::int64_t Count = 0;
  std::int64_t PointCount = 0;
  int Size = 3; ///< corners of a cell
  /** Writes the corners of some cells, and a level for each. */
  std::function<void(const isodiamond::CellRange&, vtkIdType* corners, std::int8_t* levels)> Read;
};

/** Finds the ghosts around a share. Cells are read block by block, all of them once a level;
 * nothing is kept of those that are not wanted. @param levels 1 or more */
Ghosts FindGhosts(
  const MeshCells& mesh, const std::vector<isodiamond::DealtCells>& dealt, int levels);

}

#endif
