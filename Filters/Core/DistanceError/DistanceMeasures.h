// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceMeasures_h
#define isodiamond_DistanceMeasures_h

#include "DistanceError/DistanceError.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/IsovertexClusters.h"
#include "Field/Parallel.h"

/**
 * @file DistanceMeasures.h
 * Raises the distance errors of all diamonds: of scale 1 and above (DistanceWalk.h), and of scale 0
 * (ScaleZeroDistances.h).
 *
 * Those two are templates of the kind of lengths. Their time is spent in small functions, of which
 * compilers inline less the more a file has: so the kinds are in files of their own, and the
 * frequent one, affine, in one for each template.
 */
namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);
void MeasureCoarse(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);

void MeasureScaleZero(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);
void MeasureScaleZero(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const Loops& loops);

/** Raises errors to the way back (WayBack.h), of each diamond by itself.
 *  @param codes by rank, of the way forth */
void MeasureBack(const IsodiamondHierarchy& relevant, const AffineLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops);
void MeasureBack(const IsodiamondHierarchy& relevant, const AxesLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops);

}

#endif
