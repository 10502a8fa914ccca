// SPDX-License-Identifier: BSD-3-Clause
#include "Lattice/DiamondPortion.h"

#include "Build/ActivationThresholds.h"
#include "Build/Classification.h"
#include "Field/PeerPortion.h"
#include "Tools/CoreTestTools.h"
#include "Tools/RandomTestTools.h"
#include "Tools/ThreadPeers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

using namespace isodiamond;

namespace
{

/** The portions of a lattice, and which of them have a diamond. */
struct Portions
{
  std::vector<DiamondPortion> All;

  explicit Portions(const std::vector<int>& begins)
  {
    for (std::size_t i = 0; i < begins.size(); ++i)
    {
      this->All.emplace_back(begins, static_cast<int>(i));
    }
  }

  static bool Has(const DiamondPortion& portion, const Place& place)
  {
    return ((portion.Has(place.Scale, place.Position[2]) >> BitOf(place.Position)) & 1U) != 0;
  }
  static bool IsCommon(const DiamondPortion& portion, const Place& place)
  {
    return ((portion.AreCommon(place.Scale, place.Position[2]) >> BitOf(place.Position)) & 1U) != 0;
  }
};

/** The first slices of some portions of a lattice, ascending. */
std::vector<int> RandomBegins(test::Random& random, int slices)
{
  std::vector<int> begins(1 + test::Pick(random, 5), 0);
  std::generate(begins.begin() + 1, begins.end(),
    [&] { return DiamondPortion::Step * test::Pick(random, slices / DiamondPortion::Step + 2); });
  std::sort(begins.begin(), begins.end());
  return begins;
}

void ExpectPartition(const Grid& grid, const Portions& portions, const Place& place)
{
  const TypeTable& shape = ShapeOf(place.Position);
  const int slice = Centre(place)[2];
  int owners = 0;
  int holders = 0;
  for (const DiamondPortion& portion : portions.All)
  {
    const bool has = Portions::Has(portion, place);
    owners += portion.Owns(slice) ? 1 : 0;
    holders += has ? 1 : 0;
    EXPECT_TRUE(has || !portion.Owns(slice));

    // The diamond's domain reaches from its lowest vertex to its highest.
    int low = slice;
    int high = slice;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      low = std::min(low, VertexAt(place, shape.Offsets[i])[2]);
      high = std::max(high, VertexAt(place, shape.Offsets[i])[2]);
    }
    const bool touches = high >= portion.Begin() && low <= portion.End();
    EXPECT_TRUE(has || !touches);
    for (int i = 0; has && i < shape.ParentCount; ++i)
    {
      const Place parent = ParentPlace(shape, place, i);
      EXPECT_TRUE(parent.Scale >= grid.Depth() || Portions::Has(portion, parent));
    }
  }
  EXPECT_EQ(owners, 1);
  for (const DiamondPortion& portion : portions.All)
  {
    EXPECT_EQ(Portions::IsCommon(portion, place), holders > 1);
  }
}

}

TEST(DiamondPortion, HasWhatTouchesItsSlicesAndAllAncestors)
{
  test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      const int slices = 2 + test::Pick(random, 100);
      const Grid grid({ 3, 4, slices });
      const Portions portions(RandomBegins(random, slices));
      for (int scale = 0; scale < grid.Depth(); ++scale)
      {
        const std::array<int, 3> positions = grid.Positions(scale);
        for (Point p{}; p[2] < positions[2]; ++p[2])
        {
          for (p[1] = 0; p[1] < std::min(positions[1], 4); ++p[1])
          {
            for (p[0] = 0; p[0] < std::min(positions[0], 4); ++p[0])
            {
              if (Parity(p) != 0)
              {
                ExpectPartition(grid, portions, { scale, p });
              }
            }
          }
        }
      }
    });
}

TEST(DiamondPortion, IsSmallBesideTheWhole)
{
  const DiamondPortion portion({ 0, 96, 192, 288 }, 1);
  std::int64_t has = 0;
  std::int64_t all = 0;
  const Grid grid({ 385, 385, 385 });
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (int z = 0; z < grid.Positions(scale)[2]; ++z)
    {
      const std::uint64_t bits =
        tables::ClassBits[0][z & 1] | tables::ClassBits[1][z & 1] | tables::ClassBits[2][z & 1];
      const std::int64_t rows =
        std::int64_t{ 1 } * grid.Positions(scale)[0] * grid.Positions(scale)[1];
      has += rows * PopCount(portion.Has(scale, z));
      all += rows * PopCount(bits);
    }
  }
  EXPECT_LT(has, 0.31 * static_cast<double>(all));
  EXPECT_GT(has, 0.25 * static_cast<double>(all));
}

namespace
{

DiamondMask MembersOf(const test::Field& field)
{
  const Grid grid(field.Dims);
  DiamondMask members =
    Classify(grid, SignLattice(grid, field.View(), field.Isovalue, SerialFor), SerialFor).Members;
  members.Insert(grid.Depth(), 0, CornerBrick());
  return members;
}

}

TEST(PeerPortion, HasAsManyDiamondsAsTheOthers)
{
  // All of the surface is in the last quarter: most slices have nothing.
  test::Field field = test::WaveField({ 33, 33, 257 });
  for (std::size_t i = 0; i < field.Samples.size() * 3 / 4; ++i)
  {
    field.Samples[i] = static_cast<float>(field.Isovalue - 1.0);
  }
  const DiamondMask all = MembersOf(field);
  std::vector<std::int64_t> sizes;
  test::ForEachPeer(
    4, [&](Peers& own) { return PeerPortion(Grid(field.Dims), all, own).TakeMembers().Size(); },
    [&](std::int64_t size) { sizes.push_back(size); });
  // The quarter with the surface has eight layers of bricks.
  EXPECT_LT(*std::max_element(sizes.begin(), sizes.end()), 0.6 * static_cast<double>(all.Size()));
  EXPECT_GT(*std::min_element(sizes.begin(), sizes.end()), 0.2 * static_cast<double>(all.Size()));
}

TEST(PeerPortion, RaisesToTheGreatestThatOneHas)
{
  const test::Field field = test::NoiseField({ 9, 12, 70 }, 3);
  const Grid grid(field.Dims);
  const DiamondMask all = MembersOf(field);
  const auto valueOf = [](const Place& place, int rank)
  {
    const Point& p = place.Position;
    return static_cast<std::uint16_t>((31 * p[0] + 17 * p[1] + 7 * p[2] + 101 * place.Scale) % 97 +
      1000 * ((p[0] + p[1] + p[2] + rank) % 3));
  };
  using Rows = std::vector<std::array<std::uint16_t, 2>>;
  constexpr int count = 3;
  std::vector<DiamondSet> sets(count);
  std::vector<Rows> values(count);
  for (const int firstScale : { 0, 2, 20 })
  {
    test::ForEachPeer(
      count,
      [&](Peers& own)
      {
        PeerPortion portion(grid, all, own);
        const DiamondSet members = portion.TakeMembers();
        Rows rows(members.Size());
        members.ForEach(
          [&](const Place& place, std::uint32_t rank) {
            rows[rank] = { valueOf(place, own.Rank()), valueOf(place, own.Rank() + 1) };
          });
        portion.Max(rows, firstScale);
        return std::tuple(own.Rank(), members, rows);
      },
      [&](const std::tuple<int, DiamondSet, Rows>& made)
      {
        const auto& [rank, members, rows] = made;
        sets[rank] = members;
        values[rank] = rows;
      });
    int common = 0;
    all.ForEach(
      [&](const Place& place)
      {
        std::array<std::uint16_t, 2> greatest{};
        int holders = 0;
        for (int rank = 0; rank < count; ++rank)
        {
          if (sets[rank].Contains(place))
          {
            greatest[0] = std::max(greatest[0], valueOf(place, rank));
            greatest[1] = std::max(greatest[1], valueOf(place, rank + 1));
            ++holders;
          }
        }
        EXPECT_GT(holders, 0);
        common += holders > 1 ? 1 : 0;
        for (int rank = 0; rank < count; ++rank)
        {
          if (const std::int64_t own = sets[rank].Rank(place); own != DiamondSet::None)
          {
            const std::array<std::uint16_t, 2> before = { valueOf(place, rank),
              valueOf(place, rank + 1) };
            EXPECT_EQ(values[rank][own], place.Scale < firstScale ? before : greatest);
          }
        }
      });
    EXPECT_GT(common, 100);
  }
}

// With random own errors, thresholds depend on each other across portions, back and forth.
TEST(PeerPortion, LeadsToTheThresholdsOfTheWhole)
{
  const int cases = test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      const test::Field field = test::NoiseField(
        { 2 + test::Pick(random, 6), 2 + test::Pick(random, 6), 30 + test::Pick(random, 40) },
        seed);
      const Grid grid(field.Dims);
      const DiamondMask all = MembersOf(field);
      const DiamondSet members(grid, all);
      std::vector<ErrorCode::Type> own(members.Size());
      std::generate(own.begin(), own.end(),
        [&] { return static_cast<ErrorCode::Type>(1 + test::Pick(random, 1000)); });
      const std::vector<ErrorCode::Type> expected =
        ActivationThresholds(grid, members, own, SerialFor);
      const std::vector<std::uint32_t> followers = FindFollowers(own, expected);
      const std::vector<ErrorCode::Type> saturated =
        SaturateUpward(grid, members, own, followers, SerialFor);
      test::ForEachPeer(
        1 + test::Pick(random, 5),
        [&](Peers& peers)
        {
          PeerPortion portion(grid, all, peers);
          const DiamondSet had = portion.TakeMembers();
          std::vector<ErrorCode::Type> ownHad(had.Size());
          had.ForEach([&](const Place& place, std::uint32_t rank)
            { ownHad[rank] = own[members.Rank(place)]; });
          const std::vector<ErrorCode::Type> found =
            ActivationThresholds(grid, had, ownHad, SerialFor, &portion);
          const std::vector<ErrorCode::Type> foundAbove =
            SaturateUpward(grid, had, ownHad, FindFollowers(ownHad, found), SerialFor, &portion);
          bool isSame = true;
          had.ForEach(
            [&](const Place& place, std::uint32_t rank)
            {
              const std::int64_t inAll = members.Rank(place);
              isSame =
                isSame && found[rank] == expected[inAll] && foundAbove[rank] == saturated[inAll];
            });
          return isSame;
        },
        [](bool isSame) { EXPECT_TRUE(isSame); });
    });
  EXPECT_GT(cases, 0);
}
