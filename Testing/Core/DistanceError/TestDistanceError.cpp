// SPDX-License-Identifier: BSD-3-Clause
// The distance metric: errors against the reference's definition, and the promise on whole meshes.
// More meshes, in worlds and of real data, are checked with VTK: Testing/Filters/TestDistance.cpp.
#include "DistanceError/DistanceError.h"
#include "DistanceError/ErrorMaxima.h"
#include "Mesh/CurrentMesh.h"
#include "Patches/PatchBound.h"
#include "Patches/PatchDistance.h"
#include "Patches/SurfacePatch.h"
#include "Patches/WorldLengths.h"
#include "Refinement/RefinedSet.h"
#include "Tools/DistanceTestTools.h"
#include "Tools/RandomTestTools.h"

#include "ReferenceError.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

using namespace isodiamond;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** A rotation about (1, 1, 1) after a spacing: lengths are the spacing's. */
AffineMap Rotated(const AffineMap& world)
{
  constexpr double a = 1.0 / 3.0;
  constexpr double b = 0.9106836025229591; // 1/3 + 1/sqrt(3)
  constexpr double c = -0.2440169358562924;
  constexpr std::array<std::array<double, 3>, 3> turn = { { { a, c, b }, { b, a, c },
    { c, b, a } } };
  AffineMap result;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      result.Rows[i][j] = turn[i][0] * world.Rows[0][j] + turn[i][1] * world.Rows[1][j] +
        turn[i][2] * world.Rows[2][j];
    }
  }
  return result;
}

std::vector<test::Field> Fields()
{
  return { test::NoiseField({ 9, 9, 9 }, 61), test::SphereField({ 17, 17, 17 }),
    test::SparseField({ 17, 17, 17 }, 62), test::WaveField({ 10, 6, 13 }),
    test::BrokenField({ 9, 10, 8 }, 63), test::SphereField({ 12, 17, 9 }) };
}

AxisCoordinates EvenCoordinates(const std::array<int, 3>& dims, const AffineMap& world)
{
  AxisCoordinates coordinates;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i < dims[axis]; ++i)
    {
      coordinates[axis].push_back(world.Rows[axis][axis] * i + world.Rows[axis][3]);
    }
  }
  return coordinates;
}

/** Expects all diamonds' errors to be the reference's, and counts the finite and infinite ones.
 *  @param inReference the same world */
template <typename ReferenceWorld>
void ExpectReferencesErrors(const test::Field& field, const GridGeometry& world,
  const ReferenceWorld& inReference, std::map<bool, int>& seen)
{
  SCOPED_TRACE(field.Name);
  const reference::Hierarchy hierarchy(field.Dims);
  for (const bool exact : { true, false })
  {
    for (const bool preserve : { true, false })
    {
      const test::Built relevant = test::Build(Model::Relevant, field, test::Placement(exact));
      const Grid& grid = relevant.Hierarchy->SampleGrid();
      const reference::ErrorCodes codes(DistanceErrorScale(grid, world));
      const std::vector<ErrorCode::Type> found = DistanceErrors(
        *relevant.Hierarchy, Finiteness(field.View()), world, preserve, test::ThreadedFor(2));
      const std::vector<double> expected = reference::OwnDistanceErrors(
        hierarchy, field.Reference(), field.Isovalue, inReference, exact, preserve);
      for (int i = 0; i < hierarchy.Size(); ++i)
      {
        const std::int64_t rank =
          relevant.Hierarchy->Diamonds().Rank(test::PlaceOf(grid, hierarchy.At(i).Center));
        if (expected[i] < 0.0)
        {
          ASSERT_TRUE(rank == DiamondSet::None || found[rank] == 0) << "diamond " << i;
          continue;
        }
        ASSERT_NE(rank, DiamondSet::None);
        // Codes of values that differ by rounding only.
        ASSERT_GE(found[rank], codes.CodeOf(expected[i] * (1 - 1e-9))) << "diamond " << i;
        ASSERT_LE(found[rank], codes.CodeOf(expected[i] * (1 + 1e-9))) << "diamond " << i;
        ++seen[expected[i] < Infinity];
      }
    }
  }
}

}

TEST(DistanceError, IsTheReferencesForEveryDiamond)
{
  const std::array<std::array<double, 3>, 2> spacings = { { { 1, 1, 1 }, { 0.5, 2.0, 1.25 } } };
  std::map<bool, int> seen; // finite or not
  for (const test::Field& field : Fields())
  {
    for (const std::array<double, 3>& spacing : spacings)
    {
      ExpectReferencesErrors(
        field, test::Spacing(spacing[0], spacing[1], spacing[2]), spacing, seen);
    }
  }
  EXPECT_GT(seen[true], 1000);
  EXPECT_GT(seen[false], 1000);
}

TEST(DistanceError, IsTheReferencesAlongUnevenAxes)
{
  std::map<bool, int> seen;
  for (const test::Field& field : Fields())
  {
    for (const double ratio : { 4.0, 100.0 })
    {
      const AxisCoordinates axes = test::UnevenCoordinates(field.Dims, ratio);
      ExpectReferencesErrors(field, GridGeometry(axes), axes, seen);
    }
  }
  EXPECT_GT(seen[true], 1000);
  EXPECT_GT(seen[false], 1000);
}

TEST(DistanceError, IsTheReferencesOnCurvilinearGrids)
{
  std::map<bool, int> seen;
  for (const test::Field& field : Fields())
  {
    for (const test::World& world : { test::Bent(field.Dims), test::Wound(field.Dims) })
    {
      ExpectReferencesErrors(
        field, world, reference::SamplePlaces{ field.Dims, *world.Positions }, seen);
    }
  }
  EXPECT_GT(seen[true], 1000);
  EXPECT_GT(seen[false], 1000);
}

TEST(DistanceError, IsThatOfTheMapAlongEvenAxes)
{
  const AffineMap world = test::Spacing(0.5, -2.0, 1.25); // sums of these are exact
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const GridGeometry axes(EvenCoordinates(field.Dims, world));
    for (const Isoregion& region :
      { Isoregion(field.Isovalue), test::RegionOf(test::RangesOf(field)[0]) })
    {
      const test::Built relevant(
        BuildIsodiamonds(Model::Relevant, field.View(), region, SerialFor), SerialFor);
      const Grid& grid = relevant.Hierarchy->SampleGrid();
      EXPECT_EQ(DistanceErrorScale(grid, axes), DistanceErrorScale(grid, world));
      for (const bool preserve : { true, false })
      {
        EXPECT_EQ(
          DistanceErrors(*relevant.Hierarchy, Finiteness(field.View()), axes, preserve, SerialFor),
          DistanceErrors(
            *relevant.Hierarchy, Finiteness(field.View()), world, preserve, SerialFor));
      }
    }
  }
}

TEST(DistanceError, GoesOnInPaddingAsInTheOutermostCells)
{
  const test::Field field = test::WaveField({ 12, 10, 13 });
  const AxisCoordinates inner = test::UnevenCoordinates({ 10, 8, 11 }, 10.0);
  AxisCoordinates padded = inner;
  for (std::vector<double>& axis : padded)
  {
    axis.insert(axis.begin(), 2.0 * axis[0] - axis[1]);
    axis.push_back(2.0 * axis.back() - axis[axis.size() - 2]);
  }
  const test::Built relevant = test::Build(Model::Relevant, field);
  const auto errors = [&](const GridGeometry& world) {
    return DistanceErrors(*relevant.Hierarchy, Finiteness(field.View()), world, false, SerialFor);
  };
  const std::vector<ErrorCode::Type> found = errors(GridGeometry(inner, 1));
  const std::vector<ErrorCode::Type> expected = errors(GridGeometry(padded));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i], expected[i], 1); // rounding only
  }
}

TEST(DistanceError, GoesOnInPaddingOfCurvilinearGrids)
{
  const test::Field field = test::WaveField({ 12, 10, 13 });
  const test::World inner = test::Bent({ 10, 8, 11 });
  const GridGeometry world(SamplePositions{ inner.Positions->data(), { 10, 8, 11 } }, 1);
  std::vector<double> padded;
  for (int z = 0; z < 13; ++z)
  {
    for (int y = 0; y < 10; ++y)
    {
      for (int x = 0; x < 12; ++x)
      {
        const Vector place = world({ 1.0 * x, 1.0 * y, 1.0 * z });
        padded.insert(padded.end(), place.begin(), place.end());
      }
    }
  }
  const test::Built relevant = test::Build(Model::Relevant, field);
  const auto errors = [&](const GridGeometry& geometry)
  {
    return DistanceErrors(
      *relevant.Hierarchy, Finiteness(field.View()), geometry, false, SerialFor);
  };
  const std::vector<ErrorCode::Type> found = errors(world);
  const std::vector<ErrorCode::Type> expected = errors(test::World(padded, field.Dims));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    ASSERT_NEAR(found[i], expected[i], 1); // rounding only
  }
}

TEST(DistanceError, IsAPromise)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    for (const GridGeometry& world : test::WorldsFor(field.Dims))
    {
      const test::Built built = test::Build(Model::Minimal, field, test::Distance(world));
      const test::SurfaceTriangles full = test::Placed(test::Extract(*built.Hierarchy, 0.0), world);
      ASSERT_FALSE(full.empty());
      for (const double tolerance : { 0.004, 0.1, 0.25, 0.5, 1.0, 2.0, 1000.0 })
      {
        test::Promise promise;
        promise.Tolerance = tolerance;
        EXPECT_EQ(
          FaultOf(promise, full, test::Placed(test::Extract(*built.Hierarchy, tolerance), world)),
          "");
      }
    }
  }
}

TEST(DistanceError, IsAPromiseWithinRegionsOfInterest)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    Box box{ { 1.5, 2.0, 2.25 }, { 5.0, 4.5, 6.5 } };
    for (const GridGeometry& world : test::StraightWorldsFor(field.Dims))
    {
      const test::Built built = test::Build(Model::Minimal, field, test::Distance(world));
      const test::SurfaceTriangles full = test::Placed(test::Extract(*built.Hierarchy, 0.0), world);
      for (const double tolerance : { 0.1, 0.4, 1.0 })
      {
        Query query{ tolerance };
        query.Region.emplace(box, built.Hierarchy->SampleGrid(), AffineMap());
        query.OutsideTolerance = 8.0 * tolerance;
        const test::SurfaceTriangles mesh =
          test::Placed(test::Extract(*built.Hierarchy, query), world);
        test::Promise promise;
        promise.Tolerance = query.OutsideTolerance;
        EXPECT_EQ(FaultOf(promise, full, mesh), "");
        promise.Tolerance = tolerance;
        promise.Within = test::Placed(box, world);
        EXPECT_EQ(FaultOf(promise, full, mesh), "");
      }
    }
  }
}

// The smallest field that was found: the interior tolerance subdivides parents of a follower where
// the surfaces' tolerance does not.
TEST(DistanceError, IsAPromiseWhateverTheInteriorTolerance)
{
  const test::Field field{ "interior", { 3, 3, 6 },
    { 4, 2, 1, 1, 2, 4, 2, 2, 2, //
      3, 1, 3, 2, 1, 0, 1, 1, 2, //
      4, 3, 0, 1, 2, 0, 1, 2, 4, //
      1, 0, 1, 2, 2, 1, 4, 2, 0, //
      2, 1, 4, 2, 3, 2, 4, 3, 2, //
      3, 3, 2, 2, 2, 1, 3, 2, 4 },
    0.5 };
  const AffineMap world = test::Spacing(3.0, 2.0, 2.0);
  BuildOptions options = test::Distance(world);
  options.RefineInterior = true;
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), Isoregion(0.5, 2.5), SerialFor, options),
    SerialFor);
  const test::Volume full = test::ExtractVolume(*built.Hierarchy, 0.0);
  test::Promise promise;
  promise.Tolerance = 3.0;
  for (const double interior : { 0.0, 1.0, Infinity })
  {
    const test::Volume volume = test::ExtractVolume(*built.Hierarchy, promise.Tolerance, interior);
    for (const int surface : { -1, 1 })
    {
      EXPECT_EQ(
        FaultOf(promise, test::Placed(full, surface, world), test::Placed(volume, surface, world)),
        "")
        << "interior tolerance " << interior << ", surface " << surface;
    }
  }
}

// The smallest field that was found: the region's box subdivides parents of a follower beside it
// where the tolerance outside does not.
TEST(DistanceError, IsAPromiseBesideARegionOfInterest)
{
  const test::Field field{ "beside", { 3, 3, 3 },
    { 4, 0, 2, 1, 1, 4, 2, 0, 3, //
      0, 4, 0, 1, 0, 4, 1, 4, 3, //
      3, 3, 0, 4, 4, 2, 2, 1, 0 },
    2.5 };
  const test::Built built = test::Build(Model::Minimal, field, test::Distance());
  Query query{ 0.0 };
  query.Region.emplace(Box{ { 0, 0, 0 }, { 0, 0, 1 } }, built.Hierarchy->SampleGrid(), AffineMap());
  query.OutsideTolerance = 1.3;
  test::Promise promise;
  promise.Tolerance = query.OutsideTolerance;
  const AffineMap world;
  EXPECT_EQ(FaultOf(promise, test::Placed(test::Extract(*built.Hierarchy, 0.0), world),
              test::Placed(test::Extract(*built.Hierarchy, query), world)),
    "");
}

namespace
{

/** The error that a query tolerates in a diamond. */
double ToleranceOf(const Query& query, const Place& place)
{
  const bool isInside = !query.Region || query.Region->Touches(place);
  const double tolerance = isInside ? query.Tolerance : query.OutsideTolerance;
  return query.View ? std::max(tolerance, query.View->ToleranceOf(place)) : tolerance;
}

/** How many diamonds are not refined though a parent is, and have an own error that is not
 *  tolerated. */
int CountLeavesThatExceed(
  const RefinedSet& refined, const Query& query, const std::vector<ErrorCode::Type>& own)
{
  const IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  const Grid& grid = hierarchy.SampleGrid();
  int count = 0;
  hierarchy.Diamonds().ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      bool isLeaf = false;
      const TypeTable& shape = ShapeOf(place.Position);
      for (int i = 0; i < shape.ParentCount && place.Scale < grid.Depth(); ++i)
      {
        const Place parent = ParentPlace(shape, place, i);
        isLeaf = isLeaf ||
          (grid.IsValid(parent.Position, parent.Scale) && refined.Contains(parent) &&
            !refined.Contains(place));
      }
      count += isLeaf && own[rank] > ErrorCode::Least &&
          own[rank] > hierarchy.Codes().Accepted(ToleranceOf(query, place))
        ? 1
        : 0;
    });
  return count;
}

}

// Whatever subdivides the parents: the tolerance, another one nearby, a viewpoint's, the
// interior's.
TEST(DistanceError, OfEveryLeafIsTolerated)
{
  std::size_t followers = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed)
  {
    SCOPED_TRACE(seed);
    test::Random numbers(seed);
    const test::RandomSamples field(numbers, 40, 2000);
    const Isoregion region = test::RandomRegion(numbers, field);
    test::OwningOptions options = test::RandomOptions(numbers, field.Dimensions);
    options.Metric = ErrorMetric::Distance;
    options.PreserveFeatures = true;
    const test::Built built(
      BuildIsodiamonds(Model::Relevant, field.View(), region, SerialFor, options), SerialFor);
    followers += built.Encoding.Arrays.Followers.size();
    const std::vector<ErrorCode::Type> own =
      DistanceErrors(*built.Hierarchy, Finiteness(field.View()), options.World, true, SerialFor);
    for (int i = 0; i < 10; ++i)
    {
      const Query query = test::RandomQuery(numbers, *built.Hierarchy, options.World);
      EXPECT_EQ(
        CountLeavesThatExceed(RefinedSet(*built.Hierarchy, query, SerialFor), query, own), 0);
    }
  }
  EXPECT_GT(followers, 100U);
}

// The way back holds even if features vanish: what is left of the mesh is near full resolution.
TEST(DistanceError, IsAPromiseOfTheWayBackWithoutFeatures)
{
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    for (const GridGeometry& world : test::WorldsFor(field.Dims))
    {
      BuildOptions options = test::Distance(world);
      options.PreserveFeatures = false;
      const test::Built built = test::Build(Model::Minimal, field, options);
      const test::SurfaceTriangles full = test::Placed(test::Extract(*built.Hierarchy, 0.0), world);
      for (const double tolerance : { 0.25, 1.0, 4.0 })
      {
        test::Promise promise;
        promise.Tolerance = tolerance;
        promise.Forth = false;
        EXPECT_EQ(
          FaultOf(promise, full, test::Placed(test::Extract(*built.Hierarchy, tolerance), world)),
          "");
      }
    }
  }
}

TEST(DistanceError, IsAPromiseOfBothSurfaces)
{
  for (const test::Field& field : { test::SphereField({ 17, 17, 17 }),
         test::WaveField({ 14, 11, 13 }), test::NoiseField({ 9, 9, 9 }, 61) })
  {
    SCOPED_TRACE(field.Name);
    for (const GridGeometry& world : test::WorldsFor(field.Dims))
    {
      const test::Built built(
        BuildIsodiamonds(Model::Minimal, field.View(), test::RegionOf(test::RangesOf(field)[0]),
          SerialFor, test::Distance(world)),
        SerialFor);
      const test::Volume full = test::ExtractVolume(*built.Hierarchy, 0.0);
      std::size_t fewest = full.Tetrahedra.size();
      for (const double tolerance : { 0.1, 0.25, 1.0, 4.0, 1000.0 })
      {
        const test::Volume volume = test::ExtractVolume(*built.Hierarchy, tolerance);
        fewest = std::min(fewest, volume.Tetrahedra.size());
        for (const int surface : { -1, 1 })
        {
          const test::SurfaceTriangles all = test::Placed(full, surface, world);
          ASSERT_GT(all.size(), 20U);
          test::Promise promise;
          promise.Tolerance = tolerance;
          EXPECT_EQ(FaultOf(promise, all, test::Placed(volume, surface, world)), "");
        }
      }
      EXPECT_LT(fewest, full.Tetrahedra.size());
    }
  }
}

TEST(DistanceError, MeasuresLengthsWhateverTheOrientation)
{
  const test::Field field = test::WaveField({ 17, 14, 11 });
  const AffineMap world = test::Spacing(0.5, 2.0, 1.25);
  const test::Built relevant = test::Build(Model::Relevant, field);
  const auto errors = [&](const AffineMap& map)
  { return DistanceErrors(*relevant.Hierarchy, Finiteness(field.View()), map, true, SerialFor); };
  const std::vector<ErrorCode::Type> straight = errors(world);
  const std::vector<ErrorCode::Type> turned = errors(Rotated(world));
  ASSERT_EQ(straight.size(), turned.size());
  for (std::size_t i = 0; i < straight.size(); ++i)
  {
    ASSERT_NEAR(straight[i], turned[i], 1); // rounding only
  }
  AffineMap mirrored = world;
  mirrored.Rows[1][1] = -2.0;
  EXPECT_EQ(errors(mirrored), straight);
}

TEST(DistanceError, DoesNotDependOnThreadsOrOnTheSource)
{
  const test::Field field = test::NoiseField({ 33, 14, 19 }, 8);
  for (const GridGeometry& world : { GridGeometry(test::Spacing(1.0, 0.7, 1.5)),
         GridGeometry(test::UnevenCoordinates(field.Dims, 1e6)) })
  {
    const BuildOptions options = test::Distance(world);
    const Encoding expected =
      BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, SerialFor, options);
    EXPECT_EQ(expected.Header.Metric, ErrorMetric::Distance);
    for (const int threads : { 2, 7 })
    {
      const Encoding encoding = BuildIsodiamonds(
        Model::Minimal, field.View(), field.Isovalue, test::ThreadedFor(threads), options);
      EXPECT_EQ(encoding.Arrays.Records, expected.Arrays.Records);
      EXPECT_EQ(encoding.Arrays.Isovertices, expected.Arrays.Isovertices);
    }
    const test::BuiltScalars scalars = test::BuildScalars(field);
    const Encoding fromScalars =
      BuildIsodiamonds(Model::Minimal, *scalars.Hierarchy, field.Isovalue, SerialFor, options);
    EXPECT_EQ(fromScalars.Arrays.Records, expected.Arrays.Records);
    EXPECT_EQ(fromScalars.Arrays.Isovertices, expected.Arrays.Isovertices);
  }
}

// Powers of two change no digit, as long as nothing vanishes or gets infinite.
TEST(DistanceError, IsTheSameInTheShortestAndTheLongestUnits)
{
  const test::Field field = test::NoiseField({ 17, 12, 9 }, 3);
  const auto build = [&](double unit)
  {
    return BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, SerialFor,
      test::Distance(test::Spacing(unit, 0.75 * unit, 1.5 * unit)));
  };
  const Encoding usual = build(1.0);
  for (const double unit : { std::ldexp(1.0, -115), std::ldexp(1.0, 115) })
  {
    const Encoding unusual = build(unit);
    EXPECT_EQ(unusual.Header.ErrorScale, unit * usual.Header.ErrorScale);
    EXPECT_EQ(unusual.Arrays.Records, usual.Arrays.Records) << unit;
  }
}

// Integers on a cube of 2^N + 1 samples: many distances are equal, or equal to the value of a code.
// With these of 3000 seeds, the order decided as long as codes were compared without a margin.
TEST(DistanceError, DoesNotDependOnTheOrderOfRanges)
{
  const ParallelFor reversed = [](std::int64_t count, std::int64_t,
                                 const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    for (std::int64_t i = count; i > 0; --i)
    {
      body(i - 1, i);
    }
  };
  for (const unsigned seed : { 16U, 200U, 340U, 500U, 582U, 598U, 603U, 847U, 1505U, 1876U })
  {
    const test::Field field = test::NoiseField({ 17, 17, 17 }, seed);
    const auto build = [&](const ParallelFor& parallelFor)
    {
      return BuildIsodiamonds(
        Model::Minimal, field.View(), field.Isovalue, parallelFor, test::Distance());
    };
    ASSERT_EQ(build(reversed).Arrays.Records, build(SerialFor).Arrays.Records) << "seed " << seed;
  }
}

// A mesh has no vertex on an edge to a sample that is not finite, wherever that is.
TEST(DistanceError, SubdividesAroundValuesThatAreNotFinite)
{
  test::Field field = test::WaveField({ 33, 33, 33 });
  for (int i = 0; i < 33 * 33 * 33; ++i)
  {
    field.Samples[i] = static_cast<float>(i % 33);
  }
  field.Isovalue = 26.3;
  field.Samples[0] = std::numeric_limits<float>::quiet_NaN();
  const test::Built built = test::Build(Model::Minimal, field, test::Distance());
  for (const double tolerance : { 0.5, 100.0, Infinity })
  {
    for (const test::Corner& point : test::Extract(*built.Hierarchy, tolerance).Points)
    {
      ASSERT_NEAR(point[0], 26.3, 33.0 / 256);
    }
  }
}

namespace
{

/** Errors of a small hierarchy before anything is found. */
struct Maxima
{
  test::Built Relevant = test::Build(Model::Relevant, Field());
  Finiteness Finite{ Field().View() };
  MapBounds None;
  ErrorMaxima Errors{ *Relevant.Hierarchy, Finite, AffineMap(), 1.0, true,
    std::vector<ErrorCode::Type>(Relevant.Hierarchy->Diamonds().Size(), 0), None };

  static test::Field Field() { return test::NoiseField({ 9, 9, 9 }, 61); }

  void Raise(std::uint32_t rank, double distance)
  {
    this->Errors.RaiseToFarthest({ 0, { 1, 1, 1 } }, rank,
      [&](Farthest& farthest)
      {
        farthest.IsAny = true;
        farthest.Squared = std::max(farthest.Squared, distance * distance);
      });
  }
};

}

// A greater distance that another thread finds in the meantime is kept.
TEST(ErrorMaxima, KeepWhatIsFoundInBetween)
{
  Maxima maxima;
  maxima.Errors.RaiseToFarthest({ 0, { 1, 1, 1 } }, 20,
    [&](Farthest& farthest)
    {
      maxima.Raise(20, 0.5);
      farthest = { 0.25 * 0.25, true };
    });
  EXPECT_EQ(maxima.Errors.Result()[20], reference::ErrorCodes(1.0).CodeOf(0.5 * DistanceMargin));
}

TEST(ErrorMaxima, AreThoseOfTwoThreadsAtOnce)
{
  for (int round = 0; round < 100; ++round)
  {
    Maxima maxima;
    const auto count = static_cast<std::uint32_t>(maxima.Errors.Result().size());
    std::atomic<int> started{ 0 };
    const auto raiseAll = [&](double odd, double even)
    {
      ++started;
      while (started < 2)
      {
      }
      for (std::uint32_t rank = 0; rank < count; ++rank)
      {
        maxima.Raise(rank, rank % 2 != 0 ? odd : even);
      }
    };
    std::thread other(raiseAll, 0.25, 0.5);
    raiseAll(0.5, 0.25);
    other.join();
    const std::vector<ErrorCode::Type> found = maxima.Errors.Result();
    const int expected = reference::ErrorCodes(1.0).CodeOf(0.5 * DistanceMargin);
    ASSERT_EQ(std::count(found.begin(), found.end(), expected), count) << "round " << round;
  }
}

TEST(ErrorMaxima, StayWhereNothingIsFound)
{
  Maxima maxima;
  const auto findNothing = [&](std::uint32_t rank) {
    maxima.Errors.RaiseToFarthest({ 0, { 1, 1, 1 } }, rank, [](Farthest& /*farthest*/) {});
  };
  maxima.Raise(21, 0.5);
  const ErrorCode::Type known = maxima.Errors.Result()[21];
  findNothing(20);
  findNothing(21);
  EXPECT_EQ(maxima.Errors.Result()[20], 0); // no isovertex at all
  EXPECT_EQ(maxima.Errors.Result()[21], known);
}

// A distance just below a code's is rounded up to the next code, whatever was known before.
TEST(ErrorMaxima, DoNotDependOnTheOrderNextToCodes)
{
  const reference::ErrorCodes codes(1.0);
  for (int code = 9000; code < 9100; ++code)
  {
    const double less = codes.ErrorOf(code) * (1.0 - 1e-4);
    const double next = codes.ErrorOf(code) * (1.0 - 1e-13);
    Maxima maxima;
    maxima.Raise(20, less);
    ASSERT_EQ(maxima.Errors.Result()[20], code);
    maxima.Raise(20, next);
    maxima.Raise(21, next);
    maxima.Raise(21, less);
    ASSERT_EQ(maxima.Errors.Result()[20], code + 1);
    ASSERT_EQ(maxima.Errors.Result()[21], code + 1);
  }
}

TEST(DistanceError, HasTheDiagonalOfTheGridAsItsScale)
{
  const Grid grid({ 3, 5, 13 });
  EXPECT_EQ(DistanceErrorScale(grid, AffineMap()), std::sqrt(2.0 * 2.0 + 4.0 * 4.0 + 12.0 * 12.0));
  EXPECT_EQ(DistanceErrorScale(grid, GridGeometry(test::Spacing(2.0, -0.75, 0.5))),
    std::sqrt(4.0 * 4.0 + 3.0 * 3.0 + 6.0 * 6.0));
  const AxisCoordinates axes = { std::vector<double>{ 1, 3, 4 }, { 9, 7, 6, 5, 3 },
    { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 14 } };
  EXPECT_EQ(
    DistanceErrorScale(grid, GridGeometry(axes)), std::sqrt(3.0 * 3.0 + 6.0 * 6.0 + 14.0 * 14.0));
}

TEST(DistanceError, RefusesWorldsWithoutLengths)
{
  const Grid grid({ 5, 5, 5 });
  EXPECT_THROW(DistanceErrorScale(grid, test::Spacing(1.0, 0.0, 1.0)), std::invalid_argument);
  EXPECT_THROW(DistanceErrorScale(grid, test::Spacing(1.0, Infinity, 1.0)), std::invalid_argument);
  for (const double unusual : { 0.9e-35, 1.1e35, 1e-110, 1e-310, 1e200, std::nan("") })
  {
    EXPECT_THROW(DistanceErrorScale(grid, test::Spacing(1.0, unusual, 1.0)), std::invalid_argument);
    EXPECT_THROW(
      DistanceErrorScale(grid, test::Spacing(unusual, unusual, unusual)), std::invalid_argument);
  }
  AffineMap sheared;
  sheared.Rows = { { { 1, 0, 0, 0 }, { 0, 1, 1e40, 0 }, { 0, 0, 1, 0 } } };
  EXPECT_THROW(DistanceErrorScale(grid, sheared), std::invalid_argument);
  AffineMap flat; // y and z lie in one direction
  flat.Rows = { { { 1, 0, 0, 0 }, { 0, 1, 2, 0 }, { 0, 0, 0, 0 } } };
  EXPECT_THROW(DistanceErrorScale(grid, flat), std::invalid_argument);
}

TEST(DistanceError, RefusesAxesWithoutLengths)
{
  const Grid grid({ 4, 4, 4 });
  const std::vector<double> good = { 1.0, 2.0, 4.0, 8.0 };
  EXPECT_GT(DistanceErrorScale(grid, GridGeometry({ good, { 8, 4, 2, 1 }, good })), 0.0);
  for (const std::vector<double>& bad :
    std::vector<std::vector<double>>{ { 1, 2, 2, 3 }, { 1, 3, 2, 4 }, { 4, 3, 2, 2 },
      { 1, 1, 1, 1 }, { std::nan(""), 1, 2, 3 }, { 0, 1, std::nan(""), 3 }, { 0, 1, 2, Infinity },
      { -Infinity, 1, 2, 3 }, { 0, 1, 2, 1e36 }, { 0, 1e-36, 1, 2 } })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      AxisCoordinates axes = { good, good, good };
      axes[axis] = bad;
      EXPECT_THROW(DistanceErrorScale(grid, GridGeometry(axes)), std::invalid_argument);
    }
  }
}

TEST(DistanceError, RefusesCurvilinearGridsWithoutLengths)
{
  const std::array<int, 3> dims = { 4, 4, 4 };
  const Grid grid(dims);
  const std::vector<float> nowhere(3 * 4 * 4 * 4);
  EXPECT_THROW(DistanceErrorScale(grid, GridGeometry(SamplePositions{ nowhere.data(), dims })),
    std::invalid_argument);
  std::vector<double> positions = *test::Bent(dims).Positions;
  EXPECT_GT(DistanceErrorScale(grid, GridGeometry(SamplePositions{ positions.data(), dims })), 0.0);
  for (const double bad : { std::nan(""), Infinity, -Infinity, 1e36 })
  {
    positions[100] = bad;
    EXPECT_THROW(DistanceErrorScale(grid, GridGeometry(SamplePositions{ positions.data(), dims })),
      std::invalid_argument);
  }
}

// Distances are measured to what extraction makes: the patches of all leaves are the faces of the
// interval volume on its surfaces.
TEST(DistanceError, PatchesAreTheSurfacesOfIntervalVolumes)
{
  for (const test::Field& field : { test::NoiseField({ 9, 9, 9 }, 21),
         test::SphereField({ 17, 17, 17 }), test::WaveField({ 10, 6, 13 }) })
  {
    SCOPED_TRACE(field.Name);
    const test::Built built(
      BuildIsodiamonds(Model::Relevant, field.View(), test::RegionOf(test::RangesOf(field)[0]),
        SerialFor, test::Distance()),
      SerialFor);
    const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
    for (const double tolerance : { 0.0, 0.5, Infinity })
    {
      const RefinedSet refined(hierarchy, { tolerance }, SerialFor);
      std::array<std::size_t, 2> triangles{};
      for (const BrickPlace& brick : AllBricks(refined.Diamonds()))
      {
        ForEachLeaf(
          refined, brick, [&](std::uint32_t rank) { return hierarchy.CarryingEdges(rank); },
          [&](const Leaf& leaf)
          {
            for (int surface = 0; surface < 2; ++surface)
            {
              triangles[surface] += PatchOf(hierarchy, leaf.Rank, leaf.Half, surface).TriangleCount;
            }
          });
      }
      const test::Volume volume = test::ExtractVolume(hierarchy, tolerance);
      EXPECT_EQ(triangles[0], test::CountSurfaceFaces(volume, -1));
      EXPECT_EQ(triangles[1], test::CountSurfaceFaces(volume, 1));
    }
  }
}

TEST(DistanceError, GivesTheSameMeshInBothModels)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    for (const bool preserve : { true, false })
    {
      BuildOptions options = test::Distance();
      options.PreserveFeatures = preserve;
      const test::Built relevant = test::Build(Model::Relevant, field, options);
      const test::Built minimal = test::Build(Model::Minimal, field, options);
      for (const double tolerance : { 0.0, 0.1, 0.5, 2.0, Infinity })
      {
        EXPECT_TRUE(test::Extract(*minimal.Hierarchy, tolerance) ==
          test::Extract(*relevant.Hierarchy, tolerance));
      }
    }
  }
}

TEST(DistanceError, KeepsIntervalVolumesFitForASolver)
{
  for (const test::Field& field : test::SmallFields())
  {
    const std::vector<reference::Isorange> ranges = test::RangesOf(field);
    for (const reference::Isorange& range : { ranges[0], ranges[2] })
    {
      for (const bool refineInterior : { false, true })
      {
        BuildOptions options = test::Distance(test::Spacing(1.0, 0.5, 2.0));
        options.RefineInterior = refineInterior;
        const Isoregion region = test::RegionOf(range);
        const test::Built relevant(
          BuildIsodiamonds(Model::Relevant, field.View(), region, SerialFor, options), SerialFor);
        const test::Built minimal(
          BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options), SerialFor);
        for (const double tolerance : { 0.2, 2.0 })
        {
          SCOPED_TRACE(field.Name + " tolerance " + std::to_string(tolerance));
          const double interior =
            refineInterior ? 0.1 * minimal.Hierarchy->InteriorCodes().Scale() : Infinity;
          const test::Volume volume = test::ExtractVolume(*minimal.Hierarchy, tolerance, interior);
          EXPECT_EQ(test::FindFault(volume, field.Dims), "");
          EXPECT_TRUE(test::PlacedTetrahedra(volume) ==
            test::PlacedTetrahedra(test::ExtractVolume(*relevant.Hierarchy, tolerance, interior)));
        }
      }
    }
  }
}

TEST(TriangleDistance, IsThatOfTheNearestPoint)
{
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto anywhere = [&](double flatness) {
    return Vector{ uniform(random), flatness * uniform(random), uniform(random) };
  };
  constexpr std::array<double, 3> unit = { 1.0, 1.0, 1.0 };
  for (int i = 0; i < 2000; ++i)
  {
    const double flatness = i % 3 == 0 ? 1e-5 : 1.0; // thin ones, too
    const Vector a = anywhere(flatness);
    const Vector b = i % 11 == 0 ? a : anywhere(flatness);
    const Vector c = anywhere(flatness);
    const reference::SurfaceTriangle triangle{ { a, b, c } };
    const TriangleDistance distance(a, b, c);
    for (int j = 0; j < 10; ++j)
    {
      const Vector point = 2.0 * anywhere(1.0);
      const double expected = reference::Distance(point, triangle, unit);
      EXPECT_NEAR(std::sqrt(distance.Squared(point)), expected, 1e-7);
      if (i % 11 != 0) // no side is a point
      {
        const Vector nearest = distance.Nearest(point);
        EXPECT_NEAR(reference::Distance(nearest, triangle, unit), 0.0, 1e-7);
        EXPECT_NEAR(std::sqrt(Dot(nearest - point, nearest - point)), expected, 1e-7);
      }
    }
  }
}

namespace
{

/** How many bounds are near the distance, and how many there are. */
struct BoundCount
{
  std::int64_t Near = 0;
  std::int64_t All = 0;
};

/** Tries a random patch of some scale, perhaps tiny or a mere point, and positions around it. */
template <typename Metric>
void ExpectBounds(const Metric& metric, int round, std::mt19937& random, BoundCount& count)
{
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const int scale = static_cast<int>(random() % 12);
  const double length = FineUnits << scale;
  const FinePosition middle = { static_cast<int>(random() % 100000),
    static_cast<int>(random() % 100000), static_cast<int>(random() % 100000) };
  const auto anywhere = [&](double most)
  {
    FinePosition position = middle;
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] += static_cast<int>(most * part(random));
    }
    return position;
  };
  std::array<FinePosition, 6> corners{};
  for (FinePosition& corner : corners)
  {
    corner = round % 7 == 0 ? middle : anywhere(round % 5 == 0 ? 2.0 : length);
  }
  const SurfacePatch& patch = tables::IsosurfacePatches[1 + random() % 7];
  PatchDistance exact;
  exact.Reset(patch, [&](int edge) { return metric(corners[edge]); });
  const BoundLengths<Metric> boundMetric(metric);
  PatchBound<Metric> bound;
  bound.Reset(boundMetric, patch, [&](int edge) { return corners[edge]; });
  std::array<FinePosition, PatchBound<Metric>::Width> positions{};
  for (FinePosition& position : positions)
  {
    position = anywhere(length);
  }
  // As near a triangle as positions can be: there, rounding is all that matters.
  for (std::size_t j = 0; j < positions.size(); j += 2)
  {
    const auto& triangle = patch.Triangles[random() % patch.TriangleCount];
    const double first = 0.5 + 0.5 * part(random);
    const double second = (1.0 - first) * (0.5 + 0.5 * part(random));
    for (int axis = 0; axis < 3; ++axis)
    {
      positions[j][axis] =
        static_cast<int>(std::lround((1.0 - first - second) * corners[triangle[0]][axis] +
          first * corners[triangle[1]][axis] + second * corners[triangle[2]][axis]));
    }
  }
  const int some = 1 + static_cast<int>(random() % positions.size());
  const auto squared = bound.Squared(positions.data(), some);
  for (int j = 0; j < some; ++j)
  {
    const double truth = boundMetric.Squared(exact.Squared(metric(positions[j])));
    ++count.All;
    if (!std::isnan(squared[j]))
    {
      EXPECT_GE(squared[j], truth * (1.0 - 1e-7)); // as a float is rounded
      count.Near += squared[j] <= 1.3 * truth + 1.0 ? 1 : 0;
    }
  }
}

}

TEST(PatchBound, IsNeverLessThanTheDistanceAndNearToItMostly)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  BoundCount count;
  for (int i = 0; i < 4000; ++i)
  {
    // Sheared and stretched worlds, of any size.
    AffineMap map;
    const double size = std::pow(10.0, 12.0 * part(random));
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        map.Rows[row][column] =
          size * (row == column ? 1.0 + 0.9 * part(random) : 0.4 * part(random));
      }
    }
    if (i % 4 == 0) // one axis leans by a half: no margin but the one for the lean
    {
      map.Rows[0] = { size, 0.5 * size, 0.0, 0.0 };
      map.Rows[1] = { 0.0, size, 0.0, 0.0 };
      map.Rows[2] = { 0.0, 0.0, size, 0.0 };
    }
    ExpectBounds(AffineLengths(map), i, random, count);
  }
  EXPECT_GT(static_cast<double>(count.Near), 0.65 * static_cast<double>(count.All));
}

TEST(PatchBound, IsSoAlongUnevenAxes)
{
  std::mt19937 random(12);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  BoundCount count;
  for (int i = 0; i < 2000; ++i)
  {
    // Of any size, far from the origin too; steps that differ by a factor of up to a million.
    const double size = std::pow(10.0, 12.0 * part(random));
    const double spread = 3.0 * std::abs(part(random));
    AxisCoordinates axes;
    for (std::vector<double>& axis : axes)
    {
      const double sign = part(random) < 0.0 ? -1.0 : 1.0;
      double at = 100.0 * size * part(random);
      for (int j = 0; j < 400; ++j)
      {
        axis.push_back(at);
        at += sign * size * std::pow(10.0, spread * part(random));
      }
    }
    const AxesLengths metric(axes, i % 2);
    ASSERT_TRUE(metric.IsValid());
    ExpectBounds(metric, i, random, count);
  }
  EXPECT_GT(static_cast<double>(count.Near), 0.65 * static_cast<double>(count.All));
}
