// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Piece.h"

#include "Mesh/ExtractionPasses.h"
#include "Private/Arrays.h"
#include "Private/Mesh.h"
#include "Private/Tuples.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkAlgorithm.h"
#include "vtkCellArray.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** Leaves a range of cells. @return the points that these have, whose ids become those among them,
 *  in the same order */
template <typename Array>
std::vector<vtkIdType> KeepCells(
  const isodiamond::CellRange& range, vtkIdType pointCount, vtkSmartPointer<vtkCellArray>& cells)
{
  using Id = typename Array::ValueType;
  // As they were given to SetData: none but our own cells come here.
  auto* offsets = vtkAOSDataArrayTemplate<Id>::FastDownCast(cells->GetOffsetsArray());
  auto* connectivity = vtkAOSDataArrayTemplate<Id>::FastDownCast(cells->GetConnectivityArray());
  const Id* offset = offsets->GetPointer(0);
  const Id* begin = connectivity->GetPointer(0) + offset[range.First];
  const Id* end = connectivity->GetPointer(0) + offset[range.Last];

  const isodiamond::KeptPoints kept(pointCount, begin, end - begin, isodiamond::SerialFor);
  vtkNew<Array> newOffsets;
  AllocateTuples(newOffsets, range.Count() + 1);
  std::transform(offset + range.First, offset + range.Last + 1, newOffsets->GetPointer(0),
    [first = offset[range.First]](Id value) { return value - first; });
  vtkNew<Array> newConnectivity;
  AllocateTuples(newConnectivity, end - begin);
  std::copy(begin, end, newConnectivity->GetPointer(0));
  kept.Rename(newConnectivity->GetPointer(0), end - begin, isodiamond::SerialFor);
  cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(newOffsets, newConnectivity);
  return kept.Ids<vtkIdType>();
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

isodiamond::CellRange ShareOf(std::int64_t cells, const int piece[2])
{
  const int number = std::clamp(piece[0], 0, piece[1]);
  return { cells * number / piece[1], cells * std::min(number + 1, piece[1]) / piece[1] };
}

void KeepShare(const int piece[2], Mesh& mesh)
{
  if (piece[0] == 0 && piece[1] == 1)
  {
    return;
  }
  const isodiamond::CellRange range = ShareOf(mesh.Cells->GetNumberOfCells(), piece);
  const vtkIdType pointCount = mesh.Points->GetNumberOfPoints();
  const std::vector<vtkIdType> points = mesh.Cells->IsStorage64Bit()
    ? KeepCells<vtkTypeInt64Array>(range, pointCount, mesh.Cells)
    : KeepCells<vtkTypeInt32Array>(range, pointCount, mesh.Cells);
  mesh.Points = PointsOf(mesh.Points, points);
  KeepTuples(mesh.PointData, points);
  std::vector<vtkIdType> cellIds(range.Count());
  std::iota(cellIds.begin(), cellIds.end(), range.First);
  KeepTuples(mesh.CellData, cellIds);
}

}
