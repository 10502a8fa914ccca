// SPDX-License-Identifier: BSD-3-Clause
// A vertex that takes another point's place, in fans made by hand.
#include "Simplification/EdgeCollapses.h"
#include "Simplification/Fan.h"
#include "Tools/SimplificationTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace isodiamond;

namespace
{

constexpr int Corners = 6;

/** A hexagonal pyramid, whose peak is not above its middle. */
struct Pyramid
{
  Vector Peak{ 0.3, 0.2, 0.5 };
  Fan::ByTriangle<Vector> Base{};

  Pyramid()
  {
    for (int i = 0; i < Corners; ++i)
    {
      this->Base[i] = { std::cos(M_PI / 3 * i), std::sin(M_PI / 3 * i), 0.0 };
    }
  }

  /** On a side, somewhere between its corners. */
  Vector On(int side, double toPeak, double toNext) const
  {
    const Vector& a = this->Base[side];
    const Vector& b = this->Base[(side + 1) % Corners];
    return a + toNext * (b - a) + toPeak * (this->Peak - (a + toNext * (b - a)));
  }
};

/** The pyramid, drawn around another point: samples of its sides, the last of which is the peak.
 *  @param vertex the other point @param allowance of what is over it */
Fan FanOf(const Pyramid& pyramid, const Vector& vertex, double allowance)
{
  const std::vector<Vector> positions = [&]
  {
    std::vector<Vector> all(pyramid.Base.begin(), pyramid.Base.begin() + Corners);
    all.push_back(vertex);
    return all;
  }();
  Hole hole;
  hole.Count = Corners;
  Fan::ByTriangle<Vector> ring{};
  Fan::ByTriangle<Vector> normals{};
  std::vector<Vector> normalsOfAll;
  for (std::uint32_t i = 0; i < Corners; ++i)
  {
    hole.Points[i] = i;
    hole.Triangles[i] = i;
    ring[i] = positions[i] - vertex;
    normals[i] = Unit(Across(positions, { Corners, i, (i + 1) % Corners }));
    normalsOfAll.push_back(normals[i]);
  }
  EXPECT_TRUE(hole.SeeFromAbove(positions, normalsOfAll, Corners));
  Fan fan;
  fan.Begin(hole, ring, normals);
  fan.Add({ {}, allowance, Corners, 0, false });
  std::uint32_t number = Corners;
  const auto add = [&](const Vector& position)
  {
    const Vector from = position - vertex;
    fan.Add({ from, allowance, ++number, hole.TriangleAt(hole.See(from)), true });
  };
  for (int side = 0; side < Corners; ++side)
  {
    for (const double toPeak : { 0.25, 0.5, 0.75 })
    {
      for (const double toNext : { 0.25, 0.5, 0.75 })
      {
        add(pyramid.On(side, toPeak, toNext));
      }
    }
  }
  add(pyramid.Peak);
  return fan;
}

constexpr std::uint32_t PeakNumber = Corners + 9 * Corners + 1;

}

TEST(VertexMoves, AFanIsBestAroundThePeak)
{
  const Pyramid pyramid;
  Fan fan = FanOf(pyramid, pyramid.On(3, 0.8, 0.5), 0.5);
  ASSERT_TRUE(fan.FindBetter(0.0));
  EXPECT_EQ(fan.Point(), PeakNumber);
  std::vector<int> over(PeakNumber + 1, -1);
  fan.ForEachSample([&](std::uint32_t number, int triangle) { over[number] = triangle; });
  EXPECT_EQ(over[PeakNumber], -1);
  EXPECT_EQ(over[Corners], 3); // the vertex
  for (int i = 0; i < 9 * Corners; ++i)
  {
    EXPECT_EQ(over[Corners + 1 + i], i / 9) << i;
  }
  for (int i = 0; i < Corners; ++i)
  {
    const Vector& a = pyramid.Base[i];
    const Vector& b = pyramid.Base[(i + 1) % Corners];
    EXPECT_NEAR(Dot(fan.NewNormal(i), Unit(Cross(a - pyramid.Peak, b - pyramid.Peak))), 1.0, 1e-12);
  }
}

TEST(VertexMoves, AFanStaysWhereItFits)
{
  const Pyramid pyramid;
  EXPECT_FALSE(FanOf(pyramid, pyramid.Peak, 0.5).FindBetter(0.0));
  // Whatever would be nearer overall, each sample has its allowance: all but the peak lie beside
  // the planes of any other fan.
  const Vector vertex = pyramid.On(3, 0.8, 0.5);
  EXPECT_TRUE(FanOf(pyramid, vertex, 1e-6).FindBetter(0.0));
  Fan strict = FanOf(pyramid, vertex, 0.5);
  strict.Add({ { 0.0, 0.0, 0.3 }, 0.3, 99, 0, false });
  strict.Add({ pyramid.Peak - vertex + Vector{ 0, 0, 0.3 }, 0.2, 100, 0, false });
  ASSERT_TRUE(!strict.FindBetter(0.0) || strict.Point() != PeakNumber);
}

// Without a limit the peak's fan is best, though its smallest angle is less than before.
TEST(VertexMoves, AFanKeepsAnglesIfItShall)
{
  Pyramid pyramid;
  pyramid.Peak = { 0.7, 0.1, 0.5 };
  const Vector vertex = pyramid.On(3, 0.7, 0.5);
  double before = 1.0;
  double after = 1.0;
  for (int i = 0; i < Corners; ++i)
  {
    const Vector& a = pyramid.Base[i];
    const Vector& b = pyramid.Base[(i + 1) % Corners];
    before = std::min(before, SmallestSine(vertex, a, b));
    after = std::min(after, SmallestSine(pyramid.Peak, a, b));
  }
  ASSERT_LT(after, 0.9 * before);
  Fan any = FanOf(pyramid, vertex, 1.0);
  ASSERT_TRUE(any.FindBetter(0.0));
  EXPECT_EQ(any.Point(), PeakNumber);
  Fan shaped = FanOf(pyramid, vertex, 1.0);
  EXPECT_TRUE(!shaped.FindBetter(0.95 * before) || shaped.Point() != PeakNumber);
}

// The peak has been removed, and the vertex that is left beside it takes its place.
TEST(VertexMoves, APointComesBack)
{
  const Pyramid pyramid;
  constexpr std::uint32_t peak = Corners;
  constexpr std::uint32_t other = Corners + 1;
  AllowedMesh mesh;
  mesh.Mesh.Positions.assign(pyramid.Base.begin(), pyramid.Base.begin() + Corners);
  mesh.Mesh.Positions.push_back(pyramid.Peak);
  mesh.Mesh.Positions.push_back(pyramid.On(3, 0.8, 0.5));
  std::vector<Triangle> around; // the other one
  for (std::uint32_t i = 0; i < Corners; ++i)
  {
    if (i != 3)
    {
      mesh.Mesh.Triangles.push_back({ peak, i, (i + 1) % Corners });
    }
    around.push_back({ other, i, (i + 1) % Corners });
  }
  mesh.Mesh.Triangles.insert(
    mesh.Mesh.Triangles.end(), { { other, 3, 4 }, { other, 4, peak }, { other, peak, 3 } });
  mesh.Allowances.assign(mesh.Mesh.Triangles.size(), 0.2); // all flat is 0.5 off
  MeshPart part = test::WholePart(mesh);
  part.Simple = Connectivity(Corners + 2, around).Linked();
  for (std::uint32_t i = 0; i < Corners; ++i)
  {
    part.IsFixed[i] = true;
  }
  for (std::size_t i = peak; i < part.Samples.size(); ++i)
  {
    part.Samples[i].Home = i == other ? None : 0;
  }
  EdgeCollapses collapses(part, 1.0);
  EXPECT_EQ(collapses.Run(), std::vector<bool>(Corners, true));
  const auto expectAround = [&](std::uint32_t centre)
  {
    for (std::uint32_t i = 0; i < Corners; ++i)
    {
      EXPECT_TRUE(AreSame(collapses.Mesh().Triangles[i], { centre, i, (i + 1) % Corners }));
    }
    test::ExpectLinks(collapses.Mesh());
    EXPECT_EQ(collapses.SampleHomes()[centre], None);
    EXPECT_LT(collapses.SampleHomes()[peak + other - centre], Corners);
  };
  expectAround(peak);
  EXPECT_EQ(collapses.SampleHomes()[other], 3);
  EXPECT_EQ(collapses.Undo({ 2 }, {}), std::vector<bool>(Corners, true));
  expectAround(other);

  // What is settled stays.
  part.IsSettled.assign(part.IsSettled.size(), true);
  EdgeCollapses none(part, 1.0);
  EXPECT_EQ(none.Run(), std::vector<bool>(Corners, false));
}

// The peak of a roof whose sides would be steeper than anything that was there.
TEST(VertexMoves, MakeNoSharpCreases)
{
  for (const double height : { 0.2, 0.4 })
  {
    AllowedMesh roof;
    roof.Mesh.Positions = { { 1, 0, 0 }, { 0, 0.1, 0 }, { -1, 0, 0 }, { 0, -0.1, 0 },
      { 0, 0, height }, { 0, 0, 0.1 } };
    roof.Mesh.Triangles = { { 4, 0, 1 }, { 4, 1, 2 }, { 4, 2, 3 }, { 4, 3, 0 } };
    roof.Allowances.assign(4, 0.9 * height); // all flat is farther off
    MeshPart part = test::WholePart(roof);
    part.Simple = Connectivity(6, { { 5, 0, 1 }, { 5, 1, 2 }, { 5, 2, 3 }, { 5, 3, 0 } }).Linked();
    for (std::size_t i = 0; i < part.Samples.size(); ++i)
    {
      part.IsFixed[std::min<std::size_t>(i, 3)] = true;
      part.Samples[i].Home = i < 4 || i == 5 ? None : 0;
    }
    EdgeCollapses collapses(part, 1.0);
    EXPECT_EQ(collapses.Run(), std::vector<bool>(4, height < 0.3)) << height;
  }
}
