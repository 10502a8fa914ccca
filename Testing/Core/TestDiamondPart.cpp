// SPDX-License-Identifier: BSD-3-Clause
#include "Lattice/DiamondPart.h"

#include "CoreTestTools.h"
#include "RandomTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace isodiamond;

namespace
{

/** The parts of a lattice, and which have a diamond. */
struct Parts
{
  std::vector<DiamondPart> All;

  explicit Parts(const std::vector<int>& begins)
  {
    for (std::size_t i = 0; i < begins.size(); ++i)
    {
      this->All.emplace_back(begins, static_cast<int>(i));
    }
  }

  static bool Has(const DiamondPart& part, const Place& place)
  {
    return ((part.Has(place.Scale, place.Position[2]) >> BitOf(place.Position)) & 1U) != 0;
  }
  static bool IsCommon(const DiamondPart& part, const Place& place)
  {
    return ((part.AreCommon(place.Scale, place.Position[2]) >> BitOf(place.Position)) & 1U) != 0;
  }
};

/** The first slices of some parts of a lattice, ascending. */
std::vector<int> RandomBegins(test::Random& random, int slices)
{
  std::vector<int> begins(1 + test::Pick(random, 5), 0);
  std::generate(begins.begin() + 1, begins.end(),
    [&] { return DiamondPart::Step * test::Pick(random, slices / DiamondPart::Step + 2); });
  std::sort(begins.begin(), begins.end());
  return begins;
}

void ExpectPartition(const Grid& grid, const Parts& parts, const Place& place)
{
  const TypeTable& shape = ShapeOf(place.Position);
  const int slice = Centre(place)[2];
  int owners = 0;
  int holders = 0;
  for (const DiamondPart& part : parts.All)
  {
    const bool has = Parts::Has(part, place);
    owners += part.Owns(slice) ? 1 : 0;
    holders += has ? 1 : 0;
    EXPECT_TRUE(has || !part.Owns(slice));

    // Its domain reaches from the lowest of its vertices to the highest.
    int low = slice;
    int high = slice;
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      low = std::min(low, VertexAt(place, shape.Offsets[i])[2]);
      high = std::max(high, VertexAt(place, shape.Offsets[i])[2]);
    }
    const bool touches = high >= part.Begin() && low <= part.End();
    EXPECT_TRUE(has || !touches);
    for (int i = 0; has && i < shape.ParentCount; ++i)
    {
      const Place parent = ParentPlace(shape, place, i);
      EXPECT_TRUE(parent.Scale >= grid.Depth() || Parts::Has(part, parent));
    }
  }
  EXPECT_EQ(owners, 1);
  for (const DiamondPart& part : parts.All)
  {
    EXPECT_EQ(Parts::IsCommon(part, place), holders > 1);
  }
}

}

TEST(DiamondPart, HasWhatTouchesItsSlicesAndAllAncestors)
{
  test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      const int slices = 2 + test::Pick(random, 100);
      const Grid grid({ 3, 4, slices });
      const Parts parts(RandomBegins(random, slices));
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
                ExpectPartition(grid, parts, { scale, p });
              }
            }
          }
        }
      }
    });
}

TEST(DiamondPart, IsSmallBesideTheWhole)
{
  const DiamondPart part({ 0, 96, 192, 288 }, 1);
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
      has += rows * PopCount(part.Has(scale, z));
      all += rows * PopCount(bits);
    }
  }
  EXPECT_LT(has, 0.31 * static_cast<double>(all));
  EXPECT_GT(has, 0.25 * static_cast<double>(all));
}
