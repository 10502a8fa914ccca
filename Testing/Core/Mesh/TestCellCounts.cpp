// SPDX-License-Identifier: BSD-3-Clause
// Counts of cells at every tolerance, against extraction.
#include "Mesh/CellCounts.h"
#include "Tools/CoreTestTools.h"
#include "Tools/IntervalTestTools.h"

#include <gtest/gtest.h>

#include <set>

using namespace isodiamond;

namespace
{

/** At 0, at every threshold that there is and just below it, and beyond all. */
void ExpectCountsOfExtraction(const IsodiamondHierarchy& hierarchy, double interior = HUGE_VAL)
{
  std::set<double> tolerances{ 0.0, HUGE_VAL };
  for (std::int64_t rank = 0; rank < hierarchy.Diamonds().Size(); ++rank)
  {
    const double threshold = hierarchy.Codes().Decode(hierarchy.Threshold(rank));
    tolerances.insert(threshold);
    tolerances.insert(std::nextafter(threshold, 0.0));
  }
  const CellCounts counts(hierarchy, SerialFor, interior);
  for (const double tolerance : tolerances)
  {
    ASSERT_EQ(counts.At(tolerance),
      CountCells(RefinedSet(hierarchy, { tolerance, interior }, SerialFor), SerialFor))
      << "at " << tolerance;
  }
}

}

TEST(CellCounts, ChangeWithTheTolerance)
{
  const test::Built built = test::Build(Model::Minimal, test::WaveField({ 17, 17, 17 }));
  const CellCounts counts(*built.Hierarchy, test::ThreadedFor(3));
  EXPECT_GT(counts.At(0.0), counts.At(0.1));
  EXPECT_GT(counts.At(0.1), counts.At(HUGE_VAL));
}

// A filter may keep those of thousands of small hierarchies.
TEST(CellCounts, OfSmallHierarchiesAreSmall)
{
  const test::Built built = test::Build(Model::Minimal, test::WaveField({ 5, 5, 5 }));
  EXPECT_LT(CellCounts(*built.Hierarchy, SerialFor).Bytes(), 10000);
}

TEST(CellCounts, AreThoseOfSurfaces)
{
  for (const test::Field& field : test::SmallFields())
  {
    SCOPED_TRACE(field.Name);
    for (const Model model : { Model::Relevant, Model::Minimal })
    {
      ExpectCountsOfExtraction(*test::Build(model, field).Hierarchy);
    }
  }
}

TEST(CellCounts, AreThoseOfVolumesAtAnyInteriorTolerance)
{
  const test::Field field = test::WaveField({ 17, 14, 9 });
  for (const bool refineInterior : { false, true })
  {
    const test::Built built(BuildIsodiamonds(Model::Minimal, field.View(), { -0.8, 0.4 }, SerialFor,
                              test::Interior(refineInterior)),
      SerialFor);
    for (const double interior : { 0.0, 0.05, 0.3, HUGE_VAL })
    {
      SCOPED_TRACE(interior);
      ExpectCountsOfExtraction(*built.Hierarchy, interior);
    }
  }
}
