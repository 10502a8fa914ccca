// SPDX-License-Identifier: BSD-3-Clause
// The promise where searches go by clusters and bricks, which small fields have no use for, checked
// by brute force over all triangles. Larger fields: ctest -C Long -L long
#include "DistanceError/DistanceError.h"
#include "Tools/DistanceTestTools.h"

#include "ReferenceError.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

using namespace isodiamond;

namespace
{

/** 33 samples on each axis, unless ISODIAMONDS_SAMPLES says otherwise. */
int Samples()
{
  const char* text = std::getenv("ISODIAMONDS_SAMPLES");
  return text != nullptr ? std::atoi(text) : 33;
}

/** Isolated samples far from each other: large diamonds with little in them. */
test::Field RareField(const std::array<int, 3>& dims, unsigned seed, int count)
{
  std::mt19937 random(seed);
  test::Field field = test::SparseField(dims, seed);
  std::fill(field.Samples.begin(), field.Samples.end(), 0.0F);
  for (int i = 0; i < count; ++i)
  {
    field.Samples[random() % field.Samples.size()] = 1.0F + static_cast<float>(random() % 5);
  }
  return field;
}

/** A bent sheet near the middle: every large diamond has a patch, and most samples are far off. */
test::Field Ridge(const std::array<int, 3>& dims)
{
  test::Field field = test::WaveField(dims);
  for (std::size_t i = 0; i < field.Samples.size(); ++i)
  {
    const double x = static_cast<double>(i % dims[0]) - 0.45 * dims[0];
    const double y = static_cast<double>(i / dims[0] % dims[1]) - 0.55 * dims[1];
    field.Samples[i] += static_cast<float>(2.0 * x + 0.7 * y + 0.02 * y * y);
  }
  return field;
}

/** Compares full resolution and the mesh of every tolerance, both ways. */
void CheckPromise(const test::Field& field, const GridGeometry& world)
{
  SCOPED_TRACE(field.Name);
  const test::Built built(BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue,
                            test::ThreadedFor(2), test::Distance(world)),
    SerialFor);
  const test::Mesh finest = test::Extract(*built.Hierarchy, 0.0);
  const test::SurfaceTriangles full = test::Placed(finest, world);
  std::size_t fewest = finest.Triangles.size();
  for (const double tolerance : { 0.3, 1.0, 3.0, 8.0 })
  {
    const test::Mesh mesh = test::Extract(*built.Hierarchy, tolerance);
    EXPECT_EQ(test::FindFault(mesh, field.Dims), "");
    fewest = std::min(fewest, mesh.Triangles.size());
    test::Promise promise;
    promise.Tolerance = tolerance;
    promise.Step = 0.25;
    promise.MostSamples = 2e4;
    EXPECT_EQ(FaultOf(promise, full, test::Placed(mesh, world)), "") << "tolerance " << tolerance;
  }
  EXPECT_LT(fewest, finest.Triangles.size());
}

}

TEST(LargeFields, KeepThePromise)
{
  const int n = Samples();
  const std::array<int, 3> cube = { n, n, n };
  const std::array<int, 3> box = { 2 * n - 1, n - 5, n / 2 };
  CheckPromise(test::SphereField(cube), AffineMap());
  CheckPromise(test::WaveField(box), test::Spacing(0.5, 2.0, 1.25));
  CheckPromise(RareField(cube, 71, 2 * n), AffineMap());
  CheckPromise(test::WaveField(cube), GridGeometry(test::UnevenCoordinates(cube, 20.0)));
}

TEST(LargeFields, KeepThePromiseAt65Samples)
{
  CheckPromise(test::SphereField({ 65, 65, 65 }), AffineMap());
}

TEST(LargeFields, KeepThePromiseOfBothSurfaces)
{
  const int n = Samples();
  const test::Field field = test::SphereField({ n, n, n });
  const test::Built built(BuildIsodiamonds(Model::Minimal, field.View(), { 0.25, 3.0 },
                            test::ThreadedFor(2), test::Distance()),
    SerialFor);
  const test::Volume full = test::ExtractVolume(*built.Hierarchy, 0.0);
  for (const double tolerance : { 0.5, 2.0 })
  {
    const test::Volume volume = test::ExtractVolume(*built.Hierarchy, tolerance);
    EXPECT_LT(volume.Tetrahedra.size(), full.Tetrahedra.size());
    for (const int surface : { -1, 1 })
    {
      test::Promise promise;
      promise.Tolerance = tolerance;
      promise.Step = 0.25;
      promise.MostSamples = 4e4;
      EXPECT_EQ(FaultOf(promise, test::Placed(full, surface, AffineMap()),
                  test::Placed(volume, surface, AffineMap())),
        "");
    }
  }
}

// In such a large field there is work for many threads while diamonds are large. Errors depend only
// on what is near: they are the same in a corner by itself, where the work goes differently.
TEST(LargeFields, HaveTheErrorsOfTheirParts)
{
  const test::Field all = test::WaveField({ 129, 129, 129 });
  test::Field part{ "part", { 65, 65, 65 }, {}, all.Isovalue };
  for (int z = 0; z < 65; ++z)
  {
    for (int y = 0; y < 65; ++y)
    {
      for (int x = 0; x < 65; ++x)
      {
        part.Samples.push_back(all.Samples[(z * 129 + y) * 129 + x]);
      }
    }
  }
  const test::Built ofAll = test::Build(Model::Relevant, all);
  const test::Built ofPart = test::Build(Model::Relevant, part);
  const auto errors = [](const test::Built& built, const test::Field& field)
  {
    return DistanceErrors(
      *built.Hierarchy, Finiteness(field.View()), AffineMap(), true, test::ThreadedFor(2));
  };
  const std::vector<ErrorCode::Type> expected = errors(ofPart, part);
  const std::vector<ErrorCode::Type> found = errors(ofAll, all);
  const ErrorCode code(DistanceErrorScale(ofPart.Hierarchy->SampleGrid(), AffineMap()));
  const ErrorCode codeOfAll(DistanceErrorScale(ofAll.Hierarchy->SampleGrid(), AffineMap()));
  std::map<int, int> seen; // by scale
  ofPart.Hierarchy->Diamonds().ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      const int h = 1 << place.Scale;
      bool isInside = place.Scale < 5; // with all tetrahedra, and those that they are halves of
      for (int axis = 0; axis < 3; ++axis)
      {
        isInside = isInside && h * (place.Position[axis] + 1) <= 64;
      }
      if (!isInside)
      {
        return;
      }
      const std::int64_t there = ofAll.Hierarchy->Diamonds().Rank(place);
      ASSERT_NE(there, DiamondSet::None);
      // Codes are rounded, in other steps for a larger grid.
      const double one = code.Decode(expected[rank]);
      const double other = codeOfAll.Decode(found[there]);
      ASSERT_LE(one, code.Decode(code.Encode(other * (1.0 + 1e-9)))) << "scale " << place.Scale;
      ASSERT_LE(other, codeOfAll.Decode(codeOfAll.Encode(one * (1.0 + 1e-9))))
        << "scale " << place.Scale;
      seen[place.Scale] += one > 0.0 && one < HUGE_VAL ? 1 : 0;
    });
  EXPECT_GT(seen[4], 0);
  EXPECT_GT(seen[3], 0);
}

// The reference is slow, but not where there is little. Each error is compared from both sides.
TEST(LargeFields, HaveTheReferencesErrorsWhereThereIsLittle)
{
  std::map<int, int> seen; // by scale
  for (const test::Field& field : { Ridge({ 33, 33, 33 }), Ridge({ 17, 40, 24 }) })
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const std::vector<double> expected = reference::OwnDistanceErrors(hierarchy, field.Reference(),
      field.Isovalue, std::array<double, 3>{ 1.0, 1.0, 1.0 }, true, true);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const Grid& grid = relevant.Hierarchy->SampleGrid();
    const std::vector<ErrorCode::Type> found =
      DistanceErrors(*relevant.Hierarchy, Finiteness(field.View()), AffineMap(), true, SerialFor);
    const reference::ErrorCodes codes(DistanceErrorScale(grid, AffineMap()));
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
      const std::int64_t rank = relevant.Hierarchy->Diamonds().Rank(place);
      if (expected[i] >= 0.0)
      {
        ASSERT_NE(rank, DiamondSet::None);
        ASSERT_GE(found[rank], codes.CodeOf(expected[i] * (1 - 1e-9))) << "diamond " << i;
        ASSERT_LE(found[rank], codes.CodeOf(expected[i] * (1 + 1e-9))) << "diamond " << i;
        seen[place.Scale] += expected[i] < HUGE_VAL ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen[4], 0); // where the search goes by clusters
}
