// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceError.h"

#include "DistanceError/DistanceMeasures.h"

#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

namespace isodiamond
{

double DistanceErrorScale(const Grid& grid, const GridGeometry& world)
{
  const Point last = { grid.Last(0), grid.Last(1), grid.Last(2) };
  return ErrorCode(std::visit([&](const auto& lengths) { return lengths.LongestDistance(last); },
                     WorldLengthsOf(world)))
    .Scale();
}

std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const Finiteness& isFinite, const GridGeometry& world, bool preserveFeatures, const Loops& loops,
  std::vector<ErrorCode::Type> codes, MapBounds* bounds, const DiamondPortion* portion)
{
  MapBounds none;
  codes.resize(relevant.Diamonds().Size(), 0);
  ErrorMaxima errors(relevant, isFinite, world, DistanceErrorScale(relevant.SampleGrid(), world),
    preserveFeatures, std::exchange(codes, {}), bounds != nullptr ? *bounds : none);
  for (int surface = 0; surface < relevant.Region().SurfaceCount(); ++surface)
  {
    for (const auto ends : { IsovertexClusters::Ends::Finite, IsovertexClusters::Ends::NotFinite })
    {
      if (ends == IsovertexClusters::Ends::NotFinite && errors.IsFinite().All())
      {
        continue; // there are none
      }
      const IsovertexClusters clusters(
        relevant, errors.IsFinite(), surface, ends, loops.Whole, portion);
      std::visit(
        [&](const auto& lengths)
        {
          using Measures = DistanceMeasures<std::decay_t<decltype(lengths)>>;
          Measures::Coarse(clusters, lengths, errors, loops);
          Measures::ScaleZero(clusters, lengths, errors, loops);
        },
        errors.Lengths());
    }
  }
  return errors.Result();
}

void RaiseByWayBack(const IsodiamondHierarchy& relevant, const GridGeometry& world,
  const BeforeWayBack& known, std::vector<ErrorCode::Type>& codes, const Loops& loops)
{
  const ErrorCode code(DistanceErrorScale(relevant.SampleGrid(), world));
  std::visit(
    [&](const auto& lengths)
    {
      DistanceMeasures<std::decay_t<decltype(lengths)>>::Back(
        relevant, lengths, known, code, codes, loops);
    },
    WorldLengthsOf(world));
}

}
