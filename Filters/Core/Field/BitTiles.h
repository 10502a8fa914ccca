// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BitTiles_h
#define isodiamond_BitTiles_h

#include "Field/Parallel.h"
#include "Lattice/Lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

class Peers;

/**
 * A bit for each point of a box, in tiles of 64 x 8 x 8: where all bits of a tile are equal only
 * that is kept. So signs take memory where a surface is, and four bytes for 4096 points elsewhere.
 */
class BitTiles
{
public:
  BitTiles() = default;
  /** All bits are 0. @param count of points on each axis */
  explicit BitTiles(const std::array<int, 3>& count);

  const std::array<int, 3>& Count() const { return this->Points; }

  /** The number of words of a row, of 64 bits each. */
  std::int64_t WordCount() const { return this->Tiles[0]; }

  /** A row of bits. */
  class Row
  {
  public:
    /** Bits 64 i and on; those beyond the row's end may be any. */
    std::uint64_t operator[](std::int64_t i) const
    {
      const std::int32_t tile = this->First[i];
      return tile >= 0 ? this->Mixed[tile][this->Word] : tile == Ones ? ~std::uint64_t{ 0 } : 0;
    }

  private:
    friend class BitTiles;
    const std::int32_t* First = nullptr; ///< of the tiles that it passes through
    const std::array<std::uint64_t, 64>* Mixed = nullptr;
    int Word = 0; ///< in each tile
  };
  Row RowAt(int y, int z) const
  {
    Row row;
    row.First = this->Lookup.data() + this->TileIndex(y >> 3, z >> 3);
    row.Mixed = this->Mixed.data();
    row.Word = 8 * (z & 7) + (y & 7);
    return row;
  }

  /** Whether tiles tell that all bits of a box are equal. Those of others can be, too.
   *  @param last included; the box may reach beyond the points */
  bool AreEqual(const Point& first, const Point& last) const
  {
    const auto tileOf = [this](int position, int axis)
    { return std::clamp(position, 0, this->Points[axis] - 1) >> (axis == 0 ? 6 : 3); };
    const Point from = { tileOf(first[0], 0), tileOf(first[1], 1), tileOf(first[2], 2) };
    const Point to = { tileOf(last[0], 0), tileOf(last[1], 1), tileOf(last[2], 2) };
    const std::int32_t state = this->Lookup[this->TileIndex(from[1], from[2]) + from[0]];
    bool areEqual = state < 0;
    for (int z = from[2]; z <= to[2] && areEqual; ++z)
    {
      for (int y = from[1]; y <= to[1] && areEqual; ++y)
      {
        const std::int32_t* const row = this->Lookup.data() + this->TileIndex(y, z);
        areEqual = std::all_of(
          row + from[0], row + to[0] + 1, [state](std::int32_t found) { return found == state; });
      }
    }
    return areEqual;
  }

  /**
   * Sets bits of some slices. Slices that were set before are to be the same.
   *
   * @param rows words of the rows of these slices, one after the other; those beyond a row's end 0
   */
  void Set(int firstSlice, int sliceCount, const std::vector<std::uint64_t>& rows,
    const ParallelFor& parallelFor);

  /** Bits that peers have set. */
  void Or(Peers& peers);

  /** Forgets what tiles hold whose bits are all equal: slices that were set one after the other may
   *  have come to that. */
  void Compress();

  /** Every second bit of every second row of every second slice. @param count of these */
  BitTiles Coarser(const std::array<int, 3>& count) const;

  /** The words of all rows; those beyond a row's end 0. */
  std::vector<std::uint64_t> AllRows() const;

private:
  using Tile = std::array<std::uint64_t, 64>; ///< word 8 z + y

  static constexpr std::int32_t Zeros = -1;
  static constexpr std::int32_t Ones = -2;

  /** Of the first tile in a row of them; and where a tile is among all. */
  std::int64_t TileIndex(int y, int z) const
  {
    return (std::int64_t{ z } * this->Tiles[1] + y) * this->Tiles[0];
  }
  Point TileAt(std::int64_t index) const
  {
    const std::int64_t row = index / this->Tiles[0];
    return { static_cast<int>(index % this->Tiles[0]), static_cast<int>(row % this->Tiles[1]),
      static_cast<int>(row / this->Tiles[1]) };
  }

  /** The bits of a word of a row that are points. */
  std::uint64_t Valid(std::int64_t word) const
  {
    const std::int64_t count = this->Points[0] - 64 * word;
    return count >= 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << count) - 1;
  }

  /** What the Lookup of a tile is to say of some words: Zeros or Ones; 0 if they are mixed. */
  std::int32_t StateOf(const Tile& tile, const Point& at) const;

  /** A tile more, of bits that are 0. @return its number in Mixed */
  std::int32_t Append()
  {
    this->Mixed.push_back(Tile{});
    return static_cast<std::int32_t>(this->Mixed.size() - 1);
  }

  std::array<int, 3> Points{};
  std::array<int, 3> Tiles{};
  std::vector<std::int32_t> Lookup; ///< Zeros, Ones, or where it is in Mixed
  std::vector<Tile> Mixed;
};

}

#endif
