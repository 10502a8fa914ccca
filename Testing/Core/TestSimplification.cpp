// SPDX-License-Identifier: BSD-3-Clause
// Simplification against brute force, with decimation of all kinds, some of it malicious.
#include "DistanceTestTools.h"
#include "Simplification/Covering.h"
#include "Simplification/MeshOptimizer.h"
#include "Simplification/SameTopology.h"
#include "Simplification/Simplification.h"
#include "TopologyTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

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

/** What holds of every result. */
void ExpectPromise(const AllowedMesh& before, const AllowedMesh& after, double allowed)
{
  ASSERT_EQ(after.Allowances.size(), after.Mesh.Triangles.size());
  EXPECT_EQ(FaultBetween(before.Mesh, after.Mesh, allowed), "");
  EXPECT_EQ(test::TopologyOf(IdsOf(after.Mesh)), test::TopologyOf(IdsOf(before.Mesh)));
  EXPECT_EQ(BorderOf(after.Mesh), BorderOf(before.Mesh));
  EXPECT_TRUE(after.Mesh.Positions == before.Mesh.Positions);
  // What is said to be left of the allowances is: each triangle used up no less than its distance.
  const test::NearestTriangle nearest(TrianglesOf(before.Mesh));
  const test::SurfaceTriangles triangles = TrianglesOf(after.Mesh);
  double least = allowed;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    double farthest = 0.0;
    test::ForEachSample(triangles[i], 0.25,
      [&](const std::array<double, 3>& point)
      { farthest = std::max(farthest, nearest.Distance(point)); });
    EXPECT_LE(farthest + after.Allowances[i], allowed + 1e-9);
    least = std::min(least, after.Allowances[i]);
  }
  const test::NearestTriangle back(triangles);
  for (const test::SurfaceTriangles::value_type& triangle : TrianglesOf(before.Mesh))
  {
    test::ForEachSample(triangle, 0.5,
      [&](const std::array<double, 3>& point)
      { EXPECT_LE(back.Distance(point) + least, allowed + 1e-9); });
  }
}

/** Collapses edges by chance, with no regard for anything. */
Decimation Reckless(unsigned int seed, std::size_t part)
{
  return [seed, part](const TriangleMesh& mesh, double)
  {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> becomes(mesh.Positions.size());
    for (std::uint32_t i = 0; i < becomes.size(); ++i)
    {
      becomes[i] = i;
    }
    for (std::size_t i = 0; i < mesh.Triangles.size() / part; ++i)
    {
      const Triangle& t = mesh.Triangles[random() % mesh.Triangles.size()];
      becomes[t[0]] = t[1];
    }
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.Triangles)
    {
      const Triangle now = { becomes[t[0]], becomes[t[1]], becomes[t[2]] };
      if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0])
      {
        triangles.push_back(now);
      }
    }
    return triangles;
  };
}

/** Leaves the triangles as they are but for a change, where there are enough. */
Decimation With(const std::function<void(const TriangleMesh&, std::vector<Triangle>&)>& change)
{
  return [change](const TriangleMesh& mesh, double)
  {
    std::vector<Triangle> triangles = mesh.Triangles;
    if (triangles.size() > 20)
    {
      change(mesh, triangles);
    }
    return triangles;
  };
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

}

TEST(Simplification, KeepsThePromise)
{
  if (!MeshOptimizer())
  {
    GTEST_SKIP() << "built without meshoptimizer";
  }
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    for (const double allowed : { 0.1, 0.4, 2.0 })
    {
      SCOPED_TRACE(allowed);
      const AllowedMesh before = MeshOf(field, 0.1, allowed);
      const AllowedMesh after = Simplify(before, MeshOptimizer(), SerialFor);
      ExpectPromise(before, after, allowed);
      EXPECT_LT(after.Mesh.Triangles.size(), before.Mesh.Triangles.size());
    }
  }
}

TEST(Simplification, SavesMostTriangles)
{
  if (!MeshOptimizer())
  {
    GTEST_SKIP() << "built without meshoptimizer";
  }
  const AllowedMesh before = MeshOf(test::SphereField({ 33, 33, 33 }), 0.1, 0.4);
  const AllowedMesh after = Simplify(before, MeshOptimizer(), SerialFor);
  EXPECT_LT(5 * after.Mesh.Triangles.size(), before.Mesh.Triangles.size());
}

TEST(Simplification, DoesNotDependOnThreads)
{
  const auto decimate = MeshOptimizer() ? MeshOptimizer() : Reckless(1, 10);
  const AllowedMesh before = MeshOf(test::WaveField({ 33, 30, 33 }), 0.0, 0.3);
  const AllowedMesh serial = Simplify(before, decimate, SerialFor);
  const AllowedMesh threaded = Simplify(before, decimate, test::ThreadedFor(4));
  EXPECT_TRUE(serial.Mesh.Triangles == threaded.Mesh.Triangles);
  EXPECT_TRUE(serial.Allowances == threaded.Allowances);
}

TEST(Simplification, HoldsTheAllowanceOfEachPlace)
{
  const auto decimate = MeshOptimizer() ? MeshOptimizer() : Reckless(1, 10);
  AllowedMesh before = MeshOf(test::WaveField({ 21, 21, 21 }), 0.0, 1.0);
  for (std::size_t i = 0; i < before.Allowances.size(); ++i)
  {
    before.Allowances[i] = before.Mesh.Corner(i, 0)[0] < 10.0 ? 0.05 : 1.0;
  }
  const AllowedMesh after = Simplify(before, decimate, SerialFor);
  ExpectPromise(before, after, 1.0);
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
  EXPECT_EQ(test::FaultOf(promise, TrianglesOf(after.Mesh), TrianglesOf(fine.Mesh)), "");
}

TEST(Simplification, CatchesRecklessDecimation)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const AllowedMesh before = MeshOf(field, 0.0, 0.3);
    for (unsigned int seed = 0; seed < 2; ++seed)
    {
      const AllowedMesh after = Simplify(before, Reckless(seed, 20), SerialFor);
      ExpectPromise(before, after, 0.3);
    }
  }
}

TEST(Simplification, CatchesSabotage)
{
  const AllowedMesh before = MeshOf(test::WaveField({ 15, 15, 15 }), 0.0, 0.5);
  const std::map<std::string, Decimation> saboteurs = {
    { "no triangles", [](const TriangleMesh&, double) { return std::vector<Triangle>(); } },
    { "ids of no points",
      With([](const TriangleMesh& mesh, std::vector<Triangle>& triangles)
        { triangles[7][1] = static_cast<std::uint32_t>(mesh.Positions.size()); }) },
    { "a hole",
      With([](const TriangleMesh&, std::vector<Triangle>& triangles)
        { triangles.erase(triangles.begin() + 9); }) },
    { "a triangle twice",
      With([](const TriangleMesh&, std::vector<Triangle>& triangles)
        { triangles.push_back(triangles[3]); }) },
    { "a triangle turned over",
      With([](const TriangleMesh&, std::vector<Triangle>& triangles)
        { std::swap(triangles[5][0], triangles[5][1]); }) },
    { "a triangle with a point twice",
      With([](const TriangleMesh&, std::vector<Triangle>& triangles)
        { triangles[4][0] = triangles[4][1]; }) },
    { "a point pulled away",
      With(
        [](const TriangleMesh& mesh, std::vector<Triangle>& triangles)
        {
          const std::uint32_t point = triangles[10][0];
          const std::uint32_t far = FarthestFrom(mesh, point);
          for (Triangle& triangle : triangles)
          {
            std::replace(triangle.begin(), triangle.end(), point, far);
          }
        }) },
    { "a piece dropped",
      With(
        [](const TriangleMesh& mesh, std::vector<Triangle>& triangles)
        {
          // All that hangs together with the last triangle.
          std::vector<bool> is(mesh.Positions.size());
          for (const std::uint32_t point : triangles.back())
          {
            is[point] = true;
          }
          for (bool grows = true; grows;)
          {
            grows = false;
            for (const Triangle& t : triangles)
            {
              const bool touches = is[t[0]] || is[t[1]] || is[t[2]];
              for (const std::uint32_t point : t)
              {
                grows = grows || (touches && !is[point]);
                is[point] = is[point] || touches;
              }
            }
          }
          triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                            [&](const Triangle& t) { return is[t[0]]; }),
            triangles.end());
        }) },
    { "a piece more",
      With(
        [](const TriangleMesh&, std::vector<Triangle>& triangles)
        {
          // A pillow of two triangles, on points that no longer have any.
          const Triangle t = triangles[2];
          triangles.clear();
          triangles.push_back(t);
          triangles.push_back({ t[1], t[0], t[2] });
        }) },
  };
  for (const auto& [name, decimate] : saboteurs)
  {
    SCOPED_TRACE(name);
    const AllowedMesh after = Simplify(before, decimate, SerialFor);
    ExpectPromise(before, after, 0.5);
  }
}

TEST(Simplification, MakesNoEdgeInTwoBlocks)
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
  const Decimation flatten = [](const TriangleMesh& mesh, double)
  {
    std::vector<Triangle> triangles = mesh.Triangles;
    if (triangles.size() > 4 * needles)
    {
      triangles.push_back(
        { triangles[0][0], triangles[0][0], triangles[0][1] }); // to be cut in two
      return triangles;
    }
    std::map<std::uint32_t, std::vector<Triangle>> halves; // by their point at the end
    for (Triangle t : triangles)
    {
      while (std::abs(mesh.Positions[t[2]][0]) < 1.0)
      {
        std::rotate(t.begin(), t.begin() + 1, t.end());
      }
      halves[t[2]].push_back(t);
    }
    triangles.clear();
    for (auto& [end, half] : halves)
    {
      if (half.size() != 4)
      {
        triangles.insert(triangles.end(), half.begin(), half.end());
        continue;
      }
      // The ring from its lowest point on, in the half's own direction.
      std::map<std::uint32_t, std::uint32_t> next;
      for (const Triangle& t : half)
      {
        next[t[0]] = t[1];
      }
      const std::uint32_t a = next.begin()->first;
      const std::uint32_t b = next[a];
      const std::uint32_t c = next[b];
      triangles.push_back({ a, b, c });
      triangles.push_back({ a, c, next[c] });
    }
    return triangles;
  };
  const AllowedMesh after = Simplify(before, flatten, SerialFor);
  EXPECT_TRUE(BorderOf(after.Mesh).empty());
  EXPECT_EQ(test::TopologyOf(IdsOf(after.Mesh)), test::TopologyOf(IdsOf(before.Mesh)));
}

TEST(Simplification, FoldsNothingOver)
{
  // Of a ball: every triangle faces away from its middle, whatever decimation does.
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
  for (unsigned int seed = 0; seed < 4; ++seed)
  {
    const AllowedMesh after = Simplify(before, Reckless(seed, 15), SerialFor);
    EXPECT_LT(after.Mesh.Triangles.size(), before.Mesh.Triangles.size());
    EXPECT_EQ(facesInward(after.Mesh), 0);
  }
}

TEST(Simplification, LeavesWhatHasNoAllowance)
{
  const AllowedMesh before = MeshOf(test::SphereField({ 17, 17, 17 }), 0.0, 0.0);
  const AllowedMesh after = Simplify(before, Reckless(1, 4), SerialFor);
  EXPECT_EQ(after.Mesh.Triangles.size(), before.Mesh.Triangles.size());
  AllowedMesh hardly = before;
  hardly.Allowances.assign(hardly.Allowances.size(), 1e-300);
  EXPECT_TRUE(Simplify(hardly, Reckless(1, 4), SerialFor).Mesh.Triangles == before.Mesh.Triangles);
  EXPECT_TRUE(Simplify({}, Reckless(1, 4), SerialFor).Mesh.Triangles.empty());
}

// A triangle twice: no decimation can be told from a change of topology there.
TEST(Simplification, LeavesMeshesWithFaultsAsTheyAre)
{
  AllowedMesh before = MeshOf(test::WaveField({ 9, 9, 9 }), 0.0, 0.5);
  const std::vector<Triangle> sound = before.Mesh.Triangles;
  before.Allowances.push_back(0.5);
  for (std::size_t i = 0; i < sound.size(); i += 7)
  {
    for (const bool first : { true, false })
    {
      before.Mesh.Triangles = sound;
      before.Mesh.Triangles.insert(
        first ? before.Mesh.Triangles.begin() : before.Mesh.Triangles.end(), sound[i]);
      const AllowedMesh after = Simplify(
        before, [&](const TriangleMesh&, double) { return sound; }, SerialFor);
      EXPECT_EQ(after.Mesh.Triangles.size(), before.Mesh.Triangles.size()) << i;
    }
  }
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
    const Connectivity links(strip);
    const Covering covering(strip, links);
    const std::array<Vector, 3> corners = { { { 0.2, 0.3, 0.1 }, { length - 0.3, 0.4, 0.2 },
      { 0.5 * length, 0.7, 0.1 } } };
    const Vector normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
    double area = 0.0;
    const bool isAll = covering.Cut(corners, 0, 0.0,
      [&](std::uint32_t, double distance, double part)
      {
        EXPECT_LE(distance, 0.2 + 1e-9);
        area += part;
        return true;
      });
    EXPECT_EQ(isAll, length < 100);
    EXPECT_EQ(isAll, std::abs(area - 0.5 * std::sqrt(Dot(normal, normal))) < 1e-9);
  }
}

TEST(Simplification, TellsOtherTopology)
{
  // A tetrahedron, and a pillow of two of its points more: both spheres, but not of one piece.
  TriangleMesh one;
  one.Positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 5, 5, 5 } };
  one.Triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  const Connectivity links(one);
  EXPECT_TRUE(links.FaultyPoints().empty());
  EXPECT_TRUE(FindOtherTopology(one, links, one, links).empty());
  TriangleMesh open = one;
  open.Triangles.pop_back();
  const Connectivity openLinks(open);
  EXPECT_FALSE(FindOtherTopology(one, links, open, openLinks).empty());
  EXPECT_FALSE(FindOtherTopology(open, openLinks, one, links).empty());
  TriangleMesh none = one;
  none.Triangles.clear();
  const Connectivity noLinks(none);
  EXPECT_EQ(FindOtherTopology(one, links, none, noLinks), std::vector<bool>(4, true));
  // Another component more, made of points that are in use as well, or in place of a handle.
  TriangleMesh two = one;
  two.Positions.insert(two.Positions.end(), { { 5, 5, 6 }, { 6, 5, 5 }, { 5, 6, 5 } });
  two.Triangles.insert(two.Triangles.end(), { { 4, 7, 6 }, { 4, 6, 5 }, { 6, 7, 5 }, { 7, 4, 5 } });
  const Connectivity twoLinks(two);
  ASSERT_TRUE(twoLinks.FaultyPoints().empty());
  one.Positions = two.Positions;
  const Connectivity oneLinks(one);
  EXPECT_FALSE(FindOtherTopology(two, twoLinks, one, oneLinks).empty());
  EXPECT_FALSE(FindOtherTopology(one, oneLinks, two, twoLinks).empty());
  // A torus of 3 x 3 squares, and a ball of the same points.
  TriangleMesh torus;
  torus.Positions.resize(9);
  for (std::uint32_t x = 0; x < 3; ++x)
  {
    for (std::uint32_t y = 0; y < 3; ++y)
    {
      const auto at = [](std::uint32_t i, std::uint32_t j) { return 3 * (i % 3) + j % 3; };
      torus.Triangles.push_back({ at(x, y), at(x + 1, y), at(x + 1, y + 1) });
      torus.Triangles.push_back({ at(x, y), at(x + 1, y + 1), at(x, y + 1) });
    }
  }
  const Connectivity torusLinks(torus);
  ASSERT_TRUE(torusLinks.FaultyPoints().empty());
  EXPECT_TRUE(FindOtherTopology(torus, torusLinks, torus, torusLinks).empty());
  TriangleMesh ball = torus;
  ball.Triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  EXPECT_FALSE(FindOtherTopology(torus, torusLinks, ball, Connectivity(ball)).empty());
  // Two balls in place of one.
  TriangleMesh octahedron;
  octahedron.Positions.resize(9);
  octahedron.Triangles = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 }, { 1, 0, 5 },
    { 2, 1, 5 }, { 3, 2, 5 }, { 0, 3, 5 } };
  const Connectivity octahedronLinks(octahedron);
  ASSERT_TRUE(octahedronLinks.FaultyPoints().empty());
  TriangleMesh pillows = octahedron;
  pillows.Triangles = { { 0, 1, 2 }, { 1, 0, 2 }, { 3, 4, 5 }, { 4, 3, 5 } };
  EXPECT_FALSE(
    FindOtherTopology(octahedron, octahedronLinks, pillows, Connectivity(pillows)).empty());
  TriangleMesh twice = one;
  twice.Triangles.push_back({ 0, 2, 1 });
  EXPECT_FALSE(Connectivity(twice).FaultyPoints().empty());
}
