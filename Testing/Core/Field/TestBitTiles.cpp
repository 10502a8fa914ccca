// SPDX-License-Identifier: BSD-3-Clause
// Tiles have the bits that were set, however they came, and tell where all are equal.
#include "Field/BitTiles.h"
#include "Tools/RandomTestTools.h"
#include "Tools/ThreadPeers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace isodiamond;

namespace
{

/** Bits of a box, one after the other. */
struct PlainBits
{
  std::array<int, 3> Count{};
  std::vector<bool> Bits;

  /** All equal, then flipped in random boxes. */
  explicit PlainBits(test::Random& random)
    : Count{ 1 + test::Pick(random, 200), 1 + test::Pick(random, 40), 1 + test::Pick(random, 60) }
    , Bits(std::size_t{ 1 } * this->Count[0] * this->Count[1] * this->Count[2],
        test::Pick(random, 2) == 0)
  {
    for (int boxes = test::Pick(random, 4); boxes > 0; --boxes)
    {
      std::array<std::array<int, 2>, 3> ends{};
      for (int axis = 0; axis < 3; ++axis)
      {
        ends[axis] = { test::Pick(random, this->Count[axis]),
          test::Pick(random, this->Count[axis]) };
        std::sort(ends[axis].begin(), ends[axis].end());
      }
      this->ForEach(
        [&](const Point& at)
        {
          bool isIn = true;
          for (int axis = 0; axis < 3; ++axis)
          {
            isIn = isIn && ends[axis][0] <= at[axis] && at[axis] <= ends[axis][1];
          }
          this->Bits[this->Index(at)] = this->Bits[this->Index(at)] != isIn;
        });
    }
  }

  std::size_t Index(const Point& at) const
  {
    return (std::size_t{ 1 } * at[2] * this->Count[1] + at[1]) * this->Count[0] + at[0];
  }
  bool operator()(const Point& at) const { return this->Bits[this->Index(at)]; }

  template <typename Body>
  void ForEach(const Body& body) const
  {
    for (int z = 0; z < this->Count[2]; ++z)
    {
      for (int y = 0; y < this->Count[1]; ++y)
      {
        for (int x = 0; x < this->Count[0]; ++x)
        {
          body(Point{ x, y, z });
        }
      }
    }
  }

  /** The rows of some slices, as words. */
  std::vector<std::uint64_t> Rows(int first, int count) const
  {
    const int words = (this->Count[0] + 63) / 64;
    std::vector<std::uint64_t> rows(std::size_t{ 1 } * words * this->Count[1] * count);
    this->ForEach(
      [&](const Point& at)
      {
        if (at[2] >= first && at[2] < first + count && (*this)(at))
        {
          rows[(std::size_t{ 1 } * (at[2] - first) * this->Count[1] + at[1]) * words +
            at[0] / 64] |= std::uint64_t{ 1 } << (at[0] % 64);
        }
      });
    return rows;
  }
};

bool BitOf(const BitTiles& tiles, const Point& at)
{
  return (tiles.RowAt(at[1], at[2])[at[0] / 64] >> (at[0] % 64) & 1U) != 0;
}

void ExpectBits(const BitTiles& tiles, const PlainBits& plain)
{
  plain.ForEach([&](const Point& at)
    { ASSERT_EQ(BitOf(tiles, at), plain(at)) << at[0] << ' ' << at[1] << ' ' << at[2]; });
  ASSERT_EQ(tiles.AllRows(), plain.Rows(0, plain.Count[2]));
}

/** Sets slices from begin to end, in runs that may overlap. */
void SetSlices(BitTiles& tiles, const PlainBits& plain, int begin, int end, test::Random& random)
{
  const ParallelFor threads = test::ThreadedFor(3);
  while (begin < end)
  {
    const int first = std::max(begin - test::Pick(random, 4), 0);
    const int last = std::min(begin + 1 + test::Pick(random, 30), end);
    tiles.Set(first, last - first, plain.Rows(first, last - first), threads);
    begin = last;
  }
}

/** Tiles call a box equal exactly if all bits of the tiles that it touches are. */
void ExpectEqualBoxes(const BitTiles& tiles, const PlainBits& plain, test::Random& random)
{
  for (int i = 0; i < 20; ++i)
  {
    Point first{};
    Point last{};
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = test::Pick(random, plain.Count[axis]) - 1;
      last[axis] = first[axis] + test::Pick(random, 12);
    }
    bool isAny[2] = { false, false };
    plain.ForEach(
      [&](const Point& at)
      {
        bool isNear = true; // in one of the box's tiles
        const std::array<int, 3> size = { 64, 8, 8 };
        for (int axis = 0; axis < 3; ++axis)
        {
          const int from = std::max(first[axis], 0);
          const int to = std::min(last[axis], plain.Count[axis] - 1);
          isNear = isNear && at[axis] / size[axis] >= from / size[axis] &&
            at[axis] / size[axis] <= to / size[axis];
        }
        isAny[plain(at) ? 1 : 0] = isAny[plain(at) ? 1 : 0] || isNear;
      });
    ASSERT_EQ(tiles.AreEqual(first, last), !(isAny[0] && isAny[1]));
  }
}

void Check(std::uint32_t seed)
{
  test::Random random(seed);
  const PlainBits plain(random);
  BitTiles tiles(plain.Count);
  SetSlices(tiles, plain, 0, plain.Count[2], random);
  ASSERT_NO_FATAL_FAILURE(ExpectBits(tiles, plain));
  tiles.Compress();
  ASSERT_NO_FATAL_FAILURE(ExpectBits(tiles, plain));
  ASSERT_NO_FATAL_FAILURE(ExpectEqualBoxes(tiles, plain, random));

  const std::array<int, 3> half = { (plain.Count[0] + 1) / 2, (plain.Count[1] + 1) / 2,
    (plain.Count[2] + 1) / 2 };
  const BitTiles coarser = tiles.Coarser(half);
  plain.ForEach(
    [&](const Point& at)
    {
      if (at[0] % 2 == 0 && at[1] % 2 == 0 && at[2] % 2 == 0)
      {
        ASSERT_EQ(BitOf(coarser, { at[0] / 2, at[1] / 2, at[2] / 2 }), plain(at));
      }
    });

  // Each of some peers sets some slices.
  const int count = 1 + test::Pick(random, 4);
  test::ForEachPeer(
    count,
    [&](Peers& own)
    {
      test::Random ownRandom(seed + own.Rank());
      BitTiles of(plain.Count);
      SetSlices(of, plain, plain.Count[2] * own.Rank() / count,
        plain.Count[2] * (own.Rank() + 1) / count, ownRandom);
      of.Or(own);
      return of;
    },
    [&](const BitTiles& of) { ExpectBits(of, plain); });
}

}

TEST(BitTiles, HaveTheBitsThatWereSet)
{
  test::ForRandomSeeds(Check);
}
