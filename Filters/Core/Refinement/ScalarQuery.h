// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ScalarQuery_h
#define isodiamond_ScalarQuery_h

#include "Hierarchy/IsodiamondHierarchy.h"
#include "Hierarchy/ScalarHierarchy.h"
#include "Refinement/Query.h"

namespace isodiamond
{

/**
 * One HD query: the subdivided diamonds, encoded as an RI in which every diamond is always
 * subdivided. Extraction from it gives the query's mesh at any tolerance. The set is closed, so all
 * vertices of its diamonds are centres of diamonds of the set.
 */
Encoded EncodeQuery(const ScalarHierarchy& hierarchy, const Isoregion& region, const Query& query,
  bool exactIsovertices, const ParallelFor& parallelFor);

}

#endif
