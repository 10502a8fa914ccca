// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceWalk_h
#define isodiamond_DistanceWalk_h

#include "IsovertexClusters.h"
#include "Parallel.h"
#include "RisingErrors.h"

namespace isodiamond
{

/**
 * Raises the distance errors of the diamonds of scale 1 and above.
 *
 * The isovertices of full resolution are handed down the tree of bisected tetrahedra. Every
 * tetrahedron that holds some raises the error of the diamond that it lies in. Where diamonds are
 * large, whole clusters are handed down: most are so near to the patches that none of their
 * isovertices can be the farthest.
 */
void MeasureCoarse(
  const IsovertexClusters& clusters, RisingErrors& errors, const ParallelFor& parallelFor);

}

#endif
