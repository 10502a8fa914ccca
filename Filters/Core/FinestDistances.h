// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FinestDistances_h
#define isodiamond_FinestDistances_h

#include "IsovertexClusters.h"
#include "Parallel.h"
#include "RisingErrors.h"

namespace isodiamond
{

/** Raises the distance errors of the diamonds of scale 0, each by itself: a table tells which edges
 *  of full resolution lie in which of its tetrahedra. */
void MeasureFinest(
  const IsovertexClusters& clusters, RisingErrors& errors, const ParallelFor& parallelFor);

}

#endif
