// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceMeasures_h
#define isodiamond_DistanceMeasures_h

#include "DistanceError/DistanceError.h"
#include "DistanceError/DistanceTests.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/IsovertexClusters.h"
#include "Field/Parallel.h"

/**
 * @file DistanceMeasures.h
 * Raises the distance errors of all diamonds: of scale 1 and above (DistanceWalk.h), and of scale 0
 * (ScaleZeroDistances.h).
 *
 * Both are templates over the kind of lengths. Their time is spent in small functions, and the more
 * of these a file has, the fewer compilers inline: so each kind has files of its own, and the
 * frequent one, affine, one for each template.
 */
namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);
void MeasureCoarse(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);
void MeasureCoarse(const IsovertexClusters& clusters, const CurvedLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);

void MeasureScaleZero(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);
void MeasureScaleZero(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);
void MeasureScaleZero(const IsovertexClusters& clusters, const CurvedLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);

/** Raises errors to the way back (WayBack.h), each diamond by itself.
 *  @param codes by rank, of the way forth */
void MeasureBack(const IsodiamondHierarchy& relevant, const AffineLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops);
void MeasureBack(const IsodiamondHierarchy& relevant, const AxesLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops);
void MeasureBack(const IsodiamondHierarchy& relevant, const CurvedLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops);

/** Tells whether diamonds exceed what is tolerated of them, on one surface (ToleranceTest.h).
 *  @param exceeds one entry per diamond, to be set where it does */
void TestTolerances(const TestedSurface& surface, const TestedHierarchy& tested,
  const AffineLengths& lengths, const std::vector<TestedDiamond>& diamonds,
  std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor);
void TestTolerances(const TestedSurface& surface, const TestedHierarchy& tested,
  const AxesLengths& lengths, const std::vector<TestedDiamond>& diamonds,
  std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor);
void TestTolerances(const TestedSurface& surface, const TestedHierarchy& tested,
  const CurvedLengths& lengths, const std::vector<TestedDiamond>& diamonds,
  std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor);

}

#endif
