// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondExchange_h
#define isodiamond_DiamondExchange_h

#include "Field/PeerPortion.h"
#include "Hierarchy/DiamondEdges.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace isodiamond
{

/** How long the diamonds' lists are, by rank.
 *  @param sizeOf DiamondEdges::IsovertexCount, or IsInside: one value or none */
template <typename Size>
std::vector<std::uint8_t> ListSizes(
  const DiamondEdges& edges, Size (DiamondEdges::*sizeOf)(std::int64_t) const)
{
  std::vector<std::uint8_t> sizes(edges.LowerAndKinds.size());
  for (std::size_t rank = 0; rank < sizes.size(); ++rank)
  {
    sizes[rank] = static_cast<std::uint8_t>((edges.*sizeOf)(static_cast<std::int64_t>(rank)));
  }
  return sizes;
}

/**
 * Brings what peers tell of diamonds to the peers that are to have it: arrays by rank in one set
 * become arrays by rank in another. All peers go through all diamonds in the same order, some at a
 * time.
 */
class DiamondExchange
{
public:
  /** @param portion of this process
   *  @param told the set of the arrays that it gives @param had that of those that it gets; both of
   *         diamonds that are in some portion. Sets and portion must outlive it
   *  @param tells whether it tells of diamonds with their centre in a slice; peers that tell of the
   *         same diamond tell the same */
  DiamondExchange(const PeerPortion& portion, const DiamondSet& told, const DiamondSet& had,
    std::function<bool(int)> tells)
    : Portion(portion)
    , Told(told)
    , Had(had)
    , Tells(std::move(tells))
  {
  }

  /** One value per diamond; or none at all, if so for all peers. */
  template <typename T>
  std::vector<T> Values(const std::vector<T>& told) const
  {
    if (told.empty())
    {
      return {}; // otherwise there are at least the corners of the base cube
    }
    std::vector<T> had;
    this->Portion.Others().Together([&] { had.resize(this->Had.Size()); });
    std::vector<T> some;
    this->ForEachBlock(
      [&](const std::vector<Entry>& block)
      {
        some.resize(block.size());
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          some[i] = block[i].IsTold ? told[block[i].Told] : T{};
        }
        this->Portion.Others().Or(some);
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          if (block[i].Had != DiamondSet::None)
          {
            had[block[i].Had] = some[i];
          }
        }
      });
    return had;
  }

  /** A list of values per diamond, one list after the other.
   *  @param sizes of the lists that are told, by rank @param total size of those that are had */
  template <typename T>
  std::vector<T> Lists(
    const std::vector<T>& told, const std::vector<std::uint8_t>& sizes, std::size_t total) const
  {
    std::vector<T> had;
    this->Portion.Others().Together([&] { had.resize(total); });
    // Ranks ascend, so lists follow one another.
    auto nextTold = told.begin();
    auto nextHad = had.begin();
    std::vector<std::uint16_t> counts;
    std::vector<T> some;
    this->ForEachBlock(
      [&](const std::vector<Entry>& block)
      {
        counts.resize(block.size());
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          counts[i] = block[i].IsTold ? sizes[block[i].Told] : 0;
        }
        this->Portion.Others().Max(counts.data(), static_cast<std::int64_t>(counts.size()));
        some.assign(std::accumulate(counts.begin(), counts.end(), std::size_t{ 0 }), T{});
        auto next = some.begin();
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          if (block[i].IsTold)
          {
            std::copy_n(nextTold, counts[i], next);
          }
          nextTold += block[i].Told != DiamondSet::None ? sizes[block[i].Told] : 0;
          next += counts[i];
        }
        this->Portion.Others().Or(some);
        next = some.begin();
        for (std::size_t i = 0; i < block.size(); ++i)
        {
          if (block[i].Had != DiamondSet::None)
          {
            nextHad = std::copy_n(next, counts[i], nextHad);
          }
          next += counts[i];
        }
      });
    return had;
  }

private:
  /** A diamond: its ranks in the two sets, None where it is not in the set. */
  struct Entry
  {
    std::int64_t Told = DiamondSet::None;
    std::int64_t Had = DiamondSet::None;
    bool IsTold = false; ///< by this process
  };

  /** Calls body(entries) for all diamonds, some at a time: equally often in all processes. */
  template <typename Body>
  void ForEachBlock(const Body& body) const
  {
    constexpr std::size_t most = 8192;
    std::vector<Entry> block;
    const auto rankIn = [](const Brick* brick, int z, int bit)
    {
      return brick != nullptr && brick->Contains(z, bit) ? std::int64_t{ brick->Rank(z, bit) }
                                                         : DiamondSet::None;
    };
    this->Portion.All().ForEachBrick(
      [&](int scale, std::int64_t index, const BrickMask& mask)
      {
        const Brick* const told = this->Told.Level(scale).Find(index);
        const Brick* const had = this->Had.Level(scale).Find(index);
        const int first = this->Portion.All().Box(scale).Origin(index)[2];
        for (int z = 0; z < 8; ++z)
        {
          const bool tells = mask[z] != 0 && this->Tells((first + z) << scale);
          ForEachBit(mask[z],
            [&](int bit)
            {
              const std::int64_t rank = rankIn(told, z, bit);
              block.push_back({ rank, rankIn(had, z, bit), tells && rank != DiamondSet::None });
            });
        }
        if (block.size() >= most)
        {
          body(block);
          block.clear();
        }
      });
    body(block);
  }

  const PeerPortion& Portion;
  const DiamondSet& Told;
  const DiamondSet& Had;
  std::function<bool(int)> Tells;
};

}

#endif
