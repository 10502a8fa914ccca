// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/DistanceWalk.h"
#include "DistanceError/ScaleZeroDistances.h"
#include "DistanceError/WayBack.h"

namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const ParallelFor& parallelFor)
{
  DistanceWalk(clusters, lengths, errors).Run(parallelFor);
}

void MeasureScaleZero(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const ParallelFor& parallelFor)
{
  ScaleZeroDistances<AxesLengths>::Run(clusters, lengths, errors, parallelFor);
}

void MeasureBack(const IsodiamondHierarchy& relevant, const AxesLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const ParallelFor& parallelFor)
{
  MeasureAllBack(relevant, lengths, known, code, codes, parallelFor);
}

}
