// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Simulation.h"

#include "Private/HierarchyQuery.h"
#include "Private/PlacedTolerance.h"

#include <cmath>

namespace vtkIsodiamond
{
namespace
{

/** In each round, leaves that are too far away become a level finer; smooth volumes need three to
 *  eight. */
constexpr int MostRounds = 10;

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
