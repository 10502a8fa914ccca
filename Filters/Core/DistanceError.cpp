// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError.h"

#include "DistanceWalk.h"
#include "FinestDistances.h"

#include <cmath>
#include <variant>

namespace isodiamond
{

double DistanceErrorScale(const Grid& grid, const GridGeometry& world)
{
  const Point last = { grid.Last(0), grid.Last(1), grid.Last(2) };
  const Vector diagonal = std::visit(
    [&](const auto& metric) {
      return metric.Between({ 0, 0, 0 }, last);
    },
    WorldMetricOf(world));
  return ErrorCode(std::sqrt(Dot(diagonal, diagonal))).Scale();
}

std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const AnySamples& samples, const GridGeometry& world, bool preserveFeatures,
  const ParallelFor& parallelFor)
{
  RisingErrors errors(
    relevant, samples, world, DistanceErrorScale(relevant.Domain(), world), preserveFeatures);
  for (int surface = 0; surface < relevant.Region().SurfaceCount(); ++surface)
  {
    for (const auto ends : { IsovertexClusters::Ends::Finite, IsovertexClusters::Ends::NotFinite })
    {
      if (ends == IsovertexClusters::Ends::NotFinite && errors.IsFinite().All())
      {
        continue; // there are none
      }
      const IsovertexClusters clusters(relevant, errors.IsFinite(), surface, ends, parallelFor);
      std::visit(
        [&](const auto& metric)
        {
          MeasureCoarse(clusters, metric, errors, parallelFor);
          MeasureFinest(clusters, metric, errors, parallelFor);
        },
        errors.Metric());
    }
  }
  return errors.Result();
}

}
