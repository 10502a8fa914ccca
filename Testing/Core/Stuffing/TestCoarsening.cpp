// SPDX-License-Identifier: BSD-3-Clause
// Coarser meshes for simulations: promises by brute force, what stays as it is, and undoing.
#include "Tools/RandomTestTools.h"
#include "Tools/StuffingTestTools.h"

#include "Stuffing/Coarsening.h"
#include "Stuffing/Relaxation.h"
#include "Stuffing/TetrahedronCollapses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace isodiamond;

namespace
{

/** A stuffed mesh, made coarser. */
struct Coarsened
{
  test::Stuffed Result;
  std::vector<std::uint32_t> FarLeaves;

  /** @param canBeFiner the same for all leaves */
  Coarsened(const test::Stuffed& stuffed, double allowance, bool canBeFiner,
    bool keepsInside = false, double usedPart = 0.75)
    : Result(stuffed)
  {
    const TetrahedronMesh plain = stuffed.PlainMesh();
    const std::vector<double> allowances(stuffed.LeafCount, allowance);
    const std::vector<bool> finer(stuffed.LeafCount, canBeFiner);
    this->FarLeaves = Coarsen(this->Result.Mesh,
      { plain, allowances, finer, keepsInside, usedPart, test::UnitAxes }, SerialFor);
  }
};

/** The sine of 16 degrees, the least dihedral angle that collapses make, less some for rounding. */
constexpr double LeastSine = 0.27563;

double WorstSine(const TetrahedronMesh& mesh)
{
  double worst = 1.0;
  for (const Corners& corners : mesh.Tetrahedra)
  {
    worst = std::min(worst, SmallestSine(mesh, corners));
  }
  return worst;
}

test::Stuffed Gyroid(double tolerance, const Isoregion& region = { 0.1, HUGE_VAL })
{
  Query query;
  query.Tolerance = tolerance;
  return { *test::BuildVolume(test::GyroidField(33, 1.5), region).Hierarchy, query };
}

/** The volume that a mesh has, to be kept. */
VolumeRange OwnVolume(const TetrahedronMesh& mesh)
{
  const double volume = VolumeOf(mesh);
  return { volume, volume };
}

/** By point: the length of its longest edge. */
std::vector<double> LongestEdges(const TetrahedronMesh& mesh)
{
  std::vector<double> longest(mesh.Positions.size());
  for (const Corners& corners : mesh.Tetrahedra)
  {
    for (const std::uint32_t a : corners)
    {
      for (const std::uint32_t b : corners)
      {
        const Vector edge = mesh.Positions[b] - mesh.Positions[a];
        longest[a] = std::max(longest[a], std::sqrt(Dot(edge, edge)));
      }
    }
  }
  return longest;
}

/** The triangles that are there, each beginning with its least point. */
std::set<Triangle> SetOf(const std::vector<Triangle>& triangles)
{
  std::set<Triangle> all;
  for (Triangle triangle : triangles)
  {
    if (triangle[0] != None)
    {
      std::rotate(
        triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
      all.insert(triangle);
    }
  }
  return all;
}

/** The tetrahedra, each with its corners sorted, whatever their order in the mesh. */
std::set<Corners> SetOf(const TetrahedronMesh& mesh)
{
  std::set<Corners> all;
  for (Corners corners : mesh.Tetrahedra)
  {
    std::sort(corners.begin(), corners.end());
    all.insert(corners);
  }
  return all;
}

}

TEST(Coarsening, KeepsPromiseShapeAndTopologyOfRandomFields)
{
  std::size_t before = 0;
  std::size_t after = 0;
  test::ForRandomVolumes(
    [&](test::Random& random, const test::RandomSamples& samples, const BuildOptions& options,
      const test::Built& built)
    {
      const Query query = test::RandomQuery(random, *built.Hierarchy, options.World);
      const test::Stuffed stuffed(*built.Hierarchy, query);
      const double allowance = std::exp(test::Uniform(random, -3.0, 1.5));
      const bool canBeFiner = random() % 2 == 0;
      const bool keepsInside = random() % 4 == 0;
      // If samples may use too much, measuring has to find what is too far away.
      const double usedPart = random() % 2 == 0 ? 0.75 : 4.0;
      const Coarsened coarse(stuffed, allowance, canBeFiner, keepsInside, usedPart);
      const test::Volume volume = coarse.Result.AsVolume();
      if (!coarse.FarLeaves.empty())
      {
        EXPECT_TRUE(canBeFiner);
        EXPECT_EQ(coarse.Result.Mesh.Tetrahedra, stuffed.Mesh.Tetrahedra);
        return;
      }
      before += stuffed.Mesh.Tetrahedra.size();
      after += coarse.Result.Mesh.Tetrahedra.size();
      EXPECT_EQ(test::FindFault(volume, samples.Dimensions), "");
      const test::AnyMesh plain(*built.Hierarchy, query);
      EXPECT_EQ(test::TopologyOf(volume, plain), test::Topology(plain));
      EXPECT_GE(WorstSine(coarse.Result.Mesh), std::min(WorstSine(stuffed.Mesh), LeastSine));
      if (canBeFiner)
      {
        EXPECT_EQ(test::FarByForce(stuffed.Plain, volume, 1.0001 * allowance), "");
      }
      std::set<std::array<double, 3>> points;
      for (const Corners& corners : stuffed.Mesh.Tetrahedra)
      {
        for (const std::uint32_t point : corners)
        {
          points.insert(stuffed.Mesh.Positions[point]);
        }
      }
      std::size_t inside = 0;
      for (std::size_t i = 0; i < volume.Points.size(); ++i)
      {
        EXPECT_TRUE(
          points.erase(volume.Points[i]) == 1 || (volume.Surfaces[i] == 0 && !keepsInside));
        inside += volume.Surfaces[i] == 0 ? 1 : 0;
      }
      if (keepsInside)
      {
        const test::Volume all = stuffed.AsVolume();
        EXPECT_EQ(inside, std::count(all.Surfaces.begin(), all.Surfaces.end(), 0));
      }
    });
  EXPECT_LT(after, before);
}

TEST(Coarsening, SavesMostOfSmoothSurfaces)
{
  const test::Stuffed stuffed = Gyroid(0.1);
  const Coarsened coarse(stuffed, 0.5, true);
  ASSERT_TRUE(coarse.FarLeaves.empty());
  EXPECT_LT(coarse.Result.Mesh.Tetrahedra.size(), stuffed.Mesh.Tetrahedra.size() / 2);
  EXPECT_EQ(test::FarByForce(stuffed.Plain, coarse.Result.AsVolume(), 0.5), "");
  EXPECT_NEAR(VolumeOf(coarse.Result.Mesh) / VolumeOf(stuffed.PlainMesh()), 1.0, 0.01);
  // No edge gets much longer than those around it were, so the inside stays fine.
  const std::vector<double> before = LongestEdges(stuffed.Mesh);
  const TetrahedronMesh& mesh = coarse.Result.Mesh;
  for (const Corners& corners : mesh.Tetrahedra)
  {
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const Vector edge = mesh.Positions[corners[i]] - mesh.Positions[corners[j]];
        const bool isInside = mesh.Surfaces[corners[i]] == 0 && mesh.Surfaces[corners[j]] == 0;
        const double most =
          (isInside ? 1.25 : 2.0) * std::max(before[corners[i]], before[corners[j]]);
        EXPECT_LE(std::sqrt(Dot(edge, edge)), most + 1e-9);
      }
    }
  }
}

// Sheets in noise are less than what is allowed apart.
TEST(Coarsening, LetsNoSheetsThroughEachOther)
{
  int seen = 0;
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    const test::Field field = test::NoiseField({ 9, 9, 9 }, seed);
    const test::Stuffed stuffed(*test::BuildVolume(field, { 3.7, HUGE_VAL }).Hierarchy, Query{});
    if (test::CountIntersections(stuffed.Mesh) == 0)
    {
      const Coarsened coarser(stuffed, 2.0, false);
      EXPECT_LT(coarser.Result.Mesh.Tetrahedra.size(), stuffed.Mesh.Tetrahedra.size());
      EXPECT_EQ(test::CountIntersections(coarser.Result.Mesh), 0U) << seed;
      ++seen;
    }
  }
  EXPECT_GT(seen, 3);
}

// Two surfaces that may move farther than they are apart: gained and lost volume has to balance.
TEST(Coarsening, KeepsTheVolumeOfWhatIsThin)
{
  const test::Stuffed stuffed = Gyroid(0.3, { -0.2, 0.2 });
  const Coarsened coarse(stuffed, 2.0, true);
  ASSERT_TRUE(coarse.FarLeaves.empty());
  EXPECT_LT(coarse.Result.Mesh.Tetrahedra.size(), stuffed.Mesh.Tetrahedra.size() * 3 / 4);
  const double wanted = VolumeOf(stuffed.PlainMesh());
  EXPECT_NEAR(VolumeOf(coarse.Result.Mesh), wanted, std::abs(VolumeOf(stuffed.Mesh) - wanted));
}

// A ball, which loses volume as it gets coarser, and what is around it, which gains some: if the
// volume at tolerance is known, the result's may lie between, but not beyond.
TEST(Coarsening, UsesTheVolumeAtTolerance)
{
  const test::Field ball = test::SphereField({ 17, 17, 17 });
  const double value = ball.Isovalue;
  for (const bool isBall : { true, false })
  {
    const Isoregion region = isBall ? Isoregion{ value, HUGE_VAL } : Isoregion{ -HUGE_VAL, value };
    const test::Stuffed stuffed(*test::BuildVolume(ball, region).Hierarchy, Query{});
    const TetrahedronMesh plain = stuffed.PlainMesh();
    const double volume = VolumeOf(plain);
    const std::vector<double> allowances(stuffed.LeafCount, 1.0);
    const std::vector<bool> finer(stuffed.LeafCount, true);
    const auto coarser = [&](std::optional<double> atTolerance)
    {
      CoarseningInput input{ plain, allowances, finer, false, 0.75, test::UnitAxes };
      input.VolumeAtTolerance = atTolerance;
      TetrahedronMesh mesh = stuffed.Mesh;
      EXPECT_TRUE(Coarsen(mesh, input, SerialFor).empty());
      return mesh;
    };
    constexpr double slack = 0.008; // of the volume may come or go
    const TetrahedronMesh kept = coarser({});
    EXPECT_NEAR(VolumeOf(kept) / volume, 1.0, slack);
    const double sign = isBall ? -1.0 : 1.0;
    for (const double part : { 0.01, 0.2 })
    {
      const TetrahedronMesh mesh = coarser((1.0 + sign * part) * volume);
      const double change = sign * (VolumeOf(mesh) / volume - 1.0);
      EXPECT_GT(change, sign * (VolumeOf(kept) / volume - 1.0) + 0.001);
      EXPECT_LT(change, part + slack);
      EXPECT_LT(mesh.Tetrahedra.size(), kept.Tetrahedra.size());
      const TetrahedronMesh other = coarser((1.0 - sign * part) * volume);
      EXPECT_NEAR(VolumeOf(other) / volume, VolumeOf(kept) / volume, 1e-9);
    }
  }
}

// What is too far away from the start has to be finer; where it cannot be, it is left as it is.
TEST(Coarsening, LeavesAloneWhatIsFarFromTheStart)
{
  const test::Stuffed stuffed = Gyroid(0.5);
  const Coarsened asked(stuffed, 1e-3, true);
  ASSERT_FALSE(asked.FarLeaves.empty());
  EXPECT_TRUE(std::is_sorted(asked.FarLeaves.begin(), asked.FarLeaves.end()));
  const TetrahedronMesh plain = stuffed.PlainMesh();
  const std::vector<double> allowances(stuffed.LeafCount, 1e-3);
  const std::vector<bool> finer(stuffed.LeafCount, true);
  EXPECT_EQ(FarLeaves(stuffed.Mesh, { plain, allowances, finer }, SerialFor), asked.FarLeaves);
  EXPECT_LT(asked.FarLeaves.back(), stuffed.LeafCount);
  EXPECT_EQ(asked.Result.Mesh.Tetrahedra, stuffed.Mesh.Tetrahedra);

  const Coarsened finest(stuffed, 1e-3, false);
  EXPECT_TRUE(finest.FarLeaves.empty());
  const std::set<Triangle> before = SetOf(SurfacesOf(stuffed.Mesh).Triangles);
  const std::set<Triangle> after = SetOf(SurfacesOf(finest.Result.Mesh).Triangles);
  EXPECT_GT(after.size(), before.size() * 9 / 10);
  EXPECT_LT(finest.Result.Mesh.Tetrahedra.size(), stuffed.Mesh.Tetrahedra.size());
}

// Two tetrahedra, each in a leaf, of which the second one is in the wrong place, in a third leaf.
TEST(Coarsening, TellsWhereAnyOfBothSurfacesIsFar)
{
  TetrahedronMesh plain;
  for (const double x : { 0.0, 10.0, 20.0 })
  {
    const Vector corner = { x, 0, 0 };
    for (const Vector& way : { Vector{}, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } })
    {
      plain.Positions.push_back(corner + way);
    }
  }
  plain.Surfaces.assign(plain.Positions.size(), 1);
  plain.OnWalls.assign(plain.Positions.size(), 0);
  TetrahedronMesh mesh = plain;
  plain.Tetrahedra = { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } };
  plain.Origins = { 0, 1 };
  mesh.Tetrahedra = { { 0, 1, 2, 3 }, { 8, 9, 10, 11 } };
  mesh.Origins = { 0, 2 };
  const std::vector<double> allowances(3, 0.1);
  using Leaves = std::vector<std::uint32_t>;
  for (const auto& [canBeNearer, far] :
    { std::pair(std::vector<bool>{ true, true, true }, Leaves{ 1, 2 }),
      std::pair(std::vector<bool>{ true, true, false }, Leaves{ 1 }),
      std::pair(std::vector<bool>{ true, false, true }, Leaves{ 2 }),
      std::pair(std::vector<bool>{ true, false, false }, Leaves{}) })
  {
    EXPECT_EQ(FarLeaves(mesh, { plain, allowances, canBeNearer }, SerialFor), far);
  }
}

TEST(Coarsening, IsTheSameWithThreads)
{
  const test::Stuffed stuffed = Gyroid(0.1);
  const Coarsened one(stuffed, 0.5, true);
  Coarsened four(stuffed, 0.5, true);
  four.Result.Mesh = stuffed.Mesh;
  const std::vector<double> allowances(stuffed.LeafCount, 0.5);
  const std::vector<bool> finer(stuffed.LeafCount, true);
  Coarsen(four.Result.Mesh, { stuffed.PlainMesh(), allowances, finer, false, 0.75, test::UnitAxes },
    test::ThreadedFor(4));
  EXPECT_EQ(four.Result.Mesh.Tetrahedra, one.Result.Mesh.Tetrahedra);
  EXPECT_EQ(four.Result.Mesh.Positions, one.Result.Mesh.Positions);
}

// Any collapses can be undone, with those that build on them; once all are, the mesh is as before.
TEST(TetrahedronCollapses, CanBeUndone)
{
  test::Stuffed stuffed = Gyroid(0.1);
  const std::set<Corners> before = SetOf(stuffed.Mesh);
  test::Random random(7);
  TetrahedronCollapses collapses(stuffed.Mesh, 20.0, OwnVolume(stuffed.Mesh));
  std::vector<std::uint32_t> all;
  for (std::uint32_t point = 0; point < stuffed.Mesh.Positions.size(); ++point)
  {
    all.push_back(point);
  }
  std::size_t together = 0; // undone though not asked for
  for (int round = 0; round < 20; ++round)
  {
    collapses.CollapseInside(SerialFor);
    ASSERT_GT(collapses.Count(), 100U);
    std::vector<std::uint32_t> some;
    for (int i = 0; i < 10; ++i)
    {
      some.push_back(all[random() % all.size()]);
    }
    const std::size_t count = collapses.Count();
    const std::vector<std::uint32_t> undone = collapses.Undo(some);
    EXPECT_EQ(collapses.Count(), count - undone.size());
    together += std::count_if(undone.begin(), undone.end(),
      [&](std::uint32_t point)
      { return std::find(some.begin(), some.end(), point) == some.end(); });
    EXPECT_TRUE(collapses.Undo(some).empty());
  }
  EXPECT_GT(together, 0U);
  collapses.CollapseInside(SerialFor);
  const std::size_t count = collapses.Count();
  EXPECT_EQ(collapses.Undo(all).size(), count);
  EXPECT_EQ(collapses.Count(), 0U);
  EXPECT_EQ(SetOf(collapses.Take()), before);
}

// Once points inside have moved, more edges can collapse; surfaces stay as they are.
TEST(TetrahedronCollapses, GoOnWhereThingsAreRelaxed)
{
  const test::Stuffed stuffed = Gyroid(0.1);
  TetrahedronCollapses collapses(stuffed.Mesh, 16.0, OwnVolume(stuffed.Mesh));
  std::size_t before = 0;
  do
  {
    before = collapses.Count();
    collapses.CollapseInside(SerialFor);
  } while (collapses.Count() > before);
  collapses.RelaxInside(test::UnitAxes, SerialFor);
  EXPECT_EQ(collapses.Count(), 0U);
  collapses.CollapseInside(SerialFor);
  EXPECT_GT(collapses.Count(), before / 40);
  const TetrahedronMesh mesh = collapses.Take();
  EXPECT_EQ(SetOf(SurfacesOf(mesh).Triangles), SetOf(SurfacesOf(stuffed.Mesh).Triangles));
  EXPECT_GE(WorstSine(mesh), std::min(WorstSine(stuffed.Mesh), LeastSine));
  EXPECT_NEAR(VolumeOf(mesh), VolumeOf(stuffed.Mesh), 1e-9 * VolumeOf(mesh));
}

TEST(Relaxation, MovesPointsInsideToBetterPlaces)
{
  const test::Stuffed stuffed = Gyroid(0.05);
  RelaxationOptions options{ 0.6, test::UnitAxes,
    [](std::uint32_t, const Vector&) { return true; } };
  LocalMesh mesh(stuffed.Mesh);
  const std::vector<std::uint32_t> moved = RelaxInside(mesh, options, SerialFor);
  const LocalMesh before(stuffed.Mesh);
  std::size_t better = 0;
  for (std::uint32_t point = 0; point < stuffed.Mesh.Positions.size(); ++point)
  {
    const bool isMoved = std::find(moved.begin(), moved.end(), point) != moved.end();
    EXPECT_EQ(isMoved, mesh.At(point) != before.At(point));
    EXPECT_TRUE(!isMoved || stuffed.Mesh.Surfaces[point] == 0);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (Walls::OnAxis(stuffed.Mesh.OnWalls[point], axis))
      {
        EXPECT_EQ(mesh.At(point)[axis], before.At(point)[axis]);
      }
    }
    better += isMoved && mesh.WorstAround(point) > before.WorstAround(point) + 0.02 ? 1 : 0;
  }
  EXPECT_GT(better, moved.size() / 2);
  EXPECT_GT(better, 500U);
  EXPECT_GE(WorstSine(mesh.Mesh()), WorstSine(stuffed.Mesh));

  LocalMesh four(stuffed.Mesh);
  EXPECT_EQ(RelaxInside(four, options, test::ThreadedFor(4)), moved);
  EXPECT_EQ(four.Mesh().Positions, mesh.Mesh().Positions);

  options.Allows = [](std::uint32_t, const Vector&) { return false; };
  EXPECT_TRUE(RelaxInside(four, options, SerialFor).empty());
}

// Undoing on a surface also undoes what builds on it inside, and what builds on that on a surface.
TEST(TetrahedronCollapses, AreUndoneTogetherWithThoseOfSurfaces)
{
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE(seed);
    test::Random random(seed);
    test::Field field = test::GyroidField(21, test::Uniform(random, 0.8, 2.5));
    for (float& sample : field.Samples)
    {
      sample += static_cast<float>(test::Uniform(random, -0.2, 0.2));
    }
    const test::Built built =
      test::BuildVolume(field, { test::Uniform(random, -0.8, 0.8), HUGE_VAL });
    Query query;
    query.Tolerance = 0.3;
    test::Stuffed stuffed(*built.Hierarchy, query);
    const std::vector<double> allowances(stuffed.LeafCount, 1.0);
    const MeasuredSurfaces surfaces(stuffed.PlainMesh(), stuffed.Mesh, allowances, SerialFor);
    const std::size_t count = surfaces.Part.Simple.Triangles.size();
    TetrahedronCollapses tetrahedra(stuffed.Mesh, 10.0, OwnVolume(stuffed.Mesh));
    if (!surfaces.AreSound || count == 0)
    {
      continue;
    }
    EdgeCollapses edges(surfaces.Part, 0.75, &tetrahedra);
    for (int round = 0; round < 4; ++round)
    {
      for (int pass = 0; pass < 3; ++pass)
      {
        tetrahedra.CollapseInside(SerialFor);
        edges.Run();
      }
      std::vector<std::uint32_t> some;
      for (int i = 0; i < 20; ++i)
      {
        const auto triangle = static_cast<std::uint32_t>(random() % count);
        if (edges.Mesh().IsThere(triangle))
        {
          some.push_back(triangle);
        }
      }
      edges.Undo(some, {});
    }
    stuffed.Mesh = tetrahedra.Take();
    EXPECT_EQ(SetOf(SurfacesOf(stuffed.Mesh).Triangles), SetOf(edges.Mesh().Triangles));
    const test::Volume volume = stuffed.AsVolume();
    EXPECT_EQ(test::FindFault(volume, field.Dims), "");
    const test::AnyMesh plain(*built.Hierarchy, query);
    EXPECT_EQ(test::TopologyOf(volume, plain), test::Topology(plain));
  }
}
