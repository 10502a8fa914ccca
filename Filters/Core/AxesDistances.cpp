// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceWalk.h"
#include "FinestDistances.h"

namespace isodiamond
{

void MeasureCoarse(const IsovertexClusters& clusters, const AxesMetric& metric,
  RisingErrors& errors, const ParallelFor& parallelFor)
{
  DistanceWalk(clusters, metric, errors).Run(parallelFor);
}

void MeasureFinest(const IsovertexClusters& clusters, const AxesMetric& metric,
  RisingErrors& errors, const ParallelFor& parallelFor)
{
  FinestDistances<AxesMetric>::Run(clusters, metric, errors, parallelFor);
}

}
