// SPDX-License-Identifier: BSD-3-Clause
// Errors and ranges of the HD against brute force over all lattice points of every diamond.
#include "FieldError/FieldError.h"
#include "Tools/CoreTestTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>

using namespace isodiamond;

namespace
{

bool HasNaNNear(const test::Field& field, const Point& centre, int reach)
{
  for (int z = 0; z < field.Dims[2]; ++z)
  {
    for (int y = 0; y < field.Dims[1]; ++y)
    {
      for (int x = 0; x < field.Dims[0]; ++x)
      {
        if (std::abs(x - centre[0]) <= reach && std::abs(y - centre[1]) <= reach &&
          std::abs(z - centre[2]) <= reach && std::isnan(SampleAt(field.View(), { x, y, z })))
        {
          return true;
        }
      }
    }
  }
  return false;
}

bool IsSame(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

/** The barycentric coordinates of a point in a tetrahedron, times its determinant; none outside. */
std::optional<std::array<double, 4>> Barycentric(
  const std::array<Point, 4>& corners, const Point& point)
{
  std::array<double, 4> coordinates{};
  for (int i = 0; i < 4; ++i)
  {
    std::array<Point, 4> moved = corners;
    moved[i] = point;
    coordinates[i] = tables::Determinant(
      moved[1] + -1 * moved[0], moved[2] + -1 * moved[0], moved[3] + -1 * moved[0]);
    if (coordinates[i] < 0.0)
    {
      return std::nullopt;
    }
  }
  return coordinates;
}

/** Calls body(point, barycentric coordinates) for the sampled points of a tetrahedron. */
template <typename Body>
void ForEachSample(const Grid& grid, const std::array<Point, 4>& corners, const Body& body)
{
  Point low = corners[0];
  Point high = corners[0];
  for (const Point& corner : corners)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::max(std::min(low[axis], corner[axis]), 0);
      high[axis] = std::min(std::max(high[axis], corner[axis]), grid.Last(axis));
    }
  }
  for (int z = low[2]; z <= high[2]; ++z)
  {
    for (int y = low[1]; y <= high[1]; ++y)
    {
      for (int x = low[0]; x <= high[0]; ++x)
      {
        if (const auto coordinates = Barycentric(corners, { x, y, z }))
        {
          body(Point{ x, y, z }, *coordinates);
        }
      }
    }
  }
}

/** A domain's summary, by barycentric coordinates of every sample in its half-tetrahedra. */
DomainSummary VisitEverySample(const Grid& grid, const AnySamples& samples, const Place& place)
{
  const auto valueAt = [&](const Point& point)
  { return grid.IsSampled(point) ? SampleAt(samples, point) : 0.0; };
  const TypeTable& shape = ShapeOf(place.Position);
  const auto vertex = [&](int i)
  { return (1 << place.Scale) * (place.Position + shape.Offsets[i]); };
  const double infinity = std::numeric_limits<double>::infinity();
  DomainSummary summary{ 0.0, { infinity, -infinity } };
  bool hasNaN = false;
  bool isFinite = !grid.SticksOut(place.Position, place.Scale);
  for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
  {
    const std::array<std::uint8_t, 3>& v = shape.HalfTetrahedra[i].Vertices;
    const std::array<Point, 4> corners = { Centre(place), vertex(v[0]), vertex(v[1]),
      vertex(v[2]) };
    const std::array<double, 4> values = { 0.5 *
        (valueAt(vertex(shape.Spine[0])) + valueAt(vertex(shape.Spine[1]))),
      valueAt(corners[1]), valueAt(corners[2]), valueAt(corners[3]) };
    ForEachSample(grid, corners,
      [&](const Point& point, const std::array<double, 4>& at)
      {
        const double value = SampleAt(samples, point);
        hasNaN = hasNaN || std::isnan(value);
        isFinite = isFinite && std::isfinite(value);
        const double interpolated =
          (at[0] * values[0] + at[1] * values[1] + at[2] * values[2] + at[3] * values[3]) /
          (at[0] + at[1] + at[2] + at[3]);
        summary.Error = std::max(summary.Error, std::abs(value - interpolated));
        summary.Range.Minimum = std::fmin(summary.Range.Minimum, value);
        summary.Range.Maximum = std::fmax(summary.Range.Maximum, value);
      });
  }
  summary.Error = isFinite ? summary.Error : infinity;
  summary.Range.Minimum = hasNaN ? std::numeric_limits<double>::quiet_NaN() : summary.Range.Minimum;
  return summary;
}

/** Calls body(place) for the diamonds of a grid from a scale on. */
template <typename Body>
void ForEachPlace(const Grid& grid, int firstScale, const Body& body)
{
  for (int scale = firstScale; scale < grid.Depth(); ++scale)
  {
    const std::array<int, 3> count = grid.Positions(scale);
    for (Point p{}; p[2] < count[2]; ++p[2])
    {
      for (p[1] = 0; p[1] < count[1]; ++p[1])
      {
        for (p[0] = 0; p[0] < count[0]; ++p[0])
        {
          if (Parity(p) != 0)
          {
            body(Place{ scale, p });
          }
        }
      }
    }
  }
}

}

TEST(FieldError, EqualsBruteForce)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const reference::Hierarchy hierarchy(field.Dims);
    const reference::ScalarField samples = field.Reference();
    const std::vector<double> errors = reference::OwnFieldErrors(hierarchy, samples);
    const test::BuiltScalars scalars = test::BuildScalars(field);
    const AnySamples view = field.View();
    const FieldErrors fieldErrors(grid, view, SerialFor);
    const ErrorCode& code = scalars.Hierarchy->Codes();
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
      const DomainSummary summary = fieldErrors.Summarize(place);
      if (std::isinf(errors[i]))
      {
        EXPECT_EQ(summary.Error, errors[i]);
        EXPECT_EQ(scalars.Hierarchy->Error(place), ErrorCode::Always);
      }
      else
      {
        EXPECT_NEAR(summary.Error, errors[i], 1e-12 * code.Scale());
        EXPECT_EQ(scalars.Hierarchy->Error(place), code.Encode(summary.Error));
      }
      const reference::ValueRange range = reference::DomainRange(hierarchy, samples, i);
      EXPECT_EQ(scalars.Hierarchy->Range(place).Maximum, range.Maximum);
      EXPECT_EQ(Isoregion(field.Isovalue).Crosses(scalars.Hierarchy->Range(place)),
        reference::IsCrossed(hierarchy, samples, field.Isovalue, i));
      // NaN is the minimum of every domain that holds one, and of no other.
      const double minimum = scalars.Hierarchy->Range(place).Minimum;
      if (std::isnan(minimum))
      {
        EXPECT_TRUE(HasNaNNear(field, Centre(place), 1 << place.Scale));
      }
      else
      {
        EXPECT_EQ(minimum, range.Minimum);
      }
    }
  }
}

TEST(FieldError, IsZeroForALinearField)
{
  test::Field field = test::WaveField({ 65, 65, 65 });
  for (int i = 0; i < 65 * 65 * 65; ++i)
  {
    field.Samples[i] = static_cast<float>(3 * (i % 65) - 2 * (i / 65 % 65) + i / 4225);
  }
  const Grid grid(field.Dims);
  const AnySamples samples = field.View();
  const FieldErrors errors(grid, samples, SerialFor);
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (int diamondClass = 0; diamondClass < 3; ++diamondClass)
    {
      const Place place{ scale, { 1, diamondClass < 2 ? 1 : 0, diamondClass < 1 ? 1 : 0 } };
      EXPECT_EQ(errors.Summarize(place).Error, 0.0);
    }
  }
}

namespace
{

/** NaN for the last sample, where cubes of samples are not whole; all others are equal. */
test::Field LastIsNaN(const std::array<int, 3>& dims)
{
  test::Field field = test::WaveField(dims);
  std::fill(field.Samples.begin(), field.Samples.end(), 1.0F);
  field.Samples.back() = std::numeric_limits<float>::quiet_NaN();
  return field;
}

}

// Parts of a domain that cannot matter are skipped.
TEST(FieldError, OfLargeDomainsEqualsAVisitToEverySample)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const test::Field& field : { test::NoiseField({ 65, 33, 33 }, 3),
         test::WaveField({ 40, 70, 33 }), test::SphereField({ 64, 49, 65 }),
         test::SparseField({ 65, 65, 33 }, 4), test::NoiseField({ 41, 73, 57 }, 6),
         test::BrokenField({ 33, 40, 33 }, 5), test::SpikeField({ 65, 65, 65 }, 1e30),
         test::SpikeField({ 65, 33, 65 }, nan), LastIsNaN({ 40, 38, 37 }) })
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const AnySamples samples = field.View();
    const FieldErrors errors(grid, samples, test::ThreadedFor(2));
    ForEachPlace(grid, 2,
      [&](const Place& place)
      {
        const DomainSummary expected = VisitEverySample(grid, samples, place);
        const DomainSummary found = errors.Summarize(place);
        ASSERT_TRUE(found.Error == expected.Error ||
          std::abs(found.Error - expected.Error) < 1e-9 * expected.Error + 1e-14);
        ASSERT_TRUE(IsSame(found.Range.Maximum, expected.Range.Maximum));
        ASSERT_TRUE(IsSame(found.Range.Minimum, expected.Range.Minimum));
      });
  }
}

// What a build of one region asks for: errors, and whether a surface crosses a domain.
TEST(FieldError, OfARegionHasTheSameErrorsAndCrossings)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const test::Field& field :
    { test::NoiseField({ 49, 33, 36 }, 3), test::WaveField({ 40, 50, 33 }),
      test::SphereField({ 64, 49, 33 }), test::SparseField({ 65, 33, 33 }, 4),
      test::BrokenField({ 33, 40, 33 }, 5), test::SpikeField({ 33, 33, 65 }, nan) })
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const AnySamples samples = field.View();
    const FieldErrors all(grid, samples, SerialFor);
    const double above = field.Isovalue + 0.25 * std::abs(field.Isovalue) + 0.125;
    for (const Isoregion& region :
      { Isoregion(field.Isovalue), Isoregion(field.Isovalue, above), Isoregion(1e20) })
    {
      const FieldErrors some(grid, samples, SerialFor, WantedRange(region));
      int whole = 0;
      int shorter = 0;
      ForEachPlace(grid, 0,
        [&](const Place& place)
        {
          const DomainSummary expected = all.Summarize(place);
          const DomainSummary found = some.Summarize(place);
          ASSERT_EQ(found.Error, expected.Error);
          ASSERT_EQ(OwnErrorCounts(region, grid, found.Range, place),
            OwnErrorCounts(region, grid, expected.Range, place));
          const bool isWhole = IsSame(found.Range.Minimum, expected.Range.Minimum) &&
            IsSame(found.Range.Maximum, expected.Range.Maximum);
          ASSERT_TRUE(isWhole || region.Crosses(found.Range));
          (isWhole ? whole : shorter) += 1;
        });
      EXPECT_GT(whole, 0);
      EXPECT_EQ(shorter > 0, region.Isovalue() < 1e20);
    }
  }
}

// Samples so far apart that 32 bits cannot tell how far: nearly all of this memory is never used.
TEST(FieldError, OfSmallDomainsInHugeSlices)
{
  constexpr int width = 16400;
  constexpr int height = 17;
  const std::array<int, 3> dims = { width, width, height };
  const std::unique_ptr<std::int8_t, void (*)(void*)> memory(
    static_cast<std::int8_t*>(std::calloc(std::size_t{ width } * width, height)), std::free);
  if (memory == nullptr)
  {
    GTEST_SKIP() << "needs 4.6 GB of address space";
  }
  const Grid grid(dims);
  const AnySamples samples = SampleView<std::int8_t>(memory.get(), dims);
  const SmallDomains domains(grid, { samples, 0 }, {});
  const Place place{ 3, { 101, 203, 1 } };
  const Point centre = Centre(place);
  for (int i = 0; i < 17 * 17 * 17; ++i)
  {
    const Point point = centre + Point{ i % 17 - 8, i / 17 % 17 - 8, i / 289 - 8 };
    memory.get()[SampleIndex(dims, point)] = static_cast<std::int8_t>(i * 37 % 101);
  }
  const DomainSummary expected = VisitEverySample(grid, samples, place);
  const DomainSummary found = domains.Summarize(place);
  EXPECT_EQ(found.Error, expected.Error);
  EXPECT_EQ(found.Range.Maximum, 100.0);
  EXPECT_EQ(found.Range.Minimum, 0.0);
  EXPECT_GT(found.Error, 10.0);
}

TEST(FieldError, AcceptsEveryScalarType)
{
  const std::array<int, 3> dims = { 9, 9, 9 };
  const test::Field field = test::NoiseField(dims, 5);
  const auto check = [&](auto zero)
  {
    using T = decltype(zero);
    const std::vector<T> values(field.Samples.begin(), field.Samples.end());
    const Encoding encoding = BuildIsodiamonds(
      Model::Minimal, SampleView<T>(values.data(), dims), field.Isovalue, SerialFor);
    const Encoding expected =
      BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, SerialFor);
    EXPECT_EQ(encoding.Arrays.Records, expected.Arrays.Records);
    EXPECT_EQ(encoding.Arrays.Isovertices, expected.Arrays.Isovertices);
  };
  check(std::int8_t{});
  check(std::uint8_t{});
  check(std::int16_t{});
  check(std::uint16_t{});
  check(std::int32_t{});
  check(std::uint32_t{});
  check(std::int64_t{});
  check(std::uint64_t{});
  check(double{});
}
