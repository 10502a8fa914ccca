// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Encoder_h
#define isodiamond_Encoder_h

#include "Field/SignLattice.h"
#include "Hierarchy/IsodiamondHierarchy.h"

namespace isodiamond
{

/**
 * Writes the encoding of a set of isodiamonds, all with the same error code: signs, isovertices and
 * values inside come from the samples.
 *
 * @param set the isodiamonds and the corners of the base cube
 * @param signs those to go by where small pieces were removed; null for the samples'. Values inside
 *        are samples all the same
 * @param withEdges whether the edges are wanted that it finds on the way; else less memory is used
 */
Encoded Encode(const EncodingHeader& header, const Grid& grid, const AnySamples& samples,
  const DiamondSet& set, ErrorCode::Type code, const ParallelFor& parallelFor,
  const SignLattice* signs = nullptr, bool withEdges = true);

}

#endif
