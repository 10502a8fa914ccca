// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/SimplificationTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace isodiamond;

namespace test
{

std::vector<Field> SurfacesToSimplify()
{
  std::vector<Field> fields = { WaveField({ 21, 18, 13 }), SphereField({ 17, 17, 17 }),
    NoiseField({ 9, 8, 9 }, 3) };
  return fields;
}

AllowedMesh MeshOf(const Field& field, double tolerance, double allowed)
{
  BuildOptions options = Distance();
  options.PreserveTopology = true;
  const Built built = Build(Model::Minimal, field, options);
  const Mesh mesh = Extract(*built.Hierarchy, tolerance);
  AllowedMesh result;
  for (const std::array<float, 3>& point : mesh.Points)
  {
    result.Mesh.Positions.push_back({ point[0], point[1], point[2] });
    result.OnWalls.push_back(Walls::At(result.Mesh.Positions.back(), Grid(field.Dims)));
  }
  for (const std::array<std::int32_t, 3>& t : mesh.Triangles)
  {
    result.Mesh.Triangles.push_back({ static_cast<std::uint32_t>(t[0]),
      static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2]) });
    result.Allowances.push_back(allowed);
  }
  return result;
}

namespace
{

WholePoint CrossOf(const WholePoint& a, const WholePoint& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

std::vector<WholePoint> SidesOf(const std::vector<WholePoint>& polygon)
{
  std::vector<WholePoint> sides;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const WholePoint& from = polygon[i];
    const WholePoint& to = polygon[(i + 1) % polygon.size()];
    sides.push_back({ to[0] - from[0], to[1] - from[1], to[2] - from[2] });
  }
  return sides;
}

std::pair<std::int64_t, std::int64_t> ShadowOf(
  const std::vector<WholePoint>& polygon, const WholePoint& axis)
{
  std::vector<std::int64_t> shadow;
  for (const WholePoint& point : polygon)
  {
    shadow.push_back(axis[0] * point[0] + axis[1] * point[1] + axis[2] * point[2]);
  }
  const auto [low, high] = std::minmax_element(shadow.begin(), shadow.end());
  return { *low, *high };
}

bool HasFoldAt(const std::vector<WholePoint>& points, const std::vector<std::uint32_t>& edge,
  std::uint32_t a, std::uint32_t b)
{
  const WholePoint& from = points[edge[0]];
  const auto at = [&](std::uint32_t point) -> WholePoint
  {
    const WholePoint& to = points[point];
    return { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
  };
  const WholePoint first = CrossOf(at(edge[1]), at(a));
  const WholePoint second = CrossOf(at(edge[1]), at(b));
  const std::int64_t along = first[0] * second[0] + first[1] * second[1] + first[2] * second[2];
  return CrossOf(first, second) == WholePoint{} && along >= 0;
}

}

bool AreApart(const std::vector<WholePoint>& a, const std::vector<WholePoint>& b)
{
  const std::vector<WholePoint> sidesOfA = SidesOf(a);
  const std::vector<WholePoint> sidesOfB = SidesOf(b);
  std::vector<WholePoint> axes;
  for (const WholePoint& side : sidesOfA)
  {
    for (const WholePoint& other : sidesOfB)
    {
      axes.push_back(CrossOf(side, other));
    }
  }
  for (const std::vector<WholePoint>& sides : { sidesOfA, sidesOfB })
  {
    const WholePoint normal = CrossOf(sides[0], sides[1]);
    axes.push_back(normal);
    for (const std::vector<WholePoint>& all : { sidesOfA, sidesOfB })
    {
      std::transform(all.begin(), all.end(), std::back_inserter(axes),
        [&](const WholePoint& side) { return CrossOf(normal, side); });
    }
  }
  return std::any_of(axes.begin(), axes.end(),
    [&](const WholePoint& axis)
    {
      const auto [lowA, highA] = ShadowOf(a, axis);
      const auto [lowB, highB] = ShadowOf(b, axis);
      return highA < lowB || highB < lowA;
    });
}

int CountIntersections(const TriangleMesh& mesh)
{
  std::vector<WholePoint> points;
  for (const Vector& position : mesh.Positions)
  {
    const Vector fine = 256.0 * position;
    points.push_back({ std::llround(fine[0]), std::llround(fine[1]), std::llround(fine[2]) });
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ(fine[axis], static_cast<double>(points.back()[axis]));
    }
  }
  const auto placesOf = [&](const std::vector<std::uint32_t>& ids)
  {
    std::vector<WholePoint> places;
    std::transform(ids.begin(), ids.end(), std::back_inserter(places),
      [&](std::uint32_t id) { return points[id]; });
    return places;
  };
  // Those that share a corner have more in common if the side opposite to it meets the other one.
  const auto doIntersect = [&](const Triangle& a, const Triangle& b)
  {
    const std::vector<std::uint32_t> allOfA(a.begin(), a.end());
    const std::vector<std::uint32_t> allOfB(b.begin(), b.end());
    std::vector<std::uint32_t> common;
    std::vector<std::uint32_t> onlyA;
    std::vector<std::uint32_t> onlyB;
    for (const std::uint32_t id : a)
    {
      (std::find(b.begin(), b.end(), id) == b.end() ? onlyA : common).push_back(id);
    }
    std::copy_if(b.begin(), b.end(), std::back_inserter(onlyB),
      [&](std::uint32_t id) { return std::find(a.begin(), a.end(), id) == a.end(); });
    if (common.size() > 1)
    {
      return common.size() == 3 || HasFoldAt(points, common, onlyA[0], onlyB[0]);
    }
    return !AreApart(placesOf(onlyA), placesOf(allOfB)) ||
      !AreApart(placesOf(onlyB), placesOf(allOfA));
  };
  int count = 0;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      bool areNear = true;
      for (int axis = 0; axis < 3 && areNear; ++axis)
      {
        const auto rangeOf = [&](const Triangle& t) {
          return std::minmax({ points[t[0]][axis], points[t[1]][axis], points[t[2]][axis] });
        };
        const auto [low, high] = rangeOf(mesh.Triangles[i]);
        const auto [otherLow, otherHigh] = rangeOf(mesh.Triangles[k]);
        areNear = low <= otherHigh && otherLow <= high;
      }
      count += areNear && doIntersect(mesh.Triangles[i], mesh.Triangles[k]) ? 1 : 0;
    }
  }
  return count;
}

SurfaceTriangles TrianglesOf(const TriangleMesh& mesh)
{
  SurfaceTriangles triangles;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    triangles.push_back({ { mesh.Corner(i, 0), mesh.Corner(i, 1), mesh.Corner(i, 2) } });
  }
  return triangles;
}

std::vector<std::array<std::int32_t, 3>> IdsOf(const TriangleMesh& mesh)
{
  std::vector<std::array<std::int32_t, 3>> ids;
  for (const Triangle& t : mesh.Triangles)
  {
    ids.push_back({ static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
      static_cast<std::int32_t>(t[2]) });
  }
  return ids;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> BorderOf(const TriangleMesh& mesh)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++edges[{ t[k], t[(k + 1) % 3] }];
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> border;
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1) << "two triangles on one side of an edge";
    if (edges.count({ edge.second, edge.first }) == 0)
    {
      border.push_back(edge);
    }
  }
  return border;
}

bool HasTwins(const TriangleMesh& mesh)
{
  std::set<Triangle> all;
  return !std::all_of(mesh.Triangles.begin(), mesh.Triangles.end(),
    [&](Triangle triangle)
    {
      std::sort(triangle.begin(), triangle.end());
      return all.insert(triangle).second;
    });
}

void ExpectBorder(const AllowedMesh& before, const TriangleMesh& after)
{
  const auto was = BorderOf(before.Mesh);
  for (const auto& edge : BorderOf(after))
  {
    const bool isOnWall =
      !before.OnWalls.empty() && (before.OnWalls[edge.first] & before.OnWalls[edge.second]) != 0;
    EXPECT_TRUE(isOnWall || std::binary_search(was.begin(), was.end(), edge))
      << edge.first << " - " << edge.second;
  }
}

MeshPart WholePart(const AllowedMesh& mesh)
{
  MeshPart part;
  part.Positions = mesh.Mesh.Positions;
  part.Original = Connectivity(part.Positions.size(), mesh.Mesh.Triangles).Linked();
  part.Allowances = mesh.Allowances;
  part.Simple = part.Original;
  part.IsFixed.resize(part.Positions.size());
  part.IsSettled.resize(part.Positions.size());
  part.OnWalls = mesh.OnWalls;
  part.OnWalls.resize(part.Positions.size());
  for (const Vector& position : part.Positions)
  {
    part.Samples.push_back({ position, mesh.Allowances.front() });
  }
  for (std::uint32_t i = 0; i < mesh.Mesh.Triangles.size(); ++i)
  {
    part.Samples.push_back({ mesh.Mesh.Middle(i), mesh.Allowances[i], i });
  }
  part.Near = NearLists(mesh.Mesh.Triangles.size());
  return part;
}

std::vector<Triangle> TrianglesLeft(
  const LinkedTriangles& mesh, std::vector<std::uint32_t>* numbers)
{
  std::vector<Triangle> left;
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    if (mesh.IsThere(i))
    {
      left.push_back(mesh.Triangles[i]);
      if (numbers != nullptr)
      {
        numbers->push_back(i);
      }
    }
  }
  return left;
}

void ExpectLinks(const LinkedTriangles& mesh)
{
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (int k = 0; k < 3 && mesh.IsThere(i); ++k)
    {
      const std::uint32_t beyond = mesh.Neighbours[i][k];
      if (beyond != None)
      {
        const int place =
          isodiamond::PlaceOf(mesh.Triangles[beyond], mesh.Triangles[i][(k + 1) % 3]);
        ASSERT_EQ(mesh.Triangles[beyond][place], mesh.Triangles[i][(k + 1) % 3]);
        ASSERT_EQ(mesh.Triangles[beyond][(place + 1) % 3], mesh.Triangles[i][k]);
        ASSERT_EQ(mesh.Neighbours[beyond][place], i);
      }
    }
  }
}

}
