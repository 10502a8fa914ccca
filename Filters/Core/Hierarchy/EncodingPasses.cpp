// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/EncodingPasses.h"

#include <limits>
#include <stdexcept>
#include <utility>

namespace isodiamond
{

EncodingPasses::EncodingPasses(
  const EncodingHeader& header, const DiamondSet& set, const ParallelFor& parallelFor)
  : Set(set)
  , For(parallelFor)
  , Bricks(AllBricks(set))
  , Next(this->Bricks.size() + 1)
  , Edges(set.Size(), header.Region)
{
  this->Result.Header = header;
  WriteBricks(set, this->Result.Arrays);
}

void WriteBricks(const DiamondSet& set, EncodingArrays<OwnedArray>& arrays)
{
  const std::int64_t count = set.CountBricks();
  arrays.BrickIndices.reserve(count);
  arrays.BrickMasks.reserve(8 * count);
  for (int scale = set.ScaleCount() - 1; scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = set.Level(scale).Bricks;
    arrays.BrickCounts.push_back(static_cast<std::uint32_t>(bricks.size()));
    for (const Brick& brick : bricks)
    {
      arrays.BrickIndices.push_back(brick.BoxIndex);
      arrays.BrickMasks.insert(
        arrays.BrickMasks.end(), brick.Occupancy.begin(), brick.Occupancy.end());
    }
  }
}

void EncodingPasses::Skip(int endScale, const SliceRange& slices)
{
  this->ForEach(0, this->Set.ScaleCount(), slices,
    [&](std::int64_t brick, const Place& place, std::uint32_t rank)
    {
      this->Next[brick].Isovertices +=
        place.Scale < endScale ? this->Edges.IsovertexCount(rank) : 0;
      this->Next[brick].InsideValues += this->Edges.IsInside(rank) ? 1 : 0;
    });
}

void EncodingPasses::Merge(Peers& peers)
{
  peers.Or(this->Result.Arrays.Isovertices);
  std::visit([&](auto& values) { peers.Or(values); }, this->Result.InsideValues);
}

Encoded EncodingPasses::Take(ErrorCode::Type code, bool withEdges)
{
  std::vector<std::uint16_t>& edges = this->Edges.LowerAndKinds;
  std::vector<std::uint16_t> records = withEdges ? edges : std::move(edges);
  for (std::uint16_t& record : records)
  {
    record = Record::Pack(code, DiamondEdges::SignIn(record));
  }
  this->Result.Arrays.Records = std::move(records);
  if (!withEdges)
  {
    return { std::move(this->Result), {}, {} };
  }
  return { std::move(this->Result), this->Set, std::move(this->Edges) };
}

void EncodingPasses::MakeRoom()
{
  // Prefix sum.
  for (std::size_t i = 0; i < this->Bricks.size(); ++i)
  {
    this->Next[i + 1].Isovertices += this->Next[i].Isovertices;
    this->Next[i + 1].InsideValues += this->Next[i].InsideValues;
  }
  if (this->Next.back().Isovertices > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("more than 2^32 - 1 isovertices");
  }
  if (this->Next.back().InsideValues > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("more than 2^31 - 1 values inside the interval volume");
  }
  this->Result.Arrays.Isovertices.resize(this->Next.back().Isovertices);
}

}
