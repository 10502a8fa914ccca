// SPDX-License-Identifier: BSD-3-Clause
// Exact and linear isovertices on all edges of all scales, against the reference.
#include "Tools/IntervalTestTools.h"

#include "ReferenceExact.h"

#include <gtest/gtest.h>

#include <functional>

using namespace isodiamond;

namespace
{

/** Calls body(place, rank, edge, surface, coefficient) for all isovertices. */
template <typename Body>
void ForEachIsovertex(const IsodiamondHierarchy& hierarchy, Body&& body)
{
  hierarchy.Diamonds().ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      const std::uint8_t* coefficients = hierarchy.Isovertices(rank);
      for (int surface = 0; surface < hierarchy.Region().SurfaceCount(); ++surface)
      {
        ForEachBit(surface == 0 ? hierarchy.Edges(rank) : hierarchy.UpperEdges(rank),
          [&](int edge) { body(place, rank, edge, surface, int{ *coefficients++ }); });
      }
    });
}

reference::Point OlderEnd(const Place& place, int edge)
{
  return Centre(place) +
    (1 << place.Scale) * tables::Parities[Parity(place.Position)].Offsets[edge];
}

std::vector<test::Field> Fields()
{
  std::vector<test::Field> fields = test::SmallFields();
  fields.push_back(test::NoiseField({ 33, 20, 26 }, 77)); // many crossings on long edges
  fields.push_back(test::BrokenField({ 17, 18, 19 }, 78));
  return fields;
}

}

TEST(IsovertexPlacement, OfIsosurfacesIsTheReferences)
{
  std::int64_t moved = 0;
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const reference::ScalarField samples = field.Reference();
    for (const bool exact : { true, false })
    {
      const test::Built built = test::Build(Model::Minimal, field, test::Placement(exact));
      EXPECT_EQ(built.Encoding.Header.ExactIsovertices, exact);
      ForEachIsovertex(*built.Hierarchy,
        [&](const Place& place, std::uint32_t, int edge, int, int coefficient)
        {
          const reference::Isovertex isovertex{ Centre(place), OlderEnd(place, edge) };
          const int linear = reference::Coefficient(samples, field.Isovalue, isovertex);
          const int expected =
            exact ? reference::ExactCoefficient(samples, field.Isovalue, isovertex) : linear;
          ASSERT_EQ(coefficient, expected);
          moved += expected != linear ? 1 : 0;
        });
    }
  }
  EXPECT_GT(moved, 1000);
}

TEST(IsovertexPlacement, OfIntervalVolumesIsTheReferences)
{
  std::int64_t moved = 0;
  std::int64_t both = 0;
  for (const test::Field& field : Fields())
  {
    const reference::ScalarField samples = field.Reference();
    for (const reference::Isorange& range : test::RangesOf(field))
    {
      SCOPED_TRACE(field.Name);
      for (const bool exact : { true, false })
      {
        const test::Built built(BuildIsodiamonds(Model::Minimal, field.View(),
                                  test::RegionOf(range), SerialFor, test::Placement(exact)),
          SerialFor);
        const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
        ForEachIsovertex(hierarchy,
          [&](const Place& place, std::uint32_t rank, int edge, int surface, int coefficient)
          {
            const reference::IntervalPoint point{ Centre(place), OlderEnd(place, edge),
              2 * surface - 1 };
            const int linear = reference::Coefficient(samples, range, point);
            const int expected =
              exact ? reference::ExactCoefficient(samples, range, point) : linear;
            ASSERT_EQ(coefficient, expected);
            moved += expected != linear ? 1 : 0;
            both += ((hierarchy.Edges(rank) & hierarchy.UpperEdges(rank)) >> edge) & 1U;
          });
      }
    }
  }
  EXPECT_GT(moved, 1000);
  EXPECT_GT(both, 1000);
}

namespace
{

/** Every isovertex has a crossing of the full-resolution field on its edge, within one coefficient
 *  step, or within two where the edge carries both surfaces. */
void ExpectOnSurface(const test::Field& field, const Isoregion& region)
{
  SCOPED_TRACE(field.Name);
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor), SerialFor);
  const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
  ForEachIsovertex(hierarchy,
    [&](const Place& place, std::uint32_t rank, int edge, int surface, int coefficient)
    {
      const int steps = 1 << place.Scale;
      const double isovalue = region.Isovalue(surface);
      const bool both = region.IsVolume() &&
        (((hierarchy.Edges(rank) & hierarchy.UpperEdges(rank)) >> edge) & 1U) != 0;
      const Point& offset = tables::Parities[Parity(place.Position)].Offsets[edge];
      const auto sample = [&](int i) { return SampleAt(field.View(), Centre(place) + i * offset); };
      double nearest = 2.0 * steps;
      for (int i = 0; i < steps; ++i)
      {
        if (region.IsAbove(surface, sample(i)) != region.IsAbove(surface, sample(i + 1)))
        {
          const double crossing = i + (isovalue - sample(i)) / (sample(i + 1) - sample(i));
          nearest = std::min(nearest, std::abs(crossing - coefficient / 256.0 * steps));
        }
      }
      ASSERT_LE(nearest, (both ? 2 : 1) * steps / 256.0);
    });
}

}

TEST(IsovertexPlacement, PutsVerticesOnTheFullResolutionSurface)
{
  for (const test::Field& field : { test::NoiseField({ 33, 33, 33 }, 5),
         test::WaveField({ 33, 20, 27 }), test::SphereField({ 40, 33, 29 }) })
  {
    ExpectOnSurface(field, field.Isovalue);
    ExpectOnSurface(field, Isoregion(field.Isovalue - 0.4, field.Isovalue + 0.3));
  }
}

// Differences overflow: isovertices may be anywhere on their edges, but in the right order.
TEST(IsovertexPlacement, StaysInRangeForHugeValues)
{
  std::vector<double> samples(125);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    samples[i] = i * i % 3 == 1 ? 1.7e308 : -1.7e308;
  }
  const SampleView<double> view(samples.data(), { 5, 5, 5 });
  for (const Isoregion& region : { Isoregion(1e308), Isoregion(-1e308, 1e308) })
  {
    const Encoding encoding = BuildIsodiamonds(Model::Minimal, view, region, SerialFor);
    EXPECT_GT(encoding.Arrays.Isovertices.size(), 100U);
    EXPECT_NO_THROW(IsodiamondHierarchy(encoding, SerialFor));
  }
}
