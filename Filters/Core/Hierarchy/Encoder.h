// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Encoder_h
#define isodiamond_Encoder_h

#include "Field/SignLattice.h"
#include "Hierarchy/IsodiamondHierarchy.h"

namespace isodiamond
{

/**
 * Writes the encoding of a set of isodiamonds, all with the same error code: signs, isovertices and
 * inside values come from the samples.
 *
 * @param set the isodiamonds and the corners of the base cube
 * @param signs those to use where small pieces were removed; null for the samples'. Inside values
 *        are samples in either case
 * @param withEdges whether to keep the diamonds, and the edges it finds on the way, for a hierarchy
 *        that need not derive them; otherwise less memory is used
 */
Encoded Encode(const EncodingHeader& header, const Grid& grid, const AnySamples& samples,
  const DiamondSet& set, ErrorCode::Type code, const ParallelFor& parallelFor,
  const SignLattice* signs = nullptr, bool withEdges = true);

}

#endif
