// SPDX-License-Identifier: BSD-3-Clause
// Interval volumes: patches, meshes at every tolerance in every model, volumes.
#include "IntervalPatches.h"
#include "IntervalTestTools.h"

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

}

TEST(IntervalPatches, HaveTheNumbersOfTetrahedraThatTheSearchPromises)
{
  // By the sorted signs: below, inside, above.
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

// Random places of the isovertices, random tetrahedra: all volumes positive, their sum that of the
// part in range, which is what two planar cuts leave when the isovertices are linear.
TEST(IntervalPatches, FillWhatIsInRangeWithPositiveTetrahedra)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int code = 0; code < 81; ++code)
  {
    const PatchSigns signs = SignsOf(code);
    for (int trial = 0; trial < 200; ++trial)
    {
      // Coefficients from the younger end; close to the ends in a part of the trials.
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
      for (const PatchTetrahedron& tetrahedron : IntervalPatches()[code])
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

TEST(IntervalPatches, MeetTheFansOfTheFaces)
{
  for (int code = 0; code < 81; ++code)
  {
    const PatchSigns signs = SignsOf(code);
    std::map<std::array<PatchPoint, 3>, int> faces;
    for (const PatchTetrahedron& tetrahedron : IntervalPatches()[code])
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
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      std::vector<PatchPoint> polygon = FacePolygon(signs, opposite);
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

TEST(Interval, IsFitForASolverAtEveryTolerance)
{
  for (const test::Field& field : test::SmallFields())
  {
    const Isoregion region = test::RangeOf(field);
    const test::BuiltScalars scalars = test::BuildScalars(field);
    const test::Built relevant(
      BuildIsodiamonds(Model::Relevant, field.View(), region, SerialFor), SerialFor);
    const test::Built minimal(
      BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor), SerialFor);
    for (const double tolerance : test::Tolerances(scalars.Encoding.ErrorScale))
    {
      SCOPED_TRACE(field.Name + " tolerance " + std::to_string(tolerance));
      const test::Volume volume = test::ExtractVolume(*minimal.Hierarchy, tolerance);
      EXPECT_EQ(test::FindFault(volume, field.Dims), "");
      EXPECT_EQ(volume.Tetrahedra.empty(), volume.Points.empty());
      const auto placed = test::PlacedTetrahedra(volume);
      EXPECT_TRUE(
        placed == test::PlacedTetrahedra(test::ExtractVolume(*relevant.Hierarchy, tolerance)));
      const test::Built query(
        EncodeQuery(*scalars.Hierarchy, region, tolerance, SerialFor), SerialFor);
      EXPECT_TRUE(placed == test::PlacedTetrahedra(test::ExtractVolume(*query.Hierarchy, 0.0)));
    }
  }
}

// A range that holds all values leaves the whole box, at any tolerance, however the grid ends.
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
