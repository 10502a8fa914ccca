// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondSet_h
#define isodiamond_DiamondSet_h

#include "Lattice/DiamondTables.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

/**
 * @file DiamondSet.h
 * Sets of diamonds as bits in bricks.
 *
 * The positions of one scale are cut into *bricks* of 8x8x8; a brick is a mask of 512 bits, one
 * 64-bit word for every z, bit 8 y + x in it. Only bricks with a bit set are kept. A diamond
 * needs no coordinates then: its bit says where it is, and the number of bits before it is its
 * *rank*, the index of its data in plain arrays.
 */
namespace isodiamond
{

using BrickMask = std::array<std::uint64_t, 8>;

inline int PopCount(std::uint64_t word)
{
  return __builtin_popcountll(word);
}

inline int LowestBit(std::uint64_t word)
{
  return __builtin_ctzll(word);
}

/** Calls body(bit) for every set bit, lowest first. */
template <typename Body>
void ForEachBit(std::uint64_t word, Body&& body)
{
  for (; word != 0; word &= word - 1)
  {
    body(LowestBit(word));
  }
}

/** The bricks of one scale as a box: how many, and where a position's brick and bit are. */
struct BrickBox
{
  std::array<int, 3> Count{};

  BrickBox() = default;
  /** @throws std::length_error beyond 2^31 - 1 bricks: they are numbered in 32 bits */
  explicit BrickBox(const std::array<int, 3>& positions)
    : Count{ (positions[0] + 7) / 8, (positions[1] + 7) / 8, (positions[2] + 7) / 8 }
  {
    if (this->Size() > std::numeric_limits<std::int32_t>::max())
    {
      throw std::length_error("The grid is too large: more than 2^31 - 1 bricks of 8x8x8 samples.");
    }
  }

  std::int64_t Size() const
  {
    return std::int64_t{ 1 } * this->Count[0] * this->Count[1] * this->Count[2];
  }

  /** Linear index of the brick at brick coordinates, -1 outside of the box. */
  std::int64_t Index(const Point& brick) const
  {
    const bool inside = brick[0] >= 0 && brick[1] >= 0 && brick[2] >= 0 &&
      brick[0] < this->Count[0] && brick[1] < this->Count[1] && brick[2] < this->Count[2];
    return inside
      ? (std::int64_t{ brick[2] } * this->Count[1] + brick[1]) * this->Count[0] + brick[0]
      : -1;
  }

  /** Position of the brick's first corner. */
  Point Origin(std::int64_t index) const
  {
    const std::int64_t row = index / this->Count[0];
    return { 8 * static_cast<int>(index % this->Count[0]),
      8 * static_cast<int>(row % this->Count[1]), 8 * static_cast<int>(row / this->Count[1]) };
  }
};

inline Point BrickOf(const Point& position)
{
  return { position[0] >> 3, position[1] >> 3, position[2] >> 3 };
}

inline constexpr int BitOf(const Point& position)
{
  return 8 * (position[1] & 7) + (position[0] & 7);
}

/** The position of a bit of a brick's word z. */
inline Point PositionOf(const Point& origin, int z, int bit)
{
  return { origin[0] + (bit & 7), origin[1] + (bit >> 3), origin[2] + z };
}

/** The bits of a brick's word whose x and y lie in ranges, ends included. */
inline std::uint64_t BitsBetween(int firstX, int lastX, int firstY, int lastY)
{
  const std::uint64_t row = (0xffU >> (7 - lastX)) & (0xffU << firstX);
  const std::uint64_t rows =
    (~std::uint64_t{ 0 } >> (8 * (7 - lastY))) & (~std::uint64_t{ 0 } << (8 * firstY));
  return (row * 0x0101010101010101U) & rows;
}

namespace tables
{

inline constexpr std::array<std::array<std::uint64_t, 2>, 3> MakeClassBits()
{
  std::array<std::array<std::uint64_t, 2>, 3> bits{};
  for (int code = 0; code < 128; ++code)
  {
    const Point position = { code & 7, (code >> 3) & 7, code >> 6 };
    if (const int parity = Parity(position); parity != 0)
    {
      bits[Parities[parity].DiamondClass][position[2]] |= std::uint64_t{ 1 } << BitOf(position);
    }
  }
  return bits;
}

/** By class, then by parity of z: the bits of a brick's word z that stand for diamonds. */
inline constexpr std::array<std::array<std::uint64_t, 2>, 3> ClassBits = MakeClassBits();

}

/** The brick of the base cube's eight corners, at scale N. */
inline BrickMask CornerBrick()
{
  return { 0x303, 0x303, 0, 0, 0, 0, 0, 0 };
}

/** A set of diamonds that grows, without ranks. */
class DiamondMask
{
public:
  DiamondMask() = default;
  explicit DiamondMask(const Grid& grid);

  bool Contains(const Place& place) const
  {
    const Level& level = this->Levels[place.Scale];
    const std::int64_t index = level.Box.Index(BrickOf(place.Position));
    if (index < 0 || level.Lookup[index] < 0)
    {
      return false;
    }
    const std::uint64_t word = level.Masks[level.Lookup[index]][place.Position[2] & 7];
    return ((word >> BitOf(place.Position)) & 1U) != 0;
  }

  /** Adds a diamond. @return whether it was not in the set before. */
  bool Insert(const Place& place);

  /** Adds the bits of one brick. */
  void Insert(int scale, std::int64_t brickIndex, const BrickMask& mask);

  /** Adds all ancestors below scale N: the smallest closed set that holds this one. */
  void CloseOverParents(const Grid& grid);

  /** The mask of a brick, null if it is empty. */
  const BrickMask* Find(int scale, std::int64_t brickIndex) const
  {
    const Level& level = this->Levels[scale];
    return level.Lookup[brickIndex] < 0 ? nullptr : &level.Masks[level.Lookup[brickIndex]];
  }

  const BrickBox& Box(int scale) const { return this->Levels[scale].Box; }
  int ScaleCount() const { return static_cast<int>(this->Levels.size()); }

  /** Calls body(scale, index, mask) for every brick, coarse to fine, in the order of the ranks. */
  template <typename Body>
  void ForEachBrick(const Body& body) const
  {
    for (int scale = this->ScaleCount() - 1; scale >= 0; --scale)
    {
      for (std::int64_t index = 0; index < this->Box(scale).Size(); ++index)
      {
        if (const BrickMask* mask = this->Find(scale, index))
        {
          body(scale, index, *mask);
        }
      }
    }
  }

  /** The same for the bits of words z that are in bitsOf(scale, z); skips bricks without any. */
  template <typename BitsOf, typename Body>
  void ForEachBrick(const BitsOf& bitsOf, const Body& body) const
  {
    this->ForEachBrick(
      [&](int scale, std::int64_t index, BrickMask mask)
      {
        const int first = this->Box(scale).Origin(index)[2];
        for (int z = 0; z < 8; ++z)
        {
          mask[z] &= bitsOf(scale, first + z);
        }
        if (mask != BrickMask{})
        {
          body(scale, index, mask);
        }
      });
  }

  /** The number of diamonds. */
  std::int64_t Size() const;

  /** Calls body(place) for every diamond, coarse to fine, in the order of the ranks. */
  template <typename Body>
  void ForEach(Body&& body) const
  {
    for (int scale = this->ScaleCount() - 1; scale >= 0; --scale)
    {
      this->ForEachOfScale(scale, body);
    }
  }

  /** Calls body(place) for every diamond of one scale. The set may grow at other scales. */
  template <typename Body>
  void ForEachOfScale(int scale, Body&& body) const
  {
    constexpr std::uint64_t all = ~std::uint64_t{ 0 };
    this->ForEachWithBits(scale, { all, all }, body);
  }

  /** Calls body(place) for every diamond of one scale and class. The set may grow at others. */
  template <typename Body>
  void ForEachOfClass(int scale, int diamondClass, Body&& body) const
  {
    this->ForEachWithBits(scale, tables::ClassBits[diamondClass], body);
  }

private:
  struct Level
  {
    BrickBox Box;
    std::vector<std::int32_t> Lookup;
    std::vector<BrickMask> Masks;
  };

  void AddParentsOfScale(const Grid& grid, int scale, int diamondClass);
  void AddParentsOfCoarserScale(const Grid& grid, int scale);

  /** @param bits the bits of a word that count, by parity of z */
  template <typename Body>
  void ForEachWithBits(int scale, const std::array<std::uint64_t, 2>& bits, const Body& body) const
  {
    const Level& level = this->Levels[scale];
    for (std::int64_t index = 0; index < level.Box.Size(); ++index)
    {
      if (level.Lookup[index] < 0)
      {
        continue;
      }
      const Point origin = level.Box.Origin(index);
      const BrickMask mask = level.Masks[level.Lookup[index]];
      for (int z = 0; z < 8; ++z)
      {
        ForEachBit(mask[z] & bits[z & 1],
          [&](int bit) {
            body(Place{ scale, PositionOf(origin, z, bit) });
          });
      }
    }
  }

  BrickMask& BrickAt(Level& level, std::int64_t brickIndex);

  std::vector<Level> Levels;
};

/** A brick of a ranked set. */
struct Brick
{
  BrickMask Occupancy{};
  std::array<std::uint16_t, 8> Before{}; ///< diamonds of this brick before each word
  std::uint32_t First = 0;               ///< rank of the brick's first diamond
  std::uint32_t BoxIndex = 0;            ///< linear index of the brick in its scale's box

  bool Contains(int z, int bit) const { return ((this->Occupancy[z] >> bit) & 1U) != 0; }

  std::uint32_t Rank(int z, int bit) const
  {
    assert(z >= 0 && z < 8 && bit >= 0 && bit < 64);
    const std::uint64_t below = this->Occupancy[z] & ((std::uint64_t{ 1 } << bit) - 1);
    return this->First + this->Before[z] + static_cast<std::uint32_t>(PopCount(below));
  }

  std::uint32_t Size() const
  {
    return this->Before[7] + static_cast<std::uint32_t>(PopCount(this->Occupancy[7]));
  }
};

/** The ranked bricks of one scale. */
struct BrickLevel
{
  BrickBox Box;
  std::vector<std::int32_t> Lookup; ///< box index -> index in Bricks, -1 where there is none
  std::vector<Brick> Bricks;        ///< in the order of their box indices
  std::int64_t FirstNumber = 0;     ///< of its first brick, in the order of AllBricks()

  const Brick* Find(const Point& position) const
  {
    return this->Find(this->Box.Index(BrickOf(position)));
  }

  /** @param boxIndex -1 for a brick outside of the box */
  const Brick* Find(std::int64_t boxIndex) const
  {
    return boxIndex < 0 || this->Lookup[boxIndex] < 0 ? nullptr
                                                      : &this->Bricks[this->Lookup[boxIndex]];
  }

  /** Calls body(index, origin) for the bricks that hold positions of a box, ends included. */
  template <typename Body>
  void ForEachBrickBetween(const Point& first, const Point& last, Body&& body) const
  {
    const Point end = BrickOf(last);
    const Point from = { std::max(first[0] >> 3, 0), std::max(first[1] >> 3, 0),
      std::max(first[2] >> 3, 0) };
    const Point to = { std::min(end[0], this->Box.Count[0] - 1),
      std::min(end[1], this->Box.Count[1] - 1), std::min(end[2], this->Box.Count[2] - 1) };
    for (int z = from[2]; z <= to[2]; ++z)
    {
      for (int y = from[1]; y <= to[1]; ++y)
      {
        const std::int64_t row = (std::int64_t{ z } * this->Box.Count[1] + y) * this->Box.Count[0];
        for (int x = from[0]; x <= to[0]; ++x)
        {
          if (const std::int32_t index = this->Lookup[row + x]; index >= 0)
          {
            body(index, Point{ 8 * x, 8 * y, 8 * z });
          }
        }
      }
    }
  }
};

/** Calls body(z, bits of word z) for a brick's words that hold positions of a box, ends included.
 *  @param origin of the brick */
template <typename Body>
void ForEachWordBetween(
  const BrickMask& mask, const Point& origin, const Point& first, const Point& last, Body&& body)
{
  Point from{};
  Point to{};
  for (int axis = 0; axis < 3; ++axis)
  {
    from[axis] = std::max(first[axis] - origin[axis], 0);
    to[axis] = std::min(last[axis] - origin[axis], 7);
  }
  const std::uint64_t bits = BitsBetween(from[0], to[0], from[1], to[1]);
  for (int z = from[2]; z <= to[2]; ++z)
  {
    body(z, mask[z] & bits);
  }
}

/**
 * A set of diamonds with ranks: coarse scales first (from N, the base cube's corners, to 0), then
 * by brick, word and bit.
 */
class DiamondSet
{
public:
  static constexpr std::int64_t None = -1;

  DiamondSet() = default;
  explicit DiamondSet(const Grid& grid);
  DiamondSet(const Grid& grid, const DiamondMask& mask);

  /** Only the bits of each word z of a mask that are in bitsOf(scale, z). */
  template <typename BitsOf>
  DiamondSet(const Grid& grid, const DiamondMask& mask, const BitsOf& bitsOf)
    : DiamondSet(grid)
  {
    mask.ForEachBrick(bitsOf,
      [&](int scale, std::int64_t index, const BrickMask& some)
      { this->Append(scale, index, some); });
  }

  /** Appends a brick; scales must come from coarse to fine and bricks of a scale in order.
   *  @throws std::length_error at more than 2^32 - 1 diamonds. */
  void Append(int scale, std::int64_t brickIndex, const BrickMask& mask);

  std::int64_t Size() const { return this->Count; }
  std::int64_t CountBricks() const { return this->BrickCount; }
  int ScaleCount() const { return static_cast<int>(this->Levels.size()); }
  const BrickLevel& Level(int scale) const { return this->Levels[scale]; }

  /** Rank of the diamond at a place, None if it is not in the set. */
  std::int64_t Rank(const Place& place) const
  {
    return RankIn(this->Levels[place.Scale].Find(place.Position), place.Position);
  }

  /** The same for a position in a brick, which may be null. */
  static std::int64_t RankIn(const Brick* brick, const Point& position)
  {
    const int z = position[2] & 7;
    const int bit = BitOf(position);
    return brick != nullptr && brick->Contains(z, bit) ? std::int64_t{ brick->Rank(z, bit) } : None;
  }

  bool Contains(const Place& place) const { return this->Rank(place) != None; }

  /** Calls body(place, rank) for every diamond of one brick's word z, in order. */
  template <typename Body>
  void ForEachInWord(int scale, const Brick& brick, int z, Body&& body) const
  {
    const Point origin = this->Levels[scale].Box.Origin(brick.BoxIndex);
    std::uint32_t rank = brick.First + brick.Before[z];
    ForEachBit(brick.Occupancy[z],
      [&](int bit) {
        body(Place{ scale, PositionOf(origin, z, bit) }, rank++);
      });
  }

  /** Calls body(place, rank) for every diamond of one brick, in order. */
  template <typename Body>
  void ForEachInBrick(int scale, const Brick& brick, Body&& body) const
  {
    for (int z = 0; z < 8; ++z)
    {
      this->ForEachInWord(scale, brick, z, body);
    }
  }

  /** Calls body(place, rank) for every diamond, in order. */
  template <typename Body>
  void ForEach(Body&& body) const
  {
    for (int scale = this->ScaleCount() - 1; scale >= 0; --scale)
    {
      for (const Brick& brick : this->Levels[scale].Bricks)
      {
        this->ForEachInBrick(scale, brick, body);
      }
    }
  }

private:
  std::vector<BrickLevel> Levels;
  std::int64_t Count = 0;
  std::int64_t BrickCount = 0;
};

/** A brick and its 26 neighbours: passes look up in it, without a search, the diamonds near those
 *  of one brick. */
class BrickWindow
{
public:
  /** @param position any in the middle brick, which need not exist */
  BrickWindow(const BrickLevel& level, const Point& position)
    : Origin(8 * BrickOf(position))
  {
    for (int i = 0; i < 27; ++i)
    {
      const Point offset = { 8 * (i % 3 - 1), 8 * (i / 3 % 3 - 1), 8 * (i / 9 - 1) };
      this->Bricks[i] = level.Find(this->Origin + offset);
    }
  }

  /** Rank of the diamond at a position of this brick or next to it; DiamondSet::None if there is
   *  none. */
  std::int64_t Rank(const Point& position) const
  {
    const int x = (position[0] - this->Origin[0] + 8) >> 3;
    const int y = (position[1] - this->Origin[1] + 8) >> 3;
    const int z = (position[2] - this->Origin[2] + 8) >> 3;
    assert(x >= 0 && x < 3 && y >= 0 && y < 3 && z >= 0 && z < 3 && "in the brick or next to it");
    return DiamondSet::RankIn(this->Bricks[x + 3 * y + 9 * z], position);
  }

private:
  Point Origin; ///< position of the middle brick's first corner
  std::array<const Brick*, 27> Bricks{};
};

/** A brick of a set: the unit of work of encoding and extraction. */
struct BrickPlace
{
  int Scale = 0;
  std::int64_t Index = 0; ///< in its level's list
};

/** Every brick, coarse to fine: the order of the ranks. */
std::vector<BrickPlace> AllBricks(const DiamondSet& set);

}

#endif
