// SPDX-License-Identifier: BSD-3-Clause
// Interval volumes: patches, meshes at every tolerance in every model, volumes.
#include "Patches/IntervalCases.h"
#include "Patches/IntervalPatches.h"
#include "Refinement/ScalarQuery.h"
#include "Tools/IntervalTestTools.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace isodiamond;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

PatchSigns SignsOf(int code)
{
  return { code % 3, code / 3 % 3, code / 9 % 3, code / 27 };
}

PatchStates MovedStatesOf(int code)
{
  return { code % 5, code / 5 % 5, code / 25 % 5, code / 125 };
}

/** Whether nothing, or nothing with a volume, is in range. */
bool IsFlat(const PatchStates& states)
{
  return *std::max_element(states.begin(), states.end()) <= OnLower ||
    *std::min_element(states.begin(), states.end()) >= OnUpper;
}

}

TEST(IntervalPatches, HaveTheNumbersOfTetrahedraThatTheSearchPromises)
{
  // By the numbers of vertices below, inside and above.
  const std::map<std::array<int, 3>, std::size_t> sizes = { { { 4, 0, 0 }, 0 }, { { 0, 0, 4 }, 0 },
    { { 0, 4, 0 }, 1 }, { { 1, 3, 0 }, 3 }, { { 2, 2, 0 }, 3 }, { { 3, 1, 0 }, 1 },
    { { 1, 0, 3 }, 3 }, { { 2, 0, 2 }, 6 }, { { 1, 1, 2 }, 5 }, { { 1, 2, 1 }, 5 } };
  for (int code = 0; code < 81; ++code)
  {
    std::array<int, 3> count{};
    for (const int sign : SignsOf(code))
    {
      ++count[sign];
    }
    auto size = sizes.find(count);
    if (size == sizes.end())
    {
      size = sizes.find({ count[2], count[1], count[0] });
    }
    ASSERT_NE(size, sizes.end());
    EXPECT_EQ(IntervalPatches()[code].size(), size->second) << code;
  }
}

// All half-tetrahedra at once, and each by itself.
TEST(IntervalPatches, CasesByWordsAreThoseOneByOne)
{
  std::array<int, 81> seen{};
  const test::Field field = test::NoiseField({ 17, 14, 16 }, 3);
  const test::Built built(
    BuildIsodiamonds(Model::Relevant, field.View(), Isoregion(3.0, 5.0), SerialFor), SerialFor);
  const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
  hierarchy.Diamonds().ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      const int type = TypeOf(place.Position);
      const TypeTable& shape = tables::Types[type];
      const IntervalCases cases(hierarchy, rank, type);
      for (int half = 0; half < shape.HalfTetrahedronCount; ++half)
      {
        const int expected = IntervalCase(hierarchy, rank, shape.HalfTetrahedra[half]);
        ASSERT_EQ(cases(half), expected) << rank << ", " << half;
        ++seen[expected];
      }
    });
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 0), 0);
}

TEST(IntervalPatches, AreThoseOfVerticesThatDidNotMove)
{
  for (int code = 0; code < 81; ++code)
  {
    const auto& patches = MovedPatches()[MovedCase(StatesOf(SignsOf(code)))];
    EXPECT_EQ(
      IntervalPatches()[code], patches.empty() ? std::vector<PatchTetrahedron>{} : patches.front());
  }
}

TEST(IntervalPatches, AreDifferentChoices)
{
  std::size_t choices = 0;
  for (const auto& patches : MovedPatches())
  {
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      EXPECT_EQ(std::find(patches.begin() + i + 1, patches.end(), patches[i]), patches.end());
    }
    choices += patches.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(choices, 0U);
}

// Wherever the isovertices are on their edges.
TEST(IntervalPatches, FillWhatIsInRangeWithPositiveTetrahedra)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int code = 0; code < 625; ++code)
  {
    const PatchStates signs = MovedStatesOf(code);
    EXPECT_EQ(MovedPatches()[code].empty(), IsFlat(signs)) << code;
    for (int trial = 0; trial < 60; ++trial)
    {
      // Coefficients from the younger end; close to the ends in some of the trials.
      std::map<int, double> along;
      const auto place = [&](const PatchPoint& point)
      {
        std::array<double, 3> position{};
        const auto corner = [](int vertex)
        {
          return std::array<double, 3>{ vertex == 1 ? 1.0 : 0.0, vertex == 2 ? 1.0 : 0.0,
            vertex == 3 ? 1.0 : 0.0 };
        };
        double t = 0.0;
        if (!point.IsVertex())
        {
          const bool rising = signs[point.Younger()] < signs[point.Older()];
          const int edge = 4 * point.Younger() + point.Older();
          if (along.count(edge) == 0)
          {
            const double a = std::pow(unit(random), trial % 3 == 0 ? 4.0 : 1.0);
            const double b = std::pow(unit(random), trial % 2 == 0 ? 4.0 : 1.0);
            along[edge] = 0.001 + 0.99 * std::min(a, b);
            along[edge + 16] = 0.005 + 0.99 * std::max(a, b);
          }
          t = along[edge + ((point.Surface() == 1) == rising ? 16 : 0)];
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          position[axis] =
            (1.0 - t) * corner(point.Younger())[axis] + t * corner(point.Older())[axis];
        }
        return position;
      };
      for (const std::vector<PatchTetrahedron>& patch : MovedPatches()[code])
      {
        for (const PatchTetrahedron& tetrahedron : patch)
        {
          test::Volume one;
          for (const PatchPoint& point : tetrahedron)
          {
            one.Points.push_back(place(point));
          }
          ASSERT_GT(test::Determinant(one, { 0, 1, 2, 3 }), 0.0) << "case " << code;
        }
      }
    }
  }
}

namespace
{

/** How often each triangle is a face of a patch's tetrahedra. */
std::map<std::array<PatchPoint, 3>, int> CountFaces(const std::vector<PatchTetrahedron>& patch)
{
  std::map<std::array<PatchPoint, 3>, int> faces;
  for (const PatchTetrahedron& tetrahedron : patch)
  {
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      std::array<PatchPoint, 3> face{};
      std::copy_if(tetrahedron.begin(), tetrahedron.end(), face.begin(),
        [&](const PatchPoint& point) { return !(point == tetrahedron[opposite]); });
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  return faces;
}

}

TEST(IntervalPatches, MeetTheFansOfTheFaces)
{
  for (int code = 0; code < 625; ++code)
  {
    for (const std::vector<PatchTetrahedron>& patch : MovedPatches()[code])
    {
      std::map<std::array<PatchPoint, 3>, int> faces = CountFaces(patch);
      for (int opposite = 0; opposite < 4; ++opposite)
      {
        const std::vector<PatchPoint> polygon = FacePolygon(MovedStatesOf(code), opposite);
        if (polygon.empty())
        {
          continue;
        }
        const PatchPoint smallest = *std::min_element(polygon.begin(), polygon.end());
        for (std::size_t i = 0; i < polygon.size(); ++i)
        {
          std::array<PatchPoint, 3> face = { smallest, polygon[i],
            polygon[(i + 1) % polygon.size()] };
          if (!(face[1] == smallest) && !(face[2] == smallest))
          {
            std::sort(face.begin(), face.end());
            EXPECT_EQ(faces[face], 1) << "case " << code;
          }
        }
      }
    }
  }
}

namespace
{

/** The three models of one field and range. */
struct Models
{
  test::Built Relevant;
  test::Built Minimal;
  test::BuiltScalars Scalars;
  Isoregion Region;

  Models(const test::Field& field, const Isoregion& region, bool refineInterior = false)
    : Relevant(BuildIsodiamonds(
                 Model::Relevant, field.View(), region, SerialFor, test::Interior(refineInterior)),
        SerialFor)
    , Minimal(BuildIsodiamonds(
                Model::Minimal, field.View(), region, SerialFor, test::Interior(refineInterior)),
        SerialFor)
    , Scalars(test::BuildScalars(field))
    , Region(region)
  {
  }

  /** The meshes of the three models must be the same, and without fault. */
  void ExpectOneSoundMesh(
    double tolerance, double interiorTolerance, const std::array<int, 3>& dims) const
  {
    const test::Volume volume =
      test::ExtractVolume(*this->Minimal.Hierarchy, tolerance, interiorTolerance);
    EXPECT_EQ(test::FindFault(volume, dims), "");
    const auto placed = test::PlacedTetrahedra(volume);
    EXPECT_TRUE(placed ==
      test::PlacedTetrahedra(
        test::ExtractVolume(*this->Relevant.Hierarchy, tolerance, interiorTolerance)));
    const test::Built query(EncodeQuery(*this->Scalars.Hierarchy, this->Region,
                              { tolerance, interiorTolerance }, true, SerialFor),
      SerialFor);
    EXPECT_TRUE(placed == test::PlacedTetrahedra(test::ExtractVolume(*query.Hierarchy, 0.0)));
  }
};

}

TEST(Interval, IsFitForASolverAtEveryTolerance)
{
  for (const test::Field& field : test::SmallFields())
  {
    for (const reference::Isorange& range : test::RangesOf(field))
    {
      const Models models(field, test::RegionOf(range));
      for (const double tolerance : test::Tolerances(models.Scalars.Encoding.ErrorScale))
      {
        SCOPED_TRACE(field.Name + " tolerance " + std::to_string(tolerance));
        models.ExpectOneSoundMesh(tolerance, Infinity, field.Dims);
      }
    }
  }
}

TEST(Interval, IsFitForASolverAtEveryInteriorTolerance)
{
  for (const test::Field& field : test::SmallFields())
  {
    const Isoregion region = test::RegionOf(test::RangesOf(field)[0]);
    const Models models(field, region, true);
    const double scale = models.Scalars.Encoding.ErrorScale;
    for (const double tolerance : { 0.0, 0.2 * scale, Infinity })
    {
      for (const double interior : { 0.0, 0.1 * scale, 0.3 * scale, Infinity })
      {
        SCOPED_TRACE(field.Name + " interior tolerance " + std::to_string(interior));
        models.ExpectOneSoundMesh(tolerance, interior, field.Dims);
      }
      // A hierarchy that can be refined inside, but is not, gives the mesh of one that cannot be.
      const test::Built plain(
        BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor), SerialFor);
      EXPECT_TRUE(test::PlacedTetrahedra(test::ExtractVolume(*plain.Hierarchy, tolerance)) ==
        test::PlacedTetrahedra(test::ExtractVolume(*models.Minimal.Hierarchy, tolerance)));
    }
  }
}

// A range that holds all values gives the grid's whole box, at any tolerance and for any size.
TEST(Interval, OfEverythingIsTheGridsBox)
{
  for (const test::Field& field : test::SmallFields())
  {
    if (std::any_of(field.Samples.begin(), field.Samples.end(),
          [](float value) { return !std::isfinite(value); }))
    {
      continue;
    }
    const double box = (field.Dims[0] - 1.0) * (field.Dims[1] - 1.0) * (field.Dims[2] - 1.0);
    for (const Model model : { Model::Relevant, Model::Minimal })
    {
      const test::Built built(
        BuildIsodiamonds(model, field.View(), Isoregion(-Infinity, Infinity), SerialFor),
        SerialFor);
      for (const double tolerance : { 0.0, 0.5, Infinity })
      {
        SCOPED_TRACE(field.Name);
        const test::Volume volume = test::ExtractVolume(*built.Hierarchy, tolerance);
        EXPECT_EQ(test::FindFault(volume, field.Dims), "");
        EXPECT_NEAR(test::TotalVolume(volume), box, 1e-9 * box);
      }
    }
  }
}

TEST(Interval, DoesNotDependOnThreads)
{
  const test::Field field = test::WaveField({ 33, 29, 40 });
  const Isoregion region(-0.3, 0.6);
  const Encoding expected =
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, test::Interior(true));
  const IsodiamondHierarchy hierarchy(expected, SerialFor);
  const test::Volume mesh = test::ExtractVolume(hierarchy, 0.1, 0.05);
  EXPECT_GT(mesh.Tetrahedra.size(), 1000U);
  for (const int threads : { 2, 7 })
  {
    const ParallelFor parallelFor = test::ThreadedFor(threads);
    const Encoding encoding =
      BuildIsodiamonds(Model::Minimal, field.View(), region, parallelFor, test::Interior(true));
    EXPECT_EQ(encoding.Arrays.Records, expected.Arrays.Records);
    EXPECT_EQ(encoding.Arrays.BrickMasks, expected.Arrays.BrickMasks);
    EXPECT_EQ(encoding.Arrays.Isovertices, expected.Arrays.Isovertices);
    EXPECT_EQ(encoding.Arrays.InteriorCodes, expected.Arrays.InteriorCodes);
    EXPECT_EQ(encoding.InsideValues, expected.InsideValues);
    const IsodiamondHierarchy other(encoding, parallelFor);
    EXPECT_TRUE(test::ExtractVolume(other, 0.1, 0.05, parallelFor) == mesh);
  }
}

TEST(Interval, HoldsTheInteriorTolerance)
{
  // At every sample in a tetrahedron that lies inside, field and interpolant differ by no more than
  // the interior tolerance. If the tetrahedron's diamond carries a surface, the other one holds.
  const test::Field field = test::WaveField({ 17, 17, 17 });
  const Isoregion region(-0.8, Infinity);
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, test::Interior(true)),
    SerialFor);
  std::size_t previous = 0;
  for (const double tolerance : { 1.0, 0.2, 0.05 })
  {
    const test::Volume volume = test::ExtractVolume(*built.Hierarchy, 0.05, tolerance);
    EXPECT_GT(volume.Tetrahedra.size(), previous);
    previous = volume.Tetrahedra.size();
    for (const std::array<std::int32_t, 4>& tetrahedron : volume.Tetrahedra)
    {
      if (std::any_of(tetrahedron.begin(), tetrahedron.end(),
            [&](std::int32_t point) { return volume.Surfaces[point] != 0; }))
      {
        continue;
      }
      const double whole = test::Determinant(volume, tetrahedron);
      std::array<double, 3> low = volume.Points[tetrahedron[0]];
      std::array<double, 3> high = low;
      for (const std::int32_t point : tetrahedron)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], volume.Points[point][axis]);
          high[axis] = std::max(high[axis], volume.Points[point][axis]);
        }
      }
      for (double z = low[2]; z <= high[2]; ++z)
      {
        for (double y = low[1]; y <= high[1]; ++y)
        {
          for (double x = low[0]; x <= high[0]; ++x)
          {
            // Barycentric coordinates by volumes.
            double interpolated = 0.0;
            bool inside = true;
            test::Volume point;
            for (const std::int32_t corner : tetrahedron)
            {
              point.Points.push_back(volume.Points[corner]);
            }
            for (int corner = 0; corner < 4; ++corner)
            {
              const std::array<double, 3> kept = point.Points[corner];
              point.Points[corner] = { x, y, z };
              const double weight = test::Determinant(point, { 0, 1, 2, 3 }) / whole;
              point.Points[corner] = kept;
              inside = inside && weight >= -1e-12;
              interpolated += weight * volume.Values[tetrahedron[corner]];
            }
            if (inside)
            {
              const double value = SampleAt(
                field.View(), { static_cast<int>(x), static_cast<int>(y), static_cast<int>(z) });
              ASSERT_LE(std::fabs(value - interpolated), tolerance + 1e-6);
            }
          }
        }
      }
    }
  }
}

// If no sample equals an isovalue, the boundary at full resolution is both isosurfaces.
TEST(Interval, IsBoundedByTheIsosurfaces)
{
  for (const test::Field& field : { test::WaveField({ 17, 17, 17 }), test::WaveField({ 14, 13, 9 }),
         test::NoiseField({ 9, 9, 9 }, 21), test::SphereField({ 10, 12, 14 }) })
  {
    const std::array<double, 2> isovalues = { 0.4503, 1.2507 };
    const test::Built built(BuildIsodiamonds(Model::Minimal, field.View(),
                              Isoregion(isovalues[0], isovalues[1]), SerialFor),
      SerialFor);
    const test::Volume volume = test::ExtractVolume(*built.Hierarchy, 0.0);
    for (int surface = 0; surface < 2; ++surface)
    {
      SCOPED_TRACE(field.Name + " surface " + std::to_string(surface));
      const test::Built single(
        BuildIsodiamonds(Model::Minimal, field.View(), isovalues[surface], SerialFor), SerialFor);
      const test::Mesh mesh = test::Extract(*single.Hierarchy, 0.0);
      std::vector<std::array<double, 3>> points;
      for (std::size_t i = 0; i < volume.Points.size(); ++i)
      {
        if (volume.Surfaces[i] == 2 * surface - 1)
        {
          EXPECT_EQ(volume.Values[i], isovalues[surface]);
          points.push_back(volume.Points[i]);
        }
      }
      ASSERT_EQ(points.size(), mesh.Points.size());
      for (const std::array<float, 3>& point : mesh.Points)
      {
        const auto distance = [&](const std::array<double, 3>& other)
        { return std::hypot(other[0] - point[0], other[1] - point[1], other[2] - point[2]); };
        double nearest = Infinity;
        for (const std::array<double, 3>& other : points)
        {
          nearest = std::min(nearest, distance(other));
        }
        EXPECT_LE(nearest, 2.0 / 256.0 * std::sqrt(3.0));
      }
      EXPECT_EQ(test::CountSurfaceFaces(volume, 2 * surface - 1), mesh.Triangles.size());
    }
  }
}
