// SPDX-License-Identifier: BSD-3-Clause
// Simplification against brute force; what it would have to find, done by hand; and undone.
#include "DistanceTestTools.h"
#include "RandomTestTools.h"
#include "Simplification/Covering.h"
#include "Simplification/EdgeCollapses.h"
#include "Simplification/PartDistance.h"
#include "Simplification/ShadowTest.h"
#include "Simplification/Simplification.h"
#include "Simplification/SimplifiedMesh.h"
#include "TopologyTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

using namespace isodiamond;

namespace
{

/** Surfaces with thin walls, holes and specks, and a border. */
std::vector<test::Field> Fields()
{
  std::vector<test::Field> fields = { test::WaveField({ 21, 18, 13 }),
    test::SphereField({ 17, 17, 17 }), test::NoiseField({ 9, 8, 9 }, 3) };
  return fields;
}

AllowedMesh MeshOf(const test::Field& field, double tolerance, double allowed)
{
  BuildOptions options = test::Distance();
  options.PreserveTopology = true;
  const test::Built built = test::Build(Model::Minimal, field, options);
  const test::Mesh mesh = test::Extract(*built.Hierarchy, tolerance);
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

test::SurfaceTriangles TrianglesOf(const TriangleMesh& mesh)
{
  test::SurfaceTriangles triangles;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    triangles.push_back({ { mesh.Corner(i, 0), mesh.Corner(i, 1), mesh.Corner(i, 2) } });
  }
  return triangles;
}

/** Of some triangles, in degrees, by cosines. */
double SmallestAngle(const TriangleMesh& mesh, std::size_t first, std::size_t last = SIZE_MAX)
{
  double smallest = 180.0;
  for (std::size_t i = first; i < std::min(last, mesh.Triangles.size()); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vector a = mesh.Corner(i, (k + 1) % 3) - mesh.Corner(i, k);
      const Vector b = mesh.Corner(i, (k + 2) % 3) - mesh.Corner(i, k);
      const double cosine = Dot(a, b) / std::sqrt(Dot(a, a) * Dot(b, b));
      smallest = std::min(smallest, DegreesOfRadian * std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
  }
  return smallest;
}

/** Every sample of each mesh near to the other. */
std::string FaultBetween(const TriangleMesh& a, const TriangleMesh& b, double allowed)
{
  test::Promise promise;
  promise.Tolerance = allowed;
  promise.Forth = false;
  const std::string back = test::FaultOf(promise, TrianglesOf(a), TrianglesOf(b));
  return back.empty() ? test::FaultOf(promise, TrianglesOf(b), TrianglesOf(a)) : back;
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

/** Border edges are on walls, as they were, or the same. */
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

/** What holds of every result. */
void ExpectPromise(const AllowedMesh& before, const TriangleMesh& after, double allowed)
{
  EXPECT_EQ(FaultBetween(before.Mesh, after, allowed), "");
  EXPECT_EQ(test::TopologyOf(IdsOf(after)), test::TopologyOf(IdsOf(before.Mesh)));
  ExpectBorder(before, after);
  EXPECT_TRUE(after.Positions == before.Mesh.Positions);
}

/** A mesh as a part of itself of which nothing is known yet. */
MeshPart Whole(const AllowedMesh& mesh)
{
  MeshPart part;
  part.Positions = mesh.Mesh.Positions;
  part.Original = Connectivity(part.Positions.size(), mesh.Mesh.Triangles).Linked();
  part.Allowances = mesh.Allowances;
  part.Simple = part.Original;
  part.IsFixed.resize(part.Positions.size());
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

/** What is wrong with triangles in place of a mesh's, all of which are said to be touched. */
PartDistance::Faults FaultsOf(const AllowedMesh& before, const std::vector<Triangle>& triangles)
{
  MeshPart part = Whole(before);
  PartDistance distance(part);
  return distance.Find(Connectivity(part.Positions.size(), triangles).Linked(),
    std::vector<std::uint32_t>(part.Samples.size(), None),
    std::vector<bool>(triangles.size(), true));
}

/** The triangles that are left of some. @param numbers are given theirs */
std::vector<Triangle> Left(
  const LinkedTriangles& mesh, std::vector<std::uint32_t>* numbers = nullptr)
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

/** Across each edge is what goes along it the other way, and knows of it. */
void ExpectLinks(const LinkedTriangles& mesh)
{
  for (std::uint32_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    for (int k = 0; k < 3 && mesh.IsThere(i); ++k)
    {
      const std::uint32_t beyond = mesh.Neighbours[i][k];
      if (beyond != None)
      {
        const int place = PlaceOf(mesh.Triangles[beyond], mesh.Triangles[i][(k + 1) % 3]);
        ASSERT_EQ(mesh.Triangles[beyond][place], mesh.Triangles[i][(k + 1) % 3]);
        ASSERT_EQ(mesh.Triangles[beyond][(place + 1) % 3], mesh.Triangles[i][k]);
        ASSERT_EQ(mesh.Neighbours[beyond][place], i);
      }
    }
  }
}

std::uint32_t FarthestFrom(const TriangleMesh& mesh, std::uint32_t point)
{
  const auto squared = [&](const Vector& place)
  {
    const Vector between = place - mesh.Positions[point];
    return Dot(between, between);
  };
  const auto farthest = std::max_element(mesh.Positions.begin(), mesh.Positions.end(),
    [&](const Vector& a, const Vector& b) { return squared(a) < squared(b); });
  return static_cast<std::uint32_t>(farthest - mesh.Positions.begin());
}

/** All triangles that hang together with one by points, and others. */
std::vector<Triangle> WithoutPieceOf(std::vector<Triangle> triangles, const Triangle& one)
{
  std::set<std::uint32_t> points(one.begin(), one.end());
  for (bool grows = true; grows;)
  {
    grows = false;
    for (const Triangle& t : triangles)
    {
      const auto touched = std::count_if(
        t.begin(), t.end(), [&](std::uint32_t point) { return points.count(point) != 0; });
      grows = grows || touched == 1 || touched == 2;
      if (touched > 0)
      {
        points.insert(t.begin(), t.end());
      }
    }
  }
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                    [&](const Triangle& t) { return points.count(t[0]) != 0; }),
    triangles.end());
  return triangles;
}

}

TEST(Simplification, KeepsThePromise)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    for (const double allowed : { 0.1, 0.4, 2.0 })
    {
      SCOPED_TRACE(allowed);
      const AllowedMesh before = MeshOf(field, 0.1, allowed);
      for (const std::size_t most : { std::size_t{ 300 }, MostOfPart })
      {
        const TriangleMesh after = Simplify(before, SerialFor, most);
        ExpectPromise(before, after, allowed);
        EXPECT_LT(after.Triangles.size(), before.Mesh.Triangles.size());
      }
    }
  }
}

TEST(Simplification, KeepsThePromiseInNoise)
{
  const int cases = test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      const int size = 3 + test::Pick(random, 5);
      const double allowed = 0.1 * (1 + test::Pick(random, 20));
      const AllowedMesh before =
        MeshOf(test::NoiseField({ size, size + 1, size }, seed), 0.0, allowed);
      if (!before.Mesh.Triangles.empty())
      {
        ExpectPromise(before, Simplify(before, SerialFor, 50 + test::Pick(random, 1000)), allowed);
      }
    });
  EXPECT_GT(cases, 0);
}

// Where samples allow much too much, everything depends on measuring and undoing.
TEST(Simplification, KeepsThePromiseWhateverSamplesAllow)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const AllowedMesh before = MeshOf(field, 0.0, 0.2);
    SimplifiedMesh simplified(before);
    for (const double cut : { 0.5, 0.35, 0.6, 0.4 })
    {
      const std::size_t last = simplified.Triangles().size();
      simplified.Simplify(150, cut, 4.0, SerialFor);
      EXPECT_LE(simplified.Triangles().size(), last);
      ExpectPromise(before, { before.Mesh.Positions, simplified.Triangles() }, 0.2);
    }
    EXPECT_LT(simplified.Triangles().size(), before.Mesh.Triangles.size());
  }
}

TEST(Simplification, SavesMostTriangles)
{
  const AllowedMesh before = MeshOf(test::SphereField({ 33, 33, 33 }), 0.1, 0.4);
  const TriangleMesh whole = Simplify(before, SerialFor);
  EXPECT_LT(10 * whole.Triangles.size(), before.Mesh.Triangles.size());
  // Hardly more where the borders of parts were, as the second pass cuts elsewhere.
  const TriangleMesh inParts = Simplify(before, SerialFor, 2000);
  EXPECT_LT(8 * inParts.Triangles.size(), before.Mesh.Triangles.size());
}

TEST(Simplification, MakesNoSmallAnglesIfItShallNot)
{
  // A bumpy sheet of triangles of 45 degrees.
  AllowedMesh sheet;
  constexpr std::uint32_t n = 40;
  for (std::uint32_t i = 0; i < n * n; ++i)
  {
    const double x = i % n;
    const double y = i / n;
    sheet.Mesh.Positions.push_back({ x, y, std::sin(0.3 * x) * std::cos(0.2 * y) });
  }
  for (std::uint32_t i = 0; i < n * (n - 1); ++i)
  {
    if (i % n + 1 < n)
    {
      sheet.Mesh.Triangles.push_back({ i, i + 1, i + n });
      sheet.Mesh.Triangles.push_back({ i + 1, i + n + 1, i + n });
    }
  }
  sheet.Allowances.assign(sheet.Mesh.Triangles.size(), 0.1);
  const TriangleMesh any = Simplify(sheet, SerialFor);
  EXPECT_LT(SmallestAngle(any, 0), 5.0);
  for (const double angle : { 9.0, 15.0, 18.0 })
  {
    sheet.LeastAngle = angle;
    const TriangleMesh shaped = Simplify(sheet, SerialFor);
    EXPECT_GE(SmallestAngle(shaped, 0), angle);
    EXPECT_LT(SmallestAngle(shaped, 0), angle + 2.0); // and makes use of it
    EXPECT_GT(shaped.Triangles.size(), any.Triangles.size());
    EXPECT_LT(shaped.Triangles.size(), sheet.Mesh.Triangles.size() / 4);
    EXPECT_EQ(FaultBetween(sheet.Mesh, shaped, 0.1), "");
  }
}

TEST(Simplification, LosesMostSmallAngles)
{
  AllowedMesh mesh = MeshOf(test::SphereField({ 17, 17, 17 }), 0.0, 0.2);
  const auto small = [](const TriangleMesh& triangles)
  {
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangles.Triangles.size(); ++i)
    {
      count += SmallestAngle(triangles, i, i + 1) < 15.0 ? 1 : 0;
    }
    return count;
  };
  const std::size_t before = small(mesh.Mesh);
  EXPECT_GT(before, mesh.Mesh.Triangles.size() / 7);
  mesh.LeastAngle = 15.0;
  const TriangleMesh shaped = Simplify(mesh, SerialFor);
  EXPECT_LT(50 * small(shaped), before);
  EXPECT_LT(40 * small(shaped), shaped.Triangles.size());
  EXPECT_EQ(FaultBetween(mesh.Mesh, shaped, 0.2), "");
}

TEST(Simplification, GoesAlongTheWalls)
{
  AllowedMesh before = MeshOf(test::WaveField({ 33, 30, 33 }), 0.0, 0.4);
  const std::size_t was = BorderOf(before.Mesh).size();
  ASSERT_GT(was, 100U);
  for (const std::size_t most : { std::size_t{ 1000 }, MostOfPart })
  {
    const TriangleMesh after = Simplify(before, SerialFor, most);
    ExpectPromise(before, after, 0.4);
    EXPECT_LT(2 * BorderOf(after).size(), was);
  }
  // Not where no walls are known.
  before.OnWalls.clear();
  const TriangleMesh after = Simplify(before, SerialFor);
  ExpectPromise(before, after, 0.4);
  EXPECT_EQ(BorderOf(after), BorderOf(before.Mesh));
}

// Tubes that end on a wall in three edges: a border of two edges is none.
TEST(Simplification, LeavesTheSmallestBorders)
{
  AllowedMesh before;
  for (std::uint32_t first = 0; first < 120; first += 6)
  {
    for (std::uint32_t i = 0; i < 6; ++i)
    {
      const double angle = 0.1 * first + i % 3 * 2.0944;
      const double z = i < 3 ? 0.0 : 10.0;
      before.Mesh.Positions.push_back(
        { 3.0 * first + 0.3 * std::cos(angle), 0.3 * std::sin(angle), z });
      before.OnWalls.push_back(Walls::At({ 1.0, 1.0, z }, Grid({ 3, 3, 3 })));
    }
    for (std::uint32_t i = 0; i < 3; ++i)
    {
      const std::uint32_t here = first + i;
      const std::uint32_t next = first + (i + 1) % 3;
      before.Mesh.Triangles.push_back({ here, next, next + 3 });
      before.Mesh.Triangles.push_back({ here, next + 3, here + 3 });
    }
  }
  before.Allowances.assign(before.Mesh.Triangles.size(), 1.0);
  EXPECT_TRUE(Simplify(before, SerialFor).Triangles == before.Mesh.Triangles);
}

TEST(Simplification, DoesNotDependOnThreads)
{
  const AllowedMesh before = MeshOf(test::WaveField({ 33, 30, 33 }), 0.0, 0.3);
  const TriangleMesh serial = Simplify(before, SerialFor, 1000);
  const TriangleMesh threaded = Simplify(before, test::ThreadedFor(4), 1000);
  EXPECT_TRUE(serial.Triangles == threaded.Triangles);
  EXPECT_LT(serial.Triangles.size(), before.Mesh.Triangles.size());
}

TEST(Simplification, HoldsTheAllowanceOfEachPlace)
{
  AllowedMesh before = MeshOf(test::WaveField({ 21, 21, 21 }), 0.0, 1.0);
  for (std::size_t i = 0; i < before.Allowances.size(); ++i)
  {
    before.Allowances[i] = before.Mesh.Corner(i, 0)[0] < 10.0 ? 0.05 : 1.0;
  }
  const TriangleMesh after = Simplify(before, SerialFor);
  ExpectPromise(before, after, 1.0);
  EXPECT_LT(2 * after.Triangles.size(), before.Mesh.Triangles.size());
  AllowedMesh fine;
  fine.Mesh.Positions = before.Mesh.Positions;
  for (std::size_t i = 0; i < before.Allowances.size(); ++i)
  {
    if (before.Allowances[i] < 1.0)
    {
      fine.Mesh.Triangles.push_back(before.Mesh.Triangles[i]);
    }
  }
  test::Promise promise;
  promise.Tolerance = 0.05;
  promise.Forth = false;
  EXPECT_EQ(test::FaultOf(promise, TrianglesOf(after), TrianglesOf(fine.Mesh)), "");
}

// What collapses must not do, done by hand.
// Without flips it is 0.106.
TEST(Simplification, IsNearOnAverage)
{
  const AllowedMesh before = MeshOf(test::WaveField({ 33, 33, 33 }), 0.05, 0.4);
  const TriangleMesh after = Simplify(before, SerialFor);
  const test::NearestTriangle nearest(TrianglesOf(after));
  double sum = 0.0;
  for (std::size_t i = 0; i < before.Mesh.Triangles.size(); ++i)
  {
    const double distance = nearest.Distance(before.Mesh.Middle(i));
    sum += distance * distance;
  }
  const double rms = std::sqrt(sum / static_cast<double>(before.Mesh.Triangles.size()));
  EXPECT_LT(rms, 0.1);
}

TEST(Simplification, CatchesSabotage)
{
  const AllowedMesh before = MeshOf(test::WaveField({ 15, 15, 15 }), 0.0, 0.2);
  const std::vector<Triangle>& sound = before.Mesh.Triangles;
  EXPECT_FALSE(FaultsOf(before, sound).Any());
  std::vector<Triangle> pulled = sound;
  const std::uint32_t point = sound[10][0];
  for (Triangle& triangle : pulled)
  {
    std::replace(triangle.begin(), triangle.end(), point, FarthestFrom(before.Mesh, point));
  }
  EXPECT_TRUE(FaultsOf(before, pulled).Any()) << "a point pulled away";
  std::vector<Triangle> hole;
  const Vector at = before.Mesh.Middle(9);
  for (std::size_t i = 0; i < sound.size(); ++i)
  {
    const Vector between = before.Mesh.Middle(i) - at;
    if (Dot(between, between) > 1.0)
    {
      hole.push_back(sound[i]);
    }
  }
  ASSERT_LT(hole.size(), sound.size());
  EXPECT_FALSE(FaultsOf(before, hole).Points.empty()) << "a hole";
  const std::vector<Triangle> fewer = WithoutPieceOf(sound, sound.back());
  EXPECT_EQ(FaultsOf(before, fewer).Any(), fewer.size() < sound.size()) << "a piece dropped";
  AllowedMesh two = before; // the wave's pieces may be one
  const auto first = static_cast<std::uint32_t>(two.Mesh.Positions.size());
  for (const Vector& corner : { Vector{ 50, 0, 0 }, { 52, 0, 0 }, { 50, 2, 0 }, { 50, 0, 2 } })
  {
    two.Mesh.Positions.push_back(corner);
  }
  for (const Triangle& t : { Triangle{ 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } })
  {
    two.Mesh.Triangles.push_back({ first + t[0], first + t[1], first + t[2] });
    two.Allowances.push_back(0.2);
  }
  EXPECT_FALSE(FaultsOf(two, two.Mesh.Triangles).Any());
  EXPECT_TRUE(FaultsOf(two, sound).Any()) << "a piece dropped";
  std::vector<Triangle> turned = sound;
  std::swap(turned[5][0], turned[5][1]);
  const PartDistance::Faults faults = FaultsOf(before, turned);
  EXPECT_GT(std::count(faults.Triangles.begin(), faults.Triangles.end(), 5U), 0)
    << "a triangle turned over";
}

TEST(Simplification, MakesNoEdgeInTwoParts)
{
  // Needles that are cut in two in the middle, at a ring of four points. Both halves would like to
  // be two triangles on these, with the same diagonal.
  constexpr std::uint32_t needles = 40;
  AllowedMesh before;
  for (std::uint32_t i = 0; i < needles; ++i)
  {
    const double y = 10.0 * i;
    const std::vector<Vector> points = { { 0, y - 1, 0 }, { 0, y, -1 }, { 0, y + 1, 0 },
      { 0, y, 1 }, { -1000, y, 0 }, { 1000, y, 0 } };
    before.Mesh.Positions.insert(before.Mesh.Positions.end(), points.begin(), points.end());
    for (std::uint32_t k = 0; k < 4; ++k)
    {
      const std::uint32_t first = 6 * i;
      const std::uint32_t here = first + k;
      const std::uint32_t next = first + (k + 1) % 4;
      before.Mesh.Triangles.push_back({ here, next, first + 4 });
      before.Mesh.Triangles.push_back({ next, here, first + 5 });
    }
  }
  before.Allowances.assign(before.Mesh.Triangles.size(), 1e5);
  const TriangleMesh after = Simplify(before, SerialFor, 4 * needles);
  EXPECT_TRUE(BorderOf(after).empty());
  EXPECT_EQ(test::TopologyOf(IdsOf(after)), test::TopologyOf(IdsOf(before.Mesh)));
}

TEST(Simplification, FoldsNothingOver)
{
  // Of a ball: every triangle faces away from its middle.
  const AllowedMesh before = MeshOf(test::SphereField({ 17, 17, 17 }), 0.0, 1.0);
  const auto facesInward = [](const TriangleMesh& mesh)
  {
    int count = 0;
    for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
    {
      const Vector a = mesh.Corner(i, 0);
      const Vector b = mesh.Corner(i, 1);
      const Vector c = mesh.Corner(i, 2);
      const Vector outward = (1.0 / 3.0) * (a + b + c) - Vector{ 8.0, 8.0, 8.0 };
      count += Dot(Cross(b - a, c - a), outward) < 0.0 ? 1 : 0;
    }
    return count;
  };
  ASSERT_EQ(facesInward(before.Mesh), 0);
  const TriangleMesh after = Simplify(before, SerialFor);
  EXPECT_LT(10 * after.Triangles.size(), before.Mesh.Triangles.size());
  EXPECT_EQ(facesInward(after), 0);
}

TEST(Simplification, LeavesWhatHasNoAllowance)
{
  const AllowedMesh before = MeshOf(test::SphereField({ 17, 17, 17 }), 0.0, 0.0);
  EXPECT_TRUE(Simplify(before, SerialFor).Triangles == before.Mesh.Triangles);
  AllowedMesh hardly = before;
  hardly.Allowances.assign(hardly.Allowances.size(), 1e-300);
  EXPECT_TRUE(Simplify(hardly, SerialFor).Triangles == before.Mesh.Triangles);
  EXPECT_TRUE(Simplify({}, SerialFor).Triangles.empty());
}

// A triangle twice: what meets at its edges cannot be told.
TEST(Simplification, LeavesMeshesWithFaultsAsTheyAre)
{
  AllowedMesh before = MeshOf(test::WaveField({ 9, 9, 9 }), 0.0, 0.5);
  const std::vector<Triangle> sound = before.Mesh.Triangles;
  ASSERT_LT(Simplify(before, SerialFor).Triangles.size(), sound.size());
  before.Allowances.push_back(0.5);
  for (std::size_t i = 0; i < sound.size(); i += 7)
  {
    before.Mesh.Triangles = sound;
    before.Mesh.Triangles.push_back(sound[i]);
    EXPECT_EQ(Simplify(before, SerialFor).Triangles.size(), before.Mesh.Triangles.size()) << i;
  }
}

// A roof whose ridge leads from point 0 to 2, and two triangles that cut across it.
namespace
{

MeshPart CutRoof()
{
  AllowedMesh roof;
  roof.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, -0.5 }, { 1, 1, 0 }, { 0, 1, -0.5 } };
  roof.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  roof.Allowances = { 1.0, 1.0 };
  MeshPart part = Whole(roof);
  part.Simple = Connectivity(4, { { 0, 1, 3 }, { 1, 2, 3 } }).Linked();
  part.Samples.push_back({ { 0.2, 0.2, 0 }, 1.0, 0 });
  part.Samples.push_back({ { 0.8, 0.8, 0 }, 1.0, 1 });
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
  ExpectLinks(collapses.Mesh());
  // Each middle lies over the triangle that it is the middle of.
  for (std::uint32_t sample = 4; sample < 6; ++sample)
  {
    const Triangle& under = collapses.Mesh().Triangles[collapses.SampleHomes()[sample]];
    const std::uint32_t corner = sample == 4 ? 1 : 3;
    EXPECT_EQ(std::count(under.begin(), under.end(), corner), 1);
  }
  const std::vector<bool> undone = collapses.Undo({ 1 }, {});
  EXPECT_EQ(undone, std::vector<bool>({ true, true }));
  EXPECT_FALSE(HasRidge(collapses.Mesh()));
  ExpectLinks(collapses.Mesh());
  EXPECT_EQ(collapses.SampleHomes()[6], 0);
  EXPECT_EQ(collapses.SampleHomes()[7], 1);
}

// Below the roof is a groove from point 1 to 3: were that edge, which the roof has lost, made
// there, it would be there twice once the roof's flip is undone.
TEST(EdgeCollapses, MakesNoEdgeThatWasFlippedAway)
{
  AllowedMesh mesh;
  mesh.Mesh.Positions = { { 0, 0, 0 }, { 1, 0, -0.5 }, { 1, 1, 0 }, { 0, 1, -0.5 },
    { 0.6, 0.6, -1.5 } };
  mesh.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 0, 3 }, { 1, 3, 4 }, { 2, 1, 4 },
    { 3, 2, 4 } };
  mesh.Allowances.assign(6, 0.3);
  MeshPart part = Whole(mesh);
  const std::vector<Triangle> cut = { { 0, 1, 3 }, { 1, 2, 3 }, { 1, 0, 4 }, { 0, 3, 4 },
    { 2, 1, 4 }, { 3, 2, 4 } };
  part.Simple = Connectivity(5, cut).Linked();
  EdgeCollapses collapses(part, 1.0);
  EXPECT_TRUE(collapses.Run()[0]);
  collapses.Undo({ 0 }, {});
  EXPECT_TRUE(BorderOf({ mesh.Mesh.Positions, Left(collapses.Mesh()) }).empty());
  // Without the roof it is made.
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
  held.IsFixed = { true, true, false, true }; // the first triangle
  MeshPart joining = CutRoof();
  joining.IsFixed = { true, false, true, false }; // the ridge may be there in another part
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

TEST(EdgeCollapses, CanBeUndone)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const AllowedMesh before = MeshOf(field, 0.0, 1.0);
    const MeshPart part = Whole(before);
    const Connectivity links(before.Mesh.Positions.size(), before.Mesh.Triangles);
    test::Random random(7);
    EdgeCollapses collapses(part, 1.0);
    const std::vector<bool> isChanged = collapses.Run();
    ASSERT_TRUE(std::count(isChanged.begin(), isChanged.end(), true) > 0);
    std::size_t last = Left(collapses.Mesh()).size();
    // Some, and in the end all.
    for (int trial = 0; trial < 30; ++trial)
    {
      std::vector<std::uint32_t> triangles;
      for (int i = 0; i < 5; ++i)
      {
        triangles.push_back(test::Pick(random, static_cast<int>(isChanged.size())));
      }
      collapses.Undo(triangles, {});
      std::vector<std::uint32_t> numbers;
      const TriangleMesh now{ before.Mesh.Positions, Left(collapses.Mesh(), &numbers) };
      EXPECT_GE(now.Triangles.size(), last);
      last = now.Triangles.size();
      ASSERT_EQ(test::TopologyOf(IdsOf(now)), test::TopologyOf(IdsOf(before.Mesh)));
      ExpectBorder(before, now);
      ExpectLinks(collapses.Mesh());
      // Each sample lies over one triangle that is there, and points in use over none.
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
    // Flips alone are left.
    EXPECT_EQ(Left(collapses.Mesh()).size(), before.Mesh.Triangles.size());
    all.resize(isChanged.size());
    std::iota(all.begin(), all.end(), 0U);
    collapses.Undo(all, {});
    std::vector<Triangle> now = Left(collapses.Mesh());
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

// Triangles on points of a mesh that are near to each other, some of them far from the mesh or over
// its border, with some of the mesh's triangles there.
TEST(ShadowTest, IsRightByBruteForce)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const AllowedMesh mesh = MeshOf(field, 0.0, 0.0);
    const std::vector<Vector>& positions = mesh.Mesh.Positions;
    const Connectivity links(positions.size(), mesh.Mesh.Triangles);
    const test::NearestTriangle nearest(TrianglesOf(mesh.Mesh));
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

// A fold: what covers a triangle and turns back does not cover it twice as much.
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

// Over a strip, and a long one, where it gives up.
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
      [&](std::uint32_t, double distance, const Covering::Piece& piece)
      {
        EXPECT_LE(distance, 0.2 + 1e-9);
        area += piece.Area();
        return true;
      });
    EXPECT_EQ(isAll, length < 100);
    EXPECT_EQ(isAll, std::abs(area - 0.5 * std::sqrt(Dot(normal, normal))) < 1e-9);
  }
}
