// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Query/HierarchyQuery.h"

#include <algorithm>

namespace vtkIsodiamond
{
namespace
{

constexpr double LargestPartOfSimplify = 0.3;
/** Leaving more would be of no use: the tetrahedra's shape limits how coarse they get, and finer
 *  ones take time. */
constexpr double PartOfSimulation = 0.65;

}

bool GetsCoarser(const WorldQuery& query, isodiamond::ErrorMetric metric)
{
  return query.Simplify ||
    (query.SimulationQuality && metric == isodiamond::ErrorMetric::Distance && !query.IsFull());
}

double PartForHierarchy(
  const WorldQuery& query, double tolerance, const isodiamond::GridGeometry& world)
{
  if (query.SimulationQuality)
  {
    return PartOfSimulation;
  }
  // A small tolerance is used up by the hierarchy's triangles. With a view the part must not depend
  // on the place.
  return query.View ? LargestPartOfSimplify
                    : std::min(LargestPartOfSimplify, 0.4 * tolerance / world.SmallestStep());
}

double CoarsestTolerance(const WorldQuery& query, isodiamond::ErrorMetric metric, double scale,
  const isodiamond::GridGeometry& world)
{
  double tolerance = scale;
  while (
    GetsCoarser(query, metric) && tolerance * PartForHierarchy(query, tolerance, world) < scale)
  {
    tolerance *= 2.0;
  }
  return tolerance;
}

WorldQuery HierarchyQuery(
  const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world)
{
  WorldQuery part = query;
  if (!GetsCoarser(query, measure.Metric))
  {
    return part;
  }
  const auto partOf = [&](double tolerance)
  { return tolerance * PartForHierarchy(query, tolerance, world); };
  part.ErrorTolerance = partOf(query.ErrorTolerance);
  part.OutsideErrorTolerance = partOf(OutsideOf(query, measure, world));
  if (part.View)
  {
    part.View->TolerancePerDistance = partOf(part.View->TolerancePerDistance);
  }
  return part;
}

}
