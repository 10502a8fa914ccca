// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Simulation.h"

#include "Private/HierarchyQuery.h"
#include "Private/PlacedTolerance.h"
#include "Private/UsedPoints.h"
#include "Stuffing/TetrahedronMesh.h"

#include "vtkCellArray.h"

#include <algorithm>
#include <cmath>

namespace vtkIsodiamond
{
namespace
{

/** In each round, leaves that are too far away become a level finer; smooth volumes need three to
 *  eight. */
constexpr int MostRounds = 10;

/** The volume of what a query gives if it is not for simulations. */
double PlainVolume(const isodiamond::IsodiamondHierarchy& hierarchy, const isodiamond::Query& query,
  const MeshOptions& options, Task& task)
{
  MeshOptions plain = options;
  plain.PointsPrecision = vtkAlgorithm::DEFAULT_PRECISION;
  plain.MorePointData = nullptr;
  plain.Wanted = {};
  const Mesh mesh = ExtractMesh(isodiamond::RefinedSet(hierarchy, query, task.For()), plain, task);
  isodiamond::TetrahedronMesh tetrahedra;
  tetrahedra.Positions = PositionsOf(mesh.Points);
  for (vtkIdType cell = 0; cell < mesh.Cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    mesh.Cells->GetCellAtId(cell, size, ids);
    isodiamond::Corners& corners = tetrahedra.Tetrahedra.emplace_back();
    std::copy_n(ids, corners.size(), corners.begin());
  }
  return VolumeOf(tetrahedra);
}

}

Mesh ExtractForSimulation(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  const isodiamond::IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  const Measure measure(hierarchy);
  MeshOptions asked = options;
  asked.ForSimulation = true;
  if (!GetsCoarser(query, measure.Metric))
  {
    return ExtractMesh(refined, asked, task);
  }
  const PlacedTolerance tolerance(query, measure, options.World);
  asked.DistanceTolerance = query.ErrorTolerance;
  asked.ToleranceIn = [&](const isodiamond::Vector* corners, int count)
  { return tolerance.In(corners, count); };
  asked.KeepsInside = std::isfinite(query.InteriorTolerance);
  isodiamond::Query core =
    CoreQuery(HierarchyQuery(query, measure, options.World), hierarchy, options.World);
  asked.VolumeAtTolerance =
    PlainVolume(hierarchy, CoreQuery(query, hierarchy, options.World), options, task);
  Mesh mesh = ExtractMesh(refined, asked, task);
  for (int round = 1; round <= MostRounds && !mesh.FarDiamonds.empty(); ++round)
  {
    core.Also.insert(core.Also.end(), mesh.FarDiamonds.begin(), mesh.FarDiamonds.end());
    asked.MayRefine = round < MostRounds;
    mesh = ExtractMesh(isodiamond::RefinedSet(hierarchy, core, task.For()), asked, task);
  }
  return mesh;
}

}
