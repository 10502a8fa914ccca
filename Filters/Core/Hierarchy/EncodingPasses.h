// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_EncodingPasses_h
#define isodiamond_EncodingPasses_h

#include "Field/Peers.h"
#include "Hierarchy/IsodiamondHierarchy.h"
#include "Hierarchy/IsovertexPlacement.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace isodiamond
{

/** Writes which bricks there are, and their masks. */
void WriteBricks(const DiamondSet& set, EncodingArrays<OwnedArray>& arrays);

/**
 * The passes of an encoding: every brick counts what its diamonds have, sums tell where to write
 * this, and it is written, diamond by diamond.
 *
 * Diamonds are read by a DiamondReader. A volume that comes in slabs is written slab by slab: the
 * diamonds of a brick are ordered by slice, so those of the next slab follow.
 */
class EncodingPasses
{
public:
  /** @param set must outlive it, as must the loops */
  EncodingPasses(
    const EncodingHeader& header, const DiamondSet& set, const ParallelFor& parallelFor);

  /** Finds signs and edges, counts, and makes room. */
  template <typename Reader>
  void Count(const Reader& reader)
  {
    this->ForEach(0, this->Set.ScaleCount(), AllSlices,
      [&](std::int64_t brick, const Place& place, std::uint32_t rank)
      {
        const int sign = reader.Sign(place);
        this->Edges.Set(rank, sign, reader.SignsOf(place, sign));
        this->Next[brick + 1].Isovertices += this->Edges.IsovertexCount(rank);
        this->Next[brick + 1].InsideValues += this->Edges.IsInside(rank) ? 1 : 0;
      });
    this->MakeRoom();
  }

  static constexpr SliceRange AllSlices{ 0, 2 << Grid::MaximumDepth };

  /** Writes the isovertices of some scales.
   *  @param edgeOf called with a place and one of its vertices; returns that edge's samples */
  template <typename EdgeOf>
  void WriteIsovertices(
    int firstScale, int endScale, const SliceRange& slices, const EdgeOf& edgeOf)
  {
    std::uint8_t* const isovertices = this->Result.Arrays.Isovertices.data();
    this->ForEach(firstScale, endScale, slices,
      [&](std::int64_t brick, const Place& place, std::uint32_t rank)
      {
        std::int64_t& next = this->Next[brick].Isovertices;
        next = WriteCoefficients(
                 this->Result.Header.Region, this->Edges.LowerOf(rank), this->Edges.UpperOf(rank),
                 [&](int vertex) { return edgeOf(place, vertex); }, isovertices + next) -
          isovertices;
      });
  }

  /** Skips what peers write, leaving room for it. */
  void Skip(int endScale, const SliceRange& slices);

  /** Combines what peers have written. */
  void Merge(Peers& peers);

  /** Makes room for the values inside an interval volume, of the samples' type. */
  template <typename Value>
  void MakeRoomForValues()
  {
    this->Result.InsideValues = std::vector<Value>(this->Next.back().InsideValues);
  }

  /** Writes these values, of all scales. */
  template <typename Reader>
  void WriteInsideValues(const SliceRange& slices, const Reader& reader)
  {
    if (!this->Result.Header.Region.IsVolume())
    {
      return;
    }
    auto& values = std::get<std::vector<typename Reader::Value>>(this->Result.InsideValues);
    this->ForEach(0, this->Set.ScaleCount(), slices,
      [&](std::int64_t brick, const Place& place, std::uint32_t rank)
      {
        if (this->Edges.IsInside(rank))
        {
          values[this->Next[brick].InsideValues++] = reader.ValueAt(place);
        }
      });
  }

  /** Calls body(place, mask of the edges with isovertices) for the counted diamonds of scales from
   *  firstScale up, one after the other. */
  template <typename Body>
  void ForEachCounted(int firstScale, const Body& body) const
  {
    for (int scale = this->Set.ScaleCount() - 1; scale >= firstScale; --scale)
    {
      for (const Brick& brick : this->Set.Level(scale).Bricks)
      {
        this->Set.ForEachInBrick(scale, brick,
          [&](const Place& place, std::uint32_t rank)
          { body(place, this->Edges.LowerOf(rank) | this->Edges.UpperOf(rank)); });
      }
    }
  }

  /** Finishes: writes the records, all with one code. @param withEdges whether to keep diamonds and
   *  edges; if not, the records take over their memory */
  Encoded Take(ErrorCode::Type code, bool withEdges);

private:
  /** What the bricks before a brick hold; while writing, also what the brick has written. */
  struct Offset
  {
    std::int64_t Isovertices = 0;
    std::int64_t InsideValues = 0;
  };

  void MakeRoom();

  /** Calls body(number of the brick, place, rank) for the diamonds of some scales that are centred
   *  in some slices; those of a brick in order. */
  template <typename Body>
  void ForEach(int firstScale, int endScale, const SliceRange& slices, const Body& body) const
  {
    ForEachIndex(this->For, static_cast<std::int64_t>(this->Bricks.size()), 16,
      [&](std::int64_t i)
      {
        const auto [scale, index] = this->Bricks[i];
        if (scale < firstScale || scale >= endScale)
        {
          return;
        }
        const BrickLevel& level = this->Set.Level(scale);
        const Brick& brick = level.Bricks[index];
        const int first = level.Box.Origin(brick.BoxIndex)[2];
        for (int z = 0; z < 8; ++z)
        {
          const int slice = (first + z) << scale;
          if (slice >= slices.Begin && slice < slices.End)
          {
            this->Set.ForEachInWord(scale, brick, z,
              [&](const Place& place, std::uint32_t rank) { body(i, place, rank); });
          }
        }
      });
  }

  const DiamondSet& Set;
  const ParallelFor& For;
  std::vector<BrickPlace> Bricks;
  std::vector<Offset> Next; ///< by brick, and the totals
  Encoding Result;
  DiamondEdges Edges;
};

}

#endif
