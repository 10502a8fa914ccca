// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/ScaleZeroDistances.h"

namespace isodiamond
{

void MeasureScaleZero(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const Loops& loops)
{
  ScaleZeroDistances<AffineLengths>::Run(clusters, lengths, errors, loops);
}

}
