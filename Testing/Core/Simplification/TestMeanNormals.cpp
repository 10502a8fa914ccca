// SPDX-License-Identifier: BSD-3-Clause
// Normals of a simpler mesh: found by hand, and on a ball, where the right ones are known.
#include "Simplification/MeanNormals.h"
#include "Simplification/Simplification.h"
#include "Tools/RandomTestTools.h"
#include "Tools/SimplificationTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace isodiamond;

namespace
{

/** By point; three numbers each. */
std::vector<float> NormalsOf(const std::vector<Vector>& normals)
{
  std::vector<float> numbers;
  for (const Vector& normal : normals)
  {
    numbers.insert(numbers.end(), normal.begin(), normal.end());
  }
  return numbers;
}

Vector NormalAt(const std::vector<float>& numbers, std::size_t point)
{
  return { numbers[3 * point], numbers[3 * point + 1], numbers[3 * point + 2] };
}

}

// A square of four triangles around a point. The point goes, and then lies over one of the two
// triangles that are left, nearer to one corner than to the others.
TEST(MeanNormals, AreOfWhatAPointStandsFor)
{
  TriangleMesh square;
  square.Positions = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 3, 1, 0.5 },
    { 9, 9, 9 } };
  square.Triangles = { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } };
  const SimplerMesh simpler{ { square.Positions, { { 0, 1, 2 }, { 0, 2, 3 } } },
    { None, None, None, None, 0, None } };
  const Vector up{ 0, 0, 1 };
  const Vector aside{ 1, 0, 0 };
  std::vector<float> normals = NormalsOf({ up, up, up, up, aside, up });
  TakeMeanNormals(square, simpler, normals.data());
  const auto area = [&](std::size_t triangle)
  {
    const Vector across = Across(square.Positions, square.Triangles[triangle]);
    return 0.5 * std::sqrt(Dot(across, across));
  };
  const double around = area(0) + area(1) + area(2) + area(3);
  // Over (0, 0), (4, 0), (4, 4) the place (3, 1) is a quarter, a half and a quarter.
  const std::array<double, 3> shares = { 0.25, 0.5, 0.25 };
  const std::array<double, 3> own = { area(3) + area(0), area(0) + area(1), area(1) + area(2) };
  for (std::size_t point = 0; point < 3; ++point)
  {
    const Vector expected = Unit(own[point] * up + shares[point] * around * aside);
    const Vector found = NormalAt(normals, point);
    EXPECT_NEAR(found[0], expected[0], 1e-6) << point;
    EXPECT_NEAR(found[2], expected[2], 1e-6) << point;
  }
  EXPECT_EQ(NormalAt(normals, 3), up) << "nothing else has a say";
  EXPECT_EQ(NormalAt(normals, 5), up) << "of no triangle";
}

TEST(MeanNormals, LeaveWhatCancelsOut)
{
  TriangleMesh fan;
  fan.Positions = { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, { 1, 1, 0 } };
  fan.Triangles = { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } };
  const SimplerMesh simpler{ { fan.Positions, { { 0, 1, 2 } } }, { None, None, None, 0 } };
  const Vector up{ 0, 0, 1 };
  std::vector<float> none = NormalsOf({ up, {}, {}, {} });
  std::vector<float> against = none;
  TakeMeanNormals(fan, simpler, none.data());
  EXPECT_EQ(none, against) << "no normals but one";
  // Two thirds of the area are around a corner; the third that it gets for the middle counts -2.
  against = NormalsOf({ up, up, up, -2.0 * up });
  std::vector<float> found = against;
  TakeMeanNormals(fan, simpler, found.data());
  EXPECT_EQ(found, against);
}

TEST(MeanNormals, AreNearerToThoseOfABallThanNoisyOnes)
{
  const AllowedMesh ball = test::MeshOf(test::SphereField({ 17, 17, 17 }), 0.0, 0.3);
  const SimplerMesh simpler = Simplify(ball, SerialFor);
  test::Random random(3);
  std::vector<Vector> radial;
  std::vector<Vector> noisy;
  for (const Vector& position : ball.Mesh.Positions)
  {
    radial.push_back(Unit(position - Vector{ 8, 8, 8 }));
    const Vector noise = { test::Uniform(random, -0.5, 0.5), test::Uniform(random, -0.5, 0.5),
      test::Uniform(random, -0.5, 0.5) };
    noisy.push_back(Unit(radial.back() + noise));
  }
  std::vector<float> means = NormalsOf(noisy);
  TakeMeanNormals(ball.Mesh, simpler, means.data());
  std::vector<bool> isUsed(noisy.size());
  for (const Triangle& triangle : simpler.Triangles)
  {
    for (const std::uint32_t point : triangle)
    {
      isUsed[point] = true;
    }
  }
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < noisy.size(); ++i)
  {
    const Vector mean = NormalAt(means, i);
    EXPECT_NEAR(Dot(mean, mean), 1.0, 1e-6);
    EXPECT_EQ(isUsed[i], simpler.Homes[i] == None) << "each lies over a triangle, or is in use";
    if (isUsed[i])
    {
      before += 1.0 - Dot(noisy[i], radial[i]);
      after += 1.0 - Dot(mean, radial[i]);
    }
  }
  EXPECT_LT(after, 0.2 * before);
}
