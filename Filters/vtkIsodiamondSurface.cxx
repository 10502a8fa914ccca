// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondSurface.h"

#include "SurfaceExtraction.h"
#include "vtkIsodiamondThreads.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <limits>

namespace vtkIsodiamond
{
namespace
{

template <typename Array>
vtkSmartPointer<vtkCellArray> WriteCells(
  const isodiamond::SurfaceExtraction& extraction, bool mirrored, vtkSignedCharArray* levels)
{
  using Id = typename Array::ValueType;
  const std::int64_t count = extraction.TriangleCount();
  vtkSmartPointer<Array> offsets = vtkSmartPointer<Array>::New();
  offsets->SetNumberOfValues(count + 1);
  Id* offset = offsets->GetPointer(0);
  SMPFor()(count + 1, 65536,
    [offset](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        offset[i] = 3 * static_cast<Id>(i);
      }
    });
  vtkSmartPointer<Array> connectivity = vtkSmartPointer<Array>::New();
  connectivity->SetNumberOfValues(3 * count);
  extraction.WriteTriangles(mirrored, connectivity->GetPointer(0), levels->GetPointer(0));
  vtkSmartPointer<vtkCellArray> cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

}

Surface ExtractSurface(const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::AffineMap& world, double tolerance)
{
  const isodiamond::RefinedSet refined(hierarchy, tolerance, SMPFor());
  const isodiamond::SurfaceExtraction extraction(refined, SMPFor());
  Surface surface;

  vtkSmartPointer<vtkFloatArray> coordinates = vtkSmartPointer<vtkFloatArray>::New();
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(extraction.PointCount());
  extraction.WritePoints(world, coordinates->GetPointer(0));
  surface.Points = vtkSmartPointer<vtkPoints>::New();
  surface.Points->SetData(coordinates);

  surface.Levels = vtkSmartPointer<vtkSignedCharArray>::New();
  surface.Levels->SetName("Level");
  surface.Levels->SetNumberOfValues(extraction.TriangleCount());
  const bool small = 3 * extraction.TriangleCount() <= std::numeric_limits<std::int32_t>::max();
  surface.Triangles = small
    ? WriteCells<vtkTypeInt32Array>(extraction, world.Mirrors(), surface.Levels)
    : WriteCells<vtkTypeInt64Array>(extraction, world.Mirrors(), surface.Levels);
  return surface;
}

vtkSmartPointer<vtkFloatArray> ConstantScalars(
  const std::string& name, std::int64_t count, double isovalue)
{
  vtkSmartPointer<vtkFloatArray> scalars = vtkSmartPointer<vtkFloatArray>::New();
  scalars->SetName(name.c_str());
  scalars->SetNumberOfValues(count);
  scalars->Fill(isovalue);
  return scalars;
}

}
