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
 * One bit for each point of a box, in tiles of 64 x 8 x 8; of a tile whose bits are all equal, only
 * their value is kept. So signs take memory where there is a surface, and four bytes for 4096
 * points elsewhere.
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
    /** Bits 64 i and on; those beyond the row's end are arbitrary. */
    std::uint64_t operator[](std::int64_t i) const
    {
      const std::int32_t tile = this->First[i];
      return tile >= 0 ? this->Mixed[tile][this->Word] : tile == Ones ? ~std::uint64_t{ 0 } : 0;
    }

  private:
    friend class BitTiles;
    const std::int32_t* First = nullptr; ///< entries of the tiles it passes through
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

  /** Whether the tiles alone show that all bits of a box are equal; else they may still be equal.
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
   * Sets the bits of some slices. Slices that were set before must get the same bits.
   *
   * @param rows words of the rows of these slices, one after the other; 0 beyond a row's end
   */
  void Set(int firstSlice, int sliceCount, const std::vector<std::uint64_t>& rows,
    const ParallelFor& parallelFor);

  /** Adds the bits that peers have set. */
  void Or(Peers& peers);

  /** Drops the words of tiles whose bits are all equal, as they may have become after slices were
   *  set one after the other. */
  void Compress();

  /** Every second bit of every second row of every second slice. @param count of these */
  BitTiles Coarser(const std::array<int, 3>& count) const;

  /** The words of all rows; bits beyond a row's end are 0. */
  std::vector<std::uint64_t> AllRows() const;

private:
  using Tile = std::array<std::uint64_t, 64>; ///< word 8 z + y

  static constexpr std::int32_t Zeros = -1;
  static constexpr std::int32_t Ones = -2;

  /** The index of the first tile in a row of tiles; and the coordinates of a tile by its index. */
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

  /** The bits of a word of a row that stand for points. */
  std::uint64_t Valid(std::int64_t word) const
  {
    const std::int64_t count = this->Points[0] - 64 * word;
    return count >= 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << count) - 1;
  }

  /** The Lookup entry for a tile of these words: Zeros or Ones; 0 if they are mixed. */
  std::int32_t StateOf(const Tile& tile, const Point& at) const;

  /** Appends a tile of bits that are 0. @return its number in Mixed */
  std::int32_t Append()
  {
    this->Mixed.push_back(Tile{});
    return static_cast<std::int32_t>(this->Mixed.size() - 1);
  }

  std::array<int, 3> Points{};
  std::array<int, 3> Tiles{};
  std::vector<std::int32_t> Lookup; ///< Zeros, Ones, or its number in Mixed
  std::vector<Tile> Mixed;
};

}

#endif
