// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Builder.h"

#include "Build/BuildSteps.h"
#include "DistanceError/DistanceError.h"

#include <optional>
#include <stdexcept>
#include <utility>

namespace isodiamond
{
namespace
{

Encoding BuildByField(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  const BuildSteps steps(source, region, options, source.FieldScale, parallelFor);
  DiamondCodes codes = steps.MeasureField();
  steps.FindThresholds(codes);
  // Isovertices last: takes less memory at a time.
  return steps.Complete(model, steps.PlaceIsovertices(0.9, 1.0, false).Encoding, std::move(codes));
}

Encoding BuildByDistance(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  // First of all: throws if there are no distances.
  const double errorScale = DistanceErrorScale(source.SampleGrid, options.World);
  const BuildSteps steps(source, region, options, errorScale, parallelFor);
  // Distances are measured on this one.
  Encoded relevant = steps.PlaceIsovertices(0.2, 0.25);
  DiamondCodes codes = steps.MeasureDistances(
    IsodiamondHierarchy(relevant.Encoding, std::move(relevant.Diamonds), std::move(relevant.Edges)),
    Finiteness(source.Samples));
  steps.FindThresholds(codes);
  return steps.Complete(model, std::move(relevant.Encoding), std::move(codes));
}

Encoding Build(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  return options.Metric == ErrorMetric::Field
    ? BuildByField(model, source, region, options, parallelFor)
    : BuildByDistance(model, source, region, options, parallelFor);
}

}

Encoding BuildIsodiamonds(Model model, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckOptions(options);
  const ErrorCode code(FieldErrorScale(samples, parallelFor));
  const Grid grid = GridOf(samples);
  std::optional<FieldErrors> errors; // take a pass over the samples, and are not always needed
  if (NeedsFieldErrors(region, options))
  {
    errors.emplace(grid, samples, parallelFor, WantedRange(region));
  }
  const auto summary = [&](const Place& place) { return SummaryOf(*errors, code.Scale(), place); };
  return Build(model, { grid, samples, code.Scale(), summary }, region, options, parallelFor);
}

Encoding BuildIsodiamonds(Model model, const ScalarHierarchy& hierarchy, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckOptions(options);
  if (options.MinimumPieceSize > 1)
  {
    throw std::invalid_argument("Small pieces cannot be removed from a hierarchy of diamonds: its "
                                "errors are those of all samples.");
  }
  const auto summary = [&](const Place& place)
  { return std::make_pair(hierarchy.Error(place), hierarchy.Range(place)); };
  return Build(model,
    { hierarchy.SampleGrid(), hierarchy.Samples(), hierarchy.Codes().Scale(), summary }, region,
    options, parallelFor);
}

}