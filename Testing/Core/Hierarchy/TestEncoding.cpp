// SPDX-License-Identifier: BSD-3-Clause
// Encodings: their size, and that damaged ones are refused.
#include "Hierarchy/IsovertexPlacement.h"
#include "Tools/IntervalTestTools.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace isodiamond;

TEST(Encoding, IsSmallerThanThePapersRecords)
{
  const test::Field field = test::SphereField({ 65, 65, 65 });
  const test::Built built = test::Build(Model::Minimal, field);
  const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
  const std::int64_t paper = 2 +
    12 * (hierarchy.Count(Kind::Active) + hierarchy.Count(Kind::Creation)) +
    hierarchy.IsovertexCount();
  EXPECT_LT(2 * hierarchy.StorageSize(), paper);
  const EncodingArrays<OwnedArray>& arrays = built.Encoding.Arrays;
  EXPECT_EQ(hierarchy.StorageSize(),
    static_cast<std::int64_t>(4 * arrays.BrickCounts.size() + 4 * arrays.BrickIndices.size() +
      8 * arrays.BrickMasks.size() + 2 * arrays.Records.size() + arrays.Isovertices.size()));
}

// A cache decides by size what to throw away: if sizes are wrong, it grows.
TEST(Encoding, SizesAreThoseOfAllArrays)
{
  const test::Field field = test::SphereField({ 33, 33, 33 });
  for (const Isoregion& region : { Isoregion(0.25), Isoregion(0.25, 3.0) })
  {
    BuildOptions options = test::Interior(region.IsVolume());
    const test::Built built(
      BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options), SerialFor);
    const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
    const EncodingArrays<OwnedArray>& arrays = built.Encoding.Arrays;
    std::size_t bricks = 0;
    std::size_t lookups = 0;
    std::size_t diamonds = 0;
    std::size_t inside = 0;
    for (int scale = 0; scale < hierarchy.Diamonds().ScaleCount(); ++scale)
    {
      bricks += hierarchy.Diamonds().Level(scale).Bricks.size();
      lookups += hierarchy.Diamonds().Level(scale).Lookup.size();
    }
    hierarchy.Diamonds().ForEach(
      [&](const Place&, std::uint32_t rank)
      {
        ++diamonds;
        inside += region.IsVolume() && hierarchy.Sign(rank) == InsideSign ? 1 : 0;
      });
    EXPECT_EQ(diamonds, arrays.Records.size());
    EXPECT_EQ(inside > 0, region.IsVolume());
    EXPECT_EQ(arrays.InteriorCodes.empty(), !region.IsVolume());
    // A float for each sample inside.
    EXPECT_EQ(hierarchy.StorageSize(),
      static_cast<std::int64_t>(4 * arrays.BrickCounts.size() + 4 * arrays.BrickIndices.size() +
        8 * arrays.BrickMasks.size() + 2 * diamonds + arrays.Isovertices.size() +
        2 * arrays.InteriorCodes.size() + 8 * arrays.Followers.size() +
        (region.IsVolume() ? 4 * inside : 0)));
    // By diamond: edges of one surface or of two, and its first isovertex, counted from the first
    // of eight diamonds. By eight diamonds: that one. By brick: the brick itself, its highest
    // thresholds and, of volumes, its first inside value. And the lookups.
    EXPECT_EQ(hierarchy.DerivedSize(),
      static_cast<std::int64_t>((region.IsVolume() ? 5 : 3) * diamonds + 4 * ((diamonds + 7) / 8) +
        (4 + sizeof(Brick)) * bricks + 4 * lookups + (region.IsVolume() ? 8 * (bricks + 1) : 0)));
  }
}

TEST(Isoregion, NeedsALowerEndThatIsLess)
{
  EXPECT_THROW(Isoregion(1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(Isoregion(2.0, 1.0), std::invalid_argument);
  EXPECT_THROW(Isoregion(std::numeric_limits<double>::quiet_NaN(), 1.0), std::invalid_argument);
  EXPECT_NO_THROW(Isoregion(1.0, std::numeric_limits<double>::infinity()));
}

TEST(Samples, TellHowManyBytesOneTakes)
{
  const std::vector<double> doubles(8);
  const std::vector<std::uint16_t> shorts(8);
  EXPECT_EQ(BytesOfSample(SampleView<double>(doubles.data(), { 2, 2, 2 })), 8);
  EXPECT_EQ(BytesOfSample(SampleView<std::uint16_t>(shorts.data(), { 2, 2, 2 })), 2);
}

namespace
{

int LinearCoefficient(double centre, double vertex, double isovalue)
{
  const std::array<double, 2> ends = { centre, vertex };
  return IsovertexCoefficient(EdgeSamples<double>(ends.data(), 1, 1), isovalue);
}

}

TEST(Encoding, CoefficientsAreWithinAStepOfTheLinearCrossing)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-5.0, 5.0);
  for (int i = 0; i < 10000; ++i)
  {
    const double a = uniform(random);
    const double b = uniform(random);
    const double k = a + (b - a) * (i / 10000.0);
    if (a == b)
    {
      continue;
    }
    const int coefficient = LinearCoefficient(a, b, k);
    EXPECT_GE(coefficient, 1);
    EXPECT_LE(coefficient, 255);
    EXPECT_NEAR(coefficient / 256.0, (k - a) / (b - a), 1.0 / 256.0);
  }
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(LinearCoefficient(infinity, 0.0, 1.0), 128);
  EXPECT_EQ(LinearCoefficient(0.0, std::numeric_limits<double>::quiet_NaN(), 1.0), 128);
}

TEST(Encoding, IsoverticesOfAnEdgeAreInTheOrderOfTheirSurfaces)
{
  const test::Field field = test::NoiseField({ 9, 9, 9 }, 2); // of small integers
  const Encoding good = BuildIsodiamonds(Model::Relevant, field.View(), { 2.5, 4.5 }, SerialFor);
  const IsodiamondHierarchy hierarchy(good, SerialFor);
  int refused = 0;
  int both = 0;
  for (std::int64_t rank = 0; rank < hierarchy.Diamonds().Size(); ++rank)
  {
    const std::uint32_t lower = hierarchy.Edges(rank);
    const std::uint32_t twice = lower & hierarchy.UpperEdges(rank);
    if (twice == 0)
    {
      continue;
    }
    ++both;
    const std::uint32_t before = (1U << LowestBit(twice)) - 1U;
    const std::int64_t first = hierarchy.FirstIsovertexOf(rank);
    Encoding bad = good;
    std::swap(bad.Arrays.Isovertices[first + PopCount(lower & before)],
      bad.Arrays
        .Isovertices[first + PopCount(lower) + PopCount(hierarchy.UpperEdges(rank) & before)]);
    try
    {
      IsodiamondHierarchy(bad, SerialFor);
      EXPECT_EQ(bad.Arrays.Isovertices, good.Arrays.Isovertices); // equal ones were swapped
    }
    catch (const std::invalid_argument&)
    {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(both, 10);
}

namespace
{

/** Damage to an encoding, and the message that is expected. */
struct Case
{
  const char* Message;
  std::function<void(Encoding&)> Damage;
};

/** The message with which an encoding is refused; empty if it is accepted. */
std::string FaultOf(const EncodingView& encoding)
{
  try
  {
    IsodiamondHierarchy(encoding, SerialFor);
    return "";
  }
  catch (const std::invalid_argument& fault)
  {
    return fault.what();
  }
}

void ExpectRefused(const Encoding& good, const std::vector<Case>& cases)
{
  EXPECT_EQ(FaultOf(good), "");
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    Encoding bad = good;
    cases[i].Damage(bad);
    EXPECT_EQ(FaultOf(bad), cases[i].Message) << "damage " << i;
  }
}

Encoding Sphere(const Isoregion& region, const BuildOptions& options = {})
{
  const test::Field field = test::SphereField({ 17, 12, 9 });
  return BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options);
}

constexpr const char* TooFewScales = "the number of scales does not match the dimensions";
constexpr const char* WrongMasks = "the numbers of brick masks and of brick indices do not match";
constexpr const char* TooFewBricks = "there are fewer bricks than the scales need";
constexpr const char* WrongIndex = "a brick's index is out of order or range";
constexpr const char* WrongPlace = "a brick has a diamond where none can be";
constexpr const char* WrongRecords = "the number of records does not match the bricks";
constexpr const char* WrongRecord = "a record has an invalid error code or sign";
constexpr const char* WrongIsovertices = "the number of isovertices does not match the signs";
constexpr const char* WrongInteriorCodes = "the number of interior codes does not match the bricks";
constexpr const char* WrongFollowers =
  "the diamonds that follow their parents are out of order or range";
constexpr const char* NoFollower = "a diamond that follows its parents lies where none can be";
constexpr const char* WrongInsideValues = "the number of inside values does not match the signs";

}

// For each check, damage that no other check finds before it: the message tells which one did.
TEST(Encoding, DamageIsRefused)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr const char* model =
    "the encoding is not that of a relevant or minimal isodiamond hierarchy";
  constexpr const char* errorScale = "the error scale is not a positive number";
  constexpr const char* fieldScale = "the field scale is not a positive number";
  constexpr const char* corners = "the corners of the base cube are missing";
  ExpectRefused(Sphere(0.25),
    { { model, [](Encoding& e) { e.Header.TheModel = Model::HierarchyOfDiamonds; } },
      { errorScale, [](Encoding& e) { e.Header.ErrorScale = 0.0; } },
      { errorScale, [](Encoding& e) { e.Header.ErrorScale = -1.0; } },
      { errorScale, [](Encoding& e) { e.Header.ErrorScale = nan; } },
      { errorScale, [](Encoding& e) { e.Header.ErrorScale = infinity; } },
      { WrongFollowers, [](Encoding& e) { e.Arrays.Followers = { 0 }; } },
      { WrongFollowers,
        [](Encoding& e) {
          e.Arrays.Followers = { 3, 3 };
        } },
      { WrongFollowers,
        [](Encoding& e) { e.Arrays.Followers = { std::uint64_t{ 1 } << 63 | 1 }; } },
      { NoFollower, [](Encoding& e) { e.Arrays.Followers = { 16 }; } }, // a corner of the base cube
      { NoFollower, [](Encoding& e) { e.Arrays.Followers = { 17 }; } }, // beyond the grid
      { fieldScale, [](Encoding& e) { e.Header.FieldScale = 0.0; } },
      { fieldScale, [](Encoding& e) { e.Header.FieldScale = nan; } },
      { fieldScale, [](Encoding& e) { e.Header.FieldScale = infinity; } },
      { TooFewScales,
        [](Encoding& e) {
          e.Header.Dimensions = { 33, 12, 9 };
        } },
      { TooFewScales, [](Encoding& e) { e.Arrays.BrickCounts.pop_back(); } },
      { TooFewScales, [](Encoding& e) { e.Arrays = {}; } },
      { WrongMasks, [](Encoding& e) { e.Arrays.BrickIndices.pop_back(); } },
      { WrongMasks, [](Encoding& e) { e.Arrays.BrickMasks.pop_back(); } },
      { TooFewBricks, [](Encoding& e) { ++e.Arrays.BrickCounts.back(); } },
      { TooFewBricks, [](Encoding& e) { e.Arrays.BrickCounts.back() = 0xffffffffU; } },
      { "there are more bricks than the scales need",
        [](Encoding& e) { --e.Arrays.BrickCounts.back(); } },
      { WrongIndex, [](Encoding& e) { e.Arrays.BrickIndices.back() = 1000000; } },
      { WrongIndex,
        [](Encoding& e) { e.Arrays.BrickIndices.back() = e.Arrays.BrickIndices.end()[-2]; } },
      { "a brick is empty", [](Encoding& e) { std::fill_n(e.Arrays.BrickMasks.end() - 8, 8, 0); } },
      { WrongPlace, [](Encoding& e) { e.Arrays.BrickMasks.end()[-8] |= 1; } }, // an even position
      { corners, [](Encoding& e) { e.Arrays.BrickMasks[0] = 0x302; } },
      { WrongRecords, [](Encoding& e) { e.Arrays.Records.pop_back(); } },
      { WrongRecords, [](Encoding& e) { e.Arrays.Records.push_back(e.Arrays.Records.back()); } },
      { WrongRecord, [](Encoding& e) { e.Arrays.Records.back() |= 2; } }, // a third side
      { WrongRecord, [](Encoding& e) { e.Arrays.Records.back() &= 3; } }, // code 0
      { WrongRecord, [](Encoding& e) { e.Arrays.Records[7] |= 1; } },     // not in the grid
      { "an isovertex has the coefficient 0",
        [](Encoding& e) { e.Arrays.Isovertices.front() = 0; } },
      { WrongIsovertices, [](Encoding& e) { e.Arrays.Isovertices.pop_back(); } },
      { WrongIsovertices, [](Encoding& e) { e.Arrays.Isovertices.push_back(7); } },
      { "there are more relevant isodiamonds than the header says",
        [](Encoding& e) { e.Header.RelevantCount = 0; } },
      { WrongInteriorCodes, // there is no interior
        [](Encoding& e) { e.Arrays.InteriorCodes.resize(e.Arrays.Records.size(), 1); } } });
}

TEST(Encoding, DamageToVolumesIsRefused)
{
  const auto resizeValues = [](int more)
  {
    return [more](Encoding& e)
    { std::visit([&](auto& values) { values.resize(values.size() + more); }, e.InsideValues); };
  };
  const Isoregion region(0.2, 1.5);
  ExpectRefused(Sphere(region),
    { { WrongInsideValues, resizeValues(1) }, { WrongInsideValues, resizeValues(-1) },
      { WrongRecord, [](Encoding& e) { e.Arrays.Records.back() |= 3; } } }); // a fourth side
  ExpectRefused(Sphere(region, test::Interior(true)),
    { { WrongInteriorCodes, [](Encoding& e) { e.Arrays.InteriorCodes.pop_back(); } },
      { WrongInteriorCodes, [](Encoding& e) { e.Arrays.InteriorCodes.push_back(1); } },
      { WrongRecord,
        [](Encoding& e) { e.Arrays.InteriorCodes.back() = ErrorCode::Always + 1; } } });
}

TEST(Encoding, HugeDimensionsAreRefusedBeforeTheyTakeMemory)
{
  Encoding bad = Sphere(0.25);
  for (const std::array<int, 3>& dimensions :
    { std::array<int, 3>{ 6000, 6000, 6000 }, { 5000, 5000, 8193 } })
  {
    bad.Header.Dimensions = dimensions;
    EXPECT_EQ(FaultOf(bad), "the dimensions are too large for what is stored") << dimensions[0];
  }
  // No grid at all.
  for (const std::array<int, 3>& dimensions : { std::array<int, 3>{ 1048577, 1048577, 1048577 },
         { 1048577, 1048577, 2 }, { 2147483647, 2, 2 }, { -5, 12, 9 } })
  {
    bad.Header.Dimensions = dimensions;
    EXPECT_THROW(IsodiamondHierarchy(bad, SerialFor), std::logic_error) << dimensions[0];
  }
}

// Codes and ranges of another grid or type would lead beyond the arrays.
TEST(Encoding, ScalarsThatDoNotFitAreRefused)
{
  const test::Field field = test::SphereField({ 9, 6, 7 });
  const ScalarEncoding good = BuildScalarHierarchy(field.View(), SerialFor);
  const auto isRefused = [&](const ScalarEncoding& encoding)
  {
    try
    {
      ScalarHierarchy(field.View(), encoding.ErrorScale, encoding.Codes.data(),
        static_cast<std::int64_t>(encoding.Codes.size()), ViewOf(encoding.Minima),
        ViewOf(encoding.Maxima));
      return false;
    }
    catch (const std::invalid_argument&)
    {
      return true;
    }
  };
  EXPECT_FALSE(isRefused(good));
  const auto isRefusedAfter = [&](const std::function<void(ScalarEncoding&)>& damage)
  {
    ScalarEncoding bad = good;
    damage(bad);
    return isRefused(bad);
  };
  const auto shorten = [](AnyValues& values)
  { std::visit([](auto& some) { some.pop_back(); }, values); };
  EXPECT_TRUE(isRefusedAfter([](ScalarEncoding& e) { e.Codes.pop_back(); }));
  EXPECT_TRUE(isRefusedAfter([&](ScalarEncoding& e) { shorten(e.Minima); }));
  EXPECT_TRUE(isRefusedAfter([&](ScalarEncoding& e) { shorten(e.Maxima); }));
  const std::size_t count = std::get<std::vector<float>>(good.Minima).size();
  EXPECT_TRUE(isRefusedAfter([](ScalarEncoding& e) { e.Codes.back() = ErrorCode::Always + 1; }));
  EXPECT_TRUE(isRefusedAfter([&](ScalarEncoding& e) { e.Minima = std::vector<double>(count); }));
  EXPECT_TRUE(isRefusedAfter([&](ScalarEncoding& e) { e.Maxima = std::vector<double>(count); }));
}

// No array is that large: the check must come before anything is read.
TEST(Encoding, MoreIsoverticesThanNumbersAreRefused)
{
  const Encoding good = Sphere(0.25);
  EncodingView view(good);
  view.Arrays.Isovertices.Size = std::int64_t{ 1 } << 32;
  EXPECT_EQ(FaultOf(view), "more than 2^32 - 1 isovertices");
}

namespace
{

/** Changes signs, masks and thresholds at random, then makes the lengths fit what they imply. */
Encoding Damage(const Encoding& good, std::mt19937& random)
{
  Encoding bad = good;
  for (std::uint32_t changes = 1 + random() % 4; changes > 0; --changes)
  {
    std::uint16_t& record = bad.Arrays.Records[random() % bad.Arrays.Records.size()];
    record =
      static_cast<std::uint16_t>(random() % 2 == 0 ? record ^ (1U + random() % 2) : random());
    if (random() % 4 == 0)
    {
      bad.Arrays.BrickMasks[random() % bad.Arrays.BrickMasks.size()] &=
        ~(std::uint64_t{ 1 } << (random() % 64));
    }
  }
  std::int64_t diamonds = 0;
  for (const std::uint64_t mask : bad.Arrays.BrickMasks)
  {
    diamonds += PopCount(mask);
  }
  bad.Arrays.Records.resize(diamonds, Record::Pack(ErrorCode::Always, 0));
  std::vector<float> inside;
  for (const std::uint16_t record : bad.Arrays.Records)
  {
    if (good.Header.Region.IsVolume() && Record::Sign(record) == InsideSign)
    {
      inside.push_back(1.0F);
    }
  }
  bad.InsideValues = inside;
  return bad;
}

}

// Damage that keeps the lengths right is not always found, but never leads out of the arrays.
TEST(Encoding, ConsistentDamageNeverHarms)
{
  const test::Field field = test::SphereField({ 17, 12, 9 });
  std::mt19937 random(6);
  int accepted = 0;
  for (const Isoregion& region : { Isoregion(field.Isovalue), Isoregion(0.2, 1.5) })
  {
    for (const Model model : { Model::Minimal, Model::Relevant })
    {
      const Encoding good = BuildIsodiamonds(model, field.View(), region, SerialFor);
      for (int i = 0; i < 200; ++i)
      {
        Encoding bad = Damage(good, random);
        for (std::size_t size = good.Arrays.Isovertices.size() - 30;
             size < good.Arrays.Isovertices.size() + 30; ++size)
        {
          bad.Arrays.Isovertices.resize(size, 100);
          try
          {
            const IsodiamondHierarchy hierarchy(bad, SerialFor);
            for (const double tolerance : { 0.0, 0.3 })
            {
              std::int32_t largest = -1;
              std::size_t points = 0;
              if (region.IsVolume())
              {
                const test::Volume volume = test::ExtractVolume(hierarchy, tolerance);
                points = volume.Points.size();
                for (const auto& t : volume.Tetrahedra)
                {
                  largest = std::max(largest, *std::max_element(t.begin(), t.end()));
                }
              }
              else
              {
                const test::Mesh mesh = test::Extract(hierarchy, tolerance);
                points = mesh.Points.size();
                for (const auto& t : mesh.Triangles)
                {
                  largest = std::max(largest, *std::max_element(t.begin(), t.end()));
                }
              }
              ASSERT_LT(largest, static_cast<std::int32_t>(points));
            }
            ++accepted;
          }
          catch (const std::invalid_argument&)
          {
          }
        }
      }
    }
  }
  EXPECT_GT(accepted, 50);
}

TEST(Encoding, RandomDamageNeverHarms)
{
  const test::Field field = test::NoiseField({ 9, 9, 9 }, 2);
  const Encoding good = BuildIsodiamonds(Model::Relevant, field.View(), field.Isovalue, SerialFor);
  std::mt19937 random(5);
  int accepted = 0;
  for (int i = 0; i < 3000; ++i)
  {
    Encoding bad = good;
    const std::uint32_t value = random();
    switch (random() % 4)
    {
      case 0:
        bad.Arrays.BrickMasks[value % bad.Arrays.BrickMasks.size()] ^= std::uint64_t{ 1 }
          << (random() % 64);
        break;
      case 1:
        bad.Arrays.Records[value % bad.Arrays.Records.size()] =
          static_cast<std::uint16_t>(random());
        break;
      case 2:
        bad.Arrays.BrickIndices[value % bad.Arrays.BrickIndices.size()] ^= 1U << (random() % 8);
        break;
      default:
        bad.Arrays.Isovertices[value % bad.Arrays.Isovertices.size()] =
          static_cast<std::uint8_t>(random());
    }
    try
    {
      const IsodiamondHierarchy hierarchy(bad, SerialFor);
      for (const double tolerance : { 0.0, 1.0, 4.0 })
      {
        const test::Mesh mesh = test::Extract(hierarchy, tolerance);
        for (const std::array<std::int32_t, 3>& t : mesh.Triangles)
        {
          for (const std::int32_t id : t)
          {
            ASSERT_GE(id, 0);
            ASSERT_LT(id, static_cast<std::int32_t>(mesh.Points.size()));
          }
        }
      }
      ++accepted;
    }
    catch (const std::invalid_argument&)
    {
    }
  }
  EXPECT_GT(accepted, 0); // other thresholds or coefficients just make another hierarchy
}
