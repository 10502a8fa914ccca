// SPDX-License-Identifier: BSD-3-Clause
// Interval volumes against the reference: kinds, refined sets, meshes, volumes.
#include "Build/Classification.h"
#include "Tools/IntervalTestTools.h"

#include "ReferenceError.h"
#include "ReferenceExact.h"
#include "ReferenceLinearVolume.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

using namespace isodiamond;
using ReferenceKind = reference::Kind;

namespace
{

/** What the reference finds for a field and a range; own errors are rounded as the codes are. */
struct Oracle
{
  reference::Hierarchy Hierarchy;
  reference::ScalarField Samples;
  reference::Isorange Range;
  std::vector<double> Errors;
  reference::DiamondSet Carrying;
  reference::DiamondSet Inside;

  Oracle(
    const test::Field& field, const reference::Isorange& range, const reference::ErrorCodes& codes)
    : Hierarchy(field.Dims)
    , Samples(field.Reference())
    , Range(range)
    , Errors(reference::OwnFieldErrors(this->Hierarchy, this->Samples))
    , Carrying(reference::CarryingDomains(this->Hierarchy, this->Samples, range))
    , Inside(reference::DiamondsInside(this->Hierarchy, this->Samples, range))
  {
    for (double& error : this->Errors)
    {
      const int code = codes.CodeOf(error);
      error =
        code == reference::ErrorCodes::Infinite ? std::numeric_limits<double>::infinity() : code;
    }
  }

  reference::DiamondSet Refine(double accepted, double acceptedInside) const
  {
    const reference::DiamondSet subdivided = reference::Refine(
      this->Hierarchy, reference::IntervalCriterion(this->Errors, this->Carrying, accepted))
                                               .Subdivided;
    return reference::RefineInterior(
      this->Hierarchy, subdivided, this->Errors, this->Inside, acceptedInside);
  }
};

void ExpectSameSet(const Oracle& oracle, const std::vector<ReferenceKind>& kinds,
  const reference::DiamondSet& expected, const RefinedSet& refined, bool minimal)
{
  const Grid& grid = refined.Hierarchy().SampleGrid();
  for (int i = 0; i < oracle.Hierarchy.Size(); ++i)
  {
    const bool stored =
      !minimal || kinds[i] == ReferenceKind::Active || kinds[i] == ReferenceKind::Creation;
    const Place place = test::PlaceOf(grid, oracle.Hierarchy.At(i).Center);
    ASSERT_EQ(refined.Contains(place), stored && expected[i]) << "diamond " << i;
  }
}

/** The same points, as many tetrahedra of each level, and, with linear isovertices, the same volume
 *  within what free diagonals allow. */
void ExpectSameMesh(const Oracle& oracle, const reference::DiamondSet& subdivided,
  const test::Volume& volume, bool exact)
{
  const std::vector<reference::Tetrahedron> leaves =
    reference::SampledLeaves(oracle.Hierarchy, subdivided);
  std::vector<std::array<double, 3>> expected;
  for (const reference::IntervalPoint& point :
    reference::PointsOf(oracle.Hierarchy, oracle.Samples, oracle.Range, leaves))
  {
    expected.push_back(exact ? reference::ExactPosition(oracle.Samples, oracle.Range, point)
                             : reference::Position(oracle.Samples, oracle.Range, point));
  }
  std::vector<std::array<double, 3>> points = volume.Points;
  std::sort(expected.begin(), expected.end());
  std::sort(points.begin(), points.end());
  EXPECT_TRUE(points == expected);
  std::map<int, int> levels;
  for (const reference::Tetrahedron& leaf : leaves)
  {
    levels[reference::LevelOf(oracle.Hierarchy, leaf)] +=
      reference::CountTetrahedra(reference::SignsOf(oracle.Samples, oracle.Range, leaf));
  }
  for (const std::int16_t level : volume.Levels)
  {
    --levels[level];
  }
  EXPECT_TRUE(
    std::all_of(levels.begin(), levels.end(), [](const auto& level) { return level.second == 0; }));
  if (exact)
  {
    return; // the reference's volumes are those of linear isovertices
  }
  const reference::ValueRange sums =
    reference::VolumesOf(oracle.Hierarchy, oracle.Samples, oracle.Range, leaves);
  const double total = test::TotalVolume(volume);
  EXPECT_GE(total, sums.Minimum - 1e-9);
  EXPECT_LE(total, sums.Maximum + 1e-9);
}

}

TEST(IntervalReference, KindsAndCountsAreTheSame)
{
  std::map<std::string, int> seen; // everything that the paper tells apart must occur
  for (const test::Field& field : test::SmallFields())
  {
    for (const reference::Isorange& range : test::RangesOf(field))
    {
      SCOPED_TRACE(field.Name);
      const Grid grid(field.Dims);
      const reference::Hierarchy hierarchy(field.Dims);
      const reference::ScalarField samples = field.Reference();
      const SignLattice signs(grid, field.View(), test::RegionOf(range), SerialFor);
      for (const bool refineInterior : { false, true })
      {
        const std::vector<ReferenceKind> kinds =
          reference::Classify(hierarchy, samples, range, refineInterior);
        const Classification found = Classify(grid, signs, test::ThreadedFor(2), refineInterior);
        for (int i = 0; i < hierarchy.Size(); ++i)
        {
          const reference::Point& centre = hierarchy.At(i).Center;
          const Place place = test::PlaceOf(grid, centre);
          ASSERT_EQ(found.Active.Contains(place), kinds[i] == ReferenceKind::Active);
          ASSERT_EQ(found.Creation.Contains(place), kinds[i] == ReferenceKind::Creation);
          ASSERT_EQ(found.Members.Contains(place), kinds[i] != ReferenceKind::Inactive);
          if (kinds[i] == ReferenceKind::Creation)
          {
            const std::array<int, 3> first = hierarchy.At(i).Spine[0];
            const bool sampled = grid.IsSampled(first);
            ++seen[!sampled ? ""
                            : (reference::SignOf(samples.At(first), range) < 0 ? "creation below"
                                                                               : "creation above")];
          }
          const bool outsideCentre =
            grid.IsSampled(centre) && reference::SignOf(samples.At(centre), range) != 0;
          if (outsideCentre && reference::HasVerticesInside(hierarchy, samples, range, i))
          {
            ++seen["inside with the centre outside"];
          }
        }
        const reference::Counts counts = reference::Count(hierarchy, samples, range, kinds);
        for (const Model model : { Model::Relevant, Model::Minimal })
        {
          const test::Built built(BuildIsodiamonds(model, field.View(), test::RegionOf(range),
                                    SerialFor, test::Interior(refineInterior)),
            SerialFor);
          EXPECT_EQ(built.Hierarchy->Count(Kind::Active), counts.Active);
          EXPECT_EQ(built.Hierarchy->Count(Kind::Creation), counts.Creation);
          EXPECT_EQ(built.Hierarchy->Header().RelevantCount, counts.Relevant);
          EXPECT_EQ(built.Hierarchy->Count(Kind::Relevant),
            model == Model::Relevant ? counts.Relevant - counts.Creation : 0);
          EXPECT_EQ(built.Hierarchy->IsovertexCount(), counts.Isovertices + counts.BaseIsovertices);
        }
      }
    }
  }
  EXPECT_GT(seen["creation below"], 10);
  EXPECT_GT(seen["creation above"], 10);
  EXPECT_GT(seen["inside with the centre outside"], 10);
}

TEST(IntervalReference, RefinedSetsAndMeshesAreTheSameInAllModels)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const test::Field& field : test::SmallFields())
  {
    for (const reference::Isorange& range : test::RangesOf(field))
    {
      SCOPED_TRACE(field.Name);
      const Isoregion region = test::RegionOf(range);
      const test::BuiltScalars scalars = test::BuildScalars(field);
      const ErrorCode& code = scalars.Hierarchy->Codes();
      const reference::ErrorCodes codes(code.Scale());
      const Oracle oracle(field, range, codes);
      for (const bool refineInterior : { false, true })
      {
        const std::vector<ReferenceKind> kinds =
          reference::Classify(oracle.Hierarchy, oracle.Samples, range, refineInterior);
        const test::Built relevant(BuildIsodiamonds(Model::Relevant, field.View(), region,
                                     SerialFor, test::Interior(refineInterior)),
          SerialFor);
        const test::Built minimal(BuildIsodiamonds(Model::Minimal, *scalars.Hierarchy, region,
                                    SerialFor, test::Interior(refineInterior)),
          SerialFor);
        BuildOptions placedLinearly = test::Interior(refineInterior);
        placedLinearly.ExactIsovertices = false;
        const test::Built linear(
          BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, placedLinearly),
          SerialFor);
        for (const double tolerance : { 0.0, 0.1 * code.Scale(), 0.4 * code.Scale(), infinity })
        {
          const double interior = refineInterior ? 0.15 * code.Scale() : infinity;
          const reference::DiamondSet expected = oracle.Refine(
            codes.LastWithin(tolerance), refineInterior ? codes.LastWithin(interior) : infinity);
          ExpectSameSet(oracle, kinds, expected,
            RefinedSet(*relevant.Hierarchy, { tolerance, interior }, SerialFor), false);
          ExpectSameSet(oracle, kinds, expected,
            RefinedSet(*minimal.Hierarchy, { tolerance, interior }, SerialFor), true);
          const DiamondMask subdivided =
            scalars.Hierarchy->Refine(region, code.Accepted(tolerance), code.Accepted(interior))
              .Subdivided;
          for (int i = 0; i < oracle.Hierarchy.Size(); ++i)
          {
            const Place place =
              test::PlaceOf(scalars.Hierarchy->SampleGrid(), oracle.Hierarchy.At(i).Center);
            ASSERT_EQ(subdivided.Contains(place), bool(expected[i]));
          }
          if (field.Name.find("broken") == std::string::npos)
          {
            ExpectSameMesh(
              oracle, expected, test::ExtractVolume(*minimal.Hierarchy, tolerance, interior), true);
            if (!refineInterior)
            {
              ExpectSameMesh(
                oracle, expected, test::ExtractVolume(*linear.Hierarchy, tolerance), false);
            }
          }
        }
      }
    }
  }
}

// The paper's figure 13: without closure, the patches of a creation diamond's descendants would
// overlap those of a coarse active diamond around it.
TEST(IntervalReference, CreationInsideACoarseActiveDiamondDoesNotOverlap)
{
  test::Field field = test::WaveField({ 17, 17, 17 });
  for (int z = 0; z < 17; ++z)
  {
    for (int y = 0; y < 17; ++y)
    {
      for (int x = 0; x < 17; ++x)
      {
        // A linear ramp, and one sample inside the range in the part below the range.
        field.Samples[(z * 17 + y) * 17 + x] =
          static_cast<float>(x == 3 && y == 3 && z == 3 ? 10.5 : x);
      }
    }
  }
  const reference::Isorange range{ 9.7, 11.3 };
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), test::RegionOf(range), SerialFor), SerialFor);
  EXPECT_GT(built.Hierarchy->Count(Kind::Creation), 0);
  const reference::ErrorCodes codes(built.Hierarchy->Codes().Scale());
  const Oracle oracle(field, range, codes);
  for (const double tolerance : test::Tolerances(built.Hierarchy->Codes().Scale()))
  {
    SCOPED_TRACE(tolerance);
    const test::Volume volume = test::ExtractVolume(*built.Hierarchy, tolerance);
    EXPECT_EQ(test::FindFault(volume, field.Dims), "");
    ExpectSameMesh(oracle,
      oracle.Refine(codes.LastWithin(tolerance), std::numeric_limits<double>::infinity()), volume,
      true);
  }
}

namespace
{

void ExpectLinearVolume(const AnySamples& samples, const reference::ScalarField& field,
  const reference::Isorange& range, double tolerance)
{
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, samples, test::RegionOf(range), SerialFor), SerialFor);
  const double total = test::TotalVolume(test::ExtractVolume(*built.Hierarchy, 0.0));
  const double expected = reference::LinearVolume(field, range);
  EXPECT_GT(expected, 0.0);
  EXPECT_NEAR(total, expected, tolerance * expected);
  std::cout << "volume " << total << ", of the linear field " << expected << "\n";
}

}

TEST(IntervalReference, VolumeIsThatOfTheLinearField)
{
  for (const test::Field& field :
    { test::WaveField({ 33, 30, 27 }), test::SphereField({ 33, 33, 33 }) })
  {
    ExpectLinearVolume(field.View(), field.Reference(), { -0.25, 0.8 }, 0.001);
  }
  // Noise of real values, so that the same rounding of coefficients does not repeat.
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  test::Field noise = test::NoiseField({ 33, 33, 33 }, 1);
  std::generate(noise.Samples.begin(), noise.Samples.end(), [&] { return unit(random); });
  ExpectLinearVolume(noise.View(), noise.Reference(), { 0.3, 0.62 }, 0.001);
}

TEST(IntervalReference, VolumeIsThatOfTheLinearFieldOnFuelAndHydrogen)
{
  const char* folder = std::getenv("ISODIAMONDS_DATA_DIR");
  struct Case
  {
    const char* File;
    int Size;
    reference::Isorange Range;
  };
  for (const Case& one : { Case{ "fuel_64x64x64_uint8.raw", 64, { 7.2, 11.4 } },
         Case{ "hydrogen_atom_128x128x128_uint8.raw", 128, { 24.0, 48.0 } } })
  {
    std::ifstream file(std::string(folder ? folder : "") + "/" + one.File, std::ios::binary);
    std::vector<std::uint8_t> samples(one.Size * one.Size * one.Size);
    if (!folder || !file.read(reinterpret_cast<char*>(samples.data()), samples.size()))
    {
      GTEST_SKIP() << "ISODIAMONDS_DATA_DIR does not hold " << one.File;
    }
    const std::array<int, 3> dims = { one.Size, one.Size, one.Size };
    ExpectLinearVolume(SampleView<std::uint8_t>(samples.data(), dims),
      { dims, { samples.begin(), samples.end() } }, one.Range, 0.001);
  }
}
