// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError.h"

#include "DistanceWalk.h"
#include "FinestDistances.h"

#include <cmath>
#include <stdexcept>

namespace isodiamond
{

double DistanceErrorScale(const Grid& grid, const AffineMap& world)
{
  const WorldMetric metric(world);
  if (!metric.IsValid())
  {
    throw std::invalid_argument("Distances need a spacing that is neither 0 nor infinite.");
  }
  const Vector diagonal = metric(grid.Last(0), grid.Last(1), grid.Last(2));
  return ErrorCode(std::sqrt(Dot(diagonal, diagonal))).Scale();
}

std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const AnySamples& samples, const AffineMap& world, bool preserveFeatures,
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
      MeasureCoarse(clusters, errors, parallelFor);
      MeasureFinest(clusters, errors, parallelFor);
    }
  }
  return errors.Result();
}

}
