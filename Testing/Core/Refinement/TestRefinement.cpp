// SPDX-License-Identifier: BSD-3-Clause
// Refined sets against the reference's walk and its smallest closed set, diamond by diamond.
#include "Build/ActivationThresholds.h"
#include "Build/Classification.h"
#include "Refinement/ScalarQuery.h"
#include "Tools/CoreTestTools.h"

#include "ReferenceError.h"
#include "ReferenceMinimal.h"
#include "ReferenceRegion.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace isodiamond;
using ReferenceKind = reference::Kind;

namespace
{

/** What the reference finds for a field; own errors are rounded as the codes are. */
struct Oracle
{
  reference::Hierarchy Hierarchy;
  reference::ScalarField Samples;
  std::vector<ReferenceKind> Kinds;
  std::vector<bool> Crossed;
  std::vector<double> Errors;

  Oracle(const test::Field& field, const reference::ErrorCodes& codes)
    : Hierarchy(field.Dims)
    , Samples(field.Reference())
    , Kinds(reference::Classify(this->Hierarchy, this->Samples, field.Isovalue))
    , Crossed(reference::CrossedDomains(this->Hierarchy, this->Samples, field.Isovalue))
    , Errors(reference::OwnFieldErrors(this->Hierarchy, this->Samples))
  {
    for (double& error : this->Errors)
    {
      // The top code stands for "always": it is above every tolerance, even infinity.
      error = codes.CodeOf(error);
    }
  }

  reference::DiamondSet Refine(int accepted) const
  {
    return reference::Refine(
      this->Hierarchy, reference::UniformCriterion(this->Errors, this->Crossed, accepted))
      .Subdivided;
  }
};

void ExpectSameSet(const Oracle& oracle, const reference::DiamondSet& expected,
  const RefinedSet& refined, bool minimal)
{
  const Grid& grid = refined.Hierarchy().SampleGrid();
  for (int i = 0; i < oracle.Hierarchy.Size(); ++i)
  {
    const bool stored = !minimal || oracle.Kinds[i] == ReferenceKind::Active ||
      oracle.Kinds[i] == ReferenceKind::Creation;
    const Place place = test::PlaceOf(grid, oracle.Hierarchy.At(i).Center);
    ASSERT_EQ(refined.Contains(place), stored && expected[i]) << "diamond " << i;
  }
}

}

TEST(Refinement, EqualsTheReferenceWalkInAllModels)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const test::Built minimal = test::Build(Model::Minimal, field);
    const test::BuiltScalars scalars = test::BuildScalars(field);
    const double scale = relevant.Hierarchy->Codes().Scale();
    const reference::ErrorCodes codes(scale);
    const Oracle oracle(field, codes);
    for (const double tolerance : test::Tolerances(scale))
    {
      SCOPED_TRACE(tolerance);
      const int accepted = codes.LastWithin(tolerance);
      const reference::DiamondSet expected = oracle.Refine(accepted);
      ASSERT_EQ(expected,
        reference::SmallestClosedSet(
          oracle.Hierarchy, reference::UniformCriterion(oracle.Errors, oracle.Crossed, accepted)));
      ExpectSameSet(
        oracle, expected, RefinedSet(*relevant.Hierarchy, { tolerance }, SerialFor), false);
      ExpectSameSet(
        oracle, expected, RefinedSet(*minimal.Hierarchy, { tolerance }, SerialFor), true);
      const DiamondMask subdivided =
        scalars.Hierarchy->Refine(field.Isovalue, relevant.Hierarchy->Codes().Accepted(tolerance))
          .Subdivided;
      for (int i = 0; i < oracle.Hierarchy.Size(); ++i)
      {
        ASSERT_EQ(subdivided.Contains(
                    test::PlaceOf(scalars.Hierarchy->SampleGrid(), oracle.Hierarchy.At(i).Center)),
          expected[i]);
      }
    }
  }
}

TEST(Refinement, FollowsArbitraryCriteria)
{
  // Random own errors, so that nothing in the field helps: the thresholds must reproduce the walk.
  std::mt19937 random(11);
  for (const test::Field& field : { test::NoiseField({ 9, 9, 9 }, 3),
         test::SparseField({ 17, 17, 17 }, 4), test::SparseField({ 10, 6, 13 }, 5) })
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    Oracle oracle(field, reference::ErrorCodes(1.0));
    DiamondMask mask(grid);
    for (int i = 0; i < oracle.Hierarchy.Size(); ++i)
    {
      oracle.Errors[i] =
        oracle.Hierarchy.At(i).SticksOut ? ErrorCode::Always : 1.0 + random() % ErrorCode::Always;
      if (oracle.Kinds[i] != ReferenceKind::Inactive)
      {
        mask.Insert(test::PlaceOf(grid, oracle.Hierarchy.At(i).Center));
      }
    }
    const DiamondSet members(grid, mask);
    std::vector<ErrorCode::Type> triggers(members.Size(), 0);
    members.ForEach(
      [&](const Place& place, std::uint32_t rank)
      {
        const int i = oracle.Hierarchy.Find(Centre(place));
        triggers[rank] = oracle.Crossed[i] ? static_cast<ErrorCode::Type>(oracle.Errors[i]) : 0;
      });
    const std::vector<ErrorCode::Type> thresholds =
      ActivationThresholds(grid, members, triggers, test::ThreadedFor(3));
    for (const int accepted : { 0, 1, 1000, 4000, 8000, 12000, 16000, ErrorCode::Always - 1 })
    {
      const reference::DiamondSet expected = oracle.Refine(accepted);
      members.ForEach(
        [&](const Place& place, std::uint32_t rank) {
          EXPECT_EQ(
            thresholds[rank] > accepted, bool(expected[oracle.Hierarchy.Find(Centre(place))]));
        });
    }
  }
}

TEST(Refinement, ThresholdsAreTheLeastSolution)
{
  // Random triggers over several bricks per scale, against plain iteration of the definition.
  std::mt19937 random(12);
  for (const test::Field& field :
    { test::SparseField({ 33, 33, 33 }, 6), test::NoiseField({ 40, 21, 28 }, 7) })
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const SignLattice signs(grid, field.View(), field.Isovalue, SerialFor);
    const DiamondSet members(grid, Classify(grid, signs, SerialFor).Members);
    std::vector<ErrorCode::Type> triggers(members.Size());
    for (ErrorCode::Type& trigger : triggers)
    {
      trigger = random() % 4 == 0 ? 0 : 1 + random() % ErrorCode::Always;
    }
    const std::int64_t root = members.Rank({ grid.Depth() - 1, { 1, 1, 1 } });
    triggers[root] = ErrorCode::Always;
    std::vector<ErrorCode::Type> expected(members.Size(), 0);
    expected[root] = triggers[root];
    for (bool changed = true; changed;)
    {
      changed = false;
      members.ForEach(
        [&](const Place& place, std::uint32_t rank)
        {
          const TypeTable& shape = ShapeOf(place.Position);
          for (int i = 0; i < shape.ParentCount; ++i)
          {
            const Place parent = ParentPlace(shape, place, i);
            const std::int64_t above =
              parent.Scale < grid.Depth() ? members.Rank(parent) : DiamondSet::None;
            if (above == DiamondSet::None)
            {
              continue;
            }
            const ErrorCode::Type down = std::min(triggers[rank], expected[above]);
            changed = changed || expected[rank] < down || expected[above] < expected[rank];
            expected[rank] = std::max(expected[rank], down);
            expected[above] = std::max(expected[above], expected[rank]);
          }
        });
    }
    EXPECT_EQ(ActivationThresholds(grid, members, triggers, SerialFor), expected);
    EXPECT_EQ(ActivationThresholds(grid, members, triggers, test::ThreadedFor(3)), expected);
  }
}

TEST(Refinement, TheWalkOnTheMinimalStructureFindsTheSameSet)
{
  // The paper's own walk over MI records, without samples, with the library's thresholds.
  for (const test::Field& field :
    { test::NoiseField({ 9, 9, 9 }, 8), test::SphereField({ 17, 17, 17 }),
      test::SparseField({ 9, 9, 9 }, 9), test::WaveField({ 10, 6, 13 }) })
  {
    SCOPED_TRACE(field.Name);
    const test::Built minimal = test::Build(Model::Minimal, field, test::Placement(false));
    const double scale = minimal.Hierarchy->Codes().Scale();
    const reference::ErrorCodes codes(scale);
    const Oracle oracle(field, codes);
    const Grid& grid = minimal.Hierarchy->SampleGrid();
    std::vector<double> thresholds(oracle.Hierarchy.Size(), 0.0);
    for (int i = 0; i < oracle.Hierarchy.Size(); ++i)
    {
      const std::int64_t rank =
        minimal.Hierarchy->Diamonds().Rank(test::PlaceOf(grid, oracle.Hierarchy.At(i).Center));
      thresholds[i] = rank != DiamondSet::None ? minimal.Hierarchy->Threshold(rank) : 0;
    }
    const reference::Encoding encoding =
      reference::Encode(oracle.Hierarchy, oracle.Samples, field.Isovalue, oracle.Kinds,
        std::vector<std::uint16_t>(oracle.Hierarchy.Size(), 1), reference::Model::Minimal);
    const reference::MinimalHierarchy walk(oracle.Hierarchy, encoding, thresholds);
    for (const double tolerance : test::Tolerances(scale))
    {
      const reference::MinimalRefinement result = walk.Refine(codes.LastWithin(tolerance));
      ExpectSameSet(
        oracle, result.Subdivided, RefinedSet(*minimal.Hierarchy, { tolerance }, SerialFor), true);
      EXPECT_EQ(test::CompareWithPatches(test::Extract(*minimal.Hierarchy, tolerance),
                  result.Patches, oracle.Samples, field.Isovalue, false),
        "");
    }
  }
}

TEST(Refinement, OneHierarchyOfDiamondsAnswersTwentyIsovalues)
{
  test::Field field = test::WaveField({ 17, 14, 19 });
  const test::BuiltScalars scalars = test::BuildScalars(field);
  for (int i = 0; i < 20; ++i)
  {
    field.Isovalue = -2.4 + 0.25 * i;
    const double tolerance = 0.02 * i;
    const test::Built fromImage = test::Build(Model::Relevant, field);
    const Encoding fromScalars =
      BuildIsodiamonds(Model::Relevant, *scalars.Hierarchy, field.Isovalue, SerialFor);
    EXPECT_EQ(fromScalars.Arrays.Records, fromImage.Encoding.Arrays.Records);
    EXPECT_EQ(fromScalars.Arrays.BrickMasks, fromImage.Encoding.Arrays.BrickMasks);
    EXPECT_EQ(fromScalars.Arrays.Isovertices, fromImage.Encoding.Arrays.Isovertices);
    const test::Built query(
      EncodeQuery(*scalars.Hierarchy, field.Isovalue, { tolerance }, true, SerialFor), SerialFor);
    EXPECT_EQ(test::PlacedTriangles(test::Extract(*query.Hierarchy, tolerance)),
      test::PlacedTriangles(test::Extract(*fromImage.Hierarchy, tolerance)));
  }
}

TEST(Refinement, HierarchyOfDiamondsVisitsFewerAsTheToleranceGrows)
{
  const test::Field field = test::SphereField({ 33, 33, 33 });
  const test::BuiltScalars scalars = test::BuildScalars(field);
  const ErrorCode& code = scalars.Hierarchy->Codes();
  std::int64_t previous = scalars.Hierarchy->Refine(field.Isovalue, 0).Visited;
  EXPECT_LT(previous, 33 * 33 * 33);
  for (const double tolerance : { 0.01, 0.05, 0.2 })
  {
    const std::int64_t visited =
      scalars.Hierarchy->Refine(field.Isovalue, code.Accepted(tolerance * code.Scale())).Visited;
    EXPECT_LT(visited, previous);
    previous = visited;
  }
}

// A named diamond is subdivided with its ancestors, and nothing else, in an MI as in an RI.
TEST(Refinement, SubdividesWhatIsNamedWhateverIsTolerated)
{
  const test::Field field = test::SphereField({ 17, 14, 17 });
  const test::Built relevant = test::Build(Model::Relevant, field);
  const test::Built minimal = test::Build(Model::Minimal, field);
  const Grid& grid = relevant.Hierarchy->SampleGrid();
  const reference::Hierarchy hierarchy(field.Dims);
  const Query coarse{ 3.0 };
  const RefinedSet without(*relevant.Hierarchy, coarse, SerialFor);
  int added = 0;
  for (int i = 0; i < hierarchy.Size(); i += 7)
  {
    const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
    if (!minimal.Hierarchy->Diamonds().Contains(place) || without.Contains(place))
    {
      continue;
    }
    ++added;
    reference::DiamondSet expected(hierarchy.Size(), false);
    for (int k = 0; k < hierarchy.Size(); ++k)
    {
      expected[k] = k == i || without.Contains(test::PlaceOf(grid, hierarchy.At(k).Center));
    }
    expected = reference::CloseOverParents(hierarchy, expected);
    Query query = coarse;
    query.Also = { place };
    const RefinedSet with(*relevant.Hierarchy, query, SerialFor);
    for (int k = 0; k < hierarchy.Size(); ++k)
    {
      ASSERT_EQ(with.Contains(test::PlaceOf(grid, hierarchy.At(k).Center)), expected[k])
        << "diamond " << k << " with " << i;
    }
    EXPECT_TRUE(
      test::Extract(*minimal.Hierarchy, query) == test::Extract(*relevant.Hierarchy, query));
  }
  EXPECT_GT(added, 50);
}

// Meshes have hidden cells cut out, so they have full resolution there, whatever the tolerance.
TEST(Refinement, GoesToTheEndAtHiddenCells)
{
  const test::Field field = test::SphereField({ 17, 17, 17 });
  const auto cellOf = [](const test::PlacedTriangle& triangle)
  {
    const auto& [a, b, c] = triangle.Corners;
    Point cell{};
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = static_cast<int>(std::floor((a[axis] + b[axis] + c[axis]) / 3.0F));
    }
    return cell;
  };
  const std::vector<test::PlacedTriangle> full =
    test::PlacedTriangles(test::Extract(*test::Build(Model::Minimal, field).Hierarchy, 0.0));
  const Point cell = cellOf(full[full.size() / 2]);
  std::vector<std::uint8_t> hidden(16 * 16 * 16, 0);
  hidden[(cell[2] * 16 + cell[1]) * 16 + cell[0]] = 1;
  const HiddenCells cells(std::move(hidden), { 16, 16, 16 });
  for (const ErrorMetric metric : { ErrorMetric::Field, ErrorMetric::Distance })
  {
    BuildOptions options;
    options.Metric = metric;
    options.Hidden = &cells;
    const test::Built built = test::Build(Model::Minimal, field, options);
    const std::vector<test::PlacedTriangle> coarse =
      test::PlacedTriangles(test::Extract(*built.Hierarchy, 3.0));
    EXPECT_LT(coarse.size(), full.size() / 2);
    for (const test::PlacedTriangle& triangle : full)
    {
      EXPECT_TRUE(cellOf(triangle) != cell ||
        std::find(coarse.begin(), coarse.end(), triangle) != coarse.end());
    }
  }
}
