// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/DistanceWalk.h"

namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AffineLengths& lengths,
  ErrorMaxima& errors, const Loops& loops)
{
  DistanceWalk(clusters, lengths, errors).Run(loops);
}

}
