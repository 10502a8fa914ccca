// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_StreamedEncoder_h
#define isodiamond_StreamedEncoder_h

#include "Field/SignLattice.h"
#include "Hierarchy/EncodingPasses.h"
#include "Hierarchy/GatheredSamples.h"

namespace isodiamond
{

/**
 * Encode() of a volume that comes in slabs: the same to the bit.
 *
 * Isovertices of short edges are placed when their slab comes, which has all of the edge. Long
 * edges lead through several: of these the few samples that count, at their ends and where they
 * cross a surface, which signs tell, are gathered, and their isovertices are placed in the end.
 */
class StreamedEncoder
{
public:
  /** So many slices a slab needs on both sides of those whose diamonds it writes, where the volume
   *  has them: the length of the longest short edge. */
  static constexpr int Overlap = 8;

  /** Scales from this on have long edges. */
  static constexpr int FirstLongScale = 4;

  /** @param signs of all samples, or of what is left of them. All but the header must outlive it */
  StreamedEncoder(const EncodingHeader& header, const Grid& grid, const DiamondSet& set,
    ErrorCode::Type code, const SignLattice& signs, const ParallelFor& parallelFor);

  /** Writes what has its centre in some slices, which come from the first to the last.
   *  @param slab with these and those that overlap */
  void Add(const SampleSlab& slab, const SliceRange& slices);

  /** Slices that a peer adds. */
  void Skip(const SliceRange& slices);

  /** What peers have added, each at least one slab; together all slices.
   *  @param areSetsOther whether each has a set of its own, with the same long edges: what it has
   *         written is its own then */
  void Merge(Peers& peers, bool areSetsOther);

  /** Once all slices have come. */
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
  bool HasValues = false; ///< room for the values inside
};

}

#endif
