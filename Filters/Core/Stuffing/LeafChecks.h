// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_LeafChecks_h
#define isodiamond_LeafChecks_h

#include "Field/Parallel.h"
#include "Mesh/CutMesh.h"

namespace isodiamond
{

/** A hierarchy from a damaged file may have leaves of which there is nothing to be made.
 *  @throws std::invalid_argument if two corners of a leaf, or two points of its pieces, are the
 * same
 */
void CheckLeaves(const CutMesh& mesh, const ParallelFor& parallelFor);

}

#endif
