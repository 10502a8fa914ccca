// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/Ghosts.h"

#include <algorithm>

namespace vtkIsodiamond
{
namespace
{

/** Calls body(cell, corners, level) for some cells. */
template <typename Body>
void ForEachCell(const MeshCells& mesh, const isodiamond::CellRange& cells, Body&& body)
{
  constexpr std::int64_t most = 1 << 16; // at once
  const std::int64_t room = std::min(most, cells.Count());
  std::vector<vtkIdType> corners(mesh.Size * room);
  std::vector<std::int16_t> levels(room);
  for (std::int64_t first = cells.First; first < cells.Last; first += most)
  {
    const isodiamond::CellRange block = { first, std::min(first + most, cells.Last) };
    mesh.Read(block, corners.data(), levels.data());
    for (std::int64_t i = 0; i < block.Count(); ++i)
    {
      body(first + i, corners.data() + mesh.Size * i, levels[i]);
    }
  }
}

}

Ghosts FindGhosts(
  const MeshCells& mesh, const std::vector<isodiamond::DealtCells>& dealt, int levels)
{
  Ghosts ghosts;
  ghosts.ArePointsOwn.assign(mesh.PointCount, false);
  const auto mark = [&](std::vector<bool>& points, const vtkIdType* corners, std::int64_t count)
  { std::for_each(corners, corners + count, [&](vtkIdType point) { points[point] = true; }); };
  for (const isodiamond::DealtCells& cells : dealt)
  {
    ForEachCell(mesh, cells.Own,
      [&](std::int64_t, const vtkIdType* corners, std::int8_t)
      { mark(ghosts.ArePointsOwn, corners, mesh.Size); });
  }
  std::vector<bool> near = ghosts.ArePointsOwn;
  std::vector<bool> isGhost(mesh.Count, false);
  for (int level = 0; level < levels; ++level)
  {
    const std::size_t before = ghosts.Corners.size();
    const auto look = [&](std::int64_t cell, const vtkIdType* corners, std::int16_t levelOfCell)
    {
      if (!isGhost[cell] &&
        std::any_of(corners, corners + mesh.Size, [&](vtkIdType point) { return near[point]; }))
      {
        isGhost[cell] = true;
        ghosts.Cells.push_back(cell);
        ghosts.Corners.insert(ghosts.Corners.end(), corners, corners + mesh.Size);
        ghosts.Levels.push_back(levelOfCell);
      }
    };
    const auto lookBefore = [&](
                              std::int64_t cell, const vtkIdType* corners, std::int16_t levelOfCell)
    {
      std::for_each(
        corners, corners + mesh.Size, [&](vtkIdType point) { ghosts.ArePointsOwn[point] = false; });
      look(cell, corners, levelOfCell);
    };
    for (const isodiamond::DealtCells& cells : dealt)
    {
      ForEachCell(mesh, { cells.All.First, cells.Own.First }, lookBefore);
      ForEachCell(mesh, { cells.Own.Last, cells.All.Last }, look);
    }
    mark(near, ghosts.Corners.data() + before,
      static_cast<std::int64_t>(ghosts.Corners.size() - before));
  }
  return ghosts;
}

}
