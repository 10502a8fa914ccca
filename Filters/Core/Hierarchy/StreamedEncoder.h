// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_StreamedEncoder_h
#define isodiamond_StreamedEncoder_h

#include "Field/SignLattice.h"
#include "Hierarchy/EncodingPasses.h"
#include "Hierarchy/GatheredSamples.h"

namespace isodiamond
{

/**
 * Encode() for a volume that comes in slabs: the same result, bit for bit.
 *
 * Isovertices of short edges are placed when their slab comes, as it has all of the edge. Long
 * edges pass through several slabs: the few samples of these that count, at their ends and where
 * they cross a surface, as the signs tell, are gathered, and their isovertices are placed last.
 */
class StreamedEncoder
{
public:
  /** How many slices a slab needs on both sides of those whose diamonds it writes, where the volume
   *  has them: the length of the longest short edge. */
  static constexpr int Overlap = 8;

  /** Scales from this on have long edges. */
  static constexpr int FirstLongScale = 4;

  /** @param signs of all samples, or of what is left of them. All but the header must outlive it */
  StreamedEncoder(const EncodingHeader& header, const Grid& grid, const DiamondSet& set,
    ErrorCode::Type code, const SignLattice& signs, const ParallelFor& parallelFor);

  /** Writes the diamonds centred in some slices, which come from the first to the last.
   *  @param slab with these slices and those that overlap */
  void Add(const SampleSlab& slab, const SliceRange& slices);

  /** Skips slices that a peer adds. */
  void Skip(const SliceRange& slices);

  /** Adds what peers have added, at least one slab each; together all slices.
   *  @param areSetsOther whether each has a set of its own, with the same long edges: then each
   *         keeps what it has written */
  void Merge(Peers& peers, bool areSetsOther);

  /** To be called once all slices have come. */
  Encoded Finish();

private:
  GatheredSamples WantedSamples() const;
  GatheredEdge LongEdge(const GatheredSamples* values, const Place& place, int vertex) const;

  const EncodingHeader Header;
  const Grid& TheGrid;
  const DiamondSet& Set;
  ErrorCode::Type Code;
  const SignLattice& Signs;
  EncodingPasses Passes;
  GatheredSamples Gathered;
  bool HasValues = false; ///< whether there is room for inside values
};

}

#endif
