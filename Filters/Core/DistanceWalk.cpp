// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceWalk.h"

namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AffineMetric& metric,
  RisingErrors& errors, const ParallelFor& parallelFor)
{
  DistanceWalk(clusters, metric, errors).Run(parallelFor);
}

}
