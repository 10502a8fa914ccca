// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/Share.h"

#include "Mesh/ExtractionPasses.h"
#include "Private/Common/Arrays.h"
#include "Private/Common/Cells.h"
#include "Private/Common/Tuples.h"
#include "Private/Extraction/Ghosts.h"
#include "Private/Extraction/Mesh.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

/** The number of corners per cell, of cells that are all alike. */
int SizeOf(vtkCellArray* cells)
{
  return cells->GetNumberOfCells() > 0 ? static_cast<int>(cells->GetCellSize(0)) : 3;
}

MeshCells CellsOf(const Mesh& mesh)
{
  vtkCellArray* const cells = mesh.Cells;
  const auto read = [cells](
                      const isodiamond::CellRange& range, vtkIdType* corners, std::int16_t* levels)
  {
    for (std::int64_t cell = range.First; cell < range.Last; ++cell)
    {
      vtkIdType size = 0;
      const vtkIdType* ids = nullptr;
      cells->GetCellAtId(cell, size, ids);
      corners = std::copy_n(ids, size, corners);
      *levels++ = 0; // not used
    }
  };
  return { cells->GetNumberOfCells(), mesh.Points->GetNumberOfPoints(), SizeOf(cells), read };
}

/** Keeps a range of cells, and ghosts. @return the points that these use, in the same order, by
 *  which the cells' ids are renumbered */
template <typename Array>
std::vector<vtkIdType> KeepCells(const isodiamond::CellRange& range, const Ghosts& ghosts,
  vtkIdType pointCount, vtkSmartPointer<vtkCellArray>& cells)
{
  using Id = typename Array::ValueType;
  // As they were given to SetData: only our own cells come here, which are all alike.
  auto* connectivity = vtkAOSDataArrayTemplate<Id>::FastDownCast(cells->GetConnectivityArray());
  const int size = SizeOf(cells);
  const Id* begin = connectivity->GetPointer(0) + size * range.First;
  const std::int64_t count = range.Count() + static_cast<std::int64_t>(ghosts.Cells.size());
  std::vector<vtkIdType> points;
  cells = WriteCellsAs<Array>(count, size, isodiamond::SerialFor,
    [&](Id* ids)
    {
      Id* next = std::copy_n(begin, size * range.Count(), ids);
      std::copy(ghosts.Corners.begin(), ghosts.Corners.end(), next);
      const isodiamond::KeptPoints kept(pointCount, ids, size * count, isodiamond::SerialFor);
      kept.Rename(ids, size * count, isodiamond::SerialFor);
      points = kept.Ids<vtkIdType>();
    });
  return points;
}

/** Deals cells out to shares whose sizes differ by at most one; if there are more shares than
 *  cells, some get none. */
isodiamond::DealtCells Deal(const isodiamond::MeshShare& share, std::int64_t cells)
{
  return { { 0, cells },
    { cells * share.Number / share.Count,
      std::min(cells * (share.Number + 1) / share.Count, cells) } };
}

}

isodiamond::MeshShare Share::OfMesh() const
{
  const auto [number, count] = this->Piece;
  return { std::clamp(number, 0, count), count, this->HasGhosts() || this->FirstIds.has_value() };
}

void KeepShare(const Share& share, Mesh& mesh)
{
  mesh.CountedSize = { mesh.Points->GetNumberOfPoints(), mesh.Cells->GetNumberOfCells() };
  if (share.Piece[1] == 1 && !share.FirstIds)
  {
    return;
  }
  const isodiamond::DealtCells dealt = Deal(share.OfMesh(), mesh.Cells->GetNumberOfCells());
  const isodiamond::CellRange& range = dealt.Own;
  const vtkIdType pointCount = mesh.Points->GetNumberOfPoints();
  const Ghosts ghosts =
    share.HasGhosts() ? FindGhosts(CellsOf(mesh), { dealt }, share.GhostLevels) : Ghosts{};
  std::vector<vtkIdType> points(pointCount);
  std::iota(points.begin(), points.end(), vtkIdType{ 0 });
  if (share.Piece[1] > 1)
  {
    points = mesh.Cells->IsStorage64Bit()
      ? KeepCells<vtkTypeInt64Array>(range, ghosts, pointCount, mesh.Cells)
      : KeepCells<vtkTypeInt32Array>(range, ghosts, pointCount, mesh.Cells);
    mesh.Points = PointsOf(mesh.Points, points);
    KeepTuples(mesh.PointData, points);
    std::vector<vtkIdType> cells(range.Count());
    std::iota(cells.begin(), cells.end(), range.First);
    cells.insert(cells.end(), ghosts.Cells.begin(), ghosts.Cells.end());
    KeepTuples(mesh.CellData, cells);
  }
  AddOrigins(share, points, { range }, ghosts, mesh);
}

void AddOrigins(const Share& share, const std::vector<vtkIdType>& points,
  const std::vector<isodiamond::CellRange>& own, const Ghosts& ghosts, Mesh& mesh)
{
  const auto pointCount = static_cast<vtkIdType>(points.size());
  const auto ownCount = static_cast<vtkIdType>(isodiamond::TotalOf(own));
  const vtkIdType cellCount = ownCount + static_cast<vtkIdType>(ghosts.Cells.size());
  if (share.FirstIds)
  {
    const auto [firstPoint, firstCell] = *share.FirstIds;
    const auto pointIds = NewArray<vtkIdTypeArray>("GlobalPointIds", pointCount);
    std::transform(points.begin(), points.end(), pointIds->GetPointer(0),
      [first = firstPoint](vtkIdType id) { return first + id; });
    mesh.PointData->SetGlobalIds(pointIds);
    const auto cellIds = NewArray<vtkIdTypeArray>("GlobalCellIds", cellCount);
    vtkIdType* ids = cellIds->GetPointer(0);
    for (const isodiamond::CellRange& cells : own)
    {
      std::iota(ids, ids + cells.Count(), firstCell + cells.First);
      ids += cells.Count();
    }
    std::transform(ghosts.Cells.begin(), ghosts.Cells.end(), ids,
      [first = firstCell](vtkIdType id) { return first + id; });
    mesh.CellData->SetGlobalIds(cellIds);
  }
  if (share.HasGhosts())
  {
    const char* name = vtkDataSetAttributes::GhostArrayName();
    const auto pointMarks = NewArray<vtkUnsignedCharArray>(name, pointCount);
    std::transform(points.begin(), points.end(), pointMarks->GetPointer(0),
      [&](vtkIdType id)
      { return ghosts.ArePointsOwn[id] ? 0 : vtkDataSetAttributes::DUPLICATEPOINT; });
    mesh.PointData->AddArray(pointMarks);
    const auto cellMarks = NewArray<vtkUnsignedCharArray>(name, cellCount);
    unsigned char* const marks = cellMarks->GetPointer(0);
    std::fill_n(marks, ownCount, 0);
    std::fill(marks + ownCount, marks + cellCount,
      static_cast<unsigned char>(vtkDataSetAttributes::DUPLICATECELL));
    mesh.CellData->AddArray(cellMarks);
  }
}

}
