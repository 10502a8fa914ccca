// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/TriangleWalk.h"

#include <gtest/gtest.h>

#include <vector>

namespace isodiamond
{
namespace
{

/** Triangles in a row, each a neighbour of the next; or in a ring. */
TriangleNeighbours Row(int count, bool isRing)
{
  TriangleNeighbours row;
  for (int i = 0; i < count; ++i)
  {
    const std::uint32_t before = i > 0 ? 1U << (i - 1) : isRing ? 1U << (count - 1) : 0U;
    const std::uint32_t after = i + 1 < count ? 1U << (i + 1) : isRing ? 1U : 0U;
    row.Set(i, before | after);
  }
  return row;
}

std::vector<int> Walk(const TriangleNeighbours& neighbours, std::uint32_t some,
  std::uint32_t others, std::uint32_t within = ~0U)
{
  TriangleWalk walk;
  if (!neighbours.FindWalk(some, others, walk, within))
  {
    return {};
  }
  return { walk.Triangles.begin(), walk.Triangles.begin() + walk.Count };
}

bool IsNothing(const std::vector<int>& steps)
{
  ReducedWalk walk;
  for (const int step : steps)
  {
    walk.Add(static_cast<std::uint8_t>(step));
  }
  return walk.IsNothing();
}

TEST(TriangleWalk, IsTheShortest)
{
  const TriangleNeighbours ring = Row(6, true);
  EXPECT_EQ(Walk(ring, 1U << 1, 1U << 4), (std::vector<int>{ 1, 2, 3, 4 }));
  EXPECT_EQ(Walk(ring, 1U << 1 | 1U << 2, 1U << 5), (std::vector<int>{ 1, 0, 5 }));
  EXPECT_EQ(Walk(ring, 1U << 1 | 1U << 2, 1U << 2 | 1U << 3), (std::vector<int>{ 2 }));
}

TEST(TriangleWalk, StaysWithin)
{
  const TriangleNeighbours ring = Row(6, true);
  EXPECT_EQ(Walk(ring, 1U << 0, 1U << 4, 0b011111), (std::vector<int>{ 0, 1, 2, 3, 4 }));
  EXPECT_TRUE(Walk(ring, 1U << 0, 1U << 3, 0b101011).empty());
  EXPECT_TRUE(Walk(Row(2, false), 1U << 0, 1U << 5).empty()) << "not connected";
}

TEST(TriangleWalk, TakesStepsBack)
{
  EXPECT_TRUE(IsNothing({ 3 }));
  EXPECT_TRUE(IsNothing({ 0, 1, 2, 2, 1, 1, 0 }));
  EXPECT_TRUE(IsNothing({ 1, 0, 1, 2, 3, 2, 1 })) << "both ways";
  EXPECT_FALSE(IsNothing({ 0, 1, 2, 1 })) << "not where it began";
  EXPECT_FALSE(IsNothing({ 0, 1, 2, 3, 0 })) << "around a ring";
}

}
}
