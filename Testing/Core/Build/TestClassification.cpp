// SPDX-License-Identifier: BSD-3-Clause
// Kinds and counts against the reference; the paper's table 1 and theorem 7.1 over all duets.
#include "Build/Builder.h"
#include "Build/Classification.h"
#include "Build/StagedBuild.h"
#include "Tools/CoreTestTools.h"
#include "Tools/RandomTestTools.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

using namespace isodiamond;
using ReferenceKind = reference::Kind;

// Ten signs of a row may lie in two words of 64 signs, and reach beyond either end of the row.
TEST(Classification, RowsOfSignsAreThoseOfTheSamples)
{
  for (const int length : { 2, 7, 8, 9, 63, 64, 65, 72, 73, 128, 129, 140 })
  {
    const test::Field field = test::NoiseField({ length, 3, 2 }, 41);
    const Grid grid(field.Dims);
    for (const Isoregion& region : { Isoregion(0.0), Isoregion(-0.3, 0.3) })
    {
      const SignLattice signs(grid, field.View(), region, SerialFor);
      for (int x0 = 0; x0 <= length + 8; x0 += 8)
      {
        const SignLattice::Row row = signs.Load(0, x0, 1, 1);
        for (int bit = 0; bit < 10; ++bit)
        {
          const Point point = { x0 - 1 + bit, 1, 1 };
          const bool isSampled = point[0] >= 0 && point[0] < length;
          const int sign = isSampled ? region.SignOf(SampleAt(field.View(), point)) : 0;
          EXPECT_EQ((row.Sampled >> bit) & 1U, isSampled ? 1U : 0U) << length << " " << point[0];
          EXPECT_EQ((row.Above[0] >> bit) & 1U, sign > 0 ? 1U : 0U) << length << " " << point[0];
          EXPECT_EQ((row.Above[1] >> bit) & 1U, sign > 1 ? 1U : 0U) << length << " " << point[0];
        }
        EXPECT_EQ((row.Sampled | row.Above[0] | row.Above[1]) >> 10, 0U);
      }
      EXPECT_EQ(signs.Load(0, 0, -1, 0).Sampled | signs.Load(0, 0, 0, 2).Sampled, 0U);
    }
  }
}

TEST(Classification, KindsEqualTheReference)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const reference::Hierarchy hierarchy(field.Dims);
    const std::vector<ReferenceKind> kinds =
      reference::Classify(hierarchy, field.Reference(), field.Isovalue);
    const SignLattice signs(grid, field.View(), field.Isovalue, SerialFor);
    const Classification found = Classify(grid, signs, test::ThreadedFor(2));
    int members = 0;
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
      EXPECT_EQ(found.Active.Contains(place), kinds[i] == ReferenceKind::Active);
      EXPECT_EQ(found.Creation.Contains(place), kinds[i] == ReferenceKind::Creation);
      EXPECT_EQ(found.Members.Contains(place), kinds[i] != ReferenceKind::Inactive);
      members += kinds[i] != ReferenceKind::Inactive ? 1 : 0;
    }
    EXPECT_EQ(DiamondSet(grid, found.Members).Size(), members); // nothing outside of the lattice
  }
}

TEST(Classification, HierarchiesKeepTheCountsAndKindsOfTheReference)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const Grid grid(field.Dims);
    const reference::Hierarchy hierarchy(field.Dims);
    const reference::ScalarField samples = field.Reference();
    const std::vector<ReferenceKind> kinds =
      reference::Classify(hierarchy, samples, field.Isovalue);
    const reference::Counts counts = reference::Count(hierarchy, samples, field.Isovalue, kinds);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const test::Built minimal = test::Build(Model::Minimal, field);
    EXPECT_EQ(relevant.Hierarchy->Count(Kind::Active), counts.Active);
    EXPECT_EQ(relevant.Hierarchy->Count(Kind::Creation), counts.Creation);
    EXPECT_EQ(relevant.Hierarchy->Count(Kind::Relevant), counts.Relevant - counts.Creation);
    EXPECT_EQ(minimal.Hierarchy->Count(Kind::Active), counts.Active);
    EXPECT_EQ(minimal.Hierarchy->Count(Kind::Creation), counts.Creation);
    EXPECT_EQ(minimal.Hierarchy->Count(Kind::Relevant), 0);
    // RI keeps the relevant diamonds in addition, and nothing else.
    EXPECT_EQ(relevant.Hierarchy->Diamonds().Size() - minimal.Hierarchy->Diamonds().Size(),
      counts.Relevant - counts.Creation);
    EXPECT_EQ(minimal.Hierarchy->IsovertexCount(), counts.Isovertices + counts.BaseIsovertices);
    EXPECT_EQ(relevant.Encoding.Arrays.Isovertices, minimal.Encoding.Arrays.Isovertices);
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      const std::int64_t rank =
        relevant.Hierarchy->Diamonds().Rank(test::PlaceOf(grid, hierarchy.At(i).Center));
      ASSERT_EQ(rank != DiamondSet::None, kinds[i] != ReferenceKind::Inactive);
      if (rank != DiamondSet::None)
      {
        EXPECT_EQ(static_cast<int>(relevant.Hierarchy->KindOf(rank)), static_cast<int>(kinds[i]));
      }
    }
  }
}

namespace
{

/** Signs of the sampled vertices of the tetrahedra that a parent and a child share. */
std::set<int> DuetSigns(const reference::Hierarchy& hierarchy, const test::Field& field,
  const reference::ScalarField& samples, int parent, int child)
{
  std::set<int> signs;
  const reference::Diamond& diamond = hierarchy.At(child);
  for (std::size_t t = 0; t < diamond.Tetrahedra.size(); ++t)
  {
    if (diamond.Origins[t] == parent)
    {
      for (const reference::Point& vertex : diamond.Tetrahedra[t].Vertices)
      {
        if (hierarchy.IsSampled(vertex))
        {
          signs.insert(reference::SignOf(samples.At(vertex), field.Isovalue));
        }
      }
    }
  }
  return signs;
}

}

// Full resolution first, errors when they are asked for: the result is the same to the bit, even if
// the samples are elsewhere by then, or an attempt was stopped before.
TEST(Classification, InTwoStepsIsAsInOne)
{
  int compared = 0;
  for (const test::Field& field : { test::NoiseField({ 9, 10, 8 }, 81),
         test::SphereField({ 17, 12, 17 }), test::BrokenField({ 9, 10, 8 }, 82) })
  {
    SCOPED_TRACE(field.Name);
    const double upper = field.Isovalue + 0.2;
    for (const Isoregion& region : { Isoregion(field.Isovalue), Isoregion(field.Isovalue, upper) })
    {
      for (const ErrorMetric metric : { ErrorMetric::Field, ErrorMetric::Distance })
      {
        for (const bool refineInterior : { false, true })
        {
          BuildOptions options;
          options.Metric = metric;
          options.RefineInterior = refineInterior;
          options.PreserveTopology = true;
          options.MinimumPieceSize = 3;
          const Encoding expected =
            BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options);
          StagedBuild staged = [&]
          {
            const test::Field passing = field;
            return StagedBuild(passing.View(), region, SerialFor, options);
          }();
          StagedBuild elsewhere(std::move(staged));
          staged = std::move(elsewhere);
          const IsodiamondHierarchy hierarchy(expected, SerialFor);
          EXPECT_TRUE(test::AnyMesh(staged.OneMesh(), Query{})
                        .IsSameInAnyOrder(test::AnyMesh(hierarchy, Query{})));
          BuildOptions stopping = options;
          stopping.Report = [](const char* phase, double, double)
          {
            if (std::string(phase) == "Finding thresholds")
            {
              throw std::runtime_error("stopped");
            }
          };
          EXPECT_THROW(
            staged.Finish(Model::Minimal, field.View(), SerialFor, stopping), std::runtime_error);
          const Encoding found =
            staged.Finish(Model::Minimal, field.View(), test::ThreadedFor(2), options);
          test::ExpectSame(found, expected);
          ++compared;
        }
      }
    }
  }
  EXPECT_EQ(compared, 24);
}

TEST(Classification, Theorem71AndTable1HoldOverAllDuets)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const reference::ScalarField samples = field.Reference();
    // The kinds are the core's; which duets are active follows from the reference's signs.
    const Grid grid(field.Dims);
    const SignLattice signs(grid, field.View(), field.Isovalue, SerialFor);
    const Classification found = Classify(grid, signs, SerialFor);
    std::vector<ReferenceKind> kinds;
    for (int i = 0; i < hierarchy.Size(); ++i)
    {
      const Place place = test::PlaceOf(grid, hierarchy.At(i).Center);
      kinds.push_back(found.Active.Contains(place) ? ReferenceKind::Active
          : found.Creation.Contains(place)         ? ReferenceKind::Creation
          : found.Members.Contains(place)          ? ReferenceKind::Relevant
                                                   : ReferenceKind::Inactive);
    }
    for (int child = 0; child < hierarchy.Size(); ++child)
    {
      for (const int parent : hierarchy.At(child).Parents)
      {
        const bool activeDuet = DuetSigns(hierarchy, field, samples, parent, child).size() == 2;
        // Theorem 7.1: the parent of an active duet is active or creation.
        if (activeDuet)
        {
          EXPECT_TRUE(
            kinds[parent] == ReferenceKind::Active || kinds[parent] == ReferenceKind::Creation);
          EXPECT_EQ(kinds[child], ReferenceKind::Active);
        }
        // Table 1: which arcs carry a patch.
        if (kinds[parent] == ReferenceKind::Creation && !hierarchy.At(child).SticksOut)
        {
          EXPECT_EQ(kinds[child], ReferenceKind::Active);
          EXPECT_TRUE(activeDuet);
        }
        if (kinds[parent] == ReferenceKind::Relevant || kinds[parent] == ReferenceKind::Inactive ||
          kinds[child] == ReferenceKind::Creation || kinds[child] == ReferenceKind::Relevant)
        {
          EXPECT_FALSE(activeDuet);
        }
        // Ancestors of what is kept are kept: inactive diamonds have inactive descendants only.
        if (kinds[parent] == ReferenceKind::Inactive)
        {
          EXPECT_EQ(kinds[child], ReferenceKind::Inactive);
        }
      }
    }
  }
}
