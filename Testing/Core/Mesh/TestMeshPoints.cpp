// SPDX-License-Identifier: BSD-3-Clause
// The points of meshes, and those that a hierarchy stores, in groups.
#include "Mesh/IntervalExtraction.h"
#include "Tools/CoreTestTools.h"
#include "Tools/IntervalTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace isodiamond;

namespace
{

void ExpectSame(const MeshPoint& a, const MeshPoint& b)
{
  EXPECT_EQ(a.Id, b.Id);
  EXPECT_TRUE(a.Index == b.Index);
  EXPECT_EQ(a.Surface, b.Surface);
  EXPECT_EQ(a.Stored, b.Stored);
}

/** The points of groups by id, each once; some groups are as large as they can be. */
template <typename ForEachGroup>
std::vector<MeshPoint> ByGroups(std::int64_t count, const ForEachGroup& forEachGroup)
{
  std::vector<MeshPoint> points(count);
  std::vector<int> seen(count);
  std::size_t largest = 0;
  forEachGroup(
    [&](const PointGroup& group)
    {
      EXPECT_FALSE(group.empty());
      largest = std::max(largest, group.size());
      for (const MeshPoint& point : group)
      {
        points.at(point.Id) = point;
        ++seen[point.Id];
      }
    });
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
  EXPECT_EQ(largest, MostInGroup);
  return points;
}

}

// An interval volume in noise: dense, with both surfaces and points inside.
TEST(MeshPoints, InGroupsAreThoseOneByOne)
{
  const test::Field field = test::NoiseField({ 21, 14, 17 }, 5);
  const reference::Isorange range = test::RangesOf(field).front();
  const test::Built built(
    BuildIsodiamonds(Model::Relevant, field.View(), test::RegionOf(range), SerialFor), SerialFor);
  const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
  const std::vector<MeshPoint> stored = ByGroups(StoredPointCount(hierarchy),
    [&](const auto& body) { ForEachStoredPointGroup(hierarchy, SerialFor, body); });
  for (const double tolerance : { 0.0, 0.4 })
  {
    const RefinedSet refined(hierarchy, { tolerance }, SerialFor);
    const IntervalExtraction extraction(refined, SerialFor);
    std::vector<MeshPoint> points(extraction.PointCount());
    extraction.ForEachPoint([&](const MeshPoint& point) { points[point.Id] = point; });
    const std::vector<MeshPoint> grouped = ByGroups(
      extraction.PointCount(), [&](const auto& body) { extraction.ForEachPointGroup(body); });
    for (std::size_t id = 0; id < points.size(); ++id)
    {
      ExpectSame(grouped[id], points[id]);
      const MeshPoint& same = stored[StoredNumber(hierarchy, points[id])];
      EXPECT_TRUE(same.Index == points[id].Index);
      EXPECT_EQ(same.Surface, points[id].Surface);
    }
  }
}
