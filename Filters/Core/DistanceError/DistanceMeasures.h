// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceMeasures_h
#define isodiamond_DistanceMeasures_h

#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/IsovertexClusters.h"
#include "Field/Parallel.h"

/**
 * @file DistanceMeasures.h
 * Raises the distance errors of all diamonds: of scale 1 and above (DistanceWalk.h), and of scale 0
 * (ScaleZeroDistances.h).
 *
 * Those two are templates of the kind of lengths, and each kind has its own file: of two in one,
 * compilers would inline less, and the time is spent in small functions.
 */
namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const ParallelFor& parallelFor);
void MeasureCoarse(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const ParallelFor& parallelFor);

void MeasureScaleZero(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const ParallelFor& parallelFor);
void MeasureScaleZero(const IsovertexClusters& clusters, const AxesLengths& lengths,
  ErrorMaxima& errors, const ParallelFor& parallelFor);

}

#endif
