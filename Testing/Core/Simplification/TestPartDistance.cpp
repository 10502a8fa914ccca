// SPDX-License-Identifier: BSD-3-Clause
// How near a mesh is to another one: against brute force, and by hand.
#include "Simplification/Covering.h"
#include "Simplification/PartDistance.h"
#include "Simplification/ShadowTest.h"
#include "Simplification/Simplification.h"
#include "Tools/RandomTestTools.h"
#include "Tools/SimplificationTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace isodiamond;

namespace
{

/** A square of two triangles, and three points far away. */
AllowedMesh SquareAndPoints()
{
  AllowedMesh square;
  square.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 5, 5, 5 },
    { 6, 5, 5 }, { 5, 6, 5 } };
  square.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  square.Allowances = { 0.2, 0.2 };
  return square;
}

}

// A square above another one, farther away than allowed, but said to be near at the start: that is
// believed of triangles that are as they were, and of no others.
TEST(PartDistance, BelievesTheStartOnly)
{
  AllowedMesh square;
  square.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  square.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  square.Allowances = { 0.2, 0.2 };
  MeshPart above = test::WholePart(square);
  for (int i = 0; i < 4; ++i)
  {
    above.Positions.push_back(above.Positions[i] + Vector{ 0, 0, 0.3 });
  }
  above.Simple = Connectivity(8, { { 4, 5, 6 }, { 4, 6, 7 } }).Linked();
  for (std::uint32_t i = 0; i < 2; ++i)
  {
    above.Near.Begin(i);
    above.Near.Add(i, i);
  }
  const auto faults = [&](bool isStartNear, const std::vector<Triangle>& triangles)
  {
    MeshPart part = above;
    PartDistance distance(part, isStartNear);
    return distance.Find(
      Connectivity(8, triangles).Linked(), std::vector<std::uint32_t>(10, None), { true, true });
  };
  EXPECT_FALSE(faults(true, { { 4, 5, 6 }, { 4, 6, 7 } }).Any());
  EXPECT_FALSE(faults(true, { { 5, 6, 4 }, { 7, 4, 6 } }).Any()) << "the same";
  EXPECT_TRUE(faults(false, { { 4, 5, 6 }, { 4, 6, 7 } }).Any());
  EXPECT_TRUE(faults(true, { { 4, 5, 7 }, { 5, 6, 7 } }).Any()) << "cut the other way";
  EXPECT_TRUE(faults(true, { { 4, 6, 5 }, { 4, 7, 6 } }).Any()) << "turned over";
}

// If the start is not known to be near, nothing is believed of it, though nothing has changed.
TEST(PartDistance, FindsWhatIsFarFromTheStart)
{
  const AllowedMesh square = SquareAndPoints();
  MeshPart part = test::WholePart(square);
  part.Simple = Connectivity(7, { { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 } }).Linked();
  PartDistance distance(part);
  const PartDistance::Faults faults = distance.Find(
    part.Simple, std::vector<std::uint32_t>(part.Samples.size(), None), std::vector<bool>(3, true));
  EXPECT_EQ(faults.Triangles, std::vector<std::uint32_t>{ 2 });
  EXPECT_TRUE(faults.Points.empty());
}

// Each triangle is where it was, but faces the other way.
TEST(PartDistance, FindsWhatIsTurnedOver)
{
  const AllowedMesh square = SquareAndPoints();
  for (const bool isTurned : { false, true })
  {
    MeshPart part = test::WholePart(square);
    const std::vector<Triangle> simple =
      isTurned ? std::vector<Triangle>{ { 0, 2, 1 }, { 0, 3, 2 } } : square.Mesh.Triangles;
    PartDistance distance(part);
    const PartDistance::Faults faults = distance.Find(Connectivity(7, simple).Linked(),
      std::vector<std::uint32_t>(part.Samples.size(), None), { true, true });
    EXPECT_EQ(faults.Triangles,
      isTurned ? std::vector<std::uint32_t>({ 0, 1 }) : std::vector<std::uint32_t>());
  }
}

// A tetrahedron, and another around it with much smaller triangles: a few are said to be near, the
// others are found to be so from these.
TEST(PartDistance, FindsWhatIsNearAroundNewPoints)
{
  AllowedMesh solid;
  solid.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  solid.Mesh.Triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  solid.Allowances.assign(4, 1.0);
  MeshPart part = test::WholePart(solid);
  std::vector<Triangle> triangles = solid.Mesh.Triangles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b, std::map<Triangle, std::uint32_t>& ids)
  {
    const auto [place, isNew] = ids.emplace(Triangle{ std::min(a, b), std::max(a, b), 0 }, 0);
    if (isNew)
    {
      place->second = static_cast<std::uint32_t>(part.Positions.size());
      part.Positions.push_back(0.5 * (part.Positions[a] + part.Positions[b]));
    }
    return place->second;
  };
  // No point in common.
  for (int i = 0; i < 4; ++i)
  {
    part.Positions.push_back(part.Positions[i] + Vector{ -0.01, -0.01, -0.01 });
  }
  for (Triangle& triangle : triangles)
  {
    std::transform(triangle.begin(), triangle.end(), triangle.begin(),
      [](std::uint32_t point) { return point + 4; });
  }
  for (int level = 0; level < 2; ++level)
  {
    std::map<Triangle, std::uint32_t> ids;
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles)
    {
      const std::uint32_t ab = middle(a, b, ids);
      const std::uint32_t bc = middle(b, c, ids);
      const std::uint32_t ca = middle(c, a, ids);
      finer.insert(finer.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
    }
    triangles = finer;
  }
  for (const double allowance : { 0.005, 10.0 })
  {
    part.Allowances.assign(4, allowance);
    part.Simple = Connectivity(part.Positions.size(), triangles).Linked();
    part.Near = NearLists(4);
    PartDistance distance(part, false, true);
    const std::vector<std::uint32_t> homes(part.Positions.size() + 4, 17);
    EXPECT_EQ(distance.Find(part.Simple, homes, std::vector<bool>(triangles.size(), true)).Any(),
      allowance < 0.01);
  }
}

// What has turned over is near if it may.
TEST(PartDistance, MayIgnoreWhatIsTurnedOver)
{
  const AllowedMesh square = SquareAndPoints();
  for (const bool mayTurnOver : { false, true })
  {
    MeshPart part = test::WholePart(square);
    PartDistance distance(part, false, mayTurnOver);
    const LinkedTriangles turned = Connectivity(7, { { 0, 2, 1 }, { 0, 3, 2 } }).Linked();
    EXPECT_NE(
      distance.Find(turned, std::vector<std::uint32_t>(part.Samples.size(), None), { true, true })
        .Any(),
      mayTurnOver);
  }
}

// Asked again, it again names something that can be undone: a triangle that was near at the start,
// and has changed since.
TEST(PartDistance, TellsOfWhatIsNotAsAtTheStart)
{
  const AllowedMesh square = SquareAndPoints();
  MeshPart part = test::WholePart(square);
  part.Simple = part.Original;
  for (std::uint32_t i = 0; i < 2; ++i)
  {
    part.Near.Begin(i);
    part.Near.Add(i, i);
  }
  const LinkedTriangles wrong = Connectivity(7, { { 0, 1, 2 }, { 4, 5, 6 } }).Linked();
  const std::vector<std::uint32_t> homes(part.Samples.size(), None);
  PartDistance distance(part, true);
  for (const bool isTouched : { true, false, false })
  {
    const PartDistance::Faults faults = distance.Find(wrong, homes, { false, isTouched });
    EXPECT_GT(std::count(faults.Triangles.begin(), faults.Triangles.end(), 1U), 0);
  }
}

// A mesh of many triangles, simplified for four times the allowance that it is compared with:
// several threads find the same faults as one, and note the same for the next time.
TEST(PartDistance, IsTheSameWithThreads)
{
  const AllowedMesh careless = test::MeshOf(test::WaveField({ 41, 38, 33 }), 0.0, 0.8);
  const LinkedTriangles simple =
    Connectivity(careless.Mesh.Positions.size(), Simplify(careless, SerialFor).Triangles).Linked();
  AllowedMesh asked = careless;
  std::fill(asked.Allowances.begin(), asked.Allowances.end(), 0.2);
  ASSERT_GT(asked.Mesh.Triangles.size(), std::size_t{ 4000 });
  MeshPart one = test::WholePart(asked);
  MeshPart three = test::WholePart(asked);
  PartDistance ofOne(one);
  PartDistance ofThree(three);
  const std::vector<std::uint32_t> homes(one.Samples.size(), None);
  std::vector<bool> isTouched(simple.Triangles.size(), true);
  for (int time = 0; time < 2; ++time)
  {
    const PartDistance::Faults found = ofOne.Find(simple, homes, isTouched);
    const PartDistance::Faults same = ofThree.Find(simple, homes, isTouched, test::ThreadedFor(3));
    EXPECT_GT(found.Triangles.size(), std::size_t{ 100 });
    EXPECT_EQ(found.Triangles, same.Triangles);
    EXPECT_EQ(found.Points, same.Points);
    for (std::size_t i = 0; i < asked.Mesh.Triangles.size(); ++i)
    {
      ASSERT_TRUE(std::equal(
        one.Near[i].begin(), one.Near[i].end(), three.Near[i].begin(), three.Near[i].end()));
    }
    isTouched.assign(isTouched.size(), false);
  }
}

// Triangles between nearby points of a mesh, some of them far from the mesh or over its border,
// tested against some of the mesh's triangles there.
TEST(ShadowTest, IsRightByBruteForce)
{
  for (const test::Field& field : test::SurfacesToSimplify())
  {
    SCOPED_TRACE(field.Name);
    const AllowedMesh mesh = test::MeshOf(field, 0.0, 0.0);
    const std::vector<Vector>& positions = mesh.Mesh.Positions;
    const Connectivity links(positions.size(), mesh.Mesh.Triangles);
    const test::NearestTriangle nearest(test::TrianglesOf(mesh.Mesh));
    test::Random random(11);
    int covered = 0;
    int notCovered = 0;
    for (int trial = 0; trial < 3000; ++trial)
    {
      const double allowed = 0.05 * (1 + test::Pick(random, 12));
      const std::vector<double> allowances(mesh.Mesh.Triangles.size(), allowed);
      ShadowTest shadow(positions, links.Linked(), allowances);
      const std::uint32_t start = test::Pick(random, static_cast<int>(mesh.Mesh.Triangles.size()));
      const double reach = 1.0 + test::Pick(random, 3);
      std::vector<std::uint32_t> around = { start };
      std::vector<std::uint32_t> points;
      for (std::uint32_t i = 0; i < mesh.Mesh.Triangles.size(); ++i)
      {
        const Vector way = mesh.Mesh.Middle(i) - mesh.Mesh.Middle(start);
        if (i != start && Dot(way, way) < reach * reach)
        {
          points.push_back(mesh.Mesh.Triangles[i][0]);
          if (test::Pick(random, 4) == 0)
          {
            around.push_back(i);
          }
        }
      }
      if (points.size() < 3)
      {
        continue;
      }
      std::array<Vector, 3> corners;
      for (Vector& corner : corners)
      {
        corner = positions[points[test::Pick(random, static_cast<int>(points.size()))]];
        corner[test::Pick(random, 3)] += 0.02 * test::Pick(random, 10);
      }
      // Along its normal, or askew.
      Vector direction = Unit(Cross(corners[1] - corners[0], corners[2] - corners[0]));
      if (test::Pick(random, 2) == 0)
      {
        direction[test::Pick(random, 3)] += 0.1 * test::Pick(random, 8);
        direction = Unit(direction);
      }
      if (!shadow.Covers(corners, direction, around))
      {
        ++notCovered;
        continue;
      }
      ++covered;
      constexpr int parts = 12;
      double farthest = 0.0;
      for (int i = 0; i <= parts; ++i)
      {
        for (int k = 0; i + k <= parts; ++k)
        {
          const Vector place = (1.0 / parts) *
            (static_cast<double>(i) * corners[0] + static_cast<double>(k) * corners[1] +
              static_cast<double>(parts - i - k) * corners[2]);
          farthest = std::max(farthest, nearest.Distance(place));
        }
      }
      ASSERT_LE(farthest, allowed) << trial;
    }
    EXPECT_GT(covered, 10);
    EXPECT_GT(notCovered, 50);
  }
}

// A fold: where the mesh covers a triangle and turns back over it, the two layers cancel out.
TEST(ShadowTest, CountsWhatFacesTheOtherWay)
{
  const std::vector<Vector> positions = { { -1, -1, 0 }, { 3, -1, 0 }, { -1, 3, 0 },
    { -1, -1, 0.1 }, { 3, -1, 0.1 }, { -1, 3, 0.1 } };
  const std::vector<Triangle> triangles = { { 0, 1, 2 }, { 4, 3, 5 } };
  const Connectivity links(positions.size(), triangles);
  const std::vector<double> allowances(2, 1.0);
  ShadowTest shadow(positions, links.Linked(), allowances);
  const std::array<Vector, 3> up = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } } };
  const std::array<Vector, 3> down = { up[1], up[0], up[2] };
  const auto covers = [&](const std::array<Vector, 3>& corners, std::vector<std::uint32_t> some)
  {
    const Vector normal = Unit(Cross(corners[1] - corners[0], corners[2] - corners[0]));
    return shadow.Covers(corners, normal, some);
  };
  EXPECT_TRUE(covers(up, { 0 }));
  EXPECT_FALSE(covers(up, { 1 }));
  EXPECT_FALSE(covers(up, { 0, 1 }));
  EXPECT_TRUE(covers(down, { 1 }));
  EXPECT_FALSE(covers(down, { 0 }));
  EXPECT_FALSE(covers({ { up[0], up[1], up[1] } }, { 0 })) << "no area";
}

// A mesh that ends short of a corner so sharp that everything in it is close to a side.
TEST(ShadowTest, LooksIntoTheCornersOfSlivers)
{
  for (const double height : { 3.5e-9, 4e-8, 1e-6, 1e-3 })
  {
    const std::array<Vector, 3> sliver = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0.5, height, 0 } } };
    const double end = std::min(0.9e-9 / height * 0.5 * 0.98, 0.4);
    const std::vector<Vector> positions = { { end, height * end, 0 }, { end, -1, 0 }, { 2, -1, 0 },
      { 2, 1, 0 }, { end, 1, 0 } };
    const Connectivity links(5, { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 } });
    const std::vector<double> allowances(3, 0.5 * end);
    ShadowTest shadow(positions, links.Linked(), allowances);
    std::vector<std::uint32_t> all = { 0, 1, 2 };
    EXPECT_FALSE(shadow.Covers(sliver, { 0, 0, 1 }, all)) << height;
  }
}

// Over a strip; if this is long, it gives up.
TEST(Covering, UsesAllOfATriangleOrTellsThatItDoesNot)
{
  for (const std::uint32_t length : { 20U, 45U, 200U })
  {
    TriangleMesh strip;
    for (std::uint32_t x = 0; x <= length; ++x)
    {
      strip.Positions.push_back({ static_cast<double>(x), 0.0, 0.0 });
      strip.Positions.push_back({ static_cast<double>(x), 1.0, 0.0 });
    }
    for (std::uint32_t i = 0; i < 2 * length; i += 2)
    {
      strip.Triangles.push_back({ i, i + 2, i + 3 });
      strip.Triangles.push_back({ i, i + 3, i + 1 });
    }
    const Connectivity links(strip.Positions.size(), strip.Triangles);
    Covering covering(strip.Positions, links.Linked());
    const std::array<Vector, 3> corners = { { { 0.2, 0.3, 0.1 }, { length - 0.3, 0.4, 0.2 },
      { 0.5 * length, 0.7, 0.1 } } };
    const Vector normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
    double area = 0.0;
    const bool isAll = covering.Cut(corners, 0, 0.0,
      [&](std::uint32_t triangle, const Covering::Piece& piece)
      {
        EXPECT_TRUE(covering.IsNear(triangle, piece.Corners.data(), piece.Count, 0.2 + 1e-9));
        area += piece.Area();
        return true;
      });
    EXPECT_EQ(isAll, length < 100);
    const double whole = 0.5 * std::sqrt(Dot(normal, normal));
    EXPECT_EQ(isAll, std::abs(area - whole) < 1e-9);
    // By looking around if walking failed: what walking used does not count then.
    constexpr double allowed = 4.0;
    int tries = 0;
    double used = 0.0;
    EXPECT_TRUE(covering.Covers(
      corners, 0, allowed,
      [&]
      {
        ++tries;
        used = 0.0;
      },
      [&](std::uint32_t triangle, const Vector* piece, int count)
      {
        const bool isNear = covering.IsNear(triangle, piece, count, allowed);
        used += isNear ? Covering::AreaOf(piece, count) : 0.0;
        return isNear;
      }));
    EXPECT_EQ(tries, length < 100 ? 1 : 2);
    EXPECT_NEAR(used, whole, 1e-9 * whole);
  }
}
