// SPDX-License-Identifier: BSD-3-Clause
// What is new in a refined mesh, and that looking there only finds what looking everywhere does.
#include "Tools/StuffingTestTools.h"

#include "Stuffing/NewLeaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace isodiamond;

namespace
{

/** A leaf, by its corners' positions. */
std::set<Point> CornersOf(const CutMesh& mesh, std::size_t leaf)
{
  std::set<Point> corners;
  for (const std::uint32_t vertex : mesh.Tetrahedra[leaf].Vertices)
  {
    corners.insert(mesh.Vertices[vertex].Position);
  }
  return corners;
}
std::set<std::set<Point>> SetOf(const CutMesh& mesh)
{
  std::set<std::set<Point>> all;
  for (std::size_t leaf = 0; leaf < mesh.Tetrahedra.size(); ++leaf)
  {
    all.insert(CornersOf(mesh, leaf));
  }
  return all;
}

/** The leaves of a part that have to be finer. @param leaves that it is a part of */
std::set<std::set<Point>> FarOf(const test::Leaves& leaves, const CutMesh& part, double allowance)
{
  const std::vector<Vector> vertices = VerticesInWorld(part, AffineMap());
  const GridGeometry world = AffineMap();
  StuffingInput input{ part, vertices, leaves.Points, world, leaves.SampleGrid };
  input.Allowances.assign(part.Tetrahedra.size(), allowance);
  input.CanBeFiner.assign(part.Tetrahedra.size(), true);
  std::set<std::set<Point>> far;
  for (const std::uint32_t leaf : FarLeaves(input, SerialFor))
  {
    far.insert(CornersOf(part, leaf));
    for (const std::uint32_t vertex : part.Tetrahedra[leaf].Vertices)
    {
      EXPECT_FALSE(part.Vertices[vertex].IsFixed);
    }
  }
  return far;
}

test::Built Gyroid()
{
  return test::BuildVolume(test::GyroidField(49, 2.0), { 0.1, HUGE_VAL });
}

bool HaveCommon(const std::set<Point>& a, const std::set<Point>& b)
{
  return std::any_of(a.begin(), a.end(), [&](const Point& point) { return b.count(point) > 0; });
}

}

TEST(NewLeaves, AreAllOfTheFirstMeshAndNoneOfTheSameAgain)
{
  const test::Built built = Gyroid();
  const test::Leaves leaves(*built.Hierarchy, 0.5);
  NewLeaves news;
  const CutMesh all = news.Find(leaves.Mesh);
  EXPECT_EQ(SetOf(all), SetOf(leaves.Mesh));
  EXPECT_TRUE(std::none_of(all.Vertices.begin(), all.Vertices.end(),
    [](const CutMesh::Vertex& vertex) { return vertex.IsFixed; }));
  EXPECT_TRUE(news.Find(leaves.Mesh).Tetrahedra.empty());
}

TEST(NewLeaves, ComeWithThreeRingsOfWhichTheLastIsHeld)
{
  const test::Built built = Gyroid();
  const test::Leaves before(*built.Hierarchy, 0.5);
  const test::Leaves after(
    *built.Hierarchy, 0.5, before.Diamonds(before.Mesh.Tetrahedra.size() / 2));
  NewLeaves news;
  news.Find(before.Mesh);
  const CutMesh part = news.Find(after.Mesh);
  const std::set<std::set<Point>> old = SetOf(before.Mesh);
  const std::set<std::set<Point>> all = SetOf(after.Mesh);
  std::set<std::set<Point>> expected;
  std::set_difference(
    all.begin(), all.end(), old.begin(), old.end(), std::inserter(expected, expected.end()));
  ASSERT_FALSE(expected.empty());
  for (int ring = 0; ring < 3; ++ring)
  {
    std::set<Point> corners;
    for (const std::set<Point>& leaf : expected)
    {
      corners.insert(leaf.begin(), leaf.end());
    }
    std::copy_if(all.begin(), all.end(), std::inserter(expected, expected.end()),
      [&](const std::set<Point>& leaf) { return HaveCommon(leaf, corners); });
  }
  ASSERT_LT(expected.size(), all.size() / 2);
  EXPECT_EQ(SetOf(part), expected);
  std::set<Point> outside;
  for (const std::set<Point>& leaf : all)
  {
    if (expected.count(leaf) == 0)
    {
      outside.insert(leaf.begin(), leaf.end());
    }
  }
  for (const CutMesh::Vertex& vertex : part.Vertices)
  {
    EXPECT_EQ(vertex.IsFixed, outside.count(vertex.Position) > 0);
  }
}

// Leaves that are far among the new ones and beside them are those that are far in the whole mesh.
TEST(NewLeaves, AreFarWhereTheyAreInTheWholeMesh)
{
  const test::Built built = Gyroid();
  const test::Leaves before(*built.Hierarchy, 0.5);
  std::size_t found = 0;
  for (const std::size_t step : { 100, 500, 2000 })
  {
    const test::Leaves after(*built.Hierarchy, 0.5, before.Diamonds(step));
    for (const double allowance : { 0.02, 0.1 })
    {
      NewLeaves news;
      news.Find(before.Mesh);
      const CutMesh part = news.Find(after.Mesh);
      const std::set<std::set<Point>> far = FarOf(after, part, allowance);
      const std::set<std::set<Point>> ofAll = FarOf(after, after.Mesh, allowance);
      const std::set<std::set<Point>> old = SetOf(before.Mesh);
      for (std::size_t leaf = 0; leaf < part.Tetrahedra.size(); ++leaf)
      {
        const std::set<Point> corners = CornersOf(part, leaf);
        if (old.count(corners) == 0)
        {
          EXPECT_EQ(far.count(corners), ofAll.count(corners));
          found += far.count(corners);
        }
      }
    }
  }
  EXPECT_GT(found, 100U);
}
