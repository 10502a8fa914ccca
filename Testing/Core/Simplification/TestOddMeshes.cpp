// SPDX-License-Identifier: BSD-3-Clause
// Simplification of what surfaces of fields hardly ever have, or have in few places.
#include "Simplification/MeshBlocks.h"
#include "Simplification/MeshDivision.h"
#include "Simplification/Simplification.h"
#include "Tools/SimplificationTestTools.h"
#include "Tools/TopologyTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

using namespace isodiamond;

namespace
{

/** Two sheets of squares, one above the other, that have the point in the middle in common. */
AllowedMesh SheetsThatMeet(int half, double allowed)
{
  AllowedMesh mesh;
  mesh.Mesh.Positions = { { 0, 0, 0 } };
  for (const int sign : { -1, 1 })
  {
    std::map<std::array<int, 2>, std::uint32_t> ids = { { { 0, 0 }, 0 } };
    const auto at = [&](int x, int y)
    {
      const auto [found, isNew] =
        ids.try_emplace({ x, y }, static_cast<std::uint32_t>(mesh.Mesh.Positions.size()));
      if (isNew)
      {
        const double height = 0.1 * (x * x + y * y) + 2.0;
        mesh.Mesh.Positions.push_back({ 1.0 * x, 1.0 * y, sign * height });
      }
      return found->second;
    };
    for (int y = -half; y < half; ++y)
    {
      for (int x = -half; x < half; ++x)
      {
        const std::array<std::uint32_t, 4> square = { at(x, y), at(x + 1, y), at(x + 1, y + 1),
          at(x, y + 1) };
        const auto [a, b, c, d] = square;
        const std::array<Triangle, 2> up = { { { a, b, c }, { a, c, d } } };
        const std::array<Triangle, 2> down = { { { a, c, b }, { a, d, c } } };
        const auto& both = sign > 0 ? up : down;
        mesh.Mesh.Triangles.insert(mesh.Mesh.Triangles.end(), both.begin(), both.end());
      }
    }
  }
  mesh.Allowances.assign(mesh.Mesh.Triangles.size(), allowed);
  return mesh;
}

constexpr std::uint32_t PointsAroundBlade = 7;

/** A blade along x, closed: its two sides meet in its edge, at z = 0.
 *  @param thickness of its back @param bend of the whole, to the side */
AllowedMesh Blade(std::uint32_t steps, double thickness, double bend, double allowed)
{
  // Around it, from the edge: up one side, and down the other.
  constexpr std::uint32_t count = PointsAroundBlade;
  const std::array<std::array<double, 2>, count> section = { { { 0, 0 }, { 1, 1 }, { 2, 2 },
    { 3, 3 }, { -3, 3 }, { -2, 2 }, { -1, 1 } } };
  AllowedMesh mesh;
  for (std::uint32_t x = 0; x <= steps; ++x)
  {
    const double middle = 2.0 * x / steps - 1.0;
    for (const auto& [y, z] : section)
    {
      mesh.Mesh.Positions.push_back({ 1.0 * x, thickness / 6.0 * y + bend * middle * middle, z });
    }
  }
  for (std::uint32_t x = 0; x < steps; ++x)
  {
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::uint32_t next = (i + 1) % count;
      const std::uint32_t a = x * count + i;
      const std::uint32_t b = x * count + next;
      mesh.Mesh.Triangles.push_back({ a, b, b + count });
      mesh.Mesh.Triangles.push_back({ a, b + count, a + count });
    }
  }
  const std::uint32_t end = steps * count;
  for (const auto& [a, b, c] : { Triangle{ 0, 6, 1 }, Triangle{ 1, 6, 2 }, Triangle{ 2, 6, 5 },
         Triangle{ 2, 5, 3 }, Triangle{ 3, 5, 4 } })
  {
    mesh.Mesh.Triangles.push_back({ a, b, c });
    mesh.Mesh.Triangles.push_back({ end + a, end + c, end + b });
  }
  mesh.Allowances.assign(mesh.Mesh.Triangles.size(), allowed);
  return mesh;
}

}

// Parts may have one sheet each, in which the point looks like any other.
TEST(OddMeshes, KeepSheetsTogetherThatMeetInAPoint)
{
  const AllowedMesh mesh = SheetsThatMeet(5, 5.0);
  const Connectivity links(mesh.Mesh.Positions.size(), mesh.Mesh.Triangles);
  EXPECT_TRUE(links.FaultyPoints().empty());
  for (std::uint32_t point = 0; point < mesh.Mesh.Positions.size(); ++point)
  {
    EXPECT_EQ(links.IsPinched(point), point == 0);
  }
  for (const std::size_t most : { mesh.Mesh.Triangles.size() / 2, MostOfPart })
  {
    const SimplerMesh after = Simplify(mesh, SerialFor, most);
    EXPECT_LT(after.Triangles.size(), mesh.Mesh.Triangles.size() / 2);
    std::array<int, 2> fans{};
    for (const Triangle& triangle : after.Triangles)
    {
      if (std::count(triangle.begin(), triangle.end(), 0U) > 0)
      {
        const double height = after.Positions[triangle[0]][2] + after.Positions[triangle[1]][2] +
          after.Positions[triangle[2]][2];
        ++fans[height > 0.0 ? 1 : 0];
      }
    }
    EXPECT_GT(fans[0], 2);
    EXPECT_GT(fans[1], 2);
    EXPECT_EQ(after.Homes[0], None);
  }
}

// Meshes of damaged hierarchies may have triangles with a point twice; around such a point there
// may be no way back.
TEST(OddMeshes, MayHaveTrianglesWithAPointTwice)
{
  for (const Triangle& bad : { Triangle{ 4, 0, 0 }, Triangle{ 0, 0, 4 }, Triangle{ 4, 4, 4 } })
  {
    AllowedMesh mesh;
    mesh.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    mesh.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, bad };
    mesh.Allowances.assign(mesh.Mesh.Triangles.size(), 0.1);
    const std::vector<std::uint32_t> faulty =
      Connectivity(mesh.Mesh.Positions.size(), mesh.Mesh.Triangles).FaultyPoints();
    for (const std::uint32_t point : bad)
    {
      EXPECT_NE(std::find(faulty.begin(), faulty.end(), point), faulty.end()) << point;
    }
    EXPECT_EQ(Simplify(mesh, SerialFor).Triangles.size(), mesh.Mesh.Triangles.size());
  }
}

// Flat tetrahedra: three faces may be in one part, and the fourth in another.
TEST(OddMeshes, KeepSpecksThatPartsShare)
{
  AllowedMesh specks;
  for (std::uint32_t i = 0; i < 40; ++i)
  {
    const double z = 10.0 * i;
    for (const Vector& corner :
      { Vector{ 0, 0, z }, Vector{ 1, 0, z }, Vector{ 0, 1, z }, Vector{ 0.3, 0.3, z + 0.4 } })
    {
      specks.Mesh.Positions.push_back(corner);
    }
    const std::uint32_t first = 4 * i;
    for (const auto& [a, b, c] :
      { Triangle{ 0, 2, 1 }, Triangle{ 0, 1, 3 }, Triangle{ 1, 2, 3 }, Triangle{ 2, 0, 3 } })
    {
      specks.Mesh.Triangles.push_back({ first + a, first + b, first + c });
    }
  }
  specks.Allowances.assign(specks.Mesh.Triangles.size(), 0.5);
  for (const std::size_t most : { 3, 5, 7, 32 })
  {
    const TriangleMesh after = Simplify(specks, SerialFor, most);
    EXPECT_EQ(test::TopologyOf(test::IdsOf(after)), test::TopologyOf(test::IdsOf(specks.Mesh)));
    EXPECT_FALSE(test::HasTwins(after)) << most;
  }
}

// There is no direction from which all triangles around a point on a blade's edge can be seen.
TEST(OddMeshes, LosePointsOnTheEdgeOfABlade)
{
  struct Case
  {
    double Thickness;
    double Bend;
    std::size_t Most;
  };
  for (const Case& one : { Case{ 0.6, 0.0, 12 }, Case{ 0.9, 0.6, 30 }, Case{ 0.4, 1.5, 80 } })
  {
    SCOPED_TRACE(one.Most);
    const AllowedMesh blade = Blade(30, one.Thickness, one.Bend, 0.3);
    const SimplerMesh after = Simplify(blade, SerialFor);
    EXPECT_EQ(test::TopologyOf(test::IdsOf(after)), test::TopologyOf(test::IdsOf(blade.Mesh)));
    EXPECT_LE(after.Triangles.size(), one.Most); // 8 if it is straight
    // Points from one side lie over that side now, though the other side may be nearer.
    int gone = 0;
    int onOtherSide = 0;
    for (std::uint32_t point = 0; point < blade.Mesh.Positions.size(); ++point)
    {
      const std::uint32_t place = point % PointsAroundBlade; // around it: 0 is the edge
      if (after.Homes[point] != None && place != 0 && place != 3 && place != 4)
      {
        const Vector across = Across(after.Positions, after.Triangles[after.Homes[point]]);
        onOtherSide += across[1] * (place < 4 ? 1.0 : -1.0) < 0.0 ? 1 : 0;
        ++gone;
      }
    }
    EXPECT_GT(gone, 100);
    EXPECT_EQ(onOtherSide, 0);
  }
}

// A point on the line between two neighbours: the triangle of the three has no area.
TEST(OddMeshes, LosePointsOnALine)
{
  constexpr std::uint32_t size = 6;
  AllowedMesh flat;
  for (std::uint32_t y = 0; y <= size; ++y)
  {
    for (std::uint32_t x = 0; x <= size; ++x)
    {
      const double shift = x == 3 && y == 3 ? 0.5 : 0.0;
      flat.Mesh.Positions.push_back({ x - shift, y + shift, 0.0 });
      if (x < size && y < size)
      {
        const std::uint32_t a = y * (size + 1) + x;
        flat.Mesh.Triangles.push_back({ a, a + 1, a + size + 2 });
        flat.Mesh.Triangles.push_back({ a, a + size + 2, a + size + 1 });
      }
    }
  }
  flat.Allowances.assign(flat.Mesh.Triangles.size(), 0.1);
  const std::vector<std::uint32_t> homes = Simplify(flat, SerialFor).Homes;
  EXPECT_NE(homes[3 * (size + 1) + 3], None);
  EXPECT_EQ(homes.size() - std::count(homes.begin(), homes.end(), None), 25U) << "all inside";
}

// Such triangles arise where points far from the origin are rounded.
TEST(OddMeshes, LoseTrianglesWithoutArea)
{
  AllowedMesh ball = test::MeshOf(test::SphereField({ 17, 17, 17 }), 0.0, 0.4);
  for (Vector& position : ball.Mesh.Positions)
  {
    for (double& coordinate : position)
    {
      coordinate = std::round(8.0 * coordinate) / 8.0;
    }
  }
  const auto countWithout = [](const TriangleMesh& mesh)
  {
    return std::count_if(mesh.Triangles.begin(), mesh.Triangles.end(),
      [&](const Triangle& triangle) { return AreaOf(mesh.Positions, triangle) == 0.0; });
  };
  const auto before = countWithout(ball.Mesh);
  EXPECT_GT(before, 50);
  const TriangleMesh after = Simplify(ball, SerialFor);
  EXPECT_LT(4 * countWithout(after), before);
  EXPECT_EQ(test::TopologyOf(test::IdsOf(after)), test::TopologyOf(test::IdsOf(ball.Mesh)));
}

TEST(OddMeshes, AreCutIntoPartsOfAnySize)
{
  std::vector<Vector> middles(23);
  for (std::size_t i = 0; i < middles.size(); ++i)
  {
    middles[i] = { static_cast<double>(i % 5), static_cast<double>(i % 3), 0.0 };
  }
  for (const std::size_t most : { 1, 2, 3, 22, 23 })
  {
    for (const double cut : { 0.01, 0.35, 0.5, 1.0 })
    {
      const MeshBlocks blocks = CutIntoBlocks(middles, most, cut);
      std::vector<std::uint32_t> all;
      for (std::size_t i = 0; i < blocks.Count(); ++i)
      {
        EXPECT_LE(blocks[i].size(), most);
        EXPECT_GT(blocks[i].size(), 0U);
        EXPECT_TRUE(std::is_sorted(blocks[i].begin(), blocks[i].end()));
        all.insert(all.end(), blocks[i].begin(), blocks[i].end());
      }
      std::sort(all.begin(), all.end());
      std::vector<std::uint32_t> expected(middles.size());
      std::iota(expected.begin(), expected.end(), 0U);
      EXPECT_EQ(all, expected);
    }
  }
}

// A strip of six triangles, of which the first two are a part, the next two another one, and the
// last two in none.
TEST(OddMeshes, HaveOriginalsThatBelongToSeveralPartsOrToNone)
{
  std::vector<Vector> positions;
  std::vector<Triangle> strip;
  for (std::uint32_t i = 0; i < 8; ++i)
  {
    positions.push_back({ 1.0 * i, 1.0 * (i % 2), 0.0 });
  }
  for (std::uint32_t i = 0; i < 6; ++i)
  {
    strip.push_back(i % 2 == 0 ? Triangle{ i, i + 2, i + 1 } : Triangle{ i, i + 1, i + 2 });
  }
  struct Case
  {
    std::vector<std::uint32_t> Near;
    std::uint32_t Owner;
  };
  for (const auto& [near, owner] : { Case{ { 1 }, 0 }, Case{ { 3, 2 }, 1 }, Case{ { 5 }, None },
         Case{ { 1, 2 }, None }, Case{ { 3, 4 }, None }, Case{ { 4, 3 }, None },
         Case{ { 2, 4, 3 }, None }, Case{ { 2, 1, 3 }, None } })
  {
    SCOPED_TRACE(testing::PrintToString(near));
    NearLists lists(2);
    lists.Begin(0);
    lists.Add(0, 2);
    lists.Begin(1);
    for (const std::uint32_t triangle : near)
    {
      lists.Add(1, triangle);
    }
    const std::vector<std::uint32_t> homes = { None, 3, 5, 0 };
    const MeshDivision division({ positions, strip, lists, homes }, { 0, 1, 2, 3 }, 2, 0.5);
    EXPECT_EQ(division.PartOf, (std::vector<std::uint32_t>{ 0, 0, 1, 1, None, None }));
    EXPECT_EQ(division.OwnerOf, (std::vector<std::uint32_t>{ 1, owner }));
    EXPECT_EQ(division.OriginalNumber[1], owner == 1 ? 1U : 0U);
    for (std::uint32_t i = 0; i < strip.size(); ++i)
    {
      const bool isNear = std::find(near.begin(), near.end(), i) != near.end();
      EXPECT_EQ(division.IsHeld[i], near.size() > 1 && owner == None && isNear) << i;
    }
    ASSERT_EQ(division.Samples[0].size(), 1U);
    EXPECT_EQ(division.Samples[0][0], 3U);
    ASSERT_EQ(division.Samples[1].size(), 1U);
    EXPECT_EQ(division.Samples[1][0], 1U);
  }
}
