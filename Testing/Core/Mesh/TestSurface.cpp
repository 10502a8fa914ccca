// SPDX-License-Identifier: BSD-3-Clause
// The extracted surfaces: against the reference's marching tetrahedra, and what must hold at
// every tolerance.
#include "Mesh/DiamondMesh.h"
#include "Mesh/SurfaceExtraction.h"
#include "Refinement/ScalarQuery.h"
#include "Tools/CoreTestTools.h"

#include "ReferenceError.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace isodiamond;

TEST(Surface, EqualsTheReferenceMeshAtEveryTolerance)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const reference::ScalarField samples = field.Reference();
    const std::vector<bool> crossed = reference::CrossedDomains(hierarchy, samples, field.Isovalue);
    std::vector<double> errors = reference::OwnFieldErrors(hierarchy, samples);
    const test::Built minimal = test::Build(Model::Minimal, field);
    const reference::ErrorCodes codes(minimal.Hierarchy->Codes().Scale());
    std::transform(errors.begin(), errors.end(), errors.begin(),
      [&](double error) { return double(codes.CodeOf(error)); });
    for (const double tolerance : test::Tolerances(minimal.Hierarchy->Codes().Scale()))
    {
      SCOPED_TRACE(tolerance);
      const reference::DiamondSet subdivided = reference::Refine(
        hierarchy, reference::UniformCriterion(errors, crossed, codes.LastWithin(tolerance)))
                                                 .Subdivided;
      EXPECT_EQ(test::CompareWithPatches(test::Extract(*minimal.Hierarchy, tolerance),
                  reference::LeafPatches(hierarchy, samples, field.Isovalue, subdivided), samples,
                  field.Isovalue),
        "");
    }
  }
}

TEST(Surface, IsTheFullResolutionSurfaceAtToleranceZero)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const reference::ScalarField samples = field.Reference();
    const std::vector<reference::Patch> patches =
      reference::FullResolutionPatches(hierarchy, samples, field.Isovalue);
    for (const bool exact : { true, false })
    {
      const test::Mesh mesh =
        test::Extract(*test::Build(Model::Minimal, field, test::Placement(exact)).Hierarchy, 0.0);
      EXPECT_EQ(test::CompareWithPatches(mesh, patches, samples, field.Isovalue, exact), "");
      EXPECT_EQ(mesh.Points.size(), reference::IsoverticesOf(patches).size());
      EXPECT_EQ(int(mesh.Triangles.size()), reference::CountTriangles(patches));
    }
  }
}

// A triangle is there, at its level, at tolerances from its diamond's threshold on, and not below.
TEST(Surface, ThresholdsTellBelowWhatTrianglesGo)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const test::Built built = test::Build(Model::Minimal, field, test::Distance());
    const ErrorCode& codes = built.Hierarchy->Codes();
    const RefinedSet refined(*built.Hierarchy, { 0.02 * codes.Scale() }, SerialFor);
    const SurfaceExtraction extraction(refined, SerialFor);
    std::vector<ErrorCode::Type> thresholds(extraction.TriangleCount());
    extraction.WriteThresholds(thresholds.data());

    const test::Mesh mesh = test::Extract(*built.Hierarchy, 0.02 * codes.Scale());
    ASSERT_EQ(mesh.Triangles.size(), thresholds.size());
    std::map<ErrorCode::Type, std::vector<test::PlacedTriangle>> byThreshold;
    for (std::size_t i = 0; i < thresholds.size(); ++i)
    {
      const auto [a, b, c] = mesh.Triangles[i];
      byThreshold[thresholds[i]].push_back(
        test::Place(mesh.Points[a], mesh.Points[b], mesh.Points[c], mesh.Levels[i]));
      EXPECT_EQ(thresholds[i] == 0, mesh.Levels[i] == Grid(field.Dims).Depth());
    }
    const auto countAt = [&](double tolerance, const std::vector<test::PlacedTriangle>& wanted)
    {
      std::vector<test::PlacedTriangle> there =
        test::PlacedTriangles(test::Extract(*built.Hierarchy, tolerance));
      std::sort(there.begin(), there.end());
      return std::count_if(wanted.begin(), wanted.end(),
        [&](const test::PlacedTriangle& triangle)
        { return std::binary_search(there.begin(), there.end(), triangle); });
    };
    // If a leaf is cut in two, the same triangle may be there again, in the half that holds it.
    std::ptrdiff_t all = 0;
    std::ptrdiff_t left = 0;
    for (const auto& [code, triangles] : byThreshold)
    {
      const double least = code == 0 ? 0.0 : codes.Decode(code);
      EXPECT_EQ(countAt(least, triangles), std::ptrdiff_t(triangles.size())) << code;
      all += code == 0 ? 0 : std::ptrdiff_t(triangles.size());
      left += code == 0 ? 0 : countAt(std::nextafter(least, 0.0), triangles);
    }
    EXPECT_LE(3 * left, all);
  }
}

TEST(Surface, ThreeModelsGiveTheIdenticalMesh)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const test::Built minimal = test::Build(Model::Minimal, field);
    const test::BuiltScalars scalars = test::BuildScalars(field);
    for (const double tolerance : test::Tolerances(minimal.Hierarchy->Codes().Scale()))
    {
      const test::Mesh mesh = test::Extract(*minimal.Hierarchy, tolerance);
      EXPECT_TRUE(mesh == test::Extract(*relevant.Hierarchy, tolerance));
      const test::Built query(
        EncodeQuery(*scalars.Hierarchy, field.Isovalue, { tolerance }, true, SerialFor), SerialFor);
      EXPECT_TRUE(mesh == test::Extract(*query.Hierarchy, tolerance));
    }
  }
}

TEST(Surface, ConformsAtEveryTolerance)
{
  std::vector<test::Field> fields = test::SmallFields();
  for (const std::array<int, 3>& dims :
    std::vector<std::array<int, 3>>{ { 33, 33, 33 }, { 32, 32, 32 }, { 50, 19, 27 } })
  {
    fields.push_back(test::NoiseField(dims, 77));
    fields.push_back(test::SphereField(dims));
    fields.push_back(test::SparseField(dims, 78));
    fields.push_back(test::WaveField(dims));
  }
  for (const test::Field& field : fields)
  {
    SCOPED_TRACE(field.Name);
    const test::Built minimal = test::Build(Model::Minimal, field);
    for (const double tolerance : test::Tolerances(minimal.Hierarchy->Codes().Scale()))
    {
      SCOPED_TRACE(tolerance);
      EXPECT_EQ(test::FindFault(test::Extract(*minimal.Hierarchy, tolerance), field.Dims), "");
    }
  }
}

TEST(Surface, NormalsPointToLowerValues)
{
  // A ball: high inside, so normals point outward.
  test::Field field = test::SphereField({ 33, 33, 33 });
  for (int i = 0; i < 33 * 33 * 33; ++i)
  {
    field.Samples[i] =
      10.0F - static_cast<float>(std::hypot(i % 33 - 16.2, i / 33 % 33 - 15.9, i / 1089 - 16.1));
  }
  const test::Built minimal = test::Build(Model::Minimal, field);
  for (const double tolerance : { 0.0, 0.05, 0.3 })
  {
    double volume = 0.0; // six times
    const test::Mesh mesh = test::Extract(*minimal.Hierarchy, tolerance);
    for (const std::array<std::int32_t, 3>& t : mesh.Triangles)
    {
      const test::Corner& a = mesh.Points[t[0]];
      const test::Corner& b = mesh.Points[t[1]];
      const test::Corner& c = mesh.Points[t[2]];
      volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
        a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    // The ball of radius 9.75; the field is the distance, so the tolerance bounds the shift.
    const double sphere = 4.0 * std::acos(-1.0) * 9.75 * 9.75;
    EXPECT_NEAR(volume / 6.0, sphere * 9.75 / 3.0, sphere * (tolerance + 0.02));
  }
}

TEST(Surface, KeepsThePromiseOfTheFieldMetric)
{
  // At every lattice point of every tetrahedron that carries the surface, by brute force.
  for (const test::Field& field : { test::NoiseField({ 17, 17, 17 }, 21),
         test::SphereField({ 17, 17, 17 }), test::WaveField({ 17, 17, 17 }),
         test::SphereField({ 14, 13, 9 }), test::WaveField({ 10, 12, 6 }) })
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const reference::ScalarField samples = field.Reference();
    const test::Built minimal = test::Build(Model::Minimal, field);
    for (const double tolerance : test::Tolerances(minimal.Hierarchy->Codes().Scale()))
    {
      const DiamondMesh mesh =
        ExtractDiamondMesh(RefinedSet(*minimal.Hierarchy, { tolerance }, SerialFor));
      std::set<int> carrying; // the diamonds of the leaves
      for (const std::array<std::int64_t, 4>& tetrahedron : mesh.Tetrahedra)
      {
        reference::Tetrahedron leaf;
        for (int i = 0; i < 4; ++i)
        {
          leaf.Vertices[i] = mesh.Points[tetrahedron[i]];
        }
        carrying.insert(hierarchy.DiamondOf(leaf));
      }
      carrying.erase(-1); // full resolution: no lattice point but the vertices
      for (const int diamond : carrying)
      {
        EXPECT_LE(reference::OwnFieldError(hierarchy, samples, diamond), tolerance);
      }
    }
  }
}

TEST(Surface, DoesNotDependOnThreads)
{
  const test::Field field = test::WaveField({ 50, 33, 41 });
  const Encoding encoding =
    BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, SerialFor);
  const IsodiamondHierarchy hierarchy(encoding, SerialFor);
  const test::Mesh expected = test::Extract(hierarchy, 0.02);
  for (const int threads : { 1, 2, 7 })
  {
    const ParallelFor parallelFor = test::ThreadedFor(threads);
    const Encoding other =
      BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, parallelFor);
    EXPECT_EQ(other.Arrays.BrickMasks, encoding.Arrays.BrickMasks);
    EXPECT_EQ(other.Arrays.Records, encoding.Arrays.Records);
    EXPECT_EQ(other.Arrays.Isovertices, encoding.Arrays.Isovertices);
    EXPECT_TRUE(
      test::Extract(IsodiamondHierarchy(other, parallelFor), 0.02, parallelFor) == expected);
    const ScalarEncoding scalars = BuildScalarHierarchy(field.View(), parallelFor);
    EXPECT_EQ(scalars.Codes, test::BuildScalars(field).Encoding.Codes);
  }
}

TEST(Surface, IsEmptyForConstantFieldsAndIsovaluesOutside)
{
  test::Field field = test::NoiseField({ 9, 6, 7 }, 1);
  for (const double isovalue : { -1.0, 8.0, 100.0 }) // 8 is the largest sample: none above
  {
    field.Isovalue = isovalue;
    EXPECT_TRUE(test::Extract(*test::Build(Model::Relevant, field).Hierarchy, 0.0).Points.empty());
  }
  std::fill(field.Samples.begin(), field.Samples.end(), 4.0F);
  field.Isovalue = 4.0;
  EXPECT_TRUE(test::Extract(*test::Build(Model::Minimal, field).Hierarchy, 0.0).Points.empty());
  EXPECT_EQ(test::BuildScalars(field).Hierarchy->Refine(4.0, 0).Visited, 1);
}

TEST(Surface, AtInfiniteToleranceDependsOnTheRoot)
{
  const double infinity = std::numeric_limits<double>::infinity();
  // An active root: the base cube's own six tetrahedra carry the coarsest surface.
  test::Field field = test::WaveField({ 17, 17, 17 });
  for (int i = 0; i < 17 * 17 * 17; ++i)
  {
    field.Samples[i] = static_cast<float>(i % 17);
  }
  field.Isovalue = 7.3;
  test::Mesh mesh = test::Extract(*test::Build(Model::Minimal, field).Hierarchy, infinity);
  EXPECT_EQ(test::FindFault(mesh, field.Dims), "");
  EXPECT_EQ(mesh.Triangles.size(), 8U); // four, and two quadrilaterals of two each
  EXPECT_TRUE(std::all_of(
    mesh.Levels.begin(), mesh.Levels.end(), [](std::int16_t level) { return level == 0; }));
  // A relevant root: all corners are on one side, so nothing is there without subdivision.
  field = test::SparseField({ 17, 17, 17 }, 3);
  for (const std::size_t corner : { 0, 16, 272, 288, 4624, 4640, 4896, 4912 })
  {
    field.Samples[corner] = 0.0F;
  }
  field.Samples[2456] = 0.0F; // the centre
  mesh = test::Extract(*test::Build(Model::Minimal, field).Hierarchy, infinity);
  EXPECT_TRUE(mesh.Triangles.empty());
}

TEST(Surface, TellsOfEachPointOnce)
{
  const test::Field field = test::SphereField({ 17, 12, 9 });
  const test::Built built = test::Build(Model::Minimal, field);
  const RefinedSet refined(*built.Hierarchy, { 0.3 }, SerialFor);
  const SurfaceExtraction extraction(refined, SerialFor);
  std::vector<double> written(3 * extraction.PointCount());
  extraction.WritePoints(AffineMap(), written.data());
  std::vector<int> seen(extraction.PointCount());
  extraction.ForEachPoint(
    [&](const MeshPoint& point)
    {
      ++seen[point.Id];
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(point.Index[axis], written[3 * point.Id + axis]);
      }
      EXPECT_EQ(point.Surface, -1);
    });
  EXPECT_GT(seen.size(), 100U);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), extraction.PointCount());
}

namespace
{

/** Six times the volume; all tetrahedra have to be positive. */
std::int64_t SixVolumesOf(const DiamondMesh& mesh)
{
  std::int64_t six = 0;
  for (const std::array<std::int64_t, 4>& t : mesh.Tetrahedra)
  {
    const Point& o = mesh.Points[t[0]];
    const int part = tables::Determinant(
      mesh.Points[t[1]] + -1 * o, mesh.Points[t[2]] + -1 * o, mesh.Points[t[3]] + -1 * o);
    EXPECT_GT(part, 0);
    six += part;
  }
  return six;
}

}

TEST(DiamondMesh, HasNothingBeyondTheGrid)
{
  for (const std::array<int, 3>& dims :
    std::vector<std::array<int, 3>>{ { 14, 13, 9 }, { 3, 17, 17 }, { 9, 17, 6 } })
  {
    // A surface in one corner only: the large diamonds left elsewhere stick out of the grid.
    test::Field field{ "corner", dims, {}, 0.5 };
    field.Samples.assign(std::size_t{ 1 } * dims[0] * dims[1] * dims[2], 0.0F);
    field.Samples[0] = 1.0F;
    const test::Built relevant = test::Build(Model::Relevant, field);
    for (const double tolerance : { 0.0, 1e9 })
    {
      const DiamondMesh mesh =
        ExtractDiamondMesh(RefinedSet(*relevant.Hierarchy, { tolerance }, SerialFor));
      EXPECT_FALSE(mesh.Tetrahedra.empty());
      for (const Point& point : mesh.Points)
      {
        EXPECT_TRUE(relevant.Hierarchy->SampleGrid().IsSampled(point));
      }
      EXPECT_LE(SixVolumesOf(mesh), 6 * (dims[0] - 1) * (dims[1] - 1) * (dims[2] - 1));
    }
  }
}

TEST(DiamondMesh, TilesTheDomainForRelevantAndScalarHierarchies)
{
  const test::Field field = test::SphereField({ 17, 17, 17 });
  const test::Built relevant = test::Build(Model::Relevant, field);
  const test::Built minimal = test::Build(Model::Minimal, field);
  const auto corners = [](const DiamondMesh& mesh, std::size_t tetrahedron)
  {
    std::array<Point, 4> points{};
    for (int i = 0; i < 4; ++i)
    {
      points[i] = mesh.Points[mesh.Tetrahedra[tetrahedron][i]];
    }
    return points;
  };
  // Those that the surface crosses, or all.
  const auto tetrahedra = [&](const DiamondMesh& mesh, bool isCrossed)
  {
    std::set<std::array<Point, 4>> chosen;
    for (std::size_t i = 0; i < mesh.Tetrahedra.size(); ++i)
    {
      std::array<Point, 4> points = corners(mesh, i);
      const auto above = std::count_if(points.begin(), points.end(),
        [&](const Point& p) { return field.Reference().At(p) > field.Isovalue; });
      std::sort(points.begin(), points.end());
      if (!isCrossed || (above != 0 && above != 4))
      {
        chosen.insert(points);
      }
    }
    return chosen;
  };
  for (const double tolerance : { 0.0, 0.1, 1.0, 1e9 })
  {
    const DiamondMesh whole =
      ExtractDiamondMesh(RefinedSet(*relevant.Hierarchy, { tolerance }, SerialFor));
    EXPECT_EQ(SixVolumesOf(whole), 6 * 16 * 16 * 16);
    // An MI knows nothing about where there is no surface, but everything about where there is one.
    const DiamondMesh part =
      ExtractDiamondMesh(RefinedSet(*minimal.Hierarchy, { tolerance }, SerialFor));
    EXPECT_EQ(tetrahedra(part, true), tetrahedra(whole, true));
    EXPECT_EQ(tetrahedra(part, true).empty(), tolerance == 1e9); // no corner of the cube is above
    EXPECT_EQ(tetrahedra(part, false).size(), part.Tetrahedra.size());
    EXPECT_LE(SixVolumesOf(part), 6 * 16 * 16 * 16);
  }
}
