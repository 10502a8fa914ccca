// SPDX-License-Identifier: BSD-3-Clause
// Where samples are in the world, which cells are hidden, and from where they are seen.
#include "Field/GridGeometry.h"
#include "Field/HiddenCells.h"
#include "Patches/CurvedLengths.h"
#include "Patches/WorldLengths.h"
#include "Refinement/RegionOfInterest.h"
#include "Refinement/Viewpoint.h"
#include "Tools/DistanceTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

using namespace isodiamond;

namespace
{

constexpr std::array<int, 3> Size = { 5, 4, 6 };

/** A bent position for each sample. */
std::vector<double> BentPositions()
{
  std::vector<double> positions;
  for (int z = 0; z < Size[2]; ++z)
  {
    for (int y = 0; y < Size[1]; ++y)
    {
      for (int x = 0; x < Size[0]; ++x)
      {
        positions.push_back(x + 0.1 * y * z);
        positions.push_back(2.0 * y - 0.2 * x * x);
        positions.push_back(0.5 * z + 0.05 * x * y);
      }
    }
  }
  return positions;
}

Vector At(const std::vector<double>& positions, int x, int y, int z)
{
  const double* p = positions.data() + 3 * ((z * Size[1] + y) * Size[0] + x);
  return { p[0], p[1], p[2] };
}

void ExpectNear(const Vector& a, const Vector& b, double tolerance = 1e-12)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(a[axis], b[axis], tolerance);
  }
}

}

TEST(GridGeometry, IsTrilinearBetweenSamplesAndLinearBeyond)
{
  const std::vector<double> positions = BentPositions();
  const GridGeometry bent(SamplePositions{ positions.data(), Size });
  for (int z = 0; z < Size[2]; ++z)
  {
    for (int y = 0; y < Size[1]; ++y)
    {
      for (int x = 0; x < Size[0]; ++x)
      {
        ExpectNear(bent({ 1.0 * x, 1.0 * y, 1.0 * z }), At(positions, x, y, z));
      }
    }
  }
  // In the middle of a cell the mean of its corners; on an edge that of two, weighted.
  Vector mean{};
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector p = At(positions, 1 + (corner & 1), 2 + ((corner >> 1) & 1), 3 + (corner >> 2));
    for (int axis = 0; axis < 3; ++axis)
    {
      mean[axis] += p[axis] / 8.0;
    }
  }
  ExpectNear(bent({ 1.5, 2.5, 3.5 }), mean);
  const Vector a = At(positions, 1, 0, 0);
  const Vector b = At(positions, 2, 0, 0);
  ExpectNear(bent({ 1.25, 0.0, 0.0 }),
    { 0.75 * a[0] + 0.25 * b[0], 0.75 * a[1] + 0.25 * b[1], 0.75 * a[2] + 0.25 * b[2] });
  const Vector first = At(positions, 0, 0, 0);
  const Vector next = At(positions, 1, 0, 0);
  ExpectNear(bent({ -1.0, 0.0, 0.0 }), 2.0 * first - next);
  // Behind a layer of padding, indices are greater by one.
  const GridGeometry padded(SamplePositions{ positions.data(), Size }, 1);
  ExpectNear(padded({ 2.5, 3.5, 4.5 }), mean);
}

TEST(GridGeometry, OfAxesIsThatOfTheSamePositions)
{
  const AxisCoordinates axes = { std::vector<double>{ 0.0, 1.0, 3.0, 3.5, 9.0 },
    { 5.0, 4.0, 2.0, 1.0 }, { -1.0, 0.0, 0.5, 0.75, 4.0, 8.0 } };
  std::vector<float> positions;
  for (const double z : axes[2])
  {
    for (const double y : axes[1])
    {
      for (const double x : axes[0])
      {
        positions.insert(
          positions.end(), { static_cast<float>(x), static_cast<float>(y), static_cast<float>(z) });
      }
    }
  }
  const GridGeometry uneven(axes);
  const GridGeometry same(SamplePositions{ positions.data(), Size });
  EXPECT_TRUE(uneven.Mirrors()); // y falls
  EXPECT_TRUE(same.Mirrors());
  EXPECT_EQ(uneven.Affine(), nullptr);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> index(-1.0, 6.0);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector at = { index(random), index(random), index(random) };
    ExpectNear(uneven(at), same(at), 1e-9);
  }
}

TEST(GridGeometry, IndexAtIsTheWayBack)
{
  AffineMap map;
  map.Rows = { { { 0.5, 0.2, 0.0, 7.0 }, { -0.1, 2.0, 0.3, 8.0 }, { 0.0, 0.1, -3.0, 9.0 } } };
  const AxisCoordinates axes = { { { 0.0, 1.0, 1.5, 4.0, 4.25 }, { 3.0, 2.0, -5.0, -6.0 },
    { 0.0, 0.1, 0.3, 0.6, 5.0, 5.5 } } };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 7.0);
  for (const GridGeometry& world : { GridGeometry(map), GridGeometry(axes), GridGeometry(axes, 1) })
  {
    for (int i = 0; i < 200; ++i)
    {
      const Vector index = i < 6 ? Vector{ 1.0 * i, 1.0 * i, 1.0 * i }
                                 : Vector{ uniform(random), uniform(random), uniform(random) };
      ExpectNear(world.IndexAt(world(index)), index);
    }
  }
}

TEST(GridGeometry, SmallestStepIsTheLeastOfAnyAxis)
{
  AffineMap map;
  map.Rows = { { { 0.0, 3.0, 0.0, 9.0 }, { -2.0, 0.0, 0.0, 9.0 }, { 0.0, 4.0, 7.0, 9.0 } } };
  EXPECT_EQ(GridGeometry(map).SmallestStep(), 2.0);
  const std::vector<double> rising = { -9.0, 0.0, 1.25, 4.0 };
  const std::vector<double> falling = { 3.0, 2.5, 0.0 };
  const std::vector<double> wide = { 10.0, 20.0 };
  EXPECT_EQ(GridGeometry({ wide, rising, falling }).SmallestStep(), 0.5);
  EXPECT_EQ(GridGeometry({ rising, wide, wide }).SmallestStep(), 1.25);
  const std::vector<double> positions = BentPositions();
  // Of so few samples all count for the mean of an axis.
  const GridGeometry bent(SamplePositions{ positions.data(), Size });
  double least = HUGE_VAL;
  for (int axis = 0; axis < 3; ++axis)
  {
    double sum = 0.0;
    int count = 0;
    Point sample{};
    for (sample[2] = 0; sample[2] < Size[2] - (axis == 2 ? 1 : 0); ++sample[2])
    {
      for (sample[1] = 0; sample[1] < Size[1] - (axis == 1 ? 1 : 0); ++sample[1])
      {
        for (sample[0] = 0; sample[0] < Size[0] - (axis == 0 ? 1 : 0); ++sample[0], ++count)
        {
          Point next = sample;
          ++next[axis];
          const Vector step = bent.SampleAt(next) - bent.SampleAt(sample);
          sum += std::hypot(step[0], step[1], step[2]);
        }
      }
    }
    least = std::min(least, sum / count);
  }
  EXPECT_NEAR(bent.SmallestStep(), least, 1e-12);
  const std::vector<double> nowhere(positions.size(), std::nan(""));
  EXPECT_EQ(GridGeometry(SamplePositions{ nowhere.data(), Size }).SmallestStep(), 0.0);
}

TEST(GridGeometry, FitsFloatsWhereTheseTellIsoverticesApart)
{
  // Floats from 2^13 to 2^14 are a 1024th apart.
  AffineMap map;
  const auto fits = [&](double step, double origin, int last)
  {
    map.Rows = { { { step, 0.0, 0.0, 0.0 }, { 0.0, -step, 0.0, origin },
      { 0.0, 0.0, step, 0.0 } } };
    return GridGeometry(map).FitsFloats({ 1, last, 1 });
  };
  EXPECT_TRUE(fits(1.0, 0.0, 10000));
  EXPECT_TRUE(fits(1.0, 0.0, 16383));
  EXPECT_FALSE(fits(1.0, 0.0, 16384));
  EXPECT_FALSE(fits(1.0, -5400000.0, 9));
  EXPECT_TRUE(fits(512.0, -5400000.0, 9)); // these are a half apart
  EXPECT_TRUE(fits(1e-30, 1e-26, 9));
  EXPECT_FALSE(fits(1e38, 0.0, 4));
  // Turned by 45 degrees, two places at coordinates of 10,000 and more.
  const double c = std::sqrt(0.5);
  map.Rows = { { { c, -c, 0.0, 10000.0 }, { c, c, 0.0, 10000.0 }, { 0.0, 0.0, 1.0, 0.0 } } };
  ASSERT_TRUE(GridGeometry(map).FitsFloats({ 9, 9, 9 }));
  for (int x = 0; x < 255; ++x)
  {
    const auto at = [&](int a, int b)
    {
      const Vector place = map(a / 256.0, b / 256.0, 0.0);
      return std::make_pair(static_cast<float>(place[0]), static_cast<float>(place[1]));
    };
    EXPECT_NE(at(x, 0), at(x + 1, 0));
    EXPECT_NE(at(x, 1), at(x + 1, 0));
  }
  const std::vector<double> near = { 0.0, 1.0, 2.0 };
  const std::vector<double> far = { -70000.0, -69999.0, -69998.0 };
  EXPECT_TRUE(GridGeometry({ near, near, near }).FitsFloats({ 2, 2, 2 }));
  EXPECT_FALSE(GridGeometry({ near, far, near }).FitsFloats({ 2, 2, 2 }));
  // Where steps are small, everything near has to be told apart, too.
  const std::vector<double> close = { 0.0, 1.0, 1.000001 };
  EXPECT_FALSE(GridGeometry({ close, near, near }).FitsFloats({ 2, 2, 2 }));
  // A bent grid's are what its own are.
  const std::vector<double> positions = BentPositions();
  const std::vector<float> rounded(positions.begin(), positions.end());
  const Point last = { Size[0] - 1, Size[1] - 1, Size[2] - 1 };
  EXPECT_FALSE(GridGeometry(SamplePositions{ positions.data(), Size }).FitsFloats(last));
  EXPECT_TRUE(GridGeometry(SamplePositions{ rounded.data(), Size }).FitsFloats(last));
}

TEST(AffineMap, HasItsDeterminantAndInverse)
{
  AffineMap map;
  map.Rows = { { { 2.0, 1.0, 0.0, 5.0 }, { 0.0, 3.0, -1.0, -2.0 }, { 4.0, 0.0, 1.0, 0.5 } } };
  // 2 (3 - 0) - 1 (0 + 4) + 0
  EXPECT_EQ(map.Determinant(), 2.0);
  EXPECT_FALSE(map.Mirrors());
  const Vector index = { 1.25, -7.0, 3.5 };
  ExpectNear(map.Inverse(map(index[0], index[1], index[2])), index);
  // Products of cofactors and columns: the determinant, or zero.
  for (int j = 0; j < 3; ++j)
  {
    for (int k = 0; k < 3; ++k)
    {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i)
      {
        sum += map.Cofactor(i, j) * map.Rows[i][k];
      }
      EXPECT_EQ(sum, j == k ? 2.0 : 0.0);
    }
  }
  std::swap(map.Rows[0], map.Rows[1]);
  EXPECT_EQ(map.Determinant(), -2.0);
  EXPECT_TRUE(map.Mirrors());
}

TEST(Samples, AreFiniteOrNot)
{
  const std::vector<int> whole(8, 7);
  const AnySamples integers = SampleView<int>(whole.data(), { 2, 2, 2 });
  EXPECT_TRUE(Finiteness(integers).All());
  for (const double special : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    std::vector<double> values(8, 7.0);
    const AnySamples samples = SampleView<double>(values.data(), { 2, 2, 2 });
    EXPECT_TRUE(Finiteness(samples).All());
    values[5] = special;
    const Finiteness isFinite(samples);
    EXPECT_FALSE(isFinite.All());
    EXPECT_FALSE(isFinite({ 1, 0, 1 }));
    EXPECT_TRUE(isFinite({ 1, 1, 1 }));
  }
}

namespace
{

/** Whether the box around a cell touches another box. */
bool CellTouches(const GridGeometry& bent, const Point& cell, const Box& box)
{
  bool touches = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector p = bent(Vector{ 1.0 * (cell[0] + (corner & 1)),
        1.0 * (cell[1] + ((corner >> 1) & 1)), 1.0 * (cell[2] + (corner >> 2)) });
      low = std::min(low, p[axis]);
      high = std::max(high, p[axis]);
    }
    touches = touches && low <= box.Maximum[axis] && high >= box.Minimum[axis];
  }
  return touches;
}

/** The index box of the cells that touch a box, those of the padding included. */
Box BoxOfCells(const GridGeometry& bent, const Box& box, int padding)
{
  Box expected{ { HUGE_VAL, HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL } };
  const int cells = 2 * padding - 1; // more than samples
  for (int z = 0; z < Size[2] + cells; ++z)
  {
    for (int y = 0; y < Size[1] + cells; ++y)
    {
      for (int x = 0; x < Size[0] + cells; ++x)
      {
        const Point cell = { x, y, z };
        for (int axis = 0; axis < 3 && CellTouches(bent, cell, box); ++axis)
        {
          expected.Minimum[axis] = std::min(expected.Minimum[axis], 1.0 * cell[axis]);
          expected.Maximum[axis] = std::max(expected.Maximum[axis], cell[axis] + 1.0);
        }
      }
    }
  }
  return expected;
}

}

TEST(GridGeometry, IndexBoxesHoldAllCellsThatTouch)
{
  const std::vector<double> positions = BentPositions();
  for (const int padding : { 0, 1 })
  {
    const GridGeometry bent(SamplePositions{ positions.data(), Size }, padding);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> world(-2.0, 8.0);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int i = 0; i < 200; ++i)
    {
      Box box{ { world(random), world(random), world(random) }, {} };
      for (int axis = 0; axis < 3; ++axis)
      {
        box.Maximum[axis] = box.Minimum[axis] + 2.0 * part(random);
      }
      const Box found = IndexBoxOf(box, bent);
      const Box expected = BoxOfCells(bent, box, padding); // and not larger
      EXPECT_EQ(found.Minimum, expected.Minimum);
      EXPECT_EQ(found.Maximum, expected.Maximum);
      for (int j = 0; j < 300; ++j) // no point of the grid in the box may be missed
      {
        Vector index{};
        for (int axis = 0; axis < 3; ++axis)
        {
          index[axis] = part(random) * (Size[axis] - 1 + 2 * padding);
        }
        const Vector p = bent(index);
        bool inside = true;
        bool isFound = true;
        for (int axis = 0; axis < 3; ++axis)
        {
          inside = inside && p[axis] >= box.Minimum[axis] && p[axis] <= box.Maximum[axis];
          isFound =
            isFound && index[axis] >= found.Minimum[axis] && index[axis] <= found.Maximum[axis];
        }
        EXPECT_TRUE(!inside || isFound);
      }
    }
  }
}

TEST(HiddenCells, TouchesAreThoseOfTheBoxAroundADiamond)
{
  const std::array<int, 3> cells = { 13, 9, 16 };
  std::mt19937 random(7);
  std::vector<std::uint8_t> hidden(13 * 9 * 16);
  for (int i = 0; i < 12; ++i)
  {
    hidden[random() % hidden.size()] = 1;
  }
  const HiddenCells some(hidden, cells);
  ASSERT_TRUE(some.Any());
  EXPECT_FALSE(HiddenCells(std::vector<std::uint8_t>(hidden.size()), cells).Any());
  const Grid grid({ 14, 10, 17 });
  for (int scale = 0; scale <= grid.Depth(); ++scale)
  {
    const std::array<int, 3> count = grid.Positions(scale);
    for (int i = 0; i < 300; ++i)
    {
      const Place place{ scale,
        { static_cast<int>(random() % count[0]), static_cast<int>(random() % count[1]),
          static_cast<int>(random() % count[2]) } };
      const int h = 1 << scale;
      bool expected = false;
      for (int z = 0; z < cells[2]; ++z)
      {
        for (int y = 0; y < cells[1]; ++y)
        {
          for (int x = 0; x < cells[0]; ++x)
          {
            const Point cell = { x, y, z };
            bool touches = hidden[(z * cells[1] + y) * cells[0] + x] != 0;
            for (int axis = 0; axis < 3; ++axis)
            {
              const int centre = h * place.Position[axis];
              touches = touches && cell[axis] < centre + h && cell[axis] + 1 > centre - h;
            }
            expected = expected || touches;
          }
        }
      }
      // Blocks at the grid's end reach beyond it, never short of it.
      EXPECT_EQ(some.Touch(place), expected) << scale;
    }
  }
}

TEST(WorldLengths, OfAnAffineMapIsTheGeometrysDistance)
{
  std::mt19937 random(10);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const auto anywhere = [&]
  {
    const auto along = [&] { return static_cast<int>(random() % (20 * FineUnits)); };
    return FinePosition{ along(), along(), along() };
  };
  for (int i = 0; i < 500; ++i)
  {
    // Sheared, and far longer along one axis than along the others.
    AffineMap world;
    for (std::array<double, 4>& row : world.Rows)
    {
      row = { part(random), 0.1 * part(random), 5.0 * part(random), 100.0 * part(random) };
    }
    const AffineLengths lengths(world);
    const auto place = [&](const FinePosition& p)
    { return Vector(world(p[0] / 256.0, p[1] / 256.0, p[2] / 256.0)); };
    const auto squared = [](const Vector& v) { return Dot(v, v); };
    const FinePosition a = anywhere();
    const FinePosition b = anywhere();
    const double length = squared(place(b) - place(a));
    EXPECT_NEAR(squared(lengths(b) - lengths(a)), length, 1e-9 * length);
    // The ball around a box holds all of it, and is no larger than it must be.
    FineBox box;
    box.Add(a);
    box.Add(b);
    const FinePosition middle = { (box.Low[0] + box.High[0]) / 2, (box.Low[1] + box.High[1]) / 2,
      (box.Low[2] + box.High[2]) / 2 };
    double farthest = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const FinePosition at = { (corner & 1) != 0 ? box.High[0] : box.Low[0],
        (corner & 2) != 0 ? box.High[1] : box.Low[1],
        (corner & 4) != 0 ? box.High[2] : box.Low[2] };
      farthest = std::max(farthest, squared(place(at) - place(middle)));
    }
    // The middle is at most a step of 1/256 from the true one.
    const double radius = lengths.SquaredRadius(box, middle);
    EXPECT_GE(radius, farthest * (1.0 - 1e-9));
    EXPECT_LE(std::sqrt(radius), std::sqrt(farthest) + 6.0 * std::sqrt(3.0) / 256.0);
  }
}

TEST(WorldLengths, OfAxesIsTheGeometrysDistance)
{
  const AxisCoordinates axes = { std::vector<double>{ 100.0, 101.0, 103.0, 103.5, 109.0 },
    { 5.0, 4.0, 2.0, 1.0 }, { -1.0, 0.0, 0.5, 0.75, 4.0, 8.0 } };
  std::mt19937 random(9);
  for (const int padding : { 0, 1 })
  {
    const GridGeometry world(axes, padding);
    const WorldLengths found = WorldLengthsOf(world);
    const AxesLengths& metric = std::get<AxesLengths>(found);
    const auto anywhere = [&]
    {
      FinePosition position{};
      for (int axis = 0; axis < 3; ++axis)
      {
        position[axis] =
          static_cast<int>(random() % (FineUnits * (Size[axis] - 1 + 2 * padding) + 1));
      }
      return position;
    };
    const auto place = [&](const FinePosition& p) {
      return world({ p[0] / 256.0, p[1] / 256.0, p[2] / 256.0 });
    };
    for (int i = 0; i < 300; ++i)
    {
      const FinePosition a = anywhere();
      const FinePosition b = anywhere();
      ExpectNear(metric(b) - metric(a), place(b) - place(a));
      // The ball around a box holds all of it, and is no larger than it must be.
      FineBox box;
      box.Add(a);
      box.Add(b);
      FinePosition middle{};
      for (int axis = 0; axis < 3; ++axis)
      {
        middle[axis] = (box.Low[axis] + box.High[axis]) / 2;
      }
      double farthest = 0.0;
      for (int corner = 0; corner < 8; ++corner)
      {
        FinePosition at = box.Low;
        for (int axis = 0; axis < 3; ++axis)
        {
          at[axis] = ((corner >> axis) & 1) != 0 ? box.High[axis] : box.Low[axis];
        }
        const Vector reach = place(at) - place(middle);
        farthest = std::max(farthest, Dot(reach, reach));
      }
      EXPECT_NEAR(metric.SquaredRadius(box, middle), farthest, 1e-9);
    }
    ExpectNear(metric.Between({ 1, 1, 1 }, { 3, 2, 4 }),
      place({ 3 * 256, 2 * 256, 4 * 256 }) - place({ 256, 256, 256 }));
  }
}

class ViewpointIn : public testing::TestWithParam<bool>
{
protected:
  static GridGeometry World(bool isUneven)
  {
    AffineMap map;
    map.Rows = { { { 0.5, 0.2, 0.0, 3.0 }, { 0.0, 2.0, -0.3, 1.0 }, { 0.1, 0.0, 1.5, -2.0 } } };
    AxisCoordinates axes;
    for (int i = 0; i < 33; ++i)
    {
      axes[0].push_back(3.0 + 0.1 * i * i);
      axes[1].push_back(10.0 - 2.0 * i);
      axes[2].push_back(0.3 * i + 3.0 * std::floor(i / 10.0));
    }
    axes[1].resize(20);
    axes[2].resize(30);
    return isUneven ? GridGeometry(axes) : GridGeometry(map);
  }
};
INSTANTIATE_TEST_SUITE_P(Worlds, ViewpointIn, testing::Bool());

TEST_P(ViewpointIn, TolerancesAreThoseOfTheNearestPointOrLess)
{
  const GridGeometry map = World(this->GetParam());
  const Grid grid({ 33, 20, 30 });
  const Vector eye = { 30.0, -5.0, 12.0 };
  const Viewpoint view(eye, 0.01, map);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  // For the ball around a cube of a half width or, where axes are uneven, for the cube itself.
  const auto expectedOf = [&](const Vector& centre, double half)
  {
    Vector away = map(centre) - eye;
    double longest = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector at = { centre[0] + ((corner & 1) != 0 ? half : -half),
        centre[1] + ((corner & 2) != 0 ? half : -half),
        centre[2] + ((corner & 4) != 0 ? half : -half) };
      const Vector reach = map(at) - map(centre);
      longest = std::max(longest, std::hypot(reach[0], reach[1], reach[2]));
    }
    if (!this->GetParam())
    {
      return 0.01 * std::max(0.0, std::hypot(away[0], away[1], away[2]) - longest);
    }
    const Vector low = map({ centre[0] - half, centre[1] + half, centre[2] - half }); // y falls
    const Vector high = map({ centre[0] + half, centre[1] - half, centre[2] + half });
    for (int axis = 0; axis < 3; ++axis)
    {
      away[axis] = std::clamp(eye[axis], low[axis], high[axis]) - eye[axis];
    }
    return 0.01 * std::hypot(away[0], away[1], away[2]);
  };
  double greatest = 0.0;
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    const std::array<int, 3> count = grid.Positions(scale);
    for (int i = 0; i < 200; ++i)
    {
      const Place place{ scale,
        { static_cast<int>(random() % count[0]), static_cast<int>(random() % count[1]),
          static_cast<int>(random() % count[2]) } };
      const double tolerance = view.ToleranceOf(place);
      greatest = std::max(greatest, tolerance);
      EXPECT_GE(tolerance, 0.0);
      const Point origin = { place.Position[0] & ~7, place.Position[1] & ~7,
        place.Position[2] & ~7 };
      EXPECT_LE(view.LeastIn(scale, origin), tolerance);
      const double h = 1 << scale;
      const Vector centre = { h * place.Position[0], h * place.Position[1], h * place.Position[2] };
      EXPECT_NEAR(tolerance, expectedOf(centre, h), 1e-9);
      const Vector middle = { h * (origin[0] + 3.5), h * (origin[1] + 3.5), h * (origin[2] + 3.5) };
      EXPECT_NEAR(view.LeastIn(scale, origin), expectedOf(middle, 4.5 * h), 1e-9);
      for (int j = 0; j < 20; ++j)
      {
        const Vector p = map({ h * (place.Position[0] + part(random)),
          h * (place.Position[1] + part(random)), h * (place.Position[2] + part(random)) });
        EXPECT_LE(
          tolerance, 0.01 * std::hypot(p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]) + 1e-12);
      }
    }
  }
  EXPECT_GT(greatest, 0.1);
  EXPECT_GE(view.GreatestIn(grid), greatest);
  double corners = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double last = 1 << grid.Depth();
    const Vector away = map({ (corner & 1) != 0 ? last : 0.0, (corner & 2) != 0 ? last : 0.0,
                          (corner & 4) != 0 ? last : 0.0 }) -
      eye;
    corners = std::max(corners, std::hypot(away[0], away[1], away[2]));
  }
  EXPECT_NEAR(view.GreatestIn(grid), 0.01 * corners, 1e-9);
  EXPECT_THROW(Viewpoint({ std::nan(""), 0.0, 0.0 }, 1.0, map), std::invalid_argument);
  EXPECT_THROW(Viewpoint(eye, HUGE_VAL, map), std::invalid_argument);
}

TEST(Viewpoint, BoundsTheTolerancesOfCurvilinearGrids)
{
  const std::array<int, 3> dims = { 33, 21, 27 };
  const Grid grid(dims);
  for (const test::World& world : { test::Bent(dims), test::Wound(dims) })
  {
    const Vector eye = world({ 40.0, 10.0, 5.0 });
    const Viewpoint view(eye, 0.01, world);
    const double greatest = view.GreatestIn(grid);
    std::mt19937 random(3);
    double nearest = HUGE_VAL;
    for (int i = 0; i < 3000; ++i)
    {
      const int scale = static_cast<int>(random() % 4);
      Place place{ scale, {} };
      for (int axis = 0; axis < 3; ++axis)
      {
        place.Position[axis] = static_cast<int>(random() % ((dims[axis] >> scale) + 1));
      }
      const double tolerance = view.ToleranceOf(place);
      EXPECT_LE(tolerance, greatest);
      // Nowhere in the cube around the diamond, as far as the grid goes, is less tolerated.
      Vector index{};
      for (int axis = 0; axis < 3; ++axis)
      {
        const double part = static_cast<double>(random()) / random.max();
        index[axis] = std::clamp(
          Centre(place)[axis] + (2.0 * part - 1.0) * (1 << scale), 0.0, dims[axis] - 1.0);
      }
      const Vector away = world(index) - eye;
      const double there = 0.01 * std::hypot(away[0], away[1], away[2]);
      EXPECT_LE(tolerance, there + 1e-12);
      nearest = std::min(nearest, there - tolerance);
    }
    EXPECT_LT(nearest, 0.1 * greatest); // it is not just nothing
  }
}

TEST(CurvedLengths, HoldWhatIsInBoxesAndNear)
{
  const std::array<int, 3> dims = { 17, 12, 14 };
  for (const test::World& world : { test::Bent(dims), test::Wound(dims) })
  {
    const CurvedLengths lengths(world);
    std::mt19937 random(4);
    const auto place = [&](const FineBox& box)
    {
      FinePosition position{};
      for (int axis = 0; axis < 3; ++axis)
      {
        position[axis] =
          box.Low[axis] + static_cast<int>(random() % (box.High[axis] - box.Low[axis] + 1));
      }
      return position;
    };
    FineBox all;
    all.Add({ 0, 0, 0 });
    all.Add(FineUnits * Point{ dims[0] - 1, dims[1] - 1, dims[2] - 1 });
    for (int i = 0; i < 2000; ++i)
    {
      // In one cell, or over some.
      const FinePosition first = place(all);
      FineBox box;
      box.Add(first);
      const FinePosition other = place(all);
      FinePosition second = other;
      for (int axis = 0; axis < 3 && i % 2 == 0; ++axis)
      {
        const int cell = std::min(first[axis] / FineUnits, dims[axis] - 2);
        second[axis] = FineUnits * cell + other[axis] % FineUnits;
      }
      box.Add(second);
      const FinePosition middle = { (first[0] + second[0]) / 2, (first[1] + second[1]) / 2,
        (first[2] + second[2]) / 2 };
      const double radius = std::sqrt(lengths.SquaredRadius(box, middle));
      for (int j = 0; j < 30; ++j)
      {
        const FinePosition inside = j < 8 ? FinePosition{ (j & 1) != 0 ? box.High[0] : box.Low[0],
          (j & 2) != 0 ? box.High[1] : box.Low[1], (j & 4) != 0 ? box.High[2] : box.Low[2] }
                                          : place(box);
        const Vector to = lengths(inside) - lengths(middle);
        EXPECT_LE(std::sqrt(Dot(to, to)), radius * (1.0 + 1e-9));
      }
      const Vector way = lengths(second) - lengths(first);
      const auto near = lengths.IndexBox(lengths(first), std::sqrt(Dot(way, way)) * (1.0 + 1e-9));
      const std::array<Vector, 2> ends = { lengths(first), lengths(second) };
      const auto between = lengths.IndexBoxAround(ends.data(), 2);
      for (int axis = 0; axis < 3; ++axis)
      {
        const double index = static_cast<double>(second[axis]) / FineUnits;
        EXPECT_LE(near.Low[axis], index);
        EXPECT_GE(near.High[axis], index);
        EXPECT_LE(between.Low[axis], index);
        EXPECT_GE(between.High[axis], index);
      }
    }
  }
}
