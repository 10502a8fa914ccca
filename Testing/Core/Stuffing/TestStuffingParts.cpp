// SPDX-License-Identifier: BSD-3-Clause
// The parts of Stuffing, one by one, on small meshes where it is known what should happen.
#include "Tools/CoreTestTools.h"
#include "Tools/RandomTestTools.h"
#include "Tools/StuffingTestTools.h"

#include "Patches/IntervalPatches.h"
#include "Stuffing/Background.h"
#include "Stuffing/BestPlace.h"
#include "Stuffing/Detours.h"
#include "Stuffing/Improvement.h"
#include "Stuffing/LocalMesh.h"
#include "Stuffing/ReturnedPoints.h"
#include "Stuffing/RingFilling.h"
#include "Stuffing/SurfaceChanges.h"
#include "Stuffing/SurfaceLinks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace isodiamond;

namespace
{

/** Tetrahedra of points, turned so that they are positive. */
TetrahedronMesh MeshOf(const std::vector<Vector>& points, std::vector<Corners> tetrahedra)
{
  TetrahedronMesh mesh;
  mesh.Positions = points;
  mesh.Surfaces.assign(points.size(), 0);
  mesh.OnWalls.assign(points.size(), 0);
  for (Corners& corners : tetrahedra)
  {
    if (SixVolumes(points[corners[0]], points[corners[1]], points[corners[2]], points[corners[3]]) <
      0.0)
    {
      std::swap(corners[2], corners[3]);
    }
    mesh.Tetrahedra.push_back(corners);
    mesh.Origins.push_back(static_cast<std::uint32_t>(mesh.Origins.size()));
  }
  return mesh;
}

/** The smallest sine, by angles; negative if a tetrahedron is not positive. */
double WorstSine(const std::vector<Vector>& points, const std::vector<Corners>& tetrahedra)
{
  const double degree = std::acos(-1.0) / 180.0;
  double worst = 1.0;
  for (const Corners& t : tetrahedra)
  {
    const auto [least, most] =
      DihedralAngles(points[t[0]], points[t[1]], points[t[2]], points[t[3]]);
    const bool isPositive =
      SixVolumes(points[t[0]], points[t[1]], points[t[2]], points[t[3]]) > 0.0;
    const double sine = std::min(std::sin(degree * least), std::sin(degree * most));
    worst = std::min(worst, isPositive ? sine : -sine);
  }
  return worst;
}

/** The tetrahedra of a rough octahedron around point 0, which is somewhere in it. */
TetrahedronMesh Octahedron(test::Random& random)
{
  std::vector<Vector> points = { { test::Uniform(random, -0.4, 0.4),
    test::Uniform(random, -0.4, 0.4), test::Uniform(random, -0.4, 0.4) } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      Vector point{};
      for (double& coordinate : point)
      {
        coordinate = test::Uniform(random, -0.2, 0.2);
      }
      point[axis] += side;
      points.push_back(point);
    }
  }
  std::vector<Corners> tetrahedra;
  for (std::uint32_t i = 0; i < 8; ++i)
  {
    tetrahedra.push_back({ 0, 1 + i % 2, 3 + i / 2 % 2, 5 + i / 4 });
  }
  return MeshOf(points, tetrahedra);
}

PointStar StarOf(const TetrahedronMesh& mesh, std::uint32_t point)
{
  PointStar star;
  for (const Corners& corners : mesh.Tetrahedra)
  {
    star.Add(mesh, corners, point);
  }
  return star;
}

/** All triangulations of a polygon whose corners are numbered from first to last. */
std::vector<std::vector<Face>> Triangulations(int first, int last)
{
  if (last - first < 2)
  {
    return { {} };
  }
  std::vector<std::vector<Face>> all;
  for (int middle = first + 1; middle < last; ++middle)
  {
    for (const std::vector<Face>& left : Triangulations(first, middle))
    {
      for (const std::vector<Face>& right : Triangulations(middle, last))
      {
        std::vector<Face> faces = left;
        faces.insert(faces.end(), right.begin(), right.end());
        faces.push_back({ static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(middle),
          static_cast<std::uint32_t>(last) });
        all.push_back(faces);
      }
    }
  }
  return all;
}

/** Six triangles of the lower surface around point 0, which is at a height, over point 7. */
TetrahedronMesh Tent(double height)
{
  std::vector<Vector> points = { { 0.0, 0.0, height } };
  std::vector<Corners> tetrahedra;
  for (std::uint32_t i = 0; i < 6; ++i)
  {
    const double angle = i * std::acos(-1.0) / 3.0;
    points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    tetrahedra.push_back({ 0, 1 + i, 1 + (i + 1) % 6, 7 });
  }
  points.push_back({ 0.0, 0.0, -1.0 });
  TetrahedronMesh mesh = MeshOf(points, tetrahedra);
  std::fill_n(mesh.Surfaces.begin(), 7, -1);
  return mesh;
}

/** Two triangles of the upper surface, over point 4. They share the edge from point 0 to point 1,
 *  which is at a height above points 2 and 3. */
TetrahedronMesh Roof(double height)
{
  TetrahedronMesh mesh = MeshOf({ { 0.0, -1.0, height }, { 0.0, 1.0, height }, { 1.0, 0.0, 0.0 },
                                  { -1.0, 0.0, 0.0 }, { 0.0, 0.0, -1.0 } },
    { { 0, 1, 2, 4 }, { 0, 1, 3, 4 } });
  std::fill_n(mesh.Surfaces.begin(), 4, 1);
  return mesh;
}

bool CanTurnRoof(const TetrahedronMesh& mesh, double distance)
{
  const LocalMesh local(mesh);
  LocalMesh::Ring ring;
  EXPECT_TRUE(local.FindRing(0, 1, 7, ring));
  EXPECT_FALSE(ring.IsClosed);
  return CanTurn(local, 0, 1, ring, distance);
}

}

TEST(InSteps, DoesAllInOrderAndSoManyAtOnce)
{
  for (const std::size_t count : { 0U, 1U, 16U, 33U })
  {
    std::vector<std::size_t> done;
    std::vector<std::size_t> sizes;
    const auto step = [&](std::int64_t many, std::int64_t grain,
                        const std::function<void(std::int64_t, std::int64_t)>& body)
    {
      const std::size_t before = done.size();
      SerialFor(many, grain, body);
      sizes.push_back(done.size() - before);
    };
    InSteps(step, count, 16, [&](std::size_t i) { done.push_back(i); });
    EXPECT_EQ(done.size(), count);
    EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
    EXPECT_EQ(sizes.size(), (count + 15) / 16);
    EXPECT_TRUE(
      std::all_of(sizes.begin(), sizes.end(), [](std::size_t size) { return size <= 16; }));
  }
}

TEST(RingFilling, IsTheBestOfAll)
{
  test::Random random(5);
  for (int round = 0; round < 200; ++round)
  {
    const int count = 3 + round % 5;
    std::vector<Vector> points = { { 0.0, 0.0, -1.0 }, { 0.1, 0.2, 1.0 } };
    std::vector<std::uint32_t> ring;
    std::vector<Corners> tetrahedra;
    for (int i = 0; i < count; ++i)
    {
      const double angle = (i + test::Uniform(random, -0.2, 0.2)) * 2.0 * std::acos(-1.0) / count;
      const double radius = test::Uniform(random, 0.6, 1.5);
      points.push_back(
        { radius * std::cos(angle), radius * std::sin(angle), test::Uniform(random, -0.4, 0.4) });
      ring.push_back(static_cast<std::uint32_t>(2 + i));
      tetrahedra.push_back({ 0, 1, ring.back(), static_cast<std::uint32_t>(2 + (i + 1) % count) });
    }
    const LocalMesh mesh(MeshOf(points, tetrahedra));
    std::vector<Corners> fresh;
    const double sine = FillRing(mesh, 0, 1, ring, fresh);
    double best = -HUGE_VAL;
    for (const std::vector<Face>& faces : Triangulations(0, count - 1))
    {
      std::vector<Corners> made;
      for (const Face& face : faces)
      {
        made.push_back({ ring[face[0]], ring[face[1]], ring[face[2]], 1 });
        made.push_back({ ring[face[0]], ring[face[2]], ring[face[1]], 0 });
      }
      best = std::max(best, WorstSine(points, made));
    }
    EXPECT_NEAR(sine, best, 1e-9);
    EXPECT_EQ(fresh.size(), 2U * (count - 2));
    EXPECT_NEAR(WorstSine(points, fresh), best, 1e-9);
  }
}

TEST(BestPlace, IsBetterAndTellsItsSine)
{
  test::Random random(6);
  int better = 0;
  for (int round = 0; round < 200; ++round)
  {
    TetrahedronMesh mesh = Octahedron(random);
    const double before = WorstSine(mesh.Positions, mesh.Tetrahedra);
    PointStar star = StarOf(mesh, 0);
    const Vector from = mesh.Positions[0];
    const PlacedPoint best = BestPlace(star, from, 0, test::UnitAxes, 1.0);
    mesh.Positions[0] = best.Place;
    EXPECT_NEAR(WorstSine(mesh.Positions, mesh.Tetrahedra), best.Sine, 1e-9);
    EXPECT_GE(best.Sine, before - 1e-9);
    EXPECT_GT(best.Sine, 0.25);
    better += best.Sine > before + 0.05 ? 1 : 0;
    // A fixed point stays.
    const PlacedPoint same = BestPlace(star, best.Place, Walls::Fixed, test::UnitAxes, 1.0);
    EXPECT_EQ(same.Place, best.Place);
    EXPECT_NEAR(same.Sine, best.Sine, 1e-12);
  }
  EXPECT_GT(better, 100);
}

TEST(BestPlace, StaysOnWalls)
{
  test::Random random(7);
  int moved = 0;
  for (int walls = 1; walls < 64; ++walls)
  {
    const TetrahedronMesh mesh = Octahedron(random);
    PointStar star = StarOf(mesh, 0);
    const Vector from = mesh.Positions[0];
    const PlacedPoint best =
      BestPlace(star, from, static_cast<Walls::Type>(walls), test::UnitAxes, 1.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (((walls >> (2 * axis)) & 3) != 0)
      {
        EXPECT_NEAR(best.Place[axis], from[axis], 1e-12);
      }
    }
    const bool isCorner = (walls & 3) != 0 && (walls & 12) != 0 && (walls & 48) != 0;
    EXPECT_TRUE(!isCorner || best.Place == from);
    moved += best.Place == from ? 0 : 1;
  }
  EXPECT_GT(moved, 30); // of 36
}

TEST(BestPlace, StaysWithinReach)
{
  test::Random random(16);
  double farthest = 0.0;
  for (int round = 0; round < 50; ++round)
  {
    const TetrahedronMesh mesh = Octahedron(random);
    PointStar star = StarOf(mesh, 0);
    const Vector from = mesh.Positions[0];
    const auto length = [&](const Vector& place)
    { return std::sqrt(Dot(place - from, place - from)); };
    const Reach reach{ 0.05, [&](const Vector& place) { return length(place) <= 0.1; } };
    const PlacedPoint best = BestPlace(star, from, 0, test::UnitAxes, 1.0, reach);
    EXPECT_LE(length(best.Place), 0.1);
    farthest = std::max(farthest, length(best.Place));
  }
  EXPECT_GT(farthest, 0.09);
}

// Where a world has no directions, points stay, even if they are in a wrong place.
TEST(BestPlace, IsAlwaysAPlace)
{
  test::Random random(8);
  TetrahedronMesh mesh = Octahedron(random);
  PointStar star = StarOf(mesh, 0);
  const Vector outside = { 5.0, 4.0, 3.0 };
  const PlacedPoint best = BestPlace(star, outside, 1, {}, 1.0);
  EXPECT_EQ(best.Place, outside);
  EXPECT_LT(best.Sine, 0.0);
}

TEST(SurfaceChanges, StayNearByTheHeightOfWhatGoes)
{
  for (const double height : { 0.1, 0.3 })
  {
    const LocalMesh tent(Tent(height));
    for (std::uint32_t to = 1; to <= 6; ++to)
    {
      EXPECT_TRUE(StaysNear(tent, 0, to, 1.01 * height));
      EXPECT_FALSE(StaysNear(tent, 0, to, 0.99 * height));
    }
    EXPECT_TRUE(StaysNear(tent, 7, 1, 0.0)); // on no surface
  }
}

TEST(SurfaceChanges, ShiftPointsInASpindleAwayFromWhatIsBeyondOrToTheMiddle)
{
  const CutSide edge{ { 1.0, 2.0, 0.0 }, { 1.0, 2.0, 2.0 }, 2.0 };
  const auto canBe = [&](double before, double aside, double after) {
    return IsBeside(edge, { 1.0, 2.0, before }, { 1.0 + aside, 2.0, after });
  };
  EXPECT_TRUE(canBe(0.1, 0.0, 0.99)); // near the end inside: as far as the middle
  EXPECT_FALSE(canBe(0.1, 0.0, 1.01));
  EXPECT_FALSE(canBe(0.1, 0.0, -0.01));
  EXPECT_TRUE(canBe(1.9, 0.0, 1.85)); // near the end beyond: only away from it
  EXPECT_FALSE(canBe(1.9, 0.0, 1.91));
  EXPECT_FALSE(canBe(2.0, 0.0, 2.01));
  EXPECT_TRUE(canBe(1.0, 0.29, 1.0)); // to the side, by 0.3 of the nearer end's distance
  EXPECT_FALSE(canBe(1.0, 0.31, 1.0));
  EXPECT_TRUE(canBe(0.5, 0.14, 0.5));
  EXPECT_FALSE(canBe(0.5, 0.16, 0.5));
  EXPECT_FALSE(canBe(1.9, 0.04, 1.9));
}

// To the side, as long as no triangle is folded.
TEST(SurfaceChanges, ShiftNoPointOverTheRim)
{
  const LocalMesh tent(Tent(0.1));
  EXPECT_TRUE(CanShift(tent, 0, { 0.5, 0.0, 0.1 }));
  EXPECT_FALSE(CanShift(tent, 0, { 1.2, 0.0, 0.1 }));
}

// A corner of the rim is pulled in: a collapse into the one beside it would turn a triangle over.
TEST(SurfaceChanges, FoldNothing)
{
  TetrahedronMesh mesh = Tent(0.05);
  mesh.Positions[3] = 0.2 * mesh.Positions[3];
  const LocalMesh tent(mesh);
  EXPECT_FALSE(StaysNear(tent, 0, 2, 10.0));
  EXPECT_TRUE(StaysNear(tent, 0, 6, 10.0));
}

TEST(SurfaceChanges, TurnEdgesThatAreFlat)
{
  EXPECT_TRUE(CanTurnRoof(Roof(0.5), 0.51));
  EXPECT_FALSE(CanTurnRoof(Roof(0.5), 0.49));
  EXPECT_TRUE(CanTurnRoof(Roof(0.57), 10.0)); // up to 60 degrees between the normals
  EXPECT_FALSE(CanTurnRoof(Roof(0.585), 10.0));
  for (std::size_t i = 0; i < 4; ++i)
  {
    TetrahedronMesh mesh = Roof(0.1);
    mesh.Surfaces[i] = -1;
    EXPECT_FALSE(CanTurnRoof(mesh, 10.0));
  }
  TetrahedronMesh wall = Roof(0.0);
  std::fill_n(wall.Surfaces.begin(), 4, 0);
  EXPECT_FALSE(CanTurnRoof(wall, 10.0));
  std::fill_n(wall.OnWalls.begin(), 4, 2);
  EXPECT_TRUE(CanTurnRoof(wall, 0.0));
  TetrahedronMesh curved = wall; // a wall's shape is the grid's, and is not measured
  curved.Positions = Roof(0.5).Positions;
  EXPECT_TRUE(CanTurnRoof(curved, 0.0));
  wall.OnWalls[3] = 4;
  EXPECT_FALSE(CanTurnRoof(wall, 0.0));
  std::fill_n(wall.OnWalls.begin(), 4, Walls::Fixed);
  EXPECT_FALSE(CanTurnRoof(wall, 10.0));
}

// Two tetrahedra, one on each side of a triangle: nothing would be left of them.
TEST(LocalMesh, CollapsesNoEdgeWhoseEndsHaveMoreInCommonOnTheBoundary)
{
  const LocalMesh mesh(
    MeshOf({ { 1, 0, 0 }, { -0.5, 0.8, 0 }, { -0.5, -0.8, 0 }, { 0, 0, 1 }, { 0, 0, -1 } },
      { { 0, 1, 2, 3 }, { 0, 1, 2, 4 } }));
  EXPECT_FALSE(mesh.CanCollapse(0, 1));
  EXPECT_FALSE(mesh.CanCollapse(1, 2));
}

TEST(LocalMesh, CollapsesAPointInside)
{
  test::Random random(11);
  for (std::uint32_t to = 1; to <= 6; ++to)
  {
    LocalMesh mesh(Octahedron(random));
    EXPECT_TRUE(mesh.CanCollapse(0, to));
    std::vector<std::uint32_t> changed;
    mesh.Collapse(0, to, changed);
    EXPECT_EQ(changed.size(), 4U);
    EXPECT_EQ(mesh.StarOf(to).end() - mesh.StarOf(to).begin(), 4);
    EXPECT_EQ(mesh.StarOf(0).end() - mesh.StarOf(0).begin(), 0);
    const TetrahedronMesh left = mesh.Take();
    EXPECT_EQ(left.Tetrahedra.size(), 4U);
    EXPECT_TRUE(std::all_of(left.Tetrahedra.begin(), left.Tetrahedra.end(),
      [&](const Corners& corners) { return Has(corners, to); }));
  }
}

TEST(LocalMesh, TellsWhatCouldBeOnASurfaceOrOnAWall)
{
  test::Random random(12);
  for (const int surface : { -1, 0, 1 })
  {
    for (const int wall : { 0, 1, 32 })
    {
      TetrahedronMesh mesh = Octahedron(random);
      for (const std::uint32_t point : { 1U, 3U, 5U })
      {
        mesh.Surfaces[point] = static_cast<std::int8_t>(surface);
        mesh.OnWalls[point] = static_cast<Walls::Type>(wall);
      }
      EXPECT_EQ(LocalMesh(mesh).IsAmbiguous({ 0, 1, 3, 5 }), surface != 0 && wall != 0);
      EXPECT_FALSE(LocalMesh(mesh).IsAmbiguous({ 0, 2, 3, 5 }));
      const int place = LocalMesh(mesh).PlaceOfFace(1, 3, 5);
      EXPECT_EQ(place,
        wall != 0        ? wall
          : surface == 0 ? 0
          : surface == 1 ? LocalMesh::UpperSurface
                         : LocalMesh::LowerSurface);
    }
  }
}

// Two flat tetrahedra whose points stay become three, around an edge through their common face.
TEST(Improvement, RemovesFaces)
{
  test::Random random(13);
  int removed = 0;
  for (int round = 0; round < 300; ++round)
  {
    std::vector<Vector> points = { { 0.0, 0.0, test::Uniform(random, 0.05, 0.4) },
      { 0.0, 0.0, test::Uniform(random, -1.0, -0.05) } };
    for (int i = 0; i < 3; ++i)
    {
      const double angle = (i + test::Uniform(random, -0.15, 0.15)) * 2.0 * std::acos(-1.0) / 3.0;
      points.push_back({ std::cos(angle), std::sin(angle), test::Uniform(random, -0.02, 0.02) });
    }
    TetrahedronMesh two = MeshOf(points, { { 2, 3, 4, 0 }, { 2, 3, 4, 1 } });
    std::fill(two.OnWalls.begin(), two.OnWalls.end(), Walls::Fixed);
    const TetrahedronMesh three =
      MeshOf(points, { { 0, 1, 2, 3 }, { 0, 1, 3, 4 }, { 0, 1, 4, 2 } });
    const double before = WorstSine(points, two.Tetrahedra);
    const double after = WorstSine(points, three.Tetrahedra);
    ImprovementOptions options;
    const double wanted = std::sin(std::acos(-1.0) / 180.0 * options.WantedAngle);
    const TetrahedronMesh improved = Improve(two, options, SerialFor);
    const bool shallBe = before < wanted && after > before + 0.01;
    EXPECT_EQ(improved.Tetrahedra.size(), shallBe ? 3U : 2U) << before << " " << after;
    EXPECT_NEAR(WorstSine(points, improved.Tetrahedra), shallBe ? after : before, 1e-9);
    removed += shallBe ? 1 : 0;
  }
  EXPECT_GT(removed, 50);
  EXPECT_LT(removed, 250);
}

// A flat tetrahedron: only its top, on a surface, can move.
TEST(Improvement, ShiftsPointsOfSurfacesIfNothingElseHelps)
{
  TetrahedronMesh flat =
    MeshOf({ { 0.0, 0.0, 0.05 }, { 1.0, 0.0, 0.0 }, { -0.5, 0.9, 0.0 }, { -0.5, -0.9, 0.0 } },
      { { 0, 1, 2, 3 } });
  std::fill(flat.OnWalls.begin() + 1, flat.OnWalls.end(), Walls::Fixed);
  flat.Surfaces[0] = 1;
  ImprovementOptions options;
  options.Axes = test::UnitAxes;
  const auto improve = [&](double move, const CutSide& edge)
  {
    options.SurfaceMove = move;
    options.CutEdges = { edge, {}, {}, {} };
    return TakeDetours(Improve(flat, options, SerialFor), options, SerialFor);
  };
  const CutSide rising{ { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, 1.0 };
  const TetrahedronMesh round = improve(0.2, rising);
  EXPECT_GE(DihedralAngles(round)[0], options.WantedAngle);
  ASSERT_EQ(round.Blended.size(), 1U);
  EXPECT_EQ(round.Blended[0].Point, 4U);
  EXPECT_EQ(round.Blended[0].Shares.at(0).Point, 0U);
  EXPECT_EQ(round.Surfaces[4], 1);
  EXPECT_EQ(round.Positions[0], flat.Positions[0]); // where the surface was
  EXPECT_TRUE(Has(round.Tetrahedra.at(0), 4) && !Has(round.Tetrahedra[0], 0));

  // No farther than allowed, at once or in steps, nor than a quarter of its edge.
  for (const auto& [move, length] : { std::pair(0.04, 1.0), std::pair(0.2, 0.16) })
  {
    const TetrahedronMesh better =
      improve(move, { { 0.0, 0.0, 0.04 }, { 0.0, 0.0, 0.04 + length }, length });
    EXPECT_GT(DihedralAngles(better)[0], DihedralAngles(flat)[0]);
    EXPECT_LE(better.Positions.back()[2], 0.09 + 1e-12);
  }
  // Not towards the end beyond, and not at all if the edge is unknown.
  const TetrahedronMesh aside = improve(0.2, { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.06 }, 0.06 });
  ASSERT_EQ(aside.Positions.size(), 5U);
  EXPECT_LE(aside.Positions[4][2], 0.05);
  EXPECT_GT(DihedralAngles(aside)[0], DihedralAngles(flat)[0]);
  options.CutEdges.clear();
  EXPECT_EQ(Improve(flat, options, SerialFor).Positions.size(), 4U);
}

TEST(ReturnedPoints, AreThoseOfSurfacesThatFoldNothingAndLeaveGoodTetrahedra)
{
  const std::vector<Vector> base = { { 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  const auto doesReturn = [&](const Vector& source, std::int8_t surface, double wanted)
  {
    std::vector<Vector> points = base;
    points.push_back(source);
    points.push_back({ 0.3, 0.3, 1.0 }); // where it is now
    TetrahedronMesh mesh = MeshOf(points, { { 0, 1, 2, 4 } });
    mesh.Surfaces[3] = surface;
    mesh.Surfaces[4] = surface;
    mesh.Blended.push_back({ 4, { { 3, 1.0 } } });
    return Has(ReturnPoints(mesh, wanted).Tetrahedra.at(0), 3);
  };
  const Vector below = { 0.3, 0.3, 0.5 };
  const double sine = WorstSine({ base[0], base[1], base[2], below }, { { 0, 1, 2, 3 } });
  for (const std::int8_t surface : { -1, 1 })
  {
    EXPECT_TRUE(doesReturn(below, surface, 0.999 * sine));
    EXPECT_FALSE(doesReturn(below, surface, 1.001 * sine));
    EXPECT_TRUE(doesReturn({ 0.5, 0.5, 0.6 }, surface, 0.0));
    EXPECT_FALSE(doesReturn({ 2.0, 2.0, 0.3 }, surface, 0.0)); // folds one triangle
  }
  EXPECT_FALSE(doesReturn(below, 0, 0.999 * sine));
}

TEST(LocalMesh, FindsRings)
{
  test::Random random(9);
  const TetrahedronMesh octahedron = Octahedron(random);
  const LocalMesh mesh(octahedron);
  LocalMesh::Ring ring;
  for (std::uint32_t point = 1; point <= 6; ++point)
  {
    ASSERT_TRUE(mesh.FindRing(0, point, 4, ring));
    EXPECT_TRUE(ring.IsClosed);
    EXPECT_EQ(ring.Points.size(), 4U);
    EXPECT_EQ(ring.Tetrahedra.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_GT(mesh.SineOf(Corners{ 0, point, ring.Points[i], ring.Points[(i + 1) % 4] }), 0.0);
    }
    EXPECT_FALSE(mesh.FindRing(0, point, 3, ring));
  }
  ASSERT_TRUE(mesh.FindRing(1, 3, 7, ring));
  EXPECT_FALSE(ring.IsClosed);
  EXPECT_EQ(ring.Points.size(), 3U);
  EXPECT_EQ(ring.Points[1], 0U);
  EXPECT_FALSE(mesh.FindRing(1, 2, 7, ring)); // no edge
  const LocalMesh twoPaths(
    MeshOf({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 1, 1, 0 }, { -1, 0, 0 }, { -1, -1, 0 } },
      { { 0, 1, 2, 3 }, { 0, 1, 4, 5 } }));
  EXPECT_FALSE(twoPaths.FindRing(0, 1, 7, ring));
}

// A vertex in a tetrahedron with two corners on the surface, and other tetrahedra around the edge
// between these corners.
TEST(SurfaceLinks, WantOneRunOfVerticesInsideAroundOppositeEdges)
{
  constexpr std::uint32_t vertex = 0;
  constexpr std::uint32_t a = 1;
  constexpr std::uint32_t b = 2;
  constexpr std::array<std::uint32_t, 4> ring = { 3, 4, 5, 6 };
  constexpr std::uint32_t behindA = 7;
  constexpr std::uint32_t behindB = 8;
  CutMesh mesh;
  mesh.Vertices.resize(9);
  const auto add = [&mesh](const Corners& corners)
  {
    mesh.Tetrahedra.emplace_back();
    mesh.Tetrahedra.back().Vertices = corners;
  };
  for (const std::uint32_t end : { ring[0], ring[3] })
  {
    add({ vertex, a, b, end });
  }
  add({ vertex, a, ring[0], ring[3] });
  add({ vertex, b, ring[0], ring[3] });
  for (int i = 0; i < 4; ++i)
  {
    const std::uint32_t next = ring[(i + 1) % 4];
    add({ behindA, a, ring[i], next });
    add({ behindB, b, ring[i], next });
    if (i < 3)
    {
      add({ a, b, ring[i], next });
    }
  }
  const std::vector<Vector> positions(mesh.Vertices.size());
  const Background background(
    mesh, positions, std::vector<Walls::Type>(mesh.Vertices.size(), 0), positions, false);
  constexpr std::uint8_t inside = OnLower + 1;
  for (const bool isTwice : { false, true })
  {
    VertexPlaces places(mesh);
    std::vector<std::uint8_t>& states = places.States;
    states[vertex] = states[a] = states[b] = OnLower;
    states[behindA] = states[behindB] = states[ring[0]] = inside;
    states[ring[2]] = isTwice ? inside : 0;
    const SurfaceLinks links(background, places);
    EXPECT_TRUE(links.CanBeOn(vertex, 0, false));
    EXPECT_EQ(links.CanBeOn(vertex, 0, true), !isTwice);
  }
}

// A moved point is blended from the corners of the tetrahedron that it is now in: no share is
// negative.
TEST(LocalMesh, BlendsWhatIsAroundTheNewPlace)
{
  test::Random random(10);
  for (int round = 0; round < 50; ++round)
  {
    LocalMesh mesh(Octahedron(random));
    const Vector to = { test::Uniform(random, -0.2, 0.2), test::Uniform(random, -0.2, 0.2),
      test::Uniform(random, -0.2, 0.2) };
    const std::vector<Vector> before = mesh.Mesh().Positions;
    mesh.Move(0, to);
    ASSERT_EQ(mesh.Mesh().Blended.size(), 1U);
    Vector sum{};
    for (const Share& share : mesh.Mesh().Blended[0].Shares)
    {
      EXPECT_GE(share.Part, -1e-12);
      sum = sum + share.Part * before[share.Point];
    }
    EXPECT_NEAR(Dot(sum - to, sum - to), 0.0, 1e-20);
    EXPECT_NEAR(
      mesh.WorstAround(0), WorstSine(mesh.Mesh().Positions, mesh.Mesh().Tetrahedra), 1e-9);
  }
}
