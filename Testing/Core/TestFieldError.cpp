// SPDX-License-Identifier: BSD-3-Clause
// Errors and ranges of the HD against brute force over all lattice points of every diamond.
#include "CoreTestTools.h"
#include "FieldError.h"

#include <gtest/gtest.h>

#include <cmath>

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
    const ErrorCode& code = scalars.Hierarchy->Codes();
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
      const DomainSummary summary = SummarizeDomain(grid, field.View(), place);
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
  test::Field field = test::WaveField({ 17, 17, 17 });
  for (int i = 0; i < 17 * 17 * 17; ++i)
  {
    field.Samples[i] = static_cast<float>(3 * (i % 17) - 2 * (i / 17 % 17) + i / 289);
  }
  const Grid grid(field.Dims);
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (int diamondClass = 0; diamondClass < 3; ++diamondClass)
    {
      const Place place{ scale, { 1, diamondClass < 2 ? 1 : 0, diamondClass < 1 ? 1 : 0 } };
      EXPECT_EQ(SummarizeDomain(grid, field.View(), place).Error, 0.0);
    }
  }
}

// Blocks that cannot matter are passed over: the summaries must be those of a visit to every
// sample.
TEST(FieldError, IsTheSameBlockByBlock)
{
  for (const test::Field& field :
    { test::NoiseField({ 65, 65, 65 }, 3), test::WaveField({ 129, 70, 100 }),
      test::SphereField({ 128, 128, 128 }), test::SpikeField({ 129, 129, 129 }, 1e30),
      test::SpikeField({ 129, 65, 129 }, std::numeric_limits<double>::quiet_NaN()) })
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const AnySamples samples = field.View();
    const FieldErrors errors(grid, samples, test::ThreadedFor(2));
    for (int scale = 4; scale < grid.Depth(); ++scale)
    {
      const std::array<int, 3> count = grid.Positions(scale);
      for (Point p{}; p[2] < count[2]; ++p[2])
      {
        for (p[1] = 0; p[1] < count[1]; ++p[1])
        {
          for (p[0] = 0; p[0] < count[0]; ++p[0])
          {
            if (Parity(p) == 0)
            {
              continue;
            }
            const DomainSummary expected = SummarizeDomain(grid, samples, { scale, p });
            const DomainSummary found = errors.Summarize({ scale, p });
            ASSERT_TRUE(found.Error == expected.Error ||
              std::abs(found.Error - expected.Error) < 1e-9 * expected.Error);
            ASSERT_EQ(found.Range.Maximum, expected.Range.Maximum);
            ASSERT_TRUE(found.Range.Minimum == expected.Range.Minimum ||
              (std::isnan(found.Range.Minimum) && std::isnan(expected.Range.Minimum)));
          }
        }
      }
    }
  }
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
