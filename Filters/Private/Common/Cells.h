// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Cells_h
#define vtkIsodiamond_Cells_h

#include "Field/Parallel.h"
#include "Private/Common/Arrays.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersion.h"

#include <algorithm>
#include <limits>

/**
 * @file Cells.h
 * Cells of a mesh that are all alike.
 */
namespace vtkIsodiamond
{

/** Cells of one size: the offsets are known, write(connectivity) fills in the point ids. */
template <typename Array, typename Write>
vtkSmartPointer<vtkCellArray> WriteCellsAs(
  std::int64_t count, int size, const isodiamond::ParallelFor& parallelFor, const Write& write)
{
  using Id = typename Array::ValueType;
  vtkSmartPointer<Array> offsets = vtkSmartPointer<Array>::New();
  AllocateTuples(offsets, count + 1);
  Id* offset = offsets->GetPointer(0);
  parallelFor(count + 1, 65536,
    [offset, size](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        offset[i] = size * static_cast<Id>(i);
      }
    });
  vtkSmartPointer<Array> connectivity = vtkSmartPointer<Array>::New();
  AllocateTuples(connectivity, size * count);
  write(connectivity->GetPointer(0));
  vtkSmartPointer<vtkCellArray> cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/** In 32 bits where these suffice: half the bytes. @param ids what is written is less than that */
template <typename Write>
vtkSmartPointer<vtkCellArray> WriteCells(std::int64_t count, int size, std::int64_t ids,
  const isodiamond::ParallelFor& parallelFor, const Write& write)
{
  return std::max(size * count, ids) <= std::numeric_limits<std::int32_t>::max()
    ? WriteCellsAs<vtkTypeInt32Array>(count, size, parallelFor, write)
    : WriteCellsAs<vtkTypeInt64Array>(count, size, parallelFor, write);
}

/** Hands cells of one type, no polyhedra, to a grid. @throws std::bad_alloc */
inline void GiveCells(vtkUnstructuredGrid* output, int type, vtkCellArray* cells)
{
  vtkNew<vtkUnsignedCharArray> types;
  AllocateTuples(types, cells->GetNumberOfCells());
  std::fill_n(types->GetPointer(0), cells->GetNumberOfCells(), static_cast<unsigned char>(type));
  // Cells given without faces would be searched for polyhedra, one by one.
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  output->SetPolyhedralCells(types, cells, nullptr, nullptr);
#else
  output->SetCells(types, cells, nullptr, nullptr);
#endif
}

}

#endif
