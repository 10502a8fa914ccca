// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Simulation.h"

#include "Private/PlacedTolerance.h"

namespace vtkIsodiamond
{
namespace
{

/** Each time leaves that are too far away become finer by a level; few need more than three. */
constexpr int MostRounds = 12;

}

Mesh ExtractForSimulation(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task)
{
  const isodiamond::IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  if (!hierarchy.Region().IsVolume())
  {
    throw std::invalid_argument("SimulationQuality is for interval volumes, not for isosurfaces.");
  }
  const Measure measure(hierarchy);
  MeshOptions asked = options;
  asked.ForSimulation = true;
  if (measure.Metric != isodiamond::ErrorMetric::Distance || query.IsFull())
  {
    return ExtractMesh(refined, asked, task);
  }
  const PlacedTolerance tolerance(query, measure, options.World);
  asked.DistanceTolerance = query.ErrorTolerance;
  asked.ToleranceIn = [&](const isodiamond::Vector* corners, int count)
  { return tolerance.In(corners, count); };
  isodiamond::Query core = CoreQuery(query, hierarchy, options.World);
  Mesh mesh = ExtractMesh(refined, asked, task);
  for (int round = 0; round < MostRounds && !mesh.FarDiamonds.empty(); ++round)
  {
    core.Also.insert(core.Also.end(), mesh.FarDiamonds.begin(), mesh.FarDiamonds.end());
    mesh = ExtractMesh(isodiamond::RefinedSet(hierarchy, core, task.For()), asked, task);
  }
  return mesh;
}

}
