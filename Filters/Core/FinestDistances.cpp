// SPDX-License-Identifier: BSD-3-Clause
#include "FinestDistances.h"

namespace isodiamond
{

void MeasureFinest(const IsovertexClusters& clusters, const AffineMetric& metric,
  RisingErrors& errors, const ParallelFor& parallelFor)
{
  FinestDistances<AffineMetric>::Run(clusters, metric, errors, parallelFor);
}

}
