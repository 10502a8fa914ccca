// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Encoder_h
#define isodiamond_Encoder_h

#include "IsodiamondHierarchy.h"
#include "Samples.h"

namespace isodiamond
{

/**
 * Writes the encoding of a set of isodiamonds: signs and isovertices come from the samples.
 *
 * @param set the isodiamonds and the corners of the base cube
 * @param thresholds by rank of the set
 */
Encoding Encode(const EncodingHeader& header, const Grid& grid, const AnySamples& samples,
  const DiamondSet& set, const std::vector<ErrorCode::Type>& thresholds,
  const ParallelFor& parallelFor);

}

#endif
