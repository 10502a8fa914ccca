// SPDX-License-Identifier: BSD-3-Clause
// Gradients of the samples, and normals, at any position.
#include "Field/Gradients.h"
#include "Field/GridGeometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace isodiamond;

namespace
{

constexpr std::array<int, 3> Size = { 5, 4, 6 };

void ExpectNear(const Vector& a, const Vector& b, double tolerance = 1e-12)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(a[axis], b[axis], tolerance);
  }
}

}

TEST(Gradients, AreCentralDifferencesAndOneSidedAtTheBorder)
{
  for (const std::array<int, 3>& size :
    std::vector<std::array<int, 3>>{ Size, { 2, 2, 2 }, { 2, 5, 3 }, { 3, 2, 7 }, { 6, 3, 2 } })
  {
    const auto pointAt = [&](int i) {
      return Point{ i % size[0], i / size[0] % size[1], i / (size[0] * size[1]) };
    };
    std::vector<int> field;
    for (int i = 0; i < size[0] * size[1] * size[2]; ++i)
    {
      const Point p = pointAt(i);
      field.push_back(p[0] * p[0] + 3 * p[1] * p[1] - p[2] * p[2]);
    }
    const GridGeometry world((AffineMap()));
    const AnySamples samples = SampleView<int>(field.data(), size);
    const Gradients gradients(samples, world);
    const std::array<double, 3> factors = { 1.0, 3.0, -1.0 };
    std::vector<Vector> positions;
    std::vector<Vector> expected;
    for (int i = 0; i < size[0] * size[1] * size[2]; ++i)
    {
      const Point p = pointAt(i);
      positions.push_back({ 1.0 * p[0], 1.0 * p[1], 1.0 * p[2] });
      Vector& gradient = expected.emplace_back();
      for (int axis = 0; axis < 3; ++axis)
      {
        const bool isFirst = p[axis] == 0;
        const bool isLast = p[axis] == size[axis] - 1;
        gradient[axis] = factors[axis] * (2 * p[axis] + (isFirst ? 1 : 0) - (isLast ? 1 : 0));
      }
      ExpectNear(gradients(positions.back()), gradient);
    }
    std::vector<Vector> found(positions.size());
    gradients.Find(positions, found.data());
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      ExpectNear(found[i], expected[i]);
    }
  }
}

TEST(Gradients, AreThoseOfAnAffineMap)
{
  // The same samples at the same positions, given by a sheared map and one by one.
  AffineMap map;
  map.Rows = { { { 0.5, 0.2, 0.0, 3.0 }, { 0.0, 2.0, -0.3, 1.0 }, { 0.1, 0.0, 1.5, -2.0 } } };
  std::vector<double> positions;
  std::vector<float> field;
  for (int z = 0; z < Size[2]; ++z)
  {
    for (int y = 0; y < Size[1]; ++y)
    {
      for (int x = 0; x < Size[0]; ++x)
      {
        const Vector p = map(x, y, z);
        positions.insert(positions.end(), p.begin(), p.end());
        field.push_back(static_cast<float>(std::sin(x) + y * y - x * z));
      }
    }
  }
  const AnySamples samples = SampleView<float>(field.data(), Size);
  const GridGeometry affine(map);
  const GridGeometry listed(SamplePositions{ positions.data(), Size });
  std::mt19937 random(5);
  std::uniform_real_distribution<double> index(-0.5, 5.5);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector at = { index(random), index(random), index(random) };
    ExpectNear(Gradients(samples, affine)(at), Gradients(samples, listed)(at), 1e-9);
  }
  // A linear field has the same gradient everywhere, also beyond the grid.
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    field[i] = static_cast<float>(
      2.0 * positions[3 * i] - positions[3 * i + 1] + 0.5 * positions[3 * i + 2]);
  }
  for (int i = 0; i < 1000; ++i)
  {
    const Vector at = { index(random), index(random), index(random) };
    ExpectNear(Gradients(samples, listed)(at), { 2.0, -1.0, 0.5 }, 1e-5);
    ExpectNear(Gradients(samples, affine)(at), { 2.0, -1.0, 0.5 }, 1e-5);
  }
}

// Of a field of squares that is NaN, or infinite, beyond a plane across each axis, on either side.
TEST(Gradients, BesideGapsAreOneSided)
{
  constexpr int size = 7;
  constexpr int plane = 3; // the last with values
  for (const double gap : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    for (int across = 0; across < 3; ++across)
    {
      for (const int side : { -1, 1 })
      {
        std::vector<double> field;
        for (int i = 0; i < size * size * size; ++i)
        {
          const Point p = { i % size, i / size % size, i / (size * size) };
          const double square = 1.0 * p[0] * p[0] + 2.0 * p[1] * p[1] + 3.0 * p[2] * p[2];
          field.push_back(side * (p[across] - plane) > 0 ? gap : square);
        }
        const AnySamples samples = SampleView<double>(field.data(), { size, size, size });
        const GridGeometry world((AffineMap()));
        Vector expected = { 2.0 * plane, 4.0 * plane, 6.0 * plane }; // central, of squares
        expected[across] -= side * (across + 1); // one-sided: with the half step's
        ExpectNear(Gradients(samples, world)({ 1.0 * plane, 1.0 * plane, 1.0 * plane }), expected);
      }
    }
  }
}

// A linear field that is NaN in one half, and infinite in a corner.
TEST(Gradients, NormalsBesideGapsAreThoseOfTheFieldOrOfTheGap)
{
  constexpr int size = 7;
  std::vector<float> field;
  for (int i = 0; i < size * size * size; ++i)
  {
    const int x = i % size;
    const int y = i / size % size;
    const int z = i / (size * size);
    field.push_back(x > 3 ? std::nanf("")
        : x + y + z == 0  ? HUGE_VALF
                          : static_cast<float>(2 * x - y + 2 * z));
  }
  const AnySamples samples = SampleView<float>(field.data(), { size, size, size });
  const GridGeometry world{ AffineMap() };
  const Gradients gradients(samples, world);
  const auto normalAt = [&](const Vector& at) { return gradients.NormalAt(at, gradients(at)); };
  for (const Vector& inside : { Vector{ 2.5, 3.25, 4.0 }, Vector{ 3.0, 2.5, 2.0 } })
  {
    ExpectNear(gradients(inside), { 2.0, -1.0, 2.0 }, 1e-6);
    ExpectNear(normalAt(inside), { -2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0 }, 1e-6);
  }
  ExpectNear(normalAt({ 3.5, 3.0, 3.0 }), { 1.0, 0.0, 0.0 }); // into the gap
  EXPECT_GT(normalAt({ 0.75, 0.0, 0.0 })[0], 0.7);            // away from the infinite corner
  EXPECT_GT(normalAt({ 0.0, 0.0, 0.75 })[2], 0.7);
  ExpectNear(normalAt({ 5.0, 3.0, 3.0 }), { 0.0, 0.0, 1.0 }); // nothing finite around it
  // A finite gradient, but its components' sum is not.
  ExpectNear(gradients.NormalAt({ 3.5, 3.0, 3.0 }, { 0.0, -1.2e308, -0.9e308 }), { 0.0, 0.8, 0.6 });
}

TEST(Gradients, NormalsHaveLengthOneHoweverLongTheGradientIs)
{
  const Vector normal = NormalOf({ 0.0, 3.0, -4.0 });
  ExpectNear(normal, { 0.0, -0.6, 0.8 });
  for (const double scale : { 1e-310, 1e-160, 1e-90, 1e90, 1e160, 1e307 })
  {
    ExpectNear(NormalOf({ 3.0 * scale, 0.0, -4.0 * scale }), { -0.6, 0.0, 0.8 });
  }
  ExpectNear(NormalOf({ 0.0, 0.0, 0.0 }), { 0.0, 0.0, 1.0 });
  ExpectNear(NormalOf({ 0.0, std::nan(""), 0.0 }), { 0.0, 0.0, 1.0 });
  ExpectNear(NormalOf({ 0.0, HUGE_VAL, 0.0 }), { 0.0, 0.0, 1.0 });
  ExpectNear(NormalOf({ 1.7e308, 0.0, 1.7e308 }), { 0.0, 0.0, 1.0 }); // its length is not finite
}

namespace
{

/** Equal to the bit, or both not numbers. */
bool AreSame(const Vector& a, const Vector& b)
{
  bool areSame = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    areSame = areSame && (a[axis] == b[axis] || (std::isnan(a[axis]) && std::isnan(b[axis])));
  }
  return areSame;
}

}

// In a field with gaps; far apart, near each other at a corner or in the middle, and beyond the
// grid.
TEST(Gradients, OfManyPositionsAreThoseOfEach)
{
  constexpr int size = 20;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> value(-1000, 1000);
  std::vector<double> field;
  for (int i = 0; i < size * size * size; ++i)
  {
    field.push_back(i % 701 == 0 ? std::nan("") : i % 997 == 0 ? HUGE_VAL : value(random));
  }
  const AnySamples samples = SampleView<double>(field.data(), { size, size, size });
  const GridGeometry world((AffineMap()));
  const Gradients gradients(samples, world);
  for (const auto& [from, to] : std::vector<std::array<double, 2>>{
         { 0.0, 19.0 }, { -2.0, 3.0 }, { 8.0, 12.0 }, { 17.0, 21.0 }, { 5.25, 5.5 } })
  {
    std::uniform_real_distribution<double> anywhere(from, to);
    for (const std::size_t count : { 0, 2, 30, 2000 })
    {
      std::vector<Vector> positions;
      while (positions.size() < count)
      {
        positions.push_back({ anywhere(random), std::round(anywhere(random)), anywhere(random) });
      }
      std::vector<Vector> found(count);
      gradients.Find(positions, found.data());
      for (std::size_t i = 0; i < count; ++i)
      {
        EXPECT_TRUE(AreSame(found[i], gradients(positions[i])))
          << from << " to " << to << ", " << i << " of " << count;
      }
    }
  }
}
