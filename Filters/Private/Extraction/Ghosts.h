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

/** Cells of other shares of a mesh that are wanted beside one's own: those that have a point in
 *  common with it and, level by level, with the ghosts so far. */
struct Ghosts
{
  std::vector<vtkIdType> Cells;     ///< their ids in the whole mesh
  std::vector<vtkIdType> Corners;   ///< of each cell, as point ids in the whole mesh
  std::vector<std::int16_t> Levels; ///< as they were read, one per cell
  std::vector<bool> ArePointsOwn;   ///< by point of the whole mesh: this share has it, none before
};

/** The cells of a mesh, as they are seen here. */
struct MeshCells
{
  std::int64_t Count = 0;
  std::int64_t PointCount = 0;
  int Size = 3; ///< corners per cell
  /** Writes the corners of a range of cells, and a level for each cell. */
  std::function<void(const isodiamond::CellRange&, vtkIdType* corners, std::int16_t* levels)> Read;
};

/** Finds the ghosts around a share. Cells are read block by block, all of them once per level; of
 * unwanted ones nothing is kept. @param levels 1 or more */
Ghosts FindGhosts(
  const MeshCells& mesh, const std::vector<isodiamond::DealtCells>& dealt, int levels);

}

#endif
