// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/Mesh.h"

#include "Mesh/IntervalExtraction.h"
#include "Mesh/SurfaceExtraction.h"
#include "Private/Common/Arrays.h"
#include "Private/Common/Cells.h"
#include "Private/Common/Tuples.h"
#include "Private/Extraction/Ghosts.h"
#include "Private/Extraction/Share.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkShortArray.h"
#include "vtkUnsignedShortArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

template <typename Array, typename Extraction>
vtkSmartPointer<vtkPoints> WritePoints(
  const Extraction& extraction, const isodiamond::GridGeometry& world)
{
  vtkSmartPointer<Array> coordinates = vtkSmartPointer<Array>::New();
  coordinates->SetNumberOfComponents(3);
  AllocateTuples(coordinates, extraction.PointCount());
  auto* values = coordinates->GetPointer(0);
  if (const isodiamond::AffineMap* map = world.Affine())
  {
    extraction.WritePoints(*map, values);
  }
  else
  {
    extraction.ForEachPoint(
      [&](const isodiamond::MeshPoint& point)
      {
        const isodiamond::Vector position = world(point.Index);
        for (int axis = 0; axis < 3; ++axis)
        {
          values[3 * point.Id + axis] = static_cast<typename Array::ValueType>(position[axis]);
        }
      });
  }
  vtkSmartPointer<vtkPoints> points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

/** Whether cells are left out after they have been written: then only all of them tell what a share
 *  is. */
bool AreSomeHidden(const MeshOptions& options)
{
  return options.Hidden != nullptr && options.Hidden->Any();
}

/** What of a mesh is extracted. */
Share ExtractedShare(const MeshOptions& options)
{
  return AreSomeHidden(options) ? Share{} : options.Wanted;
}

/** Adds the wanted cells of an extraction, whose points are limited to theirs.
 *  @param counted cells @param write (range, ids, levels) */
template <typename Extraction, typename Write>
void AddCells(Extraction& extraction, std::int64_t counted, int size, const MeshOptions& options,
  const isodiamond::ParallelFor& parallelFor, Mesh& mesh, const Write& write)
{
  const Share share = ExtractedShare(options);
  const std::vector<isodiamond::DealtCells> dealt = extraction.Dealt();
  mesh.CountedSize = { extraction.PointCount(), counted };
  const Ghosts ghosts = share.HasGhosts()
    ? FindGhosts({ counted, extraction.PointCount(), size, write }, dealt, share.GhostLevels)
    : Ghosts{};
  const std::vector<isodiamond::CellRange> own = isodiamond::OwnCells(dealt);
  const std::int64_t ownCount = isodiamond::TotalOf(own);
  const std::int64_t count = ownCount + static_cast<std::int64_t>(ghosts.Cells.size());
  // Neither this array nor "Surface" has signed characters, which ParaView writes into CSV files as
  // such; VTK takes unsigned ones for colours.
  const auto levels = NewArray<vtkShortArray>("Level", count);
  // First with the ids of all points, even for a share.
  mesh.Cells = WriteCells(count, size, extraction.PointCount(), parallelFor,
    [&](auto* connectivity)
    {
      std::int64_t written = 0;
      for (const isodiamond::CellRange& cells : own)
      {
        write(cells, connectivity + size * written, levels->GetPointer(0) + written);
        written += cells.Count();
      }
      std::copy(ghosts.Corners.begin(), ghosts.Corners.end(), connectivity + size * ownCount);
      if (share.Piece[1] > 1)
      {
        extraction.KeepPointsOf(connectivity, size * count);
      }
    });
  std::copy(ghosts.Levels.begin(), ghosts.Levels.end(), levels->GetPointer(0) + ownCount);
  mesh.CellData->AddArray(levels);
  if (share.HasGhosts() || share.FirstIds)
  {
    AddOrigins(share, extraction.template PointIds<vtkIdType>(), own, ghosts, mesh);
  }
}

/** Whether points are doubles. */
bool AreDoubles(const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options)
{
  if (options.PointsPrecision != vtkAlgorithm::DEFAULT_PRECISION)
  {
    return options.PointsPrecision == vtkAlgorithm::DOUBLE_PRECISION;
  }
  const isodiamond::Grid& grid = hierarchy.SampleGrid();
  return hierarchy.Region().IsVolume() ||
    !options.World.FitsFloats({ grid.Last(0), grid.Last(1), grid.Last(2) });
}

template <typename Extraction>
void AddPoints(const Extraction& extraction, const isodiamond::IsodiamondHierarchy& hierarchy,
  const MeshOptions& options, Mesh& mesh)
{
  mesh.Points = AreDoubles(hierarchy, options)
    ? WritePoints<vtkDoubleArray>(extraction, options.World)
    : WritePoints<vtkFloatArray>(extraction, options.World);
}

template <typename Extraction>
void AddMorePointData(const Extraction& extraction, const MeshOptions& options, Mesh& mesh)
{
  if (!options.MorePointData)
  {
    return;
  }
  const std::vector<PointWriter> writers =
    options.MorePointData(extraction.PointCount(), mesh.PointData);
  if (!writers.empty())
  {
    extraction.ForEachPointGroup(Together(writers));
  }
}

/** Where the field's array has no name, its values get one: VTK cannot read a file of an array
 * whose name is empty. */
const char* NameOfValues(const MeshOptions& options)
{
  return options.ArrayName.empty() ? "Scalars" : options.ArrayName.c_str();
}

template <typename Array>
void AddValuesAs(
  const isodiamond::IntervalExtraction& extraction, const MeshOptions& options, Mesh& mesh)
{
  const auto values = NewArray<Array>(NameOfValues(options), extraction.PointCount());
  const auto surfaces = NewArray<vtkShortArray>("Surface", extraction.PointCount());
  extraction.WriteValues(values->GetPointer(0), surfaces->GetPointer(0));
  mesh.PointData->SetScalars(values);
  mesh.PointData->AddArray(surfaces);
}

bool NeedDouble(const isodiamond::AnySamples& samples)
{
  return isodiamond::BytesOfSample(samples) > 2 &&
    !std::holds_alternative<isodiamond::SampleView<float>>(samples);
}

/** Field values: floats unless the samples need more. */
void AddValues(const isodiamond::IntervalExtraction& extraction,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options, Mesh& mesh)
{
  if (NeedDouble(hierarchy.InsideValues()))
  {
    AddValuesAs<vtkDoubleArray>(extraction, options, mesh);
  }
  else
  {
    AddValuesAs<vtkFloatArray>(extraction, options, mesh);
  }
}

/** The cell of the grid that holds the middle of a mesh's cell. */
isodiamond::Point CellOfGrid(
  const std::vector<isodiamond::Vector>& positions, const vtkIdType* ids, vtkIdType size)
{
  isodiamond::Point cell{};
  for (int axis = 0; axis < 3; ++axis)
  {
    double sum = 0.0;
    for (vtkIdType i = 0; i < size; ++i)
    {
      sum += positions[ids[i]][axis];
    }
    cell[axis] = static_cast<int>(std::floor(sum / static_cast<double>(size)));
  }
  return cell;
}

/** Removes the cells that lie in hidden cells of the grid, and points that no cell then uses. The
 *  mesh there is at full resolution, so each of its cells lies in one of the grid's. */
template <typename Extraction>
void LeaveOutHidden(const Extraction& extraction, const isodiamond::HiddenCells& hidden, Mesh& mesh)
{
  std::vector<isodiamond::Vector> positions(extraction.PointCount());
  extraction.ForEachPoint(
    [&](const isodiamond::MeshPoint& point) { positions[point.Id] = point.Index; });
  std::vector<vtkIdType> keptCells;
  std::vector<vtkIdType> keptPoints;
  std::vector<vtkIdType> newIds(positions.size(), -1);
  vtkIdType size = 0; // of a cell: all have the same number of points
  const vtkIdType* ids = nullptr;
  for (vtkIdType cell = 0; cell < mesh.Cells->GetNumberOfCells(); ++cell)
  {
    mesh.Cells->GetCellAtId(cell, size, ids);
    if (hidden(CellOfGrid(positions, ids, size)))
    {
      continue;
    }
    keptCells.push_back(cell);
    for (vtkIdType i = 0; i < size; ++i)
    {
      if (newIds[ids[i]] < 0)
      {
        newIds[ids[i]] = static_cast<vtkIdType>(keptPoints.size());
        keptPoints.push_back(ids[i]);
      }
    }
  }
  mesh.Cells = WriteCellsAs<vtkTypeInt64Array>(static_cast<std::int64_t>(keptCells.size()),
    static_cast<int>(size), isodiamond::SerialFor,
    [&](auto* connectivity)
    {
      for (const vtkIdType cell : keptCells)
      {
        mesh.Cells->GetCellAtId(cell, size, ids);
        connectivity =
          std::transform(ids, ids + size, connectivity, [&](vtkIdType id) { return newIds[id]; });
      }
    });
  mesh.Points = PointsOf(mesh.Points, keptPoints);
  KeepTuples(mesh.PointData, keptPoints);
  KeepTuples(mesh.CellData, keptCells);
}

/** What comes after points, cells and values. */
template <typename Extraction>
void Complete(const Extraction& extraction, const MeshOptions& options, Mesh& mesh)
{
  AddMorePointData(extraction, options, mesh);
  if (AreSomeHidden(options))
  {
    LeaveOutHidden(extraction, *options.Hidden, mesh);
  }
}

void ExtractVolume(const isodiamond::RefinedSet& refined, const MeshOptions& options,
  const isodiamond::ParallelFor& parallelFor, Mesh& mesh)
{
  isodiamond::IntervalExtraction extraction(refined, parallelFor, ExtractedShare(options).OfMesh());
  AddCells(extraction, extraction.TetrahedronCount(), 4, options, parallelFor, mesh,
    [&](const isodiamond::CellRange& cells, auto* connectivity, std::int16_t* levels)
    { extraction.WriteTetrahedra(cells, options.World.Mirrors(), connectivity, levels); });
  AddPoints(extraction, refined.Hierarchy(), options, mesh);
  AddValues(extraction, refined.Hierarchy(), options, mesh);
  Complete(extraction, options, mesh);
}

void ExtractSurface(const isodiamond::RefinedSet& refined, const MeshOptions& options,
  const isodiamond::ParallelFor& parallelFor, Mesh& mesh)
{
  isodiamond::SurfaceExtraction extraction(refined, parallelFor, ExtractedShare(options).OfMesh());
  AddCells(extraction, extraction.TriangleCount(), 3, options, parallelFor, mesh,
    [&](const isodiamond::CellRange& cells, auto* connectivity, std::int16_t* levels)
    { extraction.WriteTriangles(cells, options.World.Mirrors(), connectivity, levels); });
  AddPoints(extraction, refined.Hierarchy(), options, mesh);
  if (options.WithThresholds)
  {
    const auto codes = NewArray<vtkUnsignedShortArray>(ThresholdsArray, extraction.TriangleCount());
    extraction.WriteThresholds(codes->GetPointer(0));
    mesh.CellData->AddArray(codes);
  }
  if (options.WithValues)
  {
    const auto values = NewArray<vtkFloatArray>(NameOfValues(options), extraction.PointCount());
    std::fill_n(values->GetPointer(0), extraction.PointCount(),
      static_cast<float>(refined.Hierarchy().Region().Isovalue()));
    mesh.PointData->AddArray(values);
    if (options.ValuesAreScalars)
    {
      mesh.PointData->SetScalars(values);
    }
  }
  Complete(extraction, options, mesh);
}

}

void Mesh::Give(vtkPolyData* triangles) const
{
  triangles->SetPoints(this->Points);
  triangles->SetPolys(this->Cells);
  triangles->GetPointData()->ShallowCopy(this->PointData);
  triangles->GetCellData()->ShallowCopy(this->CellData);
}

void Mesh::Give(vtkUnstructuredGrid* output, bool isVolume) const
{
  output->SetPoints(this->Points);
  GiveCells(output, isVolume ? VTK_TETRA : VTK_TRIANGLE, this->Cells);
  output->GetPointData()->ShallowCopy(this->PointData);
  output->GetCellData()->ShallowCopy(this->CellData);
}

Mesh ExtractMesh(const isodiamond::RefinedSet& refined, const MeshOptions& options, Task& task)
{
  task.Begin("Extracting the mesh", 0.0, 1.0);
  Mesh mesh;
  if (refined.Hierarchy().Region().IsVolume())
  {
    ExtractVolume(refined, options, task.For(), mesh);
  }
  else
  {
    ExtractSurface(refined, options, task.For(), mesh);
  }
  if (AreSomeHidden(options))
  {
    KeepShare(options.Wanted, mesh);
  }
  return mesh;
}

Mesh ExtractPoints(const isodiamond::IntervalExtraction& extraction,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options)
{
  Mesh mesh;
  AddPoints(extraction, hierarchy, options, mesh);
  AddValues(extraction, hierarchy, options, mesh);
  AddMorePointData(extraction, options, mesh);
  return mesh;
}

}
