// SPDX-License-Identifier: BSD-3-Clause
#include "Field/BitTiles.h"

#include "Field/Peers.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace isodiamond
{
namespace
{

/** The even bits of a word, packed into its lower half. */
std::uint64_t EvenBits(std::uint64_t word)
{
  word &= 0x5555555555555555ULL;
  word = (word | (word >> 1)) & 0x3333333333333333ULL;
  word = (word | (word >> 2)) & 0x0f0f0f0f0f0f0f0fULL;
  word = (word | (word >> 4)) & 0x00ff00ff00ff00ffULL;
  word = (word | (word >> 8)) & 0x0000ffff0000ffffULL;
  return (word | (word >> 16)) & 0x00000000ffffffffULL;
}

}

BitTiles::BitTiles(const std::array<int, 3>& count)
  : Points(count)
  , Tiles{ (count[0] + 63) / 64, (count[1] + 7) / 8, (count[2] + 7) / 8 }
  , Lookup(TileIndex(0, Tiles[2]), Zeros)
{
}

std::int32_t BitTiles::StateOf(const Tile& tile, const Point& at) const
{
  const std::uint64_t valid = this->Valid(at[0]);
  bool areZeros = true;
  bool areOnes = true;
  for (int z = 0; z < std::min(8, this->Points[2] - 8 * at[2]); ++z)
  {
    for (int y = 0; y < std::min(8, this->Points[1] - 8 * at[1]); ++y)
    {
      areZeros = areZeros && (tile[8 * z + y] & valid) == 0;
      areOnes = areOnes && (tile[8 * z + y] & valid) == valid;
    }
  }
  return areZeros ? Zeros : areOnes ? Ones : 0;
}

void BitTiles::Set(int firstSlice, int sliceCount, const std::vector<std::uint64_t>& rows,
  const ParallelFor& parallelFor)
{
  const int endSlice = firstSlice + sliceCount;
  const std::int64_t first = this->TileIndex(0, firstSlice >> 3);
  const std::int64_t last = this->TileIndex(0, (endSlice + 7) >> 3);
  const auto tileOf = [&](const Point& at)
  {
    Tile tile{}; // bits of other slices are 0 until those are set
    for (int z = std::max(8 * at[2], firstSlice); z < std::min(8 * at[2] + 8, endSlice); ++z)
    {
      for (int y = 8 * at[1]; y < std::min(8 * at[1] + 8, this->Points[1]); ++y)
      {
        const std::int64_t row = std::int64_t{ z - firstSlice } * this->Points[1] + y;
        tile[8 * (z & 7) + (y & 7)] = rows[row * this->Tiles[0] + at[0]];
      }
    }
    return tile;
  };
  std::vector<std::int32_t> states(last - first);
  ForEachIndex(parallelFor, states.size(), 256,
    [&](std::int64_t i)
    {
      const Point at = this->TileAt(first + i);
      states[i] = this->StateOf(tileOf(at), at);
    });
  const std::size_t most = this->Mixed.size() + std::count(states.begin(), states.end(), 0);
  if (most > this->Mixed.capacity())
  {
    this->Mixed.reserve(std::max(most, this->Mixed.size() + this->Mixed.size() / 4)); // not doubled
  }
  for (std::int64_t i = 0; i < last - first; ++i)
  {
    std::int32_t& found = this->Lookup[first + i];
    if (found == Zeros && states[i] != Zeros)
    {
      found = states[i] == Ones ? Ones : this->Append();
    }
  }
  ForEachIndex(parallelFor, states.size(), 256,
    [&](std::int64_t i)
    {
      if (const std::int32_t found = this->Lookup[first + i]; found >= 0)
      {
        const Tile tile = tileOf(this->TileAt(first + i));
        Tile& words = this->Mixed[found];
        std::transform(tile.begin(), tile.end(), words.begin(), words.begin(), std::bit_or<>());
      }
    });
}

void BitTiles::Or(Peers& peers)
{
  constexpr std::uint8_t isMixed = 1;
  constexpr std::uint8_t isOnes = 2;
  std::vector<std::uint8_t> states;
  peers.Together(
    [&]
    {
      states.resize(this->Lookup.size());
      std::transform(this->Lookup.begin(), this->Lookup.end(), states.begin(),
        [](std::int32_t found) -> std::uint8_t {
          return found >= 0 ? isMixed : found == Ones ? isOnes : 0;
        });
    });
  peers.Or(states);
  // Tiles that are mixed for any peer are so for all, in the same order.
  std::vector<Tile> all;
  peers.Together(
    [&]
    {
      all.reserve(std::count(states.begin(), states.end(), isMixed));
      for (std::size_t i = 0; i < states.size(); ++i)
      {
        std::int32_t& found = this->Lookup[i];
        if ((states[i] & isOnes) != 0)
        {
          found = Ones;
        }
        else if ((states[i] & isMixed) != 0)
        {
          all.push_back(found >= 0 ? this->Mixed[found] : Tile{});
          found = static_cast<std::int32_t>(all.size() - 1);
        }
      }
    });
  this->Mixed = std::move(all);
  peers.Or(this->Mixed);
}

void BitTiles::Compress()
{
  std::vector<std::int32_t> numbers(this->Mixed.size(), 0); // by present number: the new one
  for (std::size_t i = 0; i < this->Lookup.size(); ++i)
  {
    if (const std::int32_t found = this->Lookup[i]; found >= 0)
    {
      numbers[found] =
        this->StateOf(this->Mixed[found], this->TileAt(static_cast<std::int64_t>(i)));
    }
  }
  std::int32_t kept = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (numbers[i] == 0)
    {
      this->Mixed[kept] = this->Mixed[i];
      numbers[i] = kept++;
    }
  }
  this->Mixed.resize(kept);
  this->Mixed.shrink_to_fit();
  for (std::int32_t& found : this->Lookup)
  {
    found = found >= 0 ? numbers[found] : found;
  }
}

BitTiles BitTiles::Coarser(const std::array<int, 3>& count) const
{
  BitTiles coarser(count);
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(coarser.Lookup.size()); ++i)
  {
    const Point at = coarser.TileAt(i);
    Tile tile{};
    for (int z = 8 * at[2]; z < std::min(8 * at[2] + 8, count[2]); ++z)
    {
      for (int y = 8 * at[1]; y < std::min(8 * at[1] + 8, count[1]); ++y)
      {
        const Row row = this->RowAt(2 * y, 2 * z);
        const std::int64_t word = 2 * std::int64_t{ at[0] };
        tile[8 * (z & 7) + (y & 7)] =
          EvenBits(row[word]) | (word + 1 < this->Tiles[0] ? EvenBits(row[word + 1]) << 32 : 0);
      }
    }
    const std::int32_t state = coarser.StateOf(tile, at);
    coarser.Lookup[i] = state;
    if (state == 0)
    {
      coarser.Lookup[i] = coarser.Append();
      coarser.Mixed.back() = tile;
    }
  }
  return coarser;
}

std::vector<std::uint64_t> BitTiles::AllRows() const
{
  std::vector<std::uint64_t> rows;
  rows.reserve(std::int64_t{ 1 } * this->Tiles[0] * this->Points[1] * this->Points[2]);
  for (int z = 0; z < this->Points[2]; ++z)
  {
    for (int y = 0; y < this->Points[1]; ++y)
    {
      const Row row = this->RowAt(y, z);
      for (int word = 0; word < this->Tiles[0]; ++word)
      {
        rows.push_back(row[word] & this->Valid(word));
      }
    }
  }
  return rows;
}

}
