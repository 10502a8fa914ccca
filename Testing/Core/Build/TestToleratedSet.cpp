// SPDX-License-Identifier: BSD-3-Clause
// Meshes of one tolerance: the refined set is the smallest that keeps it, by the errors that are
// measured for all tolerances, and whole meshes keep the promise.
#include "Build/OwnErrors.h"
#include "Build/StagedBuild.h"
#include "DistanceError/DistanceError.h"
#include "Patches/WorldLengths.h"
#include "Tools/DistanceTestTools.h"
#include "Tools/TopologyTestTools.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>
#include <variant>

using namespace isodiamond;

namespace
{

/** Waves with some samples that are not finite, which no coarse diamond has as a vertex. */
test::Field HoledField()
{
  test::Field field = test::WaveField({ 30, 17, 20 });
  field.Name = "waves with holes";
  std::mt19937 random(64);
  for (std::size_t i = 0; i < field.Samples.size(); ++i)
  {
    const auto x = static_cast<int>(i % 30);
    const auto y = static_cast<int>(i / 30 % 17);
    const auto z = static_cast<int>(i / 510);
    if ((x & y & z & 1) != 0 && random() % 200 == 0)
    {
      field.Samples[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  return field;
}

std::vector<test::Field> Fields()
{
  return { HoledField(), test::NoiseField({ 9, 9, 9 }, 61), test::SphereField({ 17, 17, 17 }),
    test::SparseField({ 17, 17, 17 }, 62), test::WaveField({ 19, 16, 21 }),
    test::BrokenField({ 9, 10, 8 }, 63), test::SphereField({ 12, 17, 9 }) };
}

using Tolerated = std::function<double(const Place&)>;

/** The errors of all diamonds, measured independently of any tolerance. */
struct AllErrors
{
  ErrorCode Code;
  double Least; ///< smaller ways back may be taken for this
  std::vector<ErrorCode::Type> Forth;
  std::vector<ErrorCode::Type> Both;

  AllErrors(
    const IsodiamondHierarchy& relevant, const AnySamples& samples, const BuildOptions& options)
    : Code(DistanceErrorScale(relevant.SampleGrid(), options.World))
    , Least(std::visit([](const auto& lengths) { return lengths.TypicalStep() / 64.0; },
        WorldLengthsOf(options.World)))
    , Forth(DistanceErrors(
        relevant, Finiteness(samples), options.World, options.PreserveFeatures, SerialFor))
    , Both(this->Forth)
  {
    RaiseByWayBack(relevant, options.World, { options.Hidden }, this->Both, SerialFor);
    SubdivideOverturned(relevant, options.World, SerialFor, this->Both);
    SubdivideOverturned(relevant, options.World, SerialFor, this->Forth);
  }
};

/** How many diamonds of the sets were looked at. */
struct Seen
{
  int Subdivided = 0;
  int Leaves = 0;
};

bool IsSubdivided(const IsodiamondHierarchy& mesh, const Place& place)
{
  const std::int64_t rank = mesh.Diamonds().Rank(place);
  return rank != DiamondSet::None && mesh.Threshold(rank) == ErrorCode::Always;
}

/** Calls body(parent) for the parents of a diamond, except corners of the base cube. */
template <typename Body>
void ForEachParent(const IsodiamondHierarchy& mesh, const Place& place, const Body& body)
{
  const TypeTable& shape = ShapeOf(place.Position);
  for (int i = 0; i < shape.ParentCount; ++i)
  {
    const Place parent = ParentPlace(shape, place, i);
    if (parent.Scale < mesh.SampleGrid().Depth() &&
      mesh.SampleGrid().IsValid(parent.Position, parent.Scale))
    {
      body(parent);
    }
  }
}

bool HasSubdividedChild(const IsodiamondHierarchy& mesh, const Place& place)
{
  const TypeTable& shape = ShapeOf(place.Position);
  bool has = false;
  for (int i = 0; i < shape.ChildCount && !has; ++i)
  {
    const Place child = ChildPlace(shape, place, i);
    has = child.Scale >= 0 && IsSubdivided(mesh, child);
  }
  return has;
}

/** Expects that a set is closed, that no diamond that it leaves whole exceeds its tolerance, and
 *  that each one in it exceeds its own, or leads to one that does. */
void ExpectSmallestSet(
  const IsodiamondHierarchy& mesh, const AllErrors& errors, const Tolerated& tolerated, Seen& seen)
{
  mesh.Diamonds().ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      if (place.Scale == mesh.SampleGrid().Depth())
      {
        return;
      }
      const bool isSubdivided = IsSubdivided(mesh, place);
      bool isMet =
        place.Scale == mesh.SampleGrid().Depth() - 1 && place.Position == Point{ 1, 1, 1 };
      ForEachParent(mesh, place,
        [&](const Place& parent)
        {
          isMet = isMet || IsSubdivided(mesh, parent);
          ASSERT_TRUE(!isSubdivided || IsSubdivided(mesh, parent)) << "not closed";
        });
      const double tolerance = tolerated(place);
      const ErrorCode::Type accepted = errors.Code.Accepted(tolerance);
      if (isSubdivided)
      {
        ++seen.Subdivided;
        ASSERT_TRUE(errors.Forth[rank] > accepted ||
          errors.Code.Decode(errors.Both[rank]) > tolerance * 8.0 / 9.0 * (1.0 - 1e-6) ||
          HasSubdividedChild(mesh, place))
          << "need not be subdivided";
      }
      else if (isMet)
      {
        ++seen.Leaves;
        ASSERT_LE(errors.Forth[rank], accepted) << "too far away";
        // In the errors of all diamonds, the way back is rounded up by a quarter at most.
        ASSERT_LE(errors.Code.Decode(errors.Both[rank]),
          1.25 * (1.0 + 1e-6) *
            std::max({ tolerance, errors.Least, errors.Code.Decode(errors.Forth[rank]) }));
      }
    });
}

}

TEST(ToleratedSet, IsTheSmallestThatKeepsTheTolerance)
{
  Seen seen;
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    for (const GridGeometry& world : test::WorldsFor(field.Dims))
    {
      for (const bool preserve : { true, false })
      {
        BuildOptions options = test::Distance(world);
        options.PreserveFeatures = preserve;
        StagedBuild staged(field.View(), field.Isovalue, SerialFor, options);
        const AllErrors errors(staged.OneMesh(), field.View(), options);
        const int middle = field.Dims[0] / 2;
        for (const double tolerance : { 0.01, 0.1, 0.3, 1.0, 3.0, 1000.0 })
        {
          SCOPED_TRACE(tolerance);
          for (const Tolerated& tolerated : { Tolerated([=](const Place&) { return tolerance; }),
                 Tolerated([=](const Place& place)
                   { return Centre(place)[0] < middle ? tolerance : 4.0 * tolerance; }) })
          {
            staged.RefineTo(tolerated, field.View(), test::ThreadedFor(2), options);
            ExpectSmallestSet(staged.OneMesh(), errors, tolerated, seen);
            ASSERT_FALSE(testing::Test::HasFailure());
          }
        }
      }
    }
  }
  EXPECT_GT(seen.Subdivided, 10000);
  EXPECT_GT(seen.Leaves, 10000);
}

// Where cells are long on one axis, errors are far below a step on that axis.
TEST(ToleratedSet, IsNotLargerBecauseCellsAreLong)
{
  const test::Field field = test::SphereField({ 33, 33, 12 });
  const BuildOptions options = test::Distance(test::Spacing(1.0, 1.0, 30.0));
  StagedBuild staged(field.View(), field.Isovalue, SerialFor, options);
  const test::Built all = test::Build(Model::Relevant, field, options);
  for (const double tolerance : { 0.1, 0.5 })
  {
    staged.RefineTo([=](const Place&) { return tolerance; }, field.View(), SerialFor, options);
    const std::size_t found = test::Extract(staged.OneMesh(), tolerance).Triangles.size();
    EXPECT_LE(found, 1.02 * test::Extract(*all.Hierarchy, tolerance).Triangles.size());
    EXPECT_LT(found, test::Extract(*all.Hierarchy, 0.0).Triangles.size());
  }
}

// Grids with few diamonds on each scale, the coarsest far wider than the grid.
TEST(ToleratedSet, IsTheSmallestOfLongGridsToo)
{
  Seen seen;
  const test::Field field = test::WaveField({ 16500, 3, 2 });
  const BuildOptions options = test::Distance();
  StagedBuild staged(field.View(), field.Isovalue, SerialFor, options);
  const AllErrors errors(staged.OneMesh(), field.View(), options);
  for (const double tolerance : { 0.3, 3.0, 3e4 })
  {
    const Tolerated tolerated = [=](const Place&) { return tolerance; };
    staged.RefineTo(tolerated, field.View(), SerialFor, options);
    ExpectSmallestSet(staged.OneMesh(), errors, tolerated, seen);
  }
  EXPECT_GT(seen.Leaves, 100);
}

TEST(ToleratedSet, IsAPromise)
{
  std::size_t fewer = 0;
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    for (const GridGeometry& world : test::WorldsFor(field.Dims))
    {
      const BuildOptions options = test::Distance(world);
      StagedBuild staged(field.View(), field.Isovalue, SerialFor, options);
      const test::SurfaceTriangles full = test::Placed(test::Extract(staged.OneMesh(), 0.0), world);
      for (const double tolerance : { 0.03, 0.1, 0.3, 1.0, 3.0, 1000.0 })
      {
        staged.RefineTo([=](const Place&) { return tolerance; }, field.View(), SerialFor, options);
        const test::SurfaceTriangles mesh =
          test::Placed(test::Extract(staged.OneMesh(), tolerance), world);
        fewer += mesh.size() < full.size() ? 1 : 0;
        test::Promise promise;
        promise.Tolerance = tolerance;
        EXPECT_EQ(FaultOf(promise, full, mesh), "");
      }
    }
  }
  EXPECT_GT(fewer, 20U);
}

TEST(ToleratedSet, IsAPromiseOfBothSurfaces)
{
  for (const test::Field& field : { test::SphereField({ 17, 17, 17 }),
         test::WaveField({ 14, 11, 13 }), test::NoiseField({ 9, 9, 9 }, 61) })
  {
    SCOPED_TRACE(field.Name);
    for (const GridGeometry& world : test::WorldsFor(field.Dims))
    {
      const BuildOptions options = test::Distance(world);
      StagedBuild staged(
        field.View(), test::RegionOf(test::RangesOf(field)[0]), SerialFor, options);
      const test::Volume full = test::ExtractVolume(staged.OneMesh(), 0.0);
      for (const double tolerance : { 0.1, 0.25, 1.0, 4.0 })
      {
        staged.RefineTo([=](const Place&) { return tolerance; }, field.View(), SerialFor, options);
        const test::Volume volume = test::ExtractVolume(staged.OneMesh(), tolerance);
        for (const int surface : { -1, 1 })
        {
          test::Promise promise;
          promise.Tolerance = tolerance;
          EXPECT_EQ(FaultOf(promise, test::Placed(full, surface, world),
                      test::Placed(volume, surface, world)),
            "");
        }
      }
    }
  }
}

// The same mesh whatever was made before, with any threads; and nothing that follows depends on it.
TEST(ToleratedSet, OfRandomFieldsIsFitAndLeavesNoTrace)
{
  const int cases = test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random numbers(seed);
      const test::RandomSamples field(numbers, 24, 3000);
      const Isoregion region = test::RandomRegion(numbers, field);
      SCOPED_TRACE(test::Describe(field, region));
      test::OwningOptions options = test::RandomOptions(numbers, field.Dimensions);
      options.Metric = ErrorMetric::Distance;
      options.RefineInterior = false;
      const HiddenCells hidden = test::RandomHidden(numbers, field.Dimensions);
      options.Hidden = region.IsVolume() ? nullptr : &hidden;
      StagedBuild staged(field.View(), region, SerialFor, options);
      const test::AnyMesh full(staged.OneMesh(), Query{});
      const double scale = DistanceErrorScale(staged.OneMesh().SampleGrid(), options.World);
      const auto meshAt = [&](StagedBuild& build, double tolerance, const ParallelFor& loops)
      {
        build.RefineTo([=](const Place&) { return tolerance; }, field.View(), loops, options);
        return test::AnyMesh(build.OneMesh(), Query{ tolerance });
      };
      const double tolerance = scale * std::exp2(-test::Uniform(numbers, 0.0, 8.0));
      const test::AnyMesh mesh = meshAt(staged, tolerance, SerialFor);
      EXPECT_EQ(mesh.Fault(field.Dimensions), "");
      EXPECT_LE(mesh.CellCount(), full.CellCount());
      if (options.PreserveTopology)
      {
        const auto left = [&](const test::AnyMesh& all)
        { return options.Hidden != nullptr ? test::WithoutHidden(all, hidden) : all; };
        EXPECT_EQ(test::Topology(left(mesh)), test::Topology(left(full)));
      }
      meshAt(staged, 0.5 * tolerance, SerialFor);
      StagedBuild other(field.View(), region, test::ThreadedFor(3), options);
      EXPECT_TRUE(mesh == meshAt(staged, tolerance, test::ThreadedFor(3)));
      EXPECT_TRUE(mesh == meshAt(other, tolerance, test::ThreadedFor(2)));
      EXPECT_TRUE(full == test::AnyMesh(staged.OneMesh(), Query{}));
      meshAt(staged, tolerance, SerialFor);
      test::ExpectSame(staged.Finish(Model::Minimal, field.View(), SerialFor, options),
        BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options));
    });
  EXPECT_GT(cases, 0);
}

TEST(ToleratedSet, NeedsDistancesAndNothingInside)
{
  const test::Field field = test::SphereField({ 9, 9, 9 });
  const auto refine = [&](const Isoregion& region, const BuildOptions& options)
  {
    StagedBuild staged(field.View(), region, SerialFor, options);
    staged.RefineTo([](const Place&) { return 1.0; }, field.View(), SerialFor, options);
  };
  EXPECT_THROW(refine(field.Isovalue, {}), std::invalid_argument);
  BuildOptions inside = test::Distance();
  inside.RefineInterior = true;
  EXPECT_THROW(refine({ field.Isovalue, field.Isovalue + 1.0 }, inside), std::invalid_argument);
  EXPECT_NO_THROW(refine(field.Isovalue, inside));
}
