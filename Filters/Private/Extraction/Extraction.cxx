// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Extraction/Extraction.h"

#include "Mesh/CellCounts.h"
#include "Private/Common/Tuples.h"
#include "Private/Common/UsedPoints.h"
#include "Private/Extraction/Share.h"
#include "Private/Extraction/Simulation.h"
#include "Private/Query/HierarchyQuery.h"
#include "Private/Query/PlacedTolerance.h"
#include "Simplification/MeanNormals.h"
#include "Simplification/Simplification.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

constexpr const char* WallsArray = "IsodiamondWalls";

/** In degrees, of triangles for simulations. */
constexpr double LeastAngle = 15.0;
/** The least tolerance that these get, as a part of the grid's smallest step: with less, slivers
 *  would stay. */
constexpr double LeastTolerance = 0.25;

/** Has points record, for a while, which walls of the grid they are on. */
PointDataMaker WithWalls(PointDataMaker others, const isodiamond::Grid& grid)
{
  return [others = std::move(others), grid](vtkIdType count, vtkPointData* pointData)
  {
    std::vector<PointWriter> writers =
      others ? others(count, pointData) : std::vector<PointWriter>{};
    const auto walls = NewArray<vtkUnsignedCharArray>(WallsArray, count);
    pointData->AddArray(walls);
    writers.push_back(
      OneByOne([grid, values = walls->GetPointer(0)](const isodiamond::MeshPoint& point)
        { values[point.Id] = isodiamond::Walls::At(point.Index, grid); }));
    return writers;
  };
}

/** @param allowed (triangle, tolerance of its place) -> what is left of that */
template <typename Allowed>
isodiamond::AllowedMesh ToCore(
  const Mesh& mesh, const PlacedTolerance& tolerance, Allowed&& allowed)
{
  isodiamond::AllowedMesh result;
  result.Mesh.Positions = PositionsOf(mesh.Points);
  const vtkIdType count = mesh.Cells->GetNumberOfCells();
  result.Mesh.Triangles.reserve(count);
  result.Allowances.reserve(count);
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    mesh.Cells->GetCellAtId(cell, size, ids);
    result.Mesh.Triangles.push_back({ static_cast<std::uint32_t>(ids[0]),
      static_cast<std::uint32_t>(ids[1]), static_cast<std::uint32_t>(ids[2]) });
    const std::array<isodiamond::Vector, 3> corners = result.Mesh.Corners(cell);
    result.Allowances.push_back(allowed(cell, tolerance.In(corners.data(), 3)));
  }
  const auto* walls =
    vtkUnsignedCharArray::FastDownCast(mesh.PointData->GetArray(WallsArray))->GetPointer(0);
  result.OnWalls.assign(walls, walls + result.Mesh.Positions.size());
  return result;
}

/**
 * Simplifies the mesh of HierarchyQuery() within what is left of the tolerances: for each triangle
 * what its diamond's error leaves, mostly more than the least that HierarchyQuery() leaves. The two
 * add up, since what a point of full resolution was measured from lies in the same diamond, or in a
 * coarser one, whose error is no less. Points stay what they are, with their data, except for
 * normals, which become means; cell data lose their meaning and are removed.
 *
 * @param query the one that was asked for
 */
void SimplifyMesh(const WorldQuery& query, const isodiamond::IsodiamondHierarchy& hierarchy,
  const MeshOptions& options, const isodiamond::ParallelFor& parallelFor, Mesh& mesh)
{
  const isodiamond::GridGeometry& world = options.World;
  const double least = query.AreTrianglesShaped ? LeastTolerance * world.SmallestStep() : 0.0;
  const auto* codes =
    vtkUnsignedShortArray::FastDownCast(mesh.CellData->GetArray(ThresholdsArray))->GetPointer(0);
  const auto allowed = [&](vtkIdType triangle, double tolerance)
  {
    const double used = std::max(tolerance, least);
    if (std::isinf(used)) // a part of it would leave nothing that is a number
    {
      return used;
    }
    const double error = codes[triangle] == 0 ? 0.0
      : options.AreErrorsKnown                ? hierarchy.Codes().Decode(codes[triangle])
                                              : PartForHierarchy(query, used, world) * used;
    return std::max(0.0, used - error);
  };
  isodiamond::AllowedMesh original =
    ToCore(mesh, PlacedTolerance(query, Measure(hierarchy), world), allowed);
  original.LeastAngle = query.AreTrianglesShaped ? LeastAngle : 0.0;
  const isodiamond::SimplerMesh simple = isodiamond::Simplify(original, parallelFor);
  mesh.PointData->RemoveArray(WallsArray);
  if (auto* const normals = vtkFloatArray::FastDownCast(mesh.PointData->GetNormals()))
  {
    isodiamond::TakeMeanNormals(original.Mesh, simple, normals->GetPointer(0));
  }
  const UsedPoints used(simple.Triangles, simple.Positions.size(), parallelFor);
  const std::vector<vtkIdType> ids = used.Ids();
  mesh.Cells = used.Write(simple.Triangles, parallelFor);
  mesh.Points = PointsOf(mesh.Points, ids);
  KeepTuples(mesh.PointData, ids);
  mesh.CellData->Initialize();
}

}

void CheckSimplify(const WorldQuery& query, isodiamond::ErrorMetric metric, bool isVolume)
{
  if (isVolume)
  {
    throw std::invalid_argument("Simplify is for isosurfaces, not for interval volumes.");
  }
  if (metric != isodiamond::ErrorMetric::Distance)
  {
    throw std::invalid_argument(query.AreTrianglesShaped
        ? "SimulationQuality of isosurfaces needs the distance metric."
        : "Simplify needs the distance metric.");
  }
}

Mesh ExtractAsAsked(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  Task extracting = task.Part(0.0, query.Simplify ? 0.3 : 1.0);
  if (query.SimulationQuality)
  {
    return ExtractForSimulation(refined, query, options, extracting);
  }
  if (!query.Simplify)
  {
    return ExtractMesh(refined, options, extracting);
  }
  MeshOptions whole = options;
  whole.Wanted = {};
  whole.WithThresholds = true;
  whole.MorePointData = WithWalls(whole.MorePointData, refined.Hierarchy().SampleGrid());
  Mesh mesh = ExtractMesh(refined, whole, extracting);
  task.Begin("Simplifying", 0.3, 1.0);
  SimplifyMesh(query, refined.Hierarchy(), options, task.For(), mesh);
  KeepShare(options.Wanted, mesh);
  return mesh;
}

std::int64_t CountAsAsked(const isodiamond::IsodiamondHierarchy& hierarchy, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  const Measure measure(hierarchy);
  if (query.Simplify || query.SimulationQuality || (options.Hidden && options.Hidden->Any()))
  {
    return ExtractAsAsked(hierarchy, query, options, task).Cells->GetNumberOfCells();
  }
  const WorldQuery extracted = HierarchyQuery(query, measure, options.World);
  return isodiamond::CountCells(
    isodiamond::RefinedSet(hierarchy, CoreQuery(extracted, hierarchy, options.World), task.For()),
    task.For());
}

Mesh ExtractAsAsked(const isodiamond::IsodiamondHierarchy& hierarchy, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  const Measure measure(hierarchy);
  if (query.Simplify)
  {
    CheckSimplify(query, measure.Metric, hierarchy.Region().IsVolume());
  }
  const WorldQuery extracted = HierarchyQuery(query, measure, options.World);
  task.Begin("Refining", 0.0, 0.3);
  const isodiamond::RefinedSet refined(
    hierarchy, CoreQuery(extracted, hierarchy, options.World), task.For());
  Task extracting = task.Part(0.3, 1.0);
  return ExtractAsAsked(refined, query, options, extracting);
}

}
