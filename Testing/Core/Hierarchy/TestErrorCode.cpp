// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/ErrorCode.h"

#include "ReferenceError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using isodiamond::ErrorCode;

TEST(ErrorCode, DecodesMonotonically)
{
  const ErrorCode code(255.0);
  for (int c = 1; c < ErrorCode::Always; ++c)
  {
    EXPECT_LT(code.Decode(static_cast<ErrorCode::Type>(c)),
      code.Decode(static_cast<ErrorCode::Type>(c + 1)));
  }
  EXPECT_EQ(code.Decode(ErrorCode::Always), std::numeric_limits<double>::infinity());
}

TEST(ErrorCode, RoundsUpByLittle)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-20.0, 0.0);
  for (const double scale : { 1e-30, 1.0, 255.0, 3.7e20 })
  {
    const ErrorCode code(scale);
    for (int i = 0; i < 20000; ++i)
    {
      const double error = scale * std::exp2(exponent(random));
      const double decoded = code.Decode(code.Encode(error));
      EXPECT_GE(decoded, error);
      EXPECT_LE(decoded, error * (1.0 + 1.0 / 512.0) * (1.0 + 1e-12));
    }
    EXPECT_GE(code.Decode(code.Encode(scale)), scale);
    EXPECT_LT(code.Encode(scale), ErrorCode::Always);
  }
}

TEST(ErrorCode, KeepsCodesThatItDecodes)
{
  const ErrorCode code(255.0);
  for (int c = 1; c < 31 * 512 + 1; ++c)
  {
    const auto exact = static_cast<ErrorCode::Type>(c);
    EXPECT_EQ(code.Encode(code.Decode(exact)), exact);
  }
}

// Next to a code's error, the rounding of a division by the scale would decide.
TEST(ErrorCode, IsTheReferencesAroundEveryCode)
{
  for (const double scale : { 1e-30, 0.1, 1.0, 255.0, 3.7e20 })
  {
    const ErrorCode code(scale);
    const reference::ErrorCodes expected(scale);
    for (int c = 1; c < 31 * 512 + 256; ++c)
    {
      const double error = expected.ErrorOf(c);
      EXPECT_EQ(code.Decode(static_cast<ErrorCode::Type>(c)), error);
      for (const double near :
        { std::nextafter(error, 0.0), error, std::nextafter(error, HUGE_VAL) })
      {
        ASSERT_EQ(code.Encode(near), expected.CodeOf(near)) << "code " << c << " scale " << scale;
        ASSERT_EQ(code.Accepted(near), expected.LastWithin(near));
      }
    }
  }
}

TEST(ErrorCode, HasItsEdges)
{
  const ErrorCode code(10.0);
  EXPECT_EQ(code.Encode(0.0), ErrorCode::Least);
  EXPECT_EQ(code.Encode(std::numeric_limits<double>::infinity()), ErrorCode::Always);
  EXPECT_EQ(code.Encode(std::numeric_limits<double>::quiet_NaN()), ErrorCode::Always);
  EXPECT_EQ(code.Accepted(0.0), 0);
  EXPECT_EQ(code.Accepted(-1.0), 0);
  EXPECT_EQ(code.Accepted(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(code.Accepted(std::numeric_limits<double>::infinity()), ErrorCode::Always - 1);
  EXPECT_EQ(ErrorCode(0.0).Scale(), 1.0); // a constant field
}

TEST(ErrorCode, AcceptsJustTheCodesWithinATolerance)
{
  const ErrorCode code(100.0);
  for (const double tolerance : { 1e-7, 0.02, 0.5, 3.0, 99.0, 100.0, 1000.0 })
  {
    const int accepted = code.Accepted(tolerance);
    EXPECT_LE(code.Decode(static_cast<ErrorCode::Type>(accepted)), tolerance);
    if (accepted < ErrorCode::Always - 1)
    {
      EXPECT_GT(code.Decode(static_cast<ErrorCode::Type>(accepted + 1)), tolerance);
    }
  }
}
