// SPDX-License-Identifier: BSD-3-Clause
// What is new in a refined mesh, and that looking there only finds what looking everywhere does.
#include "StuffingTestTools.h"

#include "Mesh/IntervalExtraction.h"
#include "Stuffing/NewLeaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace isodiamond;

namespace
{

/** The leaves of a gyroid at a tolerance, of which some more diamonds may be refined. */
struct Leaves
{
  explicit Leaves(const IsodiamondHierarchy& hierarchy, const std::vector<Place>& also = {})
    : SampleGrid(hierarchy.SampleGrid())
  {
    Query query;
    query.Tolerance = 0.5;
    query.Also = also;
    const RefinedSet refined(hierarchy, query, SerialFor);
    const IntervalExtraction extraction(refined, SerialFor);
    this->Points.resize(extraction.PointCount());
    extraction.ForEachPoint([&](const MeshPoint& point) { this->Points[point.Id] = point.Index; });
    this->Mesh = extraction.Leaves(nullptr);
  }

  /** By the corners' positions. */
  static std::set<Point> CornersOf(const CutMesh& mesh, std::size_t leaf)
  {
    std::set<Point> corners;
    for (const std::uint32_t vertex : mesh.Tetrahedra[leaf].Vertices)
    {
      corners.insert(mesh.Vertices[vertex].Position);
    }
    return corners;
  }
  static std::set<std::set<Point>> SetOf(const CutMesh& mesh)
  {
    std::set<std::set<Point>> all;
    for (std::size_t leaf = 0; leaf < mesh.Tetrahedra.size(); ++leaf)
    {
      all.insert(CornersOf(mesh, leaf));
    }
    return all;
  }

  /** The leaves of a part that have to be finer. */
  std::set<std::set<Point>> FarOf(const CutMesh& part, double allowance) const
  {
    const std::vector<Vector> vertices = VerticesInWorld(part, AffineMap());
    const GridGeometry world = AffineMap();
    StuffingInput input{ part, vertices, this->Points, world, this->SampleGrid };
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

  const Grid& SampleGrid;
  std::vector<Vector> Points;
  CutMesh Mesh;
};

/** Some diamonds in which a mesh's leaves lie: one for each step of their numbers. */
std::vector<Place> Some(const Leaves& leaves, std::size_t step)
{
  std::vector<Place> places;
  for (std::size_t leaf = 0; leaf < leaves.Mesh.Tetrahedra.size(); leaf += step)
  {
    if (const auto place = DiamondOf(leaves.Mesh, leaf, leaves.SampleGrid))
    {
      places.push_back(*place);
    }
  }
  return places;
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
  const Leaves leaves(*built.Hierarchy);
  NewLeaves news;
  const CutMesh all = news.Find(leaves.Mesh);
  EXPECT_EQ(Leaves::SetOf(all), Leaves::SetOf(leaves.Mesh));
  EXPECT_TRUE(std::none_of(all.Vertices.begin(), all.Vertices.end(),
    [](const CutMesh::Vertex& vertex) { return vertex.IsFixed; }));
  EXPECT_TRUE(news.Find(leaves.Mesh).Tetrahedra.empty());
}

TEST(NewLeaves, ComeWithThreeRingsOfWhichTheLastIsHeld)
{
  const test::Built built = Gyroid();
  const Leaves before(*built.Hierarchy);
  const Leaves after(*built.Hierarchy, Some(before, before.Mesh.Tetrahedra.size() / 2));
  NewLeaves news;
  news.Find(before.Mesh);
  const CutMesh part = news.Find(after.Mesh);
  const std::set<std::set<Point>> old = Leaves::SetOf(before.Mesh);
  const std::set<std::set<Point>> all = Leaves::SetOf(after.Mesh);
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
  EXPECT_EQ(Leaves::SetOf(part), expected);
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
  const Leaves before(*built.Hierarchy);
  std::size_t found = 0;
  for (const std::size_t step : { 100, 500, 2000 })
  {
    const Leaves after(*built.Hierarchy, Some(before, step));
    for (const double allowance : { 0.02, 0.1 })
    {
      NewLeaves news;
      news.Find(before.Mesh);
      const CutMesh part = news.Find(after.Mesh);
      const std::set<std::set<Point>> far = after.FarOf(part, allowance);
      const std::set<std::set<Point>> ofAll = after.FarOf(after.Mesh, allowance);
      const std::set<std::set<Point>> old = Leaves::SetOf(before.Mesh);
      for (std::size_t leaf = 0; leaf < part.Tetrahedra.size(); ++leaf)
      {
        const std::set<Point> corners = Leaves::CornersOf(part, leaf);
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
