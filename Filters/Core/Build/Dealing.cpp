// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Dealing.h"

#include "FieldError/MidpointOrder.h"
#include "Hierarchy/EncodingPasses.h"
#include "Hierarchy/StreamedEncoder.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

/** Some diamonds, in the order of all: their ranks among those that are told of, and had. */
class Block
{
public:
  static constexpr std::size_t Most = 8192;

  void Add(std::int64_t told, std::int64_t had)
  {
    this->Told.push_back(told);
    this->Had.push_back(had);
  }
  void Clear()
  {
    this->Told.clear();
    this->Had.clear();
  }
  std::size_t Size() const { return this->Told.size(); }

  /** Calls body(i, rank) for those that this process tells of. */
  template <typename Body>
  void ForEachTold(const Body& body) const
  {
    ForEach(this->Told, body);
  }
  template <typename Body>
  void ForEachHad(const Body& body) const
  {
    ForEach(this->Had, body);
  }

private:
  template <typename Body>
  static void ForEach(const std::vector<std::int64_t>& ranks, const Body& body)
  {
    for (std::size_t i = 0; i < ranks.size(); ++i)
    {
      if (ranks[i] != DiamondSet::None)
      {
        body(i, static_cast<std::size_t>(ranks[i]));
      }
    }
  }

  std::vector<std::int64_t> Told;
  std::vector<std::int64_t> Had;
};

/** Calls body(block) for all diamonds, some at once: as often in all processes. */
template <typename Body>
void ForEachBlock(
  const DiamondMask& all, const DiamondSet& told, const DiamondSet& had, const Body& body)
{
  Block block;
  all.ForEach(
    [&](const Place& place)
    {
      block.Add(told.Rank(place), had.Rank(place));
      if (block.Size() == Block::Most)
      {
        body(block);
        block.Clear();
      }
    });
  body(block);
}

/** Where lists of so many values begin that are one behind the other, and at last their end. */
template <typename Size>
std::vector<std::uint32_t> FirstsOf(const std::vector<Size>& sizes)
{
  std::vector<std::uint32_t> firsts(sizes.size() + 1, 0);
  std::inclusive_scan(
    sizes.begin(), sizes.end(), firsts.begin() + 1, std::plus<>(), std::uint32_t{ 0 });
  return firsts;
}

/** Deals arrays of what slabs tell. */
class Dealer
{
public:
  Dealer(const PeerPortion& portion, const DiamondSet& told, const DiamondSet& had)
    : Portion(portion)
    , Told(told)
    , Had(had)
  {
  }

  /** One value a diamond, 0 where others tell; or none, of all peers. */
  template <typename T>
  std::vector<T> Values(const std::vector<T>& told) const
  {
    if (told.empty())
    {
      return {}; // else there are the corners of the base cube
    }
    std::vector<T> had;
    this->Portion.Others().Together([&] { had.resize(this->Had.Size()); });
    std::vector<T> some;
    ForEachBlock(this->Portion.All(), this->Told, this->Had,
      [&](const Block& block)
      {
        some.assign(block.Size(), T{});
        block.ForEachTold([&](std::size_t i, std::size_t rank) { some[i] = told[rank]; });
        this->Portion.Others().Or(some);
        block.ForEachHad([&](std::size_t i, std::size_t rank) { had[rank] = some[i]; });
      });
    return had;
  }

  /** A list of values a diamond. @param toldSizes, hadSizes by rank */
  template <typename T>
  std::vector<T> Lists(const std::vector<T>& told, const std::vector<std::uint8_t>& toldSizes,
    const std::vector<std::uint8_t>& hadSizes) const
  {
    std::vector<std::uint32_t> toldFirsts;
    std::vector<std::uint32_t> hadFirsts;
    std::vector<T> had;
    this->Portion.Others().Together(
      [&]
      {
        toldFirsts = FirstsOf(toldSizes);
        hadFirsts = FirstsOf(hadSizes);
        had.resize(hadFirsts.back());
      });
    std::vector<std::uint16_t> sizes;
    std::vector<T> some;
    ForEachBlock(this->Portion.All(), this->Told, this->Had,
      [&](const Block& block)
      {
        sizes.assign(block.Size(), 0);
        block.ForEachTold([&](std::size_t i, std::size_t rank) { sizes[i] = toldSizes[rank]; });
        this->Portion.Others().Max(sizes.data(), static_cast<std::int64_t>(sizes.size()));
        const std::vector<std::uint32_t> firsts = FirstsOf(sizes);
        some.assign(firsts.back(), T{});
        block.ForEachTold([&](std::size_t i, std::size_t rank)
          { std::copy_n(told.begin() + toldFirsts[rank], sizes[i], some.begin() + firsts[i]); });
        this->Portion.Others().Or(some);
        block.ForEachHad([&](std::size_t i, std::size_t rank)
          { std::copy_n(some.begin() + firsts[i], sizes[i], had.begin() + hadFirsts[rank]); });
      });
    return had;
  }

private:
  const PeerPortion& Portion;
  const DiamondSet& Told;
  const DiamondSet& Had;
};

/** How many isovertices diamonds have, by rank. */
std::vector<std::uint8_t> IsovertexCounts(const DiamondEdges& edges)
{
  std::vector<std::uint8_t> counts(edges.LowerAndKinds.size());
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    counts[rank] =
      static_cast<std::uint8_t>(PopCount(edges.LowerOf(rank)) + PopCount(edges.UpperOf(rank)));
  }
  return counts;
}

/** How many values inside of an interval volume: one or none. */
std::vector<std::uint8_t> InsideCounts(const DiamondEdges& edges)
{
  std::vector<std::uint8_t> counts(edges.LowerAndKinds.size());
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    counts[rank] = edges.SignOf(rank) == InsideSign ? 1 : 0;
  }
  return counts;
}

DiamondSet TellersOf(const DiamondMask& all, const Grid& grid, const std::vector<SliceRange>& slabs)
{
  const auto isTold = [&](int scale, int slice)
  {
    return scale >= std::min(Dealing::FirstCommonScale, grid.Depth()) ||
      std::any_of(slabs.begin(), slabs.end(),
        [&](const SliceRange& slab) { return slice >= slab.Begin && slice < slab.End; });
  };
  return { grid, all, [&](int scale, int z) {
            return isTold(scale, z << scale) ? ~std::uint64_t{ 0 } : std::uint64_t{ 0 };
          } };
}

}

static_assert(Dealing::FirstCommonScale <= StreamedEncoder::FirstLongScale &&
    Dealing::FirstCommonScale <= MidpointOrder::MaximumScale + 1,
  "long edges and large domains are those of all peers");

Dealing::Dealing(const Grid& grid, const PeerPortion& portion, const DiamondSet& members,
  const std::vector<SliceRange>& slabs)
  : Portion(portion)
  , Members(members)
  , Told(TellersOf(portion.All(), grid, slabs))
{
}

Encoded Dealing::Deal(Encoded told) const
{
  // What has been dealt is forgotten.
  const Dealer dealer(this->Portion, this->Told, this->Members);
  const auto deal = [&](auto& values) { values = dealer.Values(std::exchange(values, {})); };
  EncodingArrays<OwnedArray>& arrays = told.Encoding.Arrays;
  std::vector<std::uint8_t> isovertices;
  std::vector<std::uint8_t> inside;
  this->Portion.Others().Together(
    [&]
    {
      isovertices = IsovertexCounts(told.Edges);
      inside = InsideCounts(told.Edges);
      arrays.BrickCounts.clear();
      arrays.BrickIndices.clear();
      arrays.BrickMasks.clear();
      WriteBricks(this->Members, arrays);
    });
  deal(arrays.Records);
  deal(told.Edges.LowerAndKinds);
  deal(told.Edges.Upper);
  arrays.Isovertices =
    dealer.Lists(std::exchange(arrays.Isovertices, {}), isovertices, IsovertexCounts(told.Edges));
  if (told.Encoding.Header.Region.IsVolume())
  {
    std::visit([&](auto& values)
      { values = dealer.Lists(std::exchange(values, {}), inside, InsideCounts(told.Edges)); },
      told.Encoding.InsideValues);
  }
  return told;
}

std::vector<ErrorCode::Type> Dealing::Deal(const std::vector<ErrorCode::Type>& told) const
{
  return Dealer(this->Portion, this->Told, this->Members).Values(told);
}

}
