// SPDX-License-Identifier: BSD-3-Clause
// What a mesh must not do: meet itself. Against exact computation in whole numbers.
#include "Simplification/Orientation.h"
#include "Simplification/PartBorders.h"
#include "Simplification/SelfIntersections.h"
#include "Simplification/TriangleIntersection.h"
#include "Tools/RandomTestTools.h"
#include "Tools/SimplificationTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace isodiamond;

namespace
{

using test::WholePoint;

Vector ToVector(const WholePoint& point)
{
  return { static_cast<double>(point[0]), static_cast<double>(point[1]),
    static_cast<double>(point[2]) };
}

WholePoint RandomPoint(test::Random& random, int size)
{
  return { test::Pick(random, size), test::Pick(random, size), test::Pick(random, size) };
}

std::int64_t Determinant(
  const WholePoint& a, const WholePoint& b, const WholePoint& c, const WholePoint& d)
{
  std::array<WholePoint, 3> rows = { a, b, c };
  for (WholePoint& row : rows)
  {
    row = { row[0] - d[0], row[1] - d[1], row[2] - d[2] };
  }
  const auto& [r, s, t] = rows;
  return r[0] * (s[1] * t[2] - s[2] * t[1]) + r[1] * (s[2] * t[0] - s[0] * t[2]) +
    r[2] * (s[0] * t[1] - s[1] * t[0]);
}

int SignOf(std::int64_t value)
{
  return (value > 0 ? 1 : 0) - (value < 0 ? 1 : 0);
}

/** A triangle without the tip at its first corner: a 64th of it. */
std::vector<WholePoint> WithoutTip(const std::vector<WholePoint>& triangle)
{
  std::vector<WholePoint> rest(4);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t tip = triangle[0][axis];
    rest[0][axis] = tip + (triangle[1][axis] - tip) / 64;
    rest[1][axis] = triangle[1][axis];
    rest[2][axis] = triangle[2][axis];
    rest[3][axis] = tip + (triangle[2][axis] - tip) / 64;
  }
  return rest;
}

/** A square sheet of triangles at a height over z = 0, which falls with x. */
void AddSheet(double height, TriangleMesh& mesh)
{
  const auto first = static_cast<std::uint32_t>(mesh.Positions.size());
  constexpr std::uint32_t size = 4;
  for (std::uint32_t y = 0; y <= size; ++y)
  {
    for (std::uint32_t x = 0; x <= size; ++x)
    {
      mesh.Positions.push_back({ 1.0 * x, 1.0 * y, height * (1.0 - 0.5 * x) });
      if (x < size && y < size)
      {
        const std::uint32_t at = first + y * (size + 1) + x;
        mesh.Triangles.push_back({ at, at + 1, at + size + 2 });
        mesh.Triangles.push_back({ at, at + size + 2, at + size + 1 });
      }
    }
  }
}

MeshPart PartOf(const TriangleMesh& mesh)
{
  return test::WholePart({ mesh, std::vector<double>(mesh.Triangles.size(), 1.0) });
}

}

// Up to 2^19 from each other, determinants have 62 bits, of which a double keeps 53.
TEST(SelfIntersections, KnowOnWhichSideAPointIs)
{
  test::Random random(1);
  std::array<int, 3> seen{};
  for (int i = 0; i < 200000; ++i)
  {
    const int size = 1 << (2 + test::Pick(random, 18));
    const WholePoint a = RandomPoint(random, size);
    const WholePoint b = RandomPoint(random, size);
    const WholePoint c = RandomPoint(random, size);
    WholePoint d = RandomPoint(random, size);
    if (i % 2 == 0)
    {
      // Nearly in their plane: half way between two points and the third, rounded.
      for (int axis = 0; axis < 3; ++axis)
      {
        d[axis] = (a[axis] + b[axis] + 2 * c[axis]) / 4 + (i % 3 - 1) * (axis == 0 ? 1 : 0);
      }
    }
    const int sign = SignOf(Determinant(a, b, c, d));
    ++seen[sign + 1];
    const Vector far = { 1e6, -1e6, 0.0 };
    const double unit = std::ldexp(1.0, test::Pick(random, 200) - 100);
    ASSERT_EQ(Orientation(ToVector(a), ToVector(b), ToVector(c), ToVector(d)), sign);
    ASSERT_EQ(
      Orientation(unit * ToVector(a), unit * ToVector(b), unit * ToVector(c), unit * ToVector(d)),
      sign);
    ASSERT_EQ(
      Orientation(far + ToVector(a), far + ToVector(b), far + ToVector(c), far + ToVector(d)),
      sign);
    const auto flat = [](const WholePoint& point) {
      return PlanePoint{ static_cast<double>(point[0]), static_cast<double>(point[1]) };
    };
    ASSERT_EQ(Orientation(flat(a), flat(b), flat(c)),
      SignOf((a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0])));
  }
  EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 1000);
}

// What rounding a difference loses decides.
TEST(SelfIntersections, KnowOnWhichSideAPointIsWhenDifferencesAreRounded)
{
  const double tiny = std::ldexp(1.0, -80);
  const Vector a = { 1.0, 0.0, 0.0 };
  const Vector b = { 0.0, 1.0, 0.0 };
  const Vector c = { 0.0, 0.0, 1.0 };
  const double third = std::ldexp(1.0, -2);
  EXPECT_EQ(Orientation(a, b, c, { 0.5, third, third }), 0);
  EXPECT_NE(Orientation(a, b, c, { 0.5, third, third }),
    Orientation(a, b, { -tiny, 0.0, 1.0 }, { 0.5, third, third }));
  EXPECT_EQ(Orientation(a, b, { tiny, 0.0, 1.0 }, { 0.5, third, third }),
    -Orientation(a, b, { -tiny, 0.0, 1.0 }, { 0.5, third, third }));
}

// With all bits of a double in use: half way between two points is on every line through them, one
// unit in the last place beside it on one side.
TEST(SelfIntersections, KnowOnWhichSideOneUnitInTheLastPlaceIs)
{
  test::Random random(3);
  const auto coordinate = [&]
  { return std::floor(test::Uniform(random, 0.5, 1.0) * 0x1p52) * 0x1p-52; };
  const double unit = 0x1p-53;
  for (int i = 0; i < 20000; ++i)
  {
    std::array<Vector, 3> corners{};
    for (Vector& corner : corners)
    {
      corner = { coordinate(), coordinate(), coordinate() };
    }
    const auto& [a, b, c] = corners;
    const double area = (a[0] - c[0]) * (b[1] - c[1]) - (a[1] - c[1]) * (b[0] - c[0]);
    if (std::abs(area) < 1e-6)
    {
      continue;
    }
    const Vector middle = 0.5 * (a + b);
    const int up = area > 0.0 ? -1 : 1; // of what lies above the plane
    ASSERT_EQ(Orientation(a, b, c, middle), 0);
    ASSERT_EQ(Orientation(a, b, c, middle + Vector{ 0.0, 0.0, unit }), up);
    ASSERT_EQ(Orientation(a, b, c, middle - Vector{ 0.0, 0.0, unit }), -up);
  }
}

// Beside the diagonal, from far away: differences are rounded (Kettner et al., Computational
// Geometry 2008).
TEST(SelfIntersections, KnowOnWhichSideOfADiagonalAPointIs)
{
  for (int i = 0; i < 64; ++i)
  {
    for (int k = 0; k < 64; ++k)
    {
      const PlanePoint place = { 0.5 + i * 0x1p-53, 0.5 + k * 0x1p-53 };
      const int sign = (k > i ? 1 : 0) - (k < i ? 1 : 0);
      ASSERT_EQ(Orientation(place, { 12.0, 12.0 }, { 24.0, 24.0 }), sign);
      ASSERT_EQ(Orientation({ 12.0, 12.0 }, { 24.0, 24.0 }, place), sign);
    }
  }
}

// Here the sign of the rounded determinant is wrong, by 2.2 of the 3 units that it may be.
TEST(SelfIntersections, KnowOnWhichSideAPointIsWhereRoundingIsNearlyAtItsWorst)
{
  const PlanePoint a = { 0x1.0a63aa7830eaep-2, 0x1.829a004e59bbp-2 };
  const PlanePoint b = { 0x1.280ee5a191d7fp+0, 0x1.53724944bfee2p+0 };
  const PlanePoint c = { -0x1.cdc3dfd2c563p-7, 0x1.65d9485e58d96p-4 };
  EXPECT_EQ(Orientation(a, b, c), -1);
  EXPECT_EQ(Orientation(b, a, c), 1);
}

TEST(SelfIntersections, AreRightByLinesThatSeparate)
{
  test::Random random(2);
  std::array<std::array<int, 2>, 2> seen{};
  for (int i = 0; i < 200000; ++i)
  {
    // Multiples of 64, few of them: most triangles touch, or lie in one plane.
    std::vector<Vector> positions;
    std::vector<WholePoint> points;
    const int size = 2 + test::Pick(random, 4);
    for (int k = 0; k < 6; ++k)
    {
      WholePoint point = RandomPoint(random, size);
      for (std::int64_t& coordinate : point)
      {
        coordinate *= 64;
      }
      points.push_back(point);
      positions.push_back(ToVector(point));
    }
    const auto hasArea = [&](const Triangle& t) { return AreaOf(positions, t) > 0.0; };
    const auto corners = [&](const Triangle& t) {
      return std::vector<WholePoint>{ points[t[0]], points[t[1]], points[t[2]] };
    };
    const bool share = test::Pick(random, 2) == 1;
    const Triangle a = { 0, 1, 2 };
    const Triangle b = { share ? 0U : 3U, 4, 5 };
    if (!hasArea(a) || !hasArea(b))
    {
      continue;
    }
    const bool doMeet = share ? !test::AreApart(WithoutTip(corners(a)), corners(b)) ||
        !test::AreApart(WithoutTip(corners(b)), corners(a))
                              : !test::AreApart(corners(a), corners(b));
    ++seen[share ? 1 : 0][doMeet ? 1 : 0];
    const Triangle turnedA = { a[1], a[2], a[0] };
    const Triangle turnedB = { b[2], b[1], b[0] };
    ASSERT_EQ(Intersect(positions, a, b), doMeet);
    ASSERT_EQ(Intersect(positions, turnedB, turnedA), doMeet);
  }
  for (const std::array<int, 2>& each : seen)
  {
    EXPECT_GT(*std::min_element(each.begin(), each.end()), 10000);
  }
}

TEST(SelfIntersections, AreFoldsInOnePlane)
{
  const std::vector<Vector> positions = { { 0.0, 0.0, 0.0 }, { 3.0, 1.0, 0.0 }, { 0.0, 2.0, 1.0 },
    { 1.0, 2.0, 1.0 / 3.0 + 1.0 }, { 6.0, -4.0, -3.0 }, { 0.0, 2.0, 1.0 + 1e-15 } };
  const Triangle flat = { 0, 1, 2 };
  EXPECT_FALSE(Intersect(positions, flat, { 1, 0, 3 })); // hinged
  EXPECT_FALSE(Intersect(positions, flat, { 1, 0, 4 })); // goes on in the same plane
  EXPECT_FALSE(Intersect(positions, flat, { 1, 0, 5 })); // nearly on it
  EXPECT_TRUE(Intersect(positions, flat, { 1, 0, 2 }));  // on it
  std::vector<Vector> folded = positions;
  folded[3] = { 3.0, 3.0, 1.0 };
  EXPECT_TRUE(Intersect(folded, flat, { 1, 0, 3 })); // on it, and beyond
}

TEST(SelfIntersections, AreThoseOfItsEdgesWhereATriangleHasNoArea)
{
  const std::vector<Vector> positions = { { 0, 0, 0 }, { 8, 0, 0 }, { 0, 8, 8 }, // oblique
    { 5, 1, 0 }, { 6, 1, 0 }, { 7, 1, 0 },                                       // below it
    { 2, 2, 0 }, { 2, 2, 1 }, { 2, 2, 3 },                                       // through it
    { 1, 1, 1 }, { 2, 2, 2 }, { 3, 3, 3 },                                       // in its plane
    { 9, 1, 1 }, { 9, 2, 2 }, { 9, 3, 3 } };                                     // and beside it
  const Triangle oblique = { 0, 1, 2 };
  for (const auto& [flat, doMeet] :
    { std::pair(Triangle{ 3, 4, 5 }, false), std::pair(Triangle{ 6, 7, 8 }, true),
      std::pair(Triangle{ 9, 10, 11 }, true), std::pair(Triangle{ 12, 13, 14 }, false),
      std::pair(Triangle{ 3, 3, 3 }, false), std::pair(Triangle{ 9, 9, 9 }, true) })
  {
    EXPECT_EQ(Intersect(positions, oblique, flat), doMeet) << flat[0];
    EXPECT_EQ(Intersect(positions, flat, oblique), doMeet) << flat[0];
  }
}

// Of so many triangles, side by side, that several threads look at them: few stand in another one.
TEST(SelfIntersections, AreFoundAmongMany)
{
  constexpr std::uint32_t count = 9000;
  const std::vector<IntersectingPair> expected = { { 5, 0 }, { 4095, 1 }, { 4096, 4094 },
    { 4097, 8 }, { 8191, 4100 }, { 8192, 4101 }, { count - 1, 4102 } };
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const double x = 4.0 * i;
    mesh.Triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
    mesh.Positions.insert(mesh.Positions.end(), { { x, 0, 0 }, { x + 1, 0, 0 }, { x, 1, 0 } });
  }
  for (const auto& [i, other] : expected)
  {
    const double x = 4.0 * other;
    mesh.Positions[3 * i] = { x + 0.25, 0.25, -1.0 };
    mesh.Positions[3 * i + 1] = { x + 0.25, 0.25, 1.0 };
    mesh.Positions[3 * i + 2] = { x + 0.5, 0.25, 1.0 };
  }
  EXPECT_EQ(IntersectionsOf(mesh.Positions, mesh.Triangles, SerialFor), expected);
  EXPECT_EQ(IntersectionsOf(mesh.Positions, mesh.Triangles, test::ThreadedFor(3)), expected);
}

// Two sheets cross; that counts only where a triangle is not what it was.
TEST(SelfIntersections, AreFoundWhereAPartHasChanged)
{
  TriangleMesh mesh;
  AddSheet(0.0, mesh);
  const std::size_t ofSheet = mesh.Triangles.size();
  AddSheet(1.0, mesh); // cuts through the first one from the start
  const MeshPart part = PartOf(mesh);
  const SelfIntersections intersections(part);
  const auto count = static_cast<std::uint32_t>(mesh.Triangles.size());
  EXPECT_TRUE(intersections.Find(part.Simple, std::vector<bool>(count, true)).empty());
  // All triangles of the second sheet with their first two points exchanged count as new.
  LinkedTriangles turned = part.Simple;
  for (std::size_t i = ofSheet; i < count; ++i)
  {
    std::swap(turned.Triangles[i][0], turned.Triangles[i][1]);
  }
  std::vector<IntersectingPair> expected;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    for (std::uint32_t k = 0; k < i; ++k)
    {
      if (Intersect(mesh.Positions, turned.Triangles[i], turned.Triangles[k]))
      {
        expected.emplace_back(i, k);
      }
    }
  }
  EXPECT_GT(expected.size(), 4U);
  std::vector<IntersectingPair> found = intersections.Find(turned, std::vector<bool>(count, true));
  const auto sort = [](std::vector<IntersectingPair>& pairs)
  {
    for (auto& [a, b] : pairs)
    {
      if (a < b)
      {
        std::swap(a, b);
      }
    }
    std::sort(pairs.begin(), pairs.end());
  };
  sort(found);
  EXPECT_EQ(found, expected);
  // One triangle that was touched last, whichever of a pair it is; and one that is gone.
  for (const auto& pair : expected)
  {
    for (const std::uint32_t one : { pair.first, pair.second })
    {
      std::vector<bool> isTouched(count);
      isTouched[one] = true;
      std::vector<IntersectingPair> of = intersections.Find(turned, isTouched);
      sort(of);
      EXPECT_EQ(std::count(of.begin(), of.end(), pair), 1);
      LinkedTriangles without = turned;
      without.Triangles[one][0] = None;
      EXPECT_TRUE(intersections.Find(without, isTouched).empty());
    }
  }
}

TEST(SelfIntersections, AreFoundWithOtherParts)
{
  TriangleMesh mesh;
  AddSheet(0.0, mesh);
  const std::size_t ofSheet = mesh.Triangles.size();
  AddSheet(1.0, mesh);
  MeshPart part = PartOf(mesh);
  part.Others.assign(part.Simple.Triangles.begin() + static_cast<std::ptrdiff_t>(ofSheet),
    part.Simple.Triangles.end());
  part.Simple.Triangles.resize(ofSheet);
  const SelfIntersections intersections(part);
  EXPECT_TRUE(intersections.Find(part.Simple, std::vector<bool>(ofSheet, true)).empty());
  LinkedTriangles turned = part.Simple;
  std::swap(turned.Triangles[4][0], turned.Triangles[4][1]); // from x = 2
  const auto found = intersections.Find(turned, std::vector<bool>(ofSheet, true));
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0], IntersectingPair(4, None));
}

// Three parts whose new triangles meet in turn: the second and the third have to be made again, and
// what they are compared with is what the first one has become.
TEST(SelfIntersections, AreFoundBetweenPartsThatAreMadeAtTheSameTime)
{
  TriangleMesh mesh;
  for (const double height : { 1.0, 1.5, 2.0 })
  {
    AddSheet(height, mesh);
  }
  const std::size_t ofSheet = mesh.Triangles.size() / 3;
  std::vector<PartBorders::Triangles> parts;
  for (std::size_t part = 0; part < 3; ++part)
  {
    const auto begin = mesh.Triangles.begin() + static_cast<std::ptrdiff_t>(part * ofSheet);
    parts.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(ofSheet));
  }
  const auto turned = [&](std::size_t part)
  {
    PartBorders::Triangles triangles = parts[part];
    for (Triangle& triangle : triangles)
    {
      std::swap(triangle[0], triangle[1]);
    }
    triangles.back()[0] = None; // gone
    return triangles;
  };
  using Numbers = std::vector<std::uint32_t>;
  const Numbers all = { 0, 1, 2 };
  PartBorders borders(mesh.Positions, parts);
  EXPECT_TRUE(borders.Meeting(all).empty()); // nothing is new
  borders.Set(0, turned(0));
  EXPECT_TRUE(borders.Meeting(all).empty()); // others know what was there
  borders.Set(2, turned(2));
  EXPECT_EQ(borders.Meeting(all), Numbers{ 2 }); // not only with the one before
  borders.Set(1, turned(1));
  borders.Set(2, turned(2));
  EXPECT_EQ(borders.Meeting(all), (Numbers{ 1, 2 }));
  const std::vector<PartBorders::Triangles> others = borders.Others({ 1 });
  ASSERT_EQ(others.size(), 1U);
  const PartBorders::Triangles first = turned(0);
  for (const Triangle& triangle : first)
  {
    EXPECT_EQ(
      std::count(others[0].begin(), others[0].end(), triangle), triangle[0] == None ? 0 : 1);
  }
  for (const Triangle& triangle : parts[2])
  {
    EXPECT_EQ(std::count(others[0].begin(), others[0].end(), triangle), 1);
  }
  EXPECT_EQ(others[0].size(), 2 * ofSheet - 1);
  // Made again in the same way: of these two, one stays as it is.
  borders.Set(1, turned(1));
  borders.Set(2, turned(2));
  EXPECT_EQ(borders.Meeting({ 1, 2 }), Numbers{ 2 });
}

// A pyramid without a base, in which another part's triangle stands, across the base. Undoing tells
// of all that it changes, not only of what intersects.
TEST(SelfIntersections, AreUndoneAndToldOf)
{
  AllowedMesh pyramid;
  pyramid.Mesh.Positions = { { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 }, { 0, -1, 0 },
    { 0.3, 0.1, -0.5 }, { 0.3, 0.2, 0.1 }, { 0.4, 0.1, 0.1 } };
  pyramid.Mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 1 } };
  pyramid.Allowances.assign(4, 2.0);
  MeshPart part = test::WholePart(pyramid);
  part.Others = { { 5, 6, 7 } };
  const SelfIntersections intersections(part);
  EdgeCollapses collapses(part, 1.0);
  EXPECT_EQ(collapses.Run(), std::vector<bool>(4, true));
  ASSERT_EQ(test::TrianglesLeft(collapses.Mesh()).size(), 2U);
  const auto found = intersections.Find(collapses.Mesh(), std::vector<bool>(4, true));
  ASSERT_EQ(found.size(), 1U);
  std::vector<bool> isTouched(4);
  isTouched[found[0].first] = true;
  intersections.Undo(collapses, isTouched);
  EXPECT_EQ(test::TrianglesLeft(collapses.Mesh()).size(), 4U);
  EXPECT_EQ(isTouched, std::vector<bool>(4, true));
}
