// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Simplify.h"

#include "Private/PlacedTolerance.h"
#include "Private/Simulation.h"
#include "Private/Tuples.h"
#include "Private/UsedPoints.h"
#include "Simplification/Simplification.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace vtkIsodiamond
{
namespace
{

/** Of a tolerance for the hierarchy. The more is left, the fewer triangles come out, and the longer
 *  it takes. */
constexpr double HierarchyPart = 0.3;

isodiamond::AllowedMesh ToCore(const Mesh& mesh, const PlacedTolerance& tolerance)
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
    const double tolerated = tolerance.In(corners.data(), 3);
    result.Allowances.push_back((1.0 - HierarchyPart) * tolerated);
  }
  return result;
}

}

void CheckSimplify(isodiamond::ErrorMetric metric, bool isVolume)
{
  if (isVolume)
  {
    throw std::invalid_argument("Simplify is for isosurfaces, not for interval volumes.");
  }
  if (metric != isodiamond::ErrorMetric::Distance)
  {
    throw std::invalid_argument("Simplify needs the distance metric.");
  }
}

WorldQuery BeforeSimplifying(
  const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world)
{
  WorldQuery part = query;
  part.ErrorTolerance *= HierarchyPart;
  part.OutsideErrorTolerance = HierarchyPart * OutsideOf(query, measure, world);
  if (part.View)
  {
    part.View->TolerancePerDistance *= HierarchyPart;
  }
  return part;
}

void SimplifyMesh(const WorldQuery& query, const Measure& measure,
  const isodiamond::GridGeometry& world, const isodiamond::ParallelFor& parallelFor, Mesh& mesh)
{
  const isodiamond::TriangleMesh simple =
    isodiamond::Simplify(ToCore(mesh, PlacedTolerance(query, measure, world)), parallelFor);
  const UsedPoints used(simple.Triangles, simple.Positions.size());
  mesh.Cells = used.Write(simple.Triangles, parallelFor);
  mesh.Points = PointsOf(mesh.Points, used.Kept);
  KeepTuples(mesh.PointData, used.Kept);
  mesh.CellData->Initialize();
}

Mesh ExtractAsAsked(const isodiamond::IsodiamondHierarchy& hierarchy, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  const Measure measure(hierarchy);
  WorldQuery extracted = query;
  if (query.Simplify)
  {
    CheckSimplify(measure.Metric, hierarchy.Region().IsVolume());
    extracted = BeforeSimplifying(query, measure, options.World);
  }
  task.Begin("Refining", 0.0, 0.3);
  const isodiamond::RefinedSet refined(
    hierarchy, CoreQuery(extracted, hierarchy, options.World), task.For());
  Task extracting = task.Part(0.3, query.Simplify ? 0.5 : 1.0);
  Mesh mesh = query.SimulationQuality ? ExtractForSimulation(refined, query, options, extracting)
                                      : ExtractMesh(refined, options, extracting);
  if (query.Simplify)
  {
    task.Begin("Simplifying", 0.5, 1.0);
    SimplifyMesh(query, measure, options.World, task.For(), mesh);
  }
  return mesh;
}

}
