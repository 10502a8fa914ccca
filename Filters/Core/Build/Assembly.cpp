// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Assembly.h"

#include "Hierarchy/EncodingPasses.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

/** Puts lists of values together, one for each diamond that is kept. */
class Assembler
{
public:
  Assembler(const PeerPortion& portion, const DiamondSet& members, const DiamondSet& kept)
    : Portion(portion)
    , Members(members)
    , Kept(kept)
  {
  }

  /** One value a diamond. */
  template <typename T>
  std::vector<T> Values(const std::vector<T>& own) const
  {
    std::vector<T> all;
    this->Portion.Others().Together(
      [&]
      {
        all.assign(this->Kept.Size(), T{});
        this->ForEachOwned(
          [&](std::uint32_t rank, std::uint32_t ownRank) { all[rank] = own[ownRank]; });
      });
    this->Portion.Others().Or(all);
    return all;
  }

  /** Lists of values. @param countOf, firstOf by rank in this portion, how many, and where they
   * begin
   */
  template <typename T, typename CountOf, typename FirstOf>
  std::vector<T> Lists(
    const std::vector<T>& own, const CountOf& countOf, const FirstOf& firstOf) const
  {
    std::vector<std::uint8_t> counts;
    this->Portion.Others().Together(
      [&]
      {
        counts.resize(this->Members.Size());
        for (std::size_t rank = 0; rank < counts.size(); ++rank)
        {
          counts[rank] = static_cast<std::uint8_t>(countOf(rank));
        }
      });
    counts = this->Values(counts);
    std::vector<T> all;
    this->Portion.Others().Together(
      [&]
      {
        all.assign(std::accumulate(counts.begin(), counts.end(), std::size_t{ 0 }), T{});
        std::uint32_t done = 0;
        auto next = all.begin();
        this->ForEachOwned(
          [&](std::uint32_t rank, std::uint32_t ownRank)
          {
            for (; done < rank; ++done)
            {
              next += counts[done];
            }
            std::copy_n(own.begin() + firstOf(ownRank), counts[rank], next);
          });
      });
    this->Portion.Others().Or(all);
    return all;
  }

private:
  /** Calls body(rank in the whole, rank in this portion), ascending. */
  template <typename Body>
  void ForEachOwned(const Body& body) const
  {
    for (int scale = this->Kept.ScaleCount() - 1; scale >= 0; --scale)
    {
      const BrickLevel& level = this->Kept.Level(scale);
      for (const Brick& brick : level.Bricks)
      {
        const Brick* const own = this->Members.Level(scale).Find(brick.BoxIndex);
        const int first = level.Box.Origin(brick.BoxIndex)[2];
        for (int z = 0; z < 8 && own != nullptr; ++z)
        {
          if (this->Portion.Diamonds().Owns((first + z) << scale))
          {
            ForEachBit(
              brick.Occupancy[z], [&](int bit) { body(brick.Rank(z, bit), own->Rank(z, bit)); });
          }
        }
      }
    }
  }

  const PeerPortion& Portion;
  const DiamondSet& Members;
  const DiamondSet& Kept;
};

/** The values inside an interval volume. */
template <typename T>
std::vector<T> InsideValuesOf(
  const std::vector<T>& own, const IsodiamondHierarchy& hierarchy, const Assembler& assembler)
{
  const auto isInside = [&](std::int64_t rank)
  { return hierarchy.Sign(rank) == InsideSign ? 1 : 0; };
  std::vector<std::uint32_t> firsts;
  std::uint32_t next = 0;
  for (std::int64_t rank = 0; rank < hierarchy.Diamonds().Size(); ++rank)
  {
    firsts.push_back(next);
    next += isInside(rank);
  }
  return assembler.Lists(own, isInside, [&](std::int64_t rank) { return firsts[rank]; });
}

}

Encoding Assemble(const PeerPortion& portion, Encoding own, const IsodiamondHierarchy& hierarchy,
  const DiamondSet& kept)
{
  const Assembler assembler(portion, hierarchy.Diamonds(), kept);
  const bool isVolume = own.Header.Region.IsVolume();
  // What has been given is forgotten.
  EncodingArrays<OwnedArray>& from = own.Arrays;
  const auto give = [&](auto& values) { return assembler.Values(std::exchange(values, {})); };
  Encoding whole;
  whole.Header = own.Header;
  portion.Others().Together([&] { WriteBricks(kept, whole.Arrays); });
  whole.Arrays.Isovertices = assembler.Lists(
    std::exchange(from.Isovertices, {}),
    [&](std::int64_t rank) {
      return PopCount(hierarchy.Edges(rank)) +
        (isVolume ? PopCount(hierarchy.UpperEdges(rank)) : 0);
    },
    [&](std::int64_t rank) { return hierarchy.FirstIsovertexOf(rank); });
  if (isVolume)
  {
    std::visit([&](auto& values)
      { whole.InsideValues = InsideValuesOf(std::exchange(values, {}), hierarchy, assembler); },
      own.InsideValues);
  }
  else
  {
    whole.InsideValues = std::move(own.InsideValues);
  }
  if (!from.InteriorCodes.empty())
  {
    whole.Arrays.InteriorCodes = give(from.InteriorCodes);
  }
  whole.Arrays.Records = give(from.Records); // the last: the hierarchy reads its signs there

  std::vector<std::uint64_t> followers;
  std::copy_if(from.Followers.begin(), from.Followers.end(), std::back_inserter(followers),
    [&](std::uint64_t code) { return portion.Diamonds().Owns(Centre(PlaceOfCentre(code))[2]); });
  whole.Arrays.Followers = portion.Others().Gather(followers);
  std::sort(whole.Arrays.Followers.begin(), whole.Arrays.Followers.end());
  return whole;
}

}
