// SPDX-License-Identifier: BSD-3-Clause
// Edge collapses and flips on small meshes made by hand, and undoing them.
#include "Simplification/EdgeCollapses.h"
#include "Tools/RandomTestTools.h"
#include "Tools/SimplificationTestTools.h"
#include "Tools/TopologyTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

using namespace isodiamond;

namespace
{

/** A roof whose ridge leads from point 0 to 2, simplified to two triangles that cut across it. */
MeshPart CutRoof()
{
  AllowedMesh roof;
  roof.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, -0.5 }, { 1, 1, 0 }, { 0, 1, -0.5 } };
  roof.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  roof.Allowances = { 1.0, 1.0 };
  MeshPart part = test::WholePart(roof);
  part.Simple = Connectivity(4, { { 0, 1, 3 }, { 1, 2, 3 } }).Linked();
  part.Samples.push_back({ { 0.2, 0.2, 0 }, 1.0, 0 });
  part.Samples.push_back({ { 0.8, 0.8, 0 }, 1.0, 1 });
  return part;
}

/** The top of a thin wall that leans over, with its edge along x through point 0. */
MeshPart ThinWall()
{
  AllowedMesh wall;
  wall.Mesh.Positions = { { 0, 0, 0 }, { -1, 0, 0 }, { 0, 0.02, -1 }, { 1, 0, 0 },
    { 0, 0.06, -1 } };
  wall.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
  wall.Allowances.assign(4, 3.0);
  MeshPart part = test::WholePart(wall);
  part.Simple = part.Original;
  return part;
}

bool HasRidge(const LinkedTriangles& mesh)
{
  return std::all_of(mesh.Triangles.begin(), mesh.Triangles.end(),
    [](const Triangle& t)
    { return std::count(t.begin(), t.end(), 0U) == 1 && std::count(t.begin(), t.end(), 2U) == 1; });
}

}

TEST(EdgeCollapses, FlipsEdgesThatCutAcrossARidge)
{
  const MeshPart part = CutRoof();
  EdgeCollapses collapses(part, 1.0);
  EXPECT_EQ(collapses.Run(), std::vector<bool>({ true, true }));
  ASSERT_TRUE(HasRidge(collapses.Mesh()));
  test::ExpectLinks(collapses.Mesh());
  // The middle of each original triangle lies over that triangle, which is there again.
  for (std::uint32_t sample = 4; sample < 6; ++sample)
  {
    const Triangle& under = collapses.Mesh().Triangles[collapses.SampleHomes()[sample]];
    const std::uint32_t corner = sample == 4 ? 1 : 3;
    EXPECT_EQ(std::count(under.begin(), under.end(), corner), 1);
  }
  const std::vector<bool> undone = collapses.Undo({ 1 }, {});
  EXPECT_EQ(undone, std::vector<bool>({ true, true }));
  EXPECT_FALSE(HasRidge(collapses.Mesh()));
  test::ExpectLinks(collapses.Mesh());
  EXPECT_EQ(collapses.SampleHomes()[6], 0);
  EXPECT_EQ(collapses.SampleHomes()[7], 1);
}

// There is no direction from which all four triangles are seen: each may only turn a little.
TEST(EdgeCollapses, GoAlongTheEdgeOfAThinWall)
{
  const MeshPart wall = ThinWall();
  EdgeCollapses along(wall, 1.0);
  along.Run();
  ASSERT_EQ(test::TrianglesLeft(along.Mesh()).size(), 2U);
  test::ExpectLinks(along.Mesh());
  // What lay over one side of the wall still does, though the other side is near enough, too.
  for (std::uint32_t i = 0; i < wall.Original.Triangles.size(); ++i)
  {
    const Triangle& under = along.Mesh().Triangles[along.SampleHomes()[wall.Positions.size() + i]];
    EXPECT_GT(
      Dot(Across(wall.Positions, under), Across(wall.Positions, wall.Original.Triangles[i])), 0.0);
  }
  along.Undo({ 0, 1, 2, 3 }, {});
  EXPECT_EQ(test::TrianglesLeft(along.Mesh()).size(), 4U);
  test::ExpectLinks(along.Mesh());
  for (std::uint32_t i = 0; i < wall.Original.Triangles.size(); ++i)
  {
    EXPECT_EQ(along.SampleHomes()[wall.Positions.size() + i], i);
  }

  MeshPart held = wall;
  held.IsFixed[1] = true;
  held.IsFixed[3] = true; // only collapses down a side are left, after which both would face up
  held.Samples.resize(held.Positions.size());
  EdgeCollapses down(held, 1.0);
  EXPECT_EQ(down.Run(), std::vector<bool>(4, false));
}

// A sample put over a triangle may lie beside it: then the triangle's plane tells nothing.
TEST(EdgeCollapses, AskHowFarWhatIsBesideAHoleIs)
{
  AllowedMesh flat;
  flat.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 } };
  flat.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
  flat.Allowances.assign(4, 0.5);
  MeshPart part = test::WholePart(flat);
  part.Simple = part.Original;
  for (const double x : { 0.3, 1.3, 3.0 })
  {
    MeshPart asked = part;
    asked.Samples.push_back({ { x, 0.1, 0.0 }, 0.5, 0 });
    EdgeCollapses collapses(asked, 1.0);
    collapses.Run();
    EXPECT_EQ(test::TrianglesLeft(collapses.Mesh()).size(), x < 2.0 ? 2U : 4U) << x;
  }
}

// Below the roof is a groove from point 1 to 3. The roof has lost that edge to a flip: if it were
// made in the groove, it would be there twice once the flip is undone.
TEST(EdgeCollapses, MakesNoEdgeThatWasFlippedAway)
{
  AllowedMesh mesh;
  mesh.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, -0.5 }, { 1, 1, 0 }, { 0, 1, -0.5 },
    { 0.6, 0.6, -1.0 } };
  mesh.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 0, 3 }, { 1, 3, 4 }, { 2, 1, 4 },
    { 3, 2, 4 } };
  mesh.Allowances.assign(6, 0.3);
  MeshPart part = test::WholePart(mesh);
  const std::vector<Triangle> cut = { { 0, 1, 3 }, { 1, 2, 3 }, { 1, 0, 4 }, { 0, 3, 4 },
    { 2, 1, 4 }, { 3, 2, 4 } };
  part.Simple = Connectivity(5, cut).Linked();
  EdgeCollapses collapses(part, 1.0);
  EXPECT_TRUE(collapses.Run()[0]);
  collapses.Undo({ 0 }, {});
  EXPECT_TRUE(
    test::BorderOf({ mesh.Mesh.Positions, test::TrianglesLeft(collapses.Mesh()) }).empty());
  // Without the roof, that edge is made.
  part.Simple = Connectivity(5, { cut.begin() + 2, cut.end() }).Linked();
  for (SurfaceSample& sample : part.Samples)
  {
    sample.Home = sample.Home == None || sample.Home < 2 ? None : sample.Home - 2;
  }
  EdgeCollapses groove(part, 1.0);
  groove.Run();
  EXPECT_TRUE(groove.Mesh().Triangles[0] == Triangle({ 3, 1, 0 }) ||
    groove.Mesh().Triangles[1] == Triangle({ 3, 1, 0 }));
}

TEST(EdgeCollapses, FlipsNothingThatHasToStay)
{
  MeshPart held = CutRoof();
  held.IsFixed = { true, true, false, true }; // all of the first triangle
  MeshPart joining = CutRoof();
  joining.IsFixed = { true, false, true, false }; // another part may have the ridge
  MeshPart shaped = CutRoof();
  shaped.Positions[2] = { 20, 20, 0 }; // with the ridge, there are slivers
  shaped.LeastSine = 0.3;
  for (const MeshPart& part : { held, joining, shaped })
  {
    EdgeCollapses collapses(part, 1.0);
    EXPECT_EQ(collapses.Run(), std::vector<bool>({ false, false }));
  }
  shaped.LeastSine = 0.0;
  EXPECT_EQ(EdgeCollapses(shaped, 1.0).Run(), std::vector<bool>({ true, true }));
}

// Two sheets meet in the ends of the roof's ridge: one of them has that edge already.
TEST(EdgeCollapses, MakesNoEdgeThatAnotherSheetHas)
{
  MeshPart roof = CutRoof();
  for (SurfaceSample& sample : roof.Samples)
  {
    sample.Home += sample.Home != None ? 1 : 0;
  }
  roof.Positions.push_back({ 0.5, 0.5, -3.0 });
  roof.Simple = Connectivity(5, { { 0, 2, 4 }, { 0, 1, 3 }, { 1, 2, 3 } }).Linked();
  roof.Samples.insert(roof.Samples.begin() + 4, { roof.Positions[4], 1.0, None });
  roof.IsFixed.resize(5);
  roof.IsSettled.resize(5);
  roof.OnWalls.resize(5);
  EXPECT_EQ(EdgeCollapses(roof, 1.0).Run(), std::vector<bool>(3, false));
  roof.Simple.Triangles[0][0] = None; // without that sheet
  EXPECT_EQ(EdgeCollapses(roof, 1.0).Run(), std::vector<bool>({ false, true, true }));
}

// A vertex at the border, between two others on a wall: the edges there have to be on it, too.
TEST(EdgeCollapses, MoveAlongTheBorderOnOneWallOnly)
{
  AllowedMesh border;
  border.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 } };
  border.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  border.Allowances = { 1.0, 1.0 };
  for (const auto& [ofVertex, ofFirst, ofLast, goes] :
    { std::array<int, 4>{ 1, 1, 1, 1 }, { 5, 1, 5, 1 }, { 4, 1, 1, 0 }, { 1, 4, 1, 0 },
      { 1, 1, 4, 0 }, { 5, 1, 4, 0 }, { 0, 1, 1, 0 } })
  {
    border.OnWalls = { static_cast<Walls::Type>(ofVertex), static_cast<Walls::Type>(ofFirst), 0,
      static_cast<Walls::Type>(ofLast) };
    const MeshPart part = test::WholePart(border);
    EXPECT_EQ(EdgeCollapses(part, 1.0).Run(), std::vector<bool>(2, goes == 1))
      << ofVertex << ofFirst << ofLast;
  }
}

// Where a triangle is at fault that is as it was, what is around it has to be undone.
TEST(EdgeCollapses, AreUndoneAroundWhatHasNotChanged)
{
  AllowedMesh flat;
  flat.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 },
    { 1, 1, 0 }, { 2, 1, 0 }, { 2, 2, 0 } };
  flat.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 }, { 1, 5, 2 },
    { 5, 6, 7 } };
  flat.Allowances.assign(6, 0.5);
  const MeshPart part = test::WholePart(flat);
  EdgeCollapses collapses(part, 1.0);
  EXPECT_EQ(collapses.Run(), std::vector<bool>({ true, true, true, true, false, false }));
  EXPECT_EQ(collapses.Undo({ 5 }, {}), std::vector<bool>(6, false)) << "farther away";
  EXPECT_EQ(collapses.Undo({ 4 }, {}), std::vector<bool>({ true, true, true, true, false, false }));
  EXPECT_EQ(test::TrianglesLeft(collapses.Mesh()).size(), 6U);
}

TEST(EdgeCollapses, CanBeUndone)
{
  for (const test::Field& field : test::SurfacesToSimplify())
  {
    SCOPED_TRACE(field.Name);
    const AllowedMesh before = test::MeshOf(field, 0.0, 1.0);
    const MeshPart part = test::WholePart(before);
    const Connectivity links(before.Mesh.Positions.size(), before.Mesh.Triangles);
    test::Random random(7);
    EdgeCollapses collapses(part, 1.0);
    const std::vector<bool> isChanged = collapses.Run();
    ASSERT_TRUE(std::count(isChanged.begin(), isChanged.end(), true) > 0);
    std::size_t last = test::TrianglesLeft(collapses.Mesh()).size();
    // Undo some, and in the end all.
    for (int trial = 0; trial < 30; ++trial)
    {
      std::vector<std::uint32_t> triangles;
      for (int i = 0; i < 5; ++i)
      {
        triangles.push_back(test::Pick(random, static_cast<int>(isChanged.size())));
      }
      collapses.Undo(triangles, {});
      std::vector<std::uint32_t> numbers;
      const TriangleMesh now{ before.Mesh.Positions,
        test::TrianglesLeft(collapses.Mesh(), &numbers) };
      EXPECT_GE(now.Triangles.size(), last);
      last = now.Triangles.size();
      ASSERT_EQ(test::TopologyOf(test::IdsOf(now)), test::TopologyOf(test::IdsOf(before.Mesh)));
      test::ExpectBorder(before, now);
      test::ExpectLinks(collapses.Mesh());
      // Points that were removed lie over a triangle that is there, and points in use over none.
      const std::set<std::uint32_t> left(numbers.begin(), numbers.end());
      const Connectivity nowLinks(now.Positions.size(), now.Triangles);
      for (std::uint32_t i = 0; i < before.Mesh.Positions.size(); ++i)
      {
        const std::uint32_t home = collapses.SampleHomes()[i];
        ASSERT_EQ(home == None, !nowLinks.At(i).empty() || links.At(i).empty());
        ASSERT_TRUE(home == None || left.count(home) == 1);
      }
    }
    std::vector<std::uint32_t> all(before.Mesh.Positions.size());
    std::iota(all.begin(), all.end(), 0U);
    collapses.Undo({}, all);
    // Only flips are left.
    EXPECT_EQ(test::TrianglesLeft(collapses.Mesh()).size(), before.Mesh.Triangles.size());
    all.resize(isChanged.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<bool> isUndone; // a triangle flipped twice loses the last flip first
    do
    {
      isUndone = collapses.Undo(all, {});
    } while (std::find(isUndone.begin(), isUndone.end(), true) != isUndone.end());
    std::vector<Triangle> now = test::TrianglesLeft(collapses.Mesh());
    std::vector<Triangle> then = before.Mesh.Triangles;
    for (std::vector<Triangle>* triangles : { &now, &then })
    {
      for (Triangle& t : *triangles)
      {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      }
      std::sort(triangles->begin(), triangles->end());
    }
    EXPECT_TRUE(now == then);
  }
}
