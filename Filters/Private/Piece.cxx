// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Piece.h"

#include "Private/Arrays.h"
#include "Private/Cells.h"
#include "Private/Tuples.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** A range of cells, and the points that they use. */
struct Part
{
  vtkIdType FirstCell = 0;
  vtkIdType LastCell = 0; ///< not in it
  std::vector<vtkIdType> Points;
  vtkSmartPointer<vtkCellArray> Cells; ///< with indices into Points
};

/** Ids of the whole's points become ids of the part's, in the same order. */
template <typename Array>
void MakePart(vtkCellArray* cells, vtkIdType pointCount, Part& part)
{
  using Id = typename Array::ValueType;
  // As they were given to SetData: none but our own cells come here.
  auto* offsets = vtkAOSDataArrayTemplate<Id>::FastDownCast(cells->GetOffsetsArray());
  auto* connectivity = vtkAOSDataArrayTemplate<Id>::FastDownCast(cells->GetConnectivityArray());
  const Id* offset = offsets->GetPointer(0);
  const Id* begin = connectivity->GetPointer(0) + offset[part.FirstCell];
  const Id* end = connectivity->GetPointer(0) + offset[part.LastCell];

  std::vector<Id> newIds(pointCount, 0); // first whether a point is used
  for (const Id* id = begin; id != end; ++id)
  {
    newIds[*id] = 1;
  }
  const vtkIdType used = std::accumulate(newIds.begin(), newIds.end(), vtkIdType{ 0 });
  part.Points.reserve(static_cast<std::size_t>(used));
  for (vtkIdType id = 0; id < pointCount; ++id)
  {
    if (newIds[id] != 0)
    {
      newIds[id] = static_cast<Id>(part.Points.size());
      part.Points.push_back(id);
    }
  }

  vtkNew<Array> newOffsets;
  AllocateTuples(newOffsets, part.LastCell - part.FirstCell + 1);
  std::transform(offset + part.FirstCell, offset + part.LastCell + 1, newOffsets->GetPointer(0),
    [first = offset[part.FirstCell]](Id value) { return value - first; });
  vtkNew<Array> newConnectivity;
  AllocateTuples(newConnectivity, end - begin);
  std::transform(
    begin, end, newConnectivity->GetPointer(0), [&newIds](Id id) { return newIds[id]; });
  part.Cells = vtkSmartPointer<vtkCellArray>::New();
  part.Cells->SetData(newOffsets, newConnectivity);
}

void KeepPart(vtkCellArray* cells, const int piece[2], vtkPointSet* mesh, Part& part)
{
  const vtkIdType count = cells->GetNumberOfCells();
  const int number = std::clamp(piece[0], 0, piece[1]);
  part.FirstCell = count * number / piece[1];
  part.LastCell = count * std::min(number + 1, piece[1]) / piece[1];
  if (cells->IsStorage64Bit())
  {
    MakePart<vtkTypeInt64Array>(cells, mesh->GetNumberOfPoints(), part);
  }
  else
  {
    MakePart<vtkTypeInt32Array>(cells, mesh->GetNumberOfPoints(), part);
  }
  mesh->SetPoints(PointsOf(mesh->GetPoints(), part.Points));
  KeepTuples(mesh->GetPointData(), part.Points);
  std::vector<vtkIdType> cellIds(part.LastCell - part.FirstCell);
  std::iota(cellIds.begin(), cellIds.end(), part.FirstCell);
  KeepTuples(mesh->GetCellData(), cellIds);
}

}

void RequestWhole(vtkInformation* inputInformation)
{
  if (!inputInformation)
  {
    return;
  }
  if (inputInformation->Has(Pipeline::WHOLE_EXTENT()))
  {
    int extent[6];
    inputInformation->Get(Pipeline::WHOLE_EXTENT(), extent);
    inputInformation->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
  inputInformation->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  inputInformation->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  inputInformation->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

void NotePiece(vtkAlgorithm* filter, vtkInformation* request, int when, int piece[2])
{
  if (when == vtkExecutive::AfterForward && request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    vtkInformation* output = filter->GetOutputInformation(0);
    piece[0] = output->Get(Pipeline::UPDATE_PIECE_NUMBER()); // 0 if there is none
    piece[1] = std::max(output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()), 1);
  }
}

void CheckWhole(vtkDataObject* volume, vtkInformation* inputInformation, const int piece[2])
{
  vtkInformation* data = volume ? volume->GetInformation() : nullptr;
  if (piece[1] == 1 || !data || !data->Has(vtkDataObject::DATA_EXTENT()) ||
    !inputInformation->Has(Pipeline::WHOLE_EXTENT()))
  {
    return;
  }
  int whole[6];
  int extent[6];
  inputInformation->Get(Pipeline::WHOLE_EXTENT(), whole);
  data->Get(vtkDataObject::DATA_EXTENT(), extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (extent[2 * axis] > whole[2 * axis] || extent[2 * axis + 1] < whole[2 * axis + 1])
    {
      throw std::invalid_argument("The input is a part of the volume, though all of it was asked "
                                  "for: in parallel every process needs the whole volume.");
    }
  }
}

void KeepPiece(vtkDataObject* mesh, const int piece[2])
{
  vtkPointSet* points = vtkPointSet::SafeDownCast(mesh);
  if ((piece[0] == 0 && piece[1] == 1) || !points || !points->GetPoints())
  {
    return;
  }
  Part part;
  if (vtkPolyData* polyData = vtkPolyData::SafeDownCast(mesh))
  {
    if (polyData->GetNumberOfVerts() > 0)
    {
      KeepPart(polyData->GetVerts(), piece, polyData, part);
      polyData->SetVerts(part.Cells);
    }
    else
    {
      KeepPart(polyData->GetPolys(), piece, polyData, part);
      polyData->SetPolys(part.Cells);
    }
  }
  else if (vtkUnstructuredGrid* grid = vtkUnstructuredGrid::SafeDownCast(mesh))
  {
    const int type = grid->GetNumberOfCells() > 0 ? grid->GetCellType(0) : VTK_EMPTY_CELL;
    KeepPart(grid->GetCells(), piece, grid, part);
    GiveCells(grid, type, part.Cells);
  }
}

}
