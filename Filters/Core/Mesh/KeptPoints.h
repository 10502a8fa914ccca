// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_KeptPoints_h
#define isodiamond_KeptPoints_h

#include "Field/Parallel.h"
#include "Lattice/DiamondSet.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The points of a mesh that some of its cells use: one bit per point of the whole mesh, and for
 * every 64 of them the number kept before, so that each kept point has an id among the kept ones,
 * in the same order. While they are being found, this takes a byte per point.
 */
class KeptPoints
{
public:
  /** @param pointCount of the whole mesh @param ids used by the cells @param size of ids */
  template <typename Id>
  KeptPoints(
    std::int64_t pointCount, const Id* ids, std::int64_t size, const ParallelFor& parallelFor)
    : Words(pointCount / 64 + 1)
  {
    // Bytes are faster to write than bits: most points are used more than once.
    std::vector<std::atomic<std::uint8_t>> isUsed(64 * this->Words.size());
    parallelFor(size, Grain,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::for_each(
          ids + begin, ids + end, [&](Id id) { isUsed[id].store(1, std::memory_order_relaxed); });
      });
    ForEachIndex(parallelFor, this->Words.size(), Grain / 64,
      [&](std::int64_t word)
      {
        std::uint64_t bits = 0;
        for (int bit = 0; bit < 64; ++bit)
        {
          bits |= std::uint64_t{ isUsed[64 * word + bit].load(std::memory_order_relaxed) } << bit;
        }
        this->Words[word].Bits = bits;
      });
    for (std::size_t i = 1; i < this->Words.size(); ++i)
    {
      this->Words[i].Before = this->Words[i - 1].Before + PopCount(this->Words[i - 1].Bits);
    }
  }

  /** Their number. */
  std::int64_t Count() const
  {
    return this->Words.back().Before + PopCount(this->Words.back().Bits);
  }

  /** Their ids in the whole mesh. */
  template <typename Id>
  std::vector<Id> Ids() const
  {
    std::vector<Id> ids;
    ids.reserve(this->Count());
    for (std::size_t i = 0; i < this->Words.size(); ++i)
    {
      ForEachBit(
        this->Words[i].Bits, [&](int bit) { ids.push_back(static_cast<Id>(64 * i + bit)); });
    }
    return ids;
  }

  bool Contains(std::int64_t id) const
  {
    return (this->Words[id / 64].Bits >> (id % 64) & 1U) != 0;
  }

  bool AnyBetween(std::int64_t first, std::int64_t last) const
  {
    return this->NewId(last) > this->NewId(first);
  }

  /** The number of kept points before a point of the whole mesh: its new id, if it is kept. */
  std::int64_t NewId(std::int64_t id) const
  {
    const Word& word = this->Words[id / 64];
    const std::uint64_t before = (std::uint64_t{ 1 } << (id % 64)) - 1;
    return word.Before + PopCount(word.Bits & before);
  }

  /** Gives kept points their new ids. */
  template <typename Id>
  void Rename(Id* ids, std::int64_t size, const ParallelFor& parallelFor) const
  {
    parallelFor(size, Grain,
      [&](std::int64_t begin, std::int64_t end)
      {
        std::transform(ids + begin, ids + end, ids + begin,
          [this](Id id) { return static_cast<Id>(this->NewId(id)); });
      });
  }

private:
  static constexpr std::int64_t Grain = 65536;

  /** 64 points: which of them are kept, and how many before them are. */
  struct Word
  {
    std::uint64_t Bits = 0;
    std::int64_t Before = 0;
  };

  std::vector<Word> Words;
};

}

#endif
