// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondMesh.h"

#include "IntervalExtraction.h"
#include "SurfaceExtraction.h"
#include "vtkIsodiamondThreads.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <limits>

namespace vtkIsodiamond
{
namespace
{

/** Cells of one size: the offsets are known, write(connectivity) fills in the point ids. */
template <typename Array, typename Write>
vtkSmartPointer<vtkCellArray> WriteCells(std::int64_t count, int size, const Write& write)
{
  using Id = typename Array::ValueType;
  vtkSmartPointer<Array> offsets = vtkSmartPointer<Array>::New();
  offsets->SetNumberOfValues(count + 1);
  Id* offset = offsets->GetPointer(0);
  SMPFor()(count + 1, 65536,
    [offset, size](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        offset[i] = size * static_cast<Id>(i);
      }
    });
  vtkSmartPointer<Array> connectivity = vtkSmartPointer<Array>::New();
  connectivity->SetNumberOfValues(size * count);
  write(connectivity->GetPointer(0));
  vtkSmartPointer<vtkCellArray> cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/** In 32 bits where they fit: half the bytes. */
template <typename Write>
vtkSmartPointer<vtkCellArray> WriteCells(std::int64_t count, int size, const Write& write)
{
  return size * count <= std::numeric_limits<std::int32_t>::max()
    ? WriteCells<vtkTypeInt32Array>(count, size, write)
    : WriteCells<vtkTypeInt64Array>(count, size, write);
}

vtkSmartPointer<vtkSignedCharArray> NewArray(const char* name, std::int64_t count)
{
  vtkSmartPointer<vtkSignedCharArray> array = vtkSmartPointer<vtkSignedCharArray>::New();
  array->SetName(name);
  array->SetNumberOfValues(count);
  return array;
}

template <typename Array, typename Extraction>
vtkSmartPointer<vtkPoints> WritePoints(
  const Extraction& extraction, const isodiamond::AffineMap& world)
{
  vtkSmartPointer<Array> coordinates = vtkSmartPointer<Array>::New();
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(extraction.PointCount());
  extraction.WritePoints(world, coordinates->GetPointer(0));
  vtkSmartPointer<vtkPoints> points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

/** Field values: floats unless the samples need more. */
template <typename Array>
void AddValues(const isodiamond::IntervalExtraction& extraction, const std::string& name,
  vtkUnstructuredGrid* output)
{
  vtkSmartPointer<Array> values = vtkSmartPointer<Array>::New();
  values->SetName(name.c_str());
  values->SetNumberOfValues(extraction.PointCount());
  const auto surfaces = NewArray("Surface", extraction.PointCount());
  extraction.WriteValues(values->GetPointer(0), surfaces->GetPointer(0));
  output->GetPointData()->SetScalars(values);
  output->GetPointData()->AddArray(surfaces);
}

bool NeedDouble(const isodiamond::AnySamples& samples)
{
  return isodiamond::BytesOfSample(samples) > 2 &&
    !std::holds_alternative<isodiamond::SampleView<float>>(samples);
}

void ExtractVolume(const isodiamond::RefinedSet& refined, const isodiamond::AffineMap& world,
  const std::string& arrayName, vtkUnstructuredGrid* output)
{
  const isodiamond::IntervalExtraction extraction(refined, SMPFor());
  // In floats the thinnest tetrahedra would turn over, even close to the world's origin.
  output->SetPoints(WritePoints<vtkDoubleArray>(extraction, world));
  const auto levels = NewArray("Level", extraction.TetrahedronCount());
  output->SetCells(VTK_TETRA,
    WriteCells(extraction.TetrahedronCount(), 4,
      [&](auto* connectivity)
      { extraction.WriteTetrahedra(world.Mirrors(), connectivity, levels->GetPointer(0)); }));
  output->GetCellData()->AddArray(levels);
  if (NeedDouble(refined.Hierarchy().InsideValues()))
  {
    AddValues<vtkDoubleArray>(extraction, arrayName, output);
  }
  else
  {
    AddValues<vtkFloatArray>(extraction, arrayName, output);
  }
}

}

Surface ExtractSurface(const isodiamond::RefinedSet& refined, const isodiamond::AffineMap& world)
{
  const isodiamond::SurfaceExtraction extraction(refined, SMPFor());
  Surface surface;
  surface.Points = WritePoints<vtkFloatArray>(extraction, world);
  surface.Levels = NewArray("Level", extraction.TriangleCount());
  surface.Triangles = WriteCells(extraction.TriangleCount(), 3,
    [&](auto* connectivity)
    { extraction.WriteTriangles(world.Mirrors(), connectivity, surface.Levels->GetPointer(0)); });
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

void ExtractMesh(const isodiamond::RefinedSet& refined, const isodiamond::AffineMap& world,
  const std::string& arrayName, vtkUnstructuredGrid* output)
{
  const isodiamond::Isoregion& region = refined.Hierarchy().Region();
  if (region.IsVolume())
  {
    ExtractVolume(refined, world, arrayName, output);
    return;
  }
  const Surface surface = ExtractSurface(refined, world);
  output->SetPoints(surface.Points);
  output->SetCells(VTK_TRIANGLE, surface.Triangles);
  output->GetCellData()->AddArray(surface.Levels);
  output->GetPointData()->SetScalars(
    ConstantScalars(arrayName, surface.Points->GetNumberOfPoints(), region.Isovalue()));
}

}
