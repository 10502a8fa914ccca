// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceMeasuresOf_h
#define isodiamond_DistanceMeasuresOf_h

#include "DistanceError/AllWaysBack.h"
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/DistanceWalk.h"
#include "DistanceError/ScaleZeroDistances.h"
#include "DistanceError/ToleranceTest.h"

/**
 * @file DistanceMeasuresOf.h
 * The definitions of DistanceMeasures, for the files that make them for a kind of lengths.
 */
namespace isodiamond
{

template <typename Lengths>
void DistanceMeasures<Lengths>::Coarse(const IsovertexClusters& clusters, const Lengths& lengths,
  ErrorMaxima& errors, const Loops& loops)
{
  DistanceWalk(clusters, lengths, errors).Run(loops);
}

template <typename Lengths>
void DistanceMeasures<Lengths>::ScaleZero(const IsovertexClusters& clusters, const Lengths& lengths,
  ErrorMaxima& errors, const Loops& loops)
{
  ScaleZeroDistances<Lengths>::Run(clusters, lengths, errors, loops);
}

template <typename Lengths>
void DistanceMeasures<Lengths>::Back(const IsodiamondHierarchy& relevant, const Lengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops)
{
  AllWaysBack(relevant, lengths, known, code, codes, loops).Run();
}

template <typename Lengths>
void DistanceMeasures<Lengths>::Test(const TestedSurface& surface, const TestedHierarchy& tested,
  const Lengths& lengths, const std::vector<TestedDiamond>& diamonds,
  std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor)
{
  TestAll(surface, tested, lengths, diamonds, exceeds, parallelFor);
}

}

#endif
