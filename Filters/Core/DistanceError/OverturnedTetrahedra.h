// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_OverturnedTetrahedra_h
#define isodiamond_OverturnedTetrahedra_h

#include "Field/GridGeometry.h"
#include "Field/Parallel.h"
#include "Hierarchy/IsodiamondHierarchy.h"

#include <vector>

namespace isodiamond
{

/**
 * Has diamonds always subdivided if a mesh with them would have tetrahedra of an interval volume
 * that are turned over in the world.
 *
 * In index space all are positive, as isovertices lie on edges, and so in an affine world. Where
 * steps differ or the grid is bent, a long edge is not straight in the world, and an isovertex on
 * it may be so far to its side that a tetrahedron turns over. At full resolution, in a single cell,
 * that does not happen along axes; in cells that are bent it may.
 *
 * @param relevant an RI; nothing happens if it is of an isosurface
 * @param codes by rank, those of such diamonds become ErrorCode::Always
 */
void SubdivideOverturned(const IsodiamondHierarchy& relevant, const GridGeometry& world,
  const ParallelFor& parallelFor, std::vector<ErrorCode::Type>& codes);

}

#endif
