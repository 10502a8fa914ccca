// SPDX-License-Identifier: BSD-3-Clause
// Regions of interest: which diamonds touch one, the refined set in all models and for both shapes,
// and the counts of subdivided and front diamonds.
#include "Refinement/ScalarQuery.h"
#include "Tools/DistanceTestTools.h"

#include "ReferenceError.h"
#include "ReferenceRegion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace isodiamond;
using ReferenceKind = reference::Kind;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Boxes with corners at multiples of 1/8 in and around a grid: also points, planes, large boxes,
 *  inverted ones, and some beyond the grid. */
std::vector<Box> RandomBoxes(const std::array<int, 3>& dims, unsigned seed, int count)
{
  std::mt19937 random(seed);
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i)
  {
    Box box;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int last = 8 * (dims[axis] - 1);
      const int low = int(random() % (last + 33)) - 16;
      const int unit = random() % 2 == 0 ? 8 : 1; // often on the lattice's planes
      const int size = random() % 4 == 0 ? 0 : int(random() % (last / 2 + 1));
      box.Minimum[axis] = low / unit * unit / 8.0;
      box.Maximum[axis] = box.Minimum[axis] + size / 8.0;
    }
    if (random() % 10 == 0)
    {
      std::swap(box.Minimum, box.Maximum);
    }
    boxes.push_back(box);
  }
  return boxes;
}

reference::Box ReferenceBox(const Box& box)
{
  return { box.Minimum, box.Maximum };
}

/** What a hierarchy stores of a set of the reference. */
reference::DiamondSet Stored(
  const reference::DiamondSet& diamonds, const std::vector<ReferenceKind>& kinds, Model model)
{
  reference::DiamondSet stored = diamonds;
  for (std::size_t i = 0; i < kinds.size(); ++i)
  {
    const bool isStored = model != Model::Minimal || kinds[i] == ReferenceKind::Active ||
      kinds[i] == ReferenceKind::Creation;
    stored[i] = stored[i] && isStored;
  }
  return stored;
}

/** The front by its definition: with MI, stored diamonds with a subdivided stored parent. */
std::int64_t CountFront(const reference::Hierarchy& hierarchy,
  const reference::DiamondSet& subdivided, const std::vector<ReferenceKind>& kinds, Model model)
{
  if (model != Model::Minimal)
  {
    const reference::DiamondSet front = reference::FrontOf(hierarchy, subdivided);
    return std::count(front.begin(), front.end(), true);
  }
  const reference::DiamondSet refined = Stored(subdivided, kinds, model);
  std::int64_t count = 0;
  for (int i = 0; i < hierarchy.Size(); ++i)
  {
    const std::vector<int>& parents = hierarchy.At(i).Parents;
    const bool isStored = kinds[i] == ReferenceKind::Active || kinds[i] == ReferenceKind::Creation;
    const bool reached = parents.empty() ||
      std::any_of(parents.begin(), parents.end(), [&](int parent) { return refined[parent]; });
    count += isStored && !refined[i] && reached ? 1 : 0;
  }
  return count;
}

void ExpectSet(const reference::Hierarchy& hierarchy, const reference::DiamondSet& expected,
  const std::vector<ReferenceKind>& kinds, const RefinedSet& refined, Model model)
{
  const reference::DiamondSet stored = Stored(expected, kinds, model);
  const Grid& grid = refined.Hierarchy().SampleGrid();
  for (int i = 0; i < hierarchy.Size(); ++i)
  {
    ASSERT_EQ(refined.Contains(test::PlaceOf(grid, hierarchy.At(i).Center)), bool(stored[i]))
      << "diamond " << i;
  }
  EXPECT_EQ(refined.Count(), std::count(stored.begin(), stored.end(), true));
  EXPECT_EQ(refined.CountFront(), CountFront(hierarchy, expected, kinds, model));
}

/** The reference's uniform sets: kinds and errors of a field and an isovalue or range. */
struct Oracle
{
  reference::Hierarchy Hierarchy;
  std::vector<ReferenceKind> Kinds;
  std::vector<double> Errors;
  std::vector<bool> Triggers;

  Oracle(const test::Field& field, const Isoregion& region, const reference::ErrorCodes& codes)
    : Hierarchy(field.Dims)
    , Errors(reference::OwnFieldErrors(this->Hierarchy, field.Reference()))
  {
    const reference::ScalarField samples = field.Reference();
    if (region.IsVolume())
    {
      const reference::Isorange range{ region.Isovalue(0), region.Isovalue(1) };
      this->Kinds = reference::Classify(this->Hierarchy, samples, range);
      this->Triggers = reference::CarryingDomains(this->Hierarchy, samples, range);
    }
    else
    {
      this->Kinds = reference::Classify(this->Hierarchy, samples, region.Isovalue());
      this->Triggers = reference::CrossedDomains(this->Hierarchy, samples, region.Isovalue());
    }
    for (double& error : this->Errors)
    {
      error = codes.CodeOf(error);
    }
  }

  reference::DiamondSet Refine(int accepted) const
  {
    return reference::Refine(
      this->Hierarchy, reference::UniformCriterion(this->Errors, this->Triggers, accepted))
      .Subdivided;
  }
};

/** All models of one field: every query's set must be the reference's, and the meshes the same. */
template <typename Compare>
void ExpectAllModels(const test::Field& field, const Isoregion& region, const Compare& compare)
{
  const test::Built relevant(
    BuildIsodiamonds(Model::Relevant, field.View(), region, SerialFor), SerialFor);
  const test::Built minimal(
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor), SerialFor);
  const test::BuiltScalars scalars = test::BuildScalars(field);
  const ErrorCode& code = minimal.Hierarchy->Codes();
  const reference::ErrorCodes codes(code.Scale());
  const Oracle oracle(field, region, codes);
  const Grid& grid = minimal.Hierarchy->SampleGrid();
  for (const Box& box : RandomBoxes(field.Dims, 4711, 12))
  {
    for (const double outside : { Infinity, 0.3 * code.Scale() })
    {
      for (const double inside : { 0.0, 0.1 * code.Scale() })
      {
        const Query query{ inside, HUGE_VAL, RegionOfInterest(box, grid, AffineMap()), outside };
        const reference::DiamondSet expected =
          reference::RefineRegion(oracle.Hierarchy, oracle.Refine(codes.LastWithin(outside)),
            oracle.Refine(codes.LastWithin(inside)), oracle.Kinds, ReferenceBox(box));
        ExpectSet(oracle.Hierarchy, expected, oracle.Kinds,
          RefinedSet(*relevant.Hierarchy, query, SerialFor), Model::Relevant);
        ExpectSet(oracle.Hierarchy, expected, oracle.Kinds,
          RefinedSet(*minimal.Hierarchy, query, SerialFor), Model::Minimal);
        const test::Built answer(
          EncodeQuery(*scalars.Hierarchy, region, query, true, SerialFor), SerialFor);
        ExpectSet(oracle.Hierarchy, expected, oracle.Kinds,
          RefinedSet(*answer.Hierarchy, {}, SerialFor), Model::HierarchyOfDiamonds);
        compare(*relevant.Hierarchy, *minimal.Hierarchy, *answer.Hierarchy, query);
      }
    }
  }
}

}

namespace
{

/** How far the tetrahedra of a diamond reach on an axis: from the first value to the second. */
std::pair<int, int> ExtentOf(const reference::Hierarchy& hierarchy, int diamond, int axis)
{
  std::pair<int, int> extent = { hierarchy.At(diamond).Center[axis],
    hierarchy.At(diamond).Center[axis] };
  for (const reference::Tetrahedron& tetrahedron : hierarchy.At(diamond).Tetrahedra)
  {
    for (const reference::Point& vertex : tetrahedron.Vertices)
    {
      extent.first = std::min(extent.first, vertex[axis]);
      extent.second = std::max(extent.second, vertex[axis]);
    }
  }
  return extent;
}

}

TEST(Region, TouchesWhatTheReferenceSays)
{
  int touched = 0;
  for (const std::array<int, 3>& dims :
    { std::array<int, 3>{ 9, 9, 9 }, { 6, 13, 4 }, { 10, 7, 17 } })
  {
    const reference::Hierarchy hierarchy(dims);
    const Grid grid(dims);
    for (const Box& box : RandomBoxes(dims, 99, 40))
    {
      const RegionOfInterest region(box, grid, AffineMap());
      for (int i = 0; i < hierarchy.Size(); ++i)
      {
        const bool expected = reference::Touches(hierarchy, i, ReferenceBox(box));
        ASSERT_EQ(region.Touches(test::PlaceOf(grid, hierarchy.At(i).Center)), expected)
          << "diamond " << i;
        touched += expected ? 1 : 0;
      }
    }
  }
  EXPECT_GT(touched, 1000);
}

// Turned by 90 degrees, a box stays a box: the region in the turned world must be the same.
TEST(Region, FollowsTheOrientationOfTheGrid)
{
  const std::array<int, 3> dims = { 9, 6, 12 };
  const Grid grid(dims);
  AffineMap turned; // x -> 2 y + 3, y -> -x + 1, z -> 0.5 z
  turned.Rows = { { { 0, 2, 0, 3 }, { -1, 0, 0, 1 }, { 0, 0, 0.5, 0 } } };
  const reference::Hierarchy hierarchy(dims);
  for (const Box& box : RandomBoxes(dims, 13, 20))
  {
    const Box inWorld{ { 2 * box.Minimum[1] + 3, 1 - box.Maximum[0], 0.5 * box.Minimum[2] },
      { 2 * box.Maximum[1] + 3, 1 - box.Minimum[0], 0.5 * box.Maximum[2] } };
    const RegionOfInterest region(inWorld, grid, turned);
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      ASSERT_EQ(region.Touches(test::PlaceOf(grid, hierarchy.At(i).Center)),
        reference::Touches(hierarchy, i, ReferenceBox(box)));
    }
  }
}

// In any orientation: a diamond with a point in the box touches it, one without a point near the
// box does not.
TEST(Region, IsRightInAnObliqueWorld)
{
  const std::array<int, 3> dims = { 9, 9, 7 };
  const Grid grid(dims);
  AffineMap world;
  world.Rows = { { { 0.8, -0.6, 0.1, 1 }, { 0.5, 0.7, 0.2, -2 }, { 0.1, 0.3, 1.3, 0.5 } } };
  const Box box{ { 0.6, 1.3, 2.4 }, { 2.7, 4.1, 5.2 } };
  const auto excess = [&](const std::array<double, 3>& p)
  {
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      most = std::max({ most, box.Minimum[axis] - p[axis], p[axis] - box.Maximum[axis] });
    }
    return most;
  };
  const RegionOfInterest region(box, grid, world);
  const reference::Hierarchy hierarchy(dims);
  int inside = 0;
  int outside = 0;
  constexpr int n = 24;
  for (int i = 0; i < hierarchy.Size(); ++i)
  {
    double least = Infinity;
    for (const reference::Tetrahedron& tetrahedron : hierarchy.At(i).Tetrahedra)
    {
      const std::array<reference::Point, 4>& v = tetrahedron.Vertices;
      for (int a = 0; a <= n; ++a)
      {
        for (int b = 0; a + b <= n; ++b)
        {
          for (int c = 0; a + b + c <= n; ++c)
          {
            std::array<double, 3> p{};
            for (int axis = 0; axis < 3; ++axis)
            {
              p[axis] =
                (a * v[0][axis] + b * v[1][axis] + c * v[2][axis] + (n - a - b - c) * v[3][axis]) /
                double(n);
            }
            least = std::min(least, excess(world(p[0], p[1], p[2])));
          }
        }
      }
    }
    const bool touches = region.Touches(test::PlaceOf(grid, hierarchy.At(i).Center));
    const double spacing = 2.0 * (1 << hierarchy.BaseExponent()) / n; // between the points
    if (least == 0.0)
    {
      ASSERT_TRUE(touches);
      ++inside;
    }
    else if (least > spacing)
    {
      ASSERT_FALSE(touches);
      ++outside;
    }
  }
  EXPECT_GT(inside, 20);
  EXPECT_GT(outside, 20);
}

TEST(Region, IsTheSmallestClosedSupersetOnSurfaces)
{
  for (const test::Field& field :
    { test::NoiseField({ 9, 9, 9 }, 41), test::SphereField({ 17, 17, 17 }),
      test::SparseField({ 17, 17, 17 }, 42), test::WaveField({ 10, 6, 13 }),
      test::NoiseField({ 2, 3, 20 }, 44), test::BrokenField({ 9, 7, 8 }, 45) })
  {
    SCOPED_TRACE(field.Name);
    ExpectAllModels(field, field.Isovalue,
      [](const IsodiamondHierarchy& relevant, const IsodiamondHierarchy& minimal,
        const IsodiamondHierarchy& answer, const Query& query)
      {
        const test::Mesh mesh = test::Extract(minimal, query);
        EXPECT_TRUE(mesh == test::Extract(relevant, query));
        EXPECT_TRUE(mesh == test::Extract(answer, 0.0));
      });
  }
}

TEST(Region, IsTheSmallestClosedSupersetOnIntervalVolumes)
{
  for (const test::Field& field : { test::NoiseField({ 9, 9, 9 }, 43),
         test::SphereField({ 17, 17, 17 }), test::WaveField({ 10, 6, 13 }) })
  {
    SCOPED_TRACE(field.Name);
    ExpectAllModels(field, test::RegionOf(test::RangesOf(field)[0]),
      [&](const IsodiamondHierarchy& relevant, const IsodiamondHierarchy& minimal,
        const IsodiamondHierarchy& answer, const Query& query)
      {
        const test::Volume volume = test::ExtractVolume(minimal, query);
        EXPECT_EQ(test::FindFault(volume, field.Dims), "");
        const auto placed = test::PlacedTetrahedra(volume);
        EXPECT_TRUE(placed == test::PlacedTetrahedra(test::ExtractVolume(relevant, query)));
        EXPECT_TRUE(placed == test::PlacedTetrahedra(test::ExtractVolume(answer, 0.0)));
      });
  }
}

// Mirrored, and far from the origin: the same diamonds.
TEST(Region, FollowsNegativeSpacingsAndFarOrigins)
{
  const std::array<int, 3> dims = { 9, 6, 12 };
  const Grid grid(dims);
  AffineMap world;
  world.Rows = { { { -0.5, 0, 0, 4096 }, { 0, 2, 0, -8192 }, { 0, 0, 1, 65536 } } };
  const reference::Hierarchy hierarchy(dims);
  for (const Box& box : RandomBoxes(dims, 17, 20))
  {
    const Box inWorld{ { 4096 - 0.5 * box.Maximum[0], 2 * box.Minimum[1] - 8192,
                         box.Minimum[2] + 65536 },
      { 4096 - 0.5 * box.Minimum[0], 2 * box.Maximum[1] - 8192, box.Maximum[2] + 65536 } };
    const RegionOfInterest region(inWorld, grid, world);
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      ASSERT_EQ(region.Touches(test::PlaceOf(grid, hierarchy.At(i).Center)),
        reference::Touches(hierarchy, i, ReferenceBox(box)));
    }
  }
}

/** @param place of a diamond centred in the brick at the origin */
void ExpectOfBrick(const RegionOfInterest& region, const Place& place, const Point& origin)
{
  const RegionOfInterest::Relation relation = region.OfBrick(place.Scale, origin);
  const bool touches = region.Touches(place);
  ASSERT_TRUE(relation != RegionOfInterest::Relation::Apart || !touches);
  ASSERT_TRUE(relation != RegionOfInterest::Relation::Within || touches);
}

// A box that ends where diamonds do touches them, even if rounding has made it an ulp shorter.
TEST(Region, TouchesDespiteRounding)
{
  const Grid grid({ 9, 9, 9 });
  AffineMap world = test::Spacing(0.1, 0.3, 0.7);
  world.Rows[0][3] = 100.0;
  const reference::Hierarchy hierarchy({ 9, 9, 9 });
  for (int plane = 1; plane < 8; ++plane)
  {
    const Vector position = world(plane, plane, plane);
    for (int axis = 0; axis < 3; ++axis)
    {
      Box below{ { -Infinity, -Infinity, -Infinity }, { Infinity, Infinity, Infinity } };
      Box above = below;
      below.Maximum[axis] = std::nextafter(position[axis], -Infinity);
      above.Minimum[axis] = std::nextafter(position[axis], Infinity);
      const RegionOfInterest belowPlane(below, grid, world);
      const RegionOfInterest abovePlane(above, grid, world);
      for (int i = 0; i < hierarchy.Size(); ++i)
      {
        const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
        const auto [low, high] = ExtentOf(hierarchy, i, axis);
        ASSERT_EQ(belowPlane.Touches(place), low <= plane);
        ASSERT_EQ(abovePlane.Touches(place), high >= plane);
        const Point origin = { place.Position[0] & ~7, place.Position[1] & ~7,
          place.Position[2] & ~7 };
        ASSERT_NO_FATAL_FAILURE(ExpectOfBrick(belowPlane, place, origin));
        ASSERT_NO_FATAL_FAILURE(ExpectOfBrick(abovePlane, place, origin));
      }
    }
  }
}

TEST(Region, GivesOneMeshByTheDistanceMetricWhateverTheThreads)
{
  for (const test::Field& field :
    { test::NoiseField({ 17, 12, 19 }, 51), test::SphereField({ 33, 33, 33 }) })
  {
    const test::Built relevant = test::Build(Model::Relevant, field, test::Distance());
    const test::Built minimal = test::Build(Model::Minimal, field, test::Distance());
    for (const Box& box : RandomBoxes(field.Dims, 52, 10))
    {
      const Query query{ 0.1, HUGE_VAL,
        RegionOfInterest(box, minimal.Hierarchy->SampleGrid(), AffineMap()), 2.0 };
      const test::Mesh mesh = test::Extract(*minimal.Hierarchy, query);
      EXPECT_TRUE(mesh == test::Extract(*relevant.Hierarchy, query));
      EXPECT_TRUE(mesh == test::Extract(*minimal.Hierarchy, query, test::ThreadedFor(3)));
    }
  }
}

TEST(Region, AtItsExtremesIsAUniformMesh)
{
  const test::Field field = test::SphereField({ 33, 33, 33 });
  const test::Built built = test::Build(Model::Minimal, field);
  const Grid& grid = built.Hierarchy->SampleGrid();
  const double fine = 0.01 * built.Hierarchy->Codes().Scale();
  const double coarse = 0.1 * built.Hierarchy->Codes().Scale();
  const auto extract = [&](const Box& box)
  {
    return test::Extract(
      *built.Hierarchy, Query{ fine, HUGE_VAL, RegionOfInterest(box, grid, AffineMap()), coarse });
  };
  const test::Mesh inside = test::Extract(*built.Hierarchy, fine);
  const test::Mesh outside = test::Extract(*built.Hierarchy, coarse);
  ASSERT_GT(inside.Triangles.size(), outside.Triangles.size());
  EXPECT_TRUE(extract({ { 0, 0, 0 }, { 32, 32, 32 } }) == inside);
  EXPECT_TRUE(
    extract({ { -Infinity, -Infinity, -Infinity }, { Infinity, Infinity, Infinity } }) == inside);
  EXPECT_TRUE(extract({ { 40, 0, 0 }, { 50, 32, 32 } }) == outside);
  EXPECT_TRUE(extract({ { 30, 30, 30 }, { 3, 3, 3 } }) == outside); // inverted
  EXPECT_TRUE(extract({ { 0, 0, 5 }, { 32, 32, 4 } }) == outside);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(extract({ { 0, nan, 0 }, { 32, 32, 32 } }), std::invalid_argument);
  EXPECT_THROW(extract({ { 0, 0, 0 }, { 32, 32, nan } }), std::invalid_argument);
  // A coarser tolerance inside than outside asks for nothing more.
  EXPECT_TRUE(
    test::Extract(*built.Hierarchy,
      Query{ coarse, HUGE_VAL, RegionOfInterest({ { 0, 0, 0 }, { 32, 32, 32 } }, grid, AffineMap()),
        fine }) == inside);
}

TEST(Region, HoldsTheInteriorToleranceInsideOnly)
{
  const test::Field field = test::WaveField({ 33, 33, 33 });
  const Isoregion region(-0.6, Infinity);
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, test::Interior(true)),
    SerialFor);
  const Grid& grid = built.Hierarchy->SampleGrid();
  const auto extract = [&](const Box& box)
  {
    return test::ExtractVolume(
      *built.Hierarchy, Query{ 0.05, 0.05, RegionOfInterest(box, grid, AffineMap()), Infinity });
  };
  const test::Volume all = extract({ { 0, 0, 0 }, { 32, 32, 32 } });
  const test::Volume part = extract({ { 4, 4, 4 }, { 12, 12, 12 } });
  const test::Volume none = extract({ { 1, 1, 1 }, { 0, 0, 0 } });
  EXPECT_EQ(test::FindFault(part, field.Dims), "");
  EXPECT_LT(part.Tetrahedra.size(), all.Tetrahedra.size());
  EXPECT_GT(part.Tetrahedra.size(), none.Tetrahedra.size());
  EXPECT_TRUE(test::PlacedTetrahedra(all) ==
    test::PlacedTetrahedra(test::ExtractVolume(*built.Hierarchy, 0.05, 0.05)));
  EXPECT_TRUE(test::PlacedTetrahedra(none) ==
    test::PlacedTetrahedra(test::ExtractVolume(*built.Hierarchy, Infinity)));
  // The three models again, now with an interior.
  const test::BuiltScalars scalars = test::BuildScalars(field);
  const Query query{ 0.05, 0.05,
    RegionOfInterest({ { 4, 4, 4 }, { 12, 12, 12 } }, grid, AffineMap()), Infinity };
  const test::Built answer(
    EncodeQuery(*scalars.Hierarchy, region, query, true, SerialFor), SerialFor);
  EXPECT_TRUE(test::PlacedTetrahedra(part) ==
    test::PlacedTetrahedra(test::ExtractVolume(*answer.Hierarchy, 0.0)));
}

TEST(Region, CountsTheUniformFrontInAllModels)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const test::Built minimal = test::Build(Model::Minimal, field);
    const test::BuiltScalars scalars = test::BuildScalars(field);
    const ErrorCode& code = minimal.Hierarchy->Codes();
    const reference::ErrorCodes codes(code.Scale());
    const Oracle oracle(field, field.Isovalue, codes);
    for (const double tolerance : test::Tolerances(code.Scale()))
    {
      const reference::DiamondSet expected = oracle.Refine(codes.LastWithin(tolerance));
      ExpectSet(oracle.Hierarchy, expected, oracle.Kinds,
        RefinedSet(*relevant.Hierarchy, { tolerance }, SerialFor), Model::Relevant);
      ExpectSet(oracle.Hierarchy, expected, oracle.Kinds,
        RefinedSet(*minimal.Hierarchy, { tolerance }, SerialFor), Model::Minimal);
      const test::Built answer(
        EncodeQuery(*scalars.Hierarchy, field.Isovalue, { tolerance }, true, SerialFor), SerialFor);
      ExpectSet(oracle.Hierarchy, expected, oracle.Kinds,
        RefinedSet(*answer.Hierarchy, {}, SerialFor), Model::HierarchyOfDiamonds);
    }
  }
}
