// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ToleranceExcess_h
#define isodiamond_ToleranceExcess_h

#include "Field/Parallel.h"
#include "Stuffing/TetrahedronMesh.h"

#include <vector>

namespace isodiamond
{

/**
 * By how much surfaces of a stuffed mesh are farther from the same ones of the volume's mesh than
 * they may be, both ways and over all of every triangle: a little more than the least length that,
 * added to all allowances, makes them near enough (Coarsening.h says why some are not).
 *
 * @param plain the volume's mesh, on points of the stuffed one
 * @param allowances by leaf, the origins of both
 * @param step the excess is told to a sixteenth of this, or of itself if that is more; if it is 0,
 *        of a small part of the bounds' diagonal
 * @return 0 where all of it is near; NaN if an edge has more than two triangles, so that surfaces
 *         cannot be measured; infinite if there is nothing to be near to
 */
double ToleranceExcess(const TetrahedronMesh& plain, const TetrahedronMesh& stuffed,
  const std::vector<double>& allowances, double step, const ParallelFor& parallelFor);

}

#endif
