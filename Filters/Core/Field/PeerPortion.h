// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_PeerPortion_h
#define isodiamond_PeerPortion_h

#include "Field/Peers.h"
#include "Lattice/DiamondPortion.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * The portion of a hierarchy that this process has while peers build it: a set of its own, with its
 * own ranks. All peers know which diamonds there are in all portions, a bit each.
 *
 * What is found for diamonds that several peers have is combined in the order of all diamonds that
 * any have in common: the same order for all peers, whichever of the diamonds they have.
 */
class PeerPortion
{
public:
  /** Cuts so that all portions have about the same number of diamonds.
   *  @param all the members of the whole hierarchy, with the corners of the base cube
   *  @param peers must outlive it */
  PeerPortion(const Grid& grid, DiamondMask all, Peers& peers);

  const DiamondPortion& Diamonds() const { return this->Portion; }
  const DiamondMask& All() const { return this->Mask; }
  Peers& Others() const { return this->With; }

  /** The diamonds of this portion, moved out for the caller to keep. */
  DiamondSet TakeMembers() { return std::move(this->Members); }

  /**
   * Raises each diamond's codes, one or a row of them, to the greatest that any peer has for it.
   *
   * @param codes by rank @param firstScale the first that counts: finer ones have no codes
   * @return whether any rose here
   */
  template <typename T>
  bool Max(std::vector<T>& codes, int firstScale = 0) const
  {
    bool rose = false;
    std::vector<std::uint16_t> some;
    this->ForEachBlock(firstScale,
      [&](const std::uint32_t* ranks, std::size_t count)
      {
        some.assign(count * Row<T>::Size, 0);
        ForEachHere(ranks, count,
          [&](std::size_t i, std::uint32_t rank) {
            std::copy_n(Row<T>::Data(codes[rank]), Row<T>::Size, some.data() + i * Row<T>::Size);
          });
        this->With.Max(some.data(), static_cast<std::int64_t>(some.size()));
        ForEachHere(ranks, count,
          [&](std::size_t i, std::uint32_t rank)
          {
            std::uint16_t* const own = Row<T>::Data(codes[rank]);
            const std::uint16_t* const all = some.data() + i * Row<T>::Size;
            rose = rose || !std::equal(own, own + Row<T>::Size, all);
            std::copy_n(all, Row<T>::Size, own);
          });
      });
    return rose;
  }

private:
  static constexpr std::uint32_t NotHere = ~std::uint32_t{ 0 };
  static constexpr std::size_t Block = 8192;

  /** A code, or codes in a row. */
  template <typename T>
  struct Row
  {
    static constexpr std::size_t Size = 1;
    static std::uint16_t* Data(T& code) { return &code; }
  };
  template <std::size_t N>
  struct Row<std::array<std::uint16_t, N>>
  {
    static constexpr std::size_t Size = N;
    static std::uint16_t* Data(std::array<std::uint16_t, N>& codes) { return codes.data(); }
  };

  /** Calls body(ranks, count) for the common diamonds, a block at a time. */
  template <typename Body>
  void ForEachBlock(int firstScale, const Body& body) const
  {
    const auto scale = static_cast<std::size_t>(firstScale);
    const std::size_t end = scale < this->EndsOfScales.size() ? this->EndsOfScales[scale] : 0;
    for (std::size_t begin = 0; begin < end; begin += Block)
    {
      body(this->Common.data() + begin, std::min(Block, end - begin));
    }
  }

  template <typename Body>
  static void ForEachHere(const std::uint32_t* ranks, std::size_t count, const Body& body)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (ranks[i] != NotHere)
      {
        body(i, ranks[i]);
      }
    }
  }

  DiamondPortion Portion;
  DiamondMask Mask;
  Peers& With;
  DiamondSet Members;
  std::vector<std::uint32_t> Common;     ///< ranks of the common ones, coarse to fine
  std::vector<std::size_t> EndsOfScales; ///< how many of them are of a scale or coarser, by scale
};

}

#endif
