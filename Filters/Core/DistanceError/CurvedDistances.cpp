// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/AllWaysBack.h"
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/DistanceWalk.h"
#include "DistanceError/ScaleZeroDistances.h"
#include "DistanceError/ToleranceTest.h"

namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const CurvedLengths& lengths,
  ErrorMaxima& errors, const Loops& loops)
{
  DistanceWalk(clusters, lengths, errors).Run(loops);
}

void MeasureScaleZero(const IsovertexClusters& clusters, const CurvedLengths& lengths,
  ErrorMaxima& errors, const Loops& loops)
{
  ScaleZeroDistances<CurvedLengths>::Run(clusters, lengths, errors, loops);
}

void MeasureBack(const IsodiamondHierarchy& relevant, const CurvedLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops)
{
  AllWaysBack(relevant, lengths, known, code, codes, loops).Run();
}

void TestTolerances(const TestedSurface& surface, const TestedHierarchy& tested,
  const CurvedLengths& lengths, const std::vector<TestedDiamond>& diamonds,
  std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor)
{
  TestAll(surface, tested, lengths, diamonds, exceeds, parallelFor);
}

}
