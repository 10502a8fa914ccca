// SPDX-License-Identifier: BSD-3-Clause
// The topology of full resolution at every tolerance: Betti numbers, counted on random meshes.
#include "Refinement/ScalarQuery.h"
#include "Tools/TopologyTestTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace isodiamond;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** An HD of any samples. */
struct Scalars
{
  ScalarEncoding Encoding;
  ScalarHierarchy Hierarchy;

  explicit Scalars(const AnySamples& samples)
    : Encoding(BuildScalarHierarchy(samples, SerialFor))
    , Hierarchy(samples, Encoding.ErrorScale, Encoding.Codes.data(),
        static_cast<std::int64_t>(Encoding.Codes.size()), ViewOf(Encoding.Minima),
        ViewOf(Encoding.Maxima))
  {
  }
};

/** One random field, with hidden cells or without; all its meshes must have one topology. */
class Case
{
public:
  explicit Case(std::uint32_t seed)
    : Numbers(seed)
    , Field(Numbers, 12, 400)
    , Region(test::RandomRegion(Numbers, Field))
    , Options(test::RandomOptions(Numbers, Field.Dimensions))
    , Hidden(test::RandomHidden(Numbers, Field.Dimensions))
  {
    this->Options.Hidden = &this->Hidden;
    this->Options.PreserveTopology = true;
  }

  void Check()
  {
    SCOPED_TRACE(test::Describe(this->Field, this->Region));
    const test::Built plain = this->BuildPlain();
    const test::Topology full = this->TopologyOf(*plain.Hierarchy, Query{});
    this->IsLost = !(this->TopologyOf(*plain.Hierarchy, Query{ Infinity }) == full);
    const test::Built minimal = this->Build(Model::Minimal);
    const test::Built relevant = this->Build(Model::Relevant);
    std::vector<Query> queries = { Query{}, Query{ Infinity } };
    for (int i = 0; i < 3; ++i)
    {
      queries.push_back(test::RandomQuery(this->Numbers, *minimal.Hierarchy, this->Options.World));
    }
    for (const Query& query : queries)
    {
      EXPECT_EQ(this->TopologyOf(*minimal.Hierarchy, query), full)
        << "tolerance " << query.Tolerance;
      EXPECT_TRUE(test::AnyMesh(*minimal.Hierarchy, query)
                    .IsSameInAnyOrder(test::AnyMesh(*relevant.Hierarchy, query)));
    }
    this->CheckInterior(full);
    this->CheckScalars();
  }

  /** Whether the topology changes at infinite tolerance if it is not preserved. */
  bool IsLost = false;

private:
  test::Built Build(Model model) const
  {
    return { BuildIsodiamonds(model, this->Field.View(), this->Region, SerialFor, this->Options),
      SerialFor };
  }

  /** By the field metric, without preserving topology: the mesh of tolerance 0 is that of marching
   *  tetrahedra. */
  test::Built BuildPlain() const
  {
    BuildOptions options;
    options.MinimumPieceSize = this->Options.MinimumPieceSize;
    options.Hidden = this->Options.Hidden;
    return { BuildIsodiamonds(
               Model::Relevant, this->Field.View(), this->Region, SerialFor, options),
      SerialFor };
  }

  /** The topology without what lies in hidden cells. */
  test::Topology TopologyOf(const IsodiamondHierarchy& hierarchy, const Query& query) const
  {
    return test::Topology(test::WithoutHidden({ hierarchy, query }, this->Hidden));
  }

  /** Which diamonds are critical does not depend on whether the interior can be refined; the others
   *  may. */
  void CheckInterior(const test::Topology& full)
  {
    if (this->Region.IsVolume())
    {
      this->Options.RefineInterior = !this->Options.RefineInterior;
      EXPECT_EQ(this->TopologyOf(*this->Build(Model::Minimal).Hierarchy, Query{ Infinity }), full);
    }
  }

  /** With an HD, which knows no hidden cells and keeps all pieces, the query asks for topology. */
  void CheckScalars()
  {
    this->Options.Hidden = nullptr;
    this->Options.MinimumPieceSize = 0;
    this->Options.Metric = ErrorMetric::Field;
    this->Options.RefineInterior = true;
    const Scalars scalars(this->Field.View());
    const test::Built minimal(
      BuildIsodiamonds(Model::Minimal, scalars.Hierarchy, this->Region, SerialFor, this->Options),
      SerialFor);
    const test::Topology full(this->Answer(scalars, Query{}));
    for (Query query : { Query{ Infinity },
           test::RandomQuery(this->Numbers, *minimal.Hierarchy, this->Options.World) })
    {
      query.PreserveTopology = true;
      const test::AnyMesh mesh = this->Answer(scalars, query);
      EXPECT_EQ(test::Topology(mesh), full) << "HD, tolerance " << query.Tolerance;
      EXPECT_TRUE(mesh.IsSameInAnyOrder({ *minimal.Hierarchy, query }));
    }
  }

  test::AnyMesh Answer(const Scalars& scalars, const Query& query) const
  {
    const test::Built answer(EncodeQuery(scalars.Hierarchy, this->Region, query,
                               this->Options.ExactIsovertices, SerialFor),
      SerialFor);
    return { *answer.Hierarchy, Query{} };
  }

  test::Random Numbers;
  test::RandomSamples Field;
  Isoregion Region;
  test::OwningOptions Options;
  HiddenCells Hidden;
};

}

// What the counts say of known shapes.
TEST(Topology, IsCountedRight)
{
  test::Field torus;
  torus.Dims = { 17, 17, 9 };
  for (int i = 0; i < 17 * 17 * 9; ++i)
  {
    const double ring = std::hypot(i % 17 - 8.2, i / 17 % 17 - 8.1) - 5.0;
    torus.Samples.push_back(static_cast<float>(std::hypot(ring, i / (17 * 17) - 4.1)));
  }
  const auto topologyOf = [&torus](const Isoregion& region)
  {
    const test::Built built(
      BuildIsodiamonds(Model::Minimal, torus.View(), region, SerialFor), SerialFor);
    return test::Topology(test::AnyMesh(*built.Hierarchy, Query{}));
  };
  using Pieces = test::PiecesTopology;
  const test::Topology surface = topologyOf(2.0);
  EXPECT_EQ(surface.Surfaces[0], (Pieces{ { 0, 0 } }));
  const test::Topology solid = topologyOf({ -Infinity, 2.0 });
  EXPECT_EQ(solid.Interval, (Pieces{ { 0, 1 } }));
  EXPECT_EQ(solid.Surfaces[1], (Pieces{ { 0, 0 } }));
  const test::Topology shell = topologyOf({ 1.0, 2.0 });
  EXPECT_EQ(shell.Interval, (Pieces{ { 0, 2 } }));
  std::vector<std::array<std::int32_t, 3>> disc;
  for (const std::int32_t i : { 1, 2, 3, 4 })
  {
    disc.push_back({ 0, i, i % 4 + 1 });
  }
  EXPECT_EQ(test::TopologyOf(disc), (Pieces{ { 1, 1 } }));
  disc.push_back({ 5, 6, 7 });
  disc.erase(disc.begin());
  EXPECT_EQ(test::TopologyOf(disc), (Pieces{ { 1, 1 }, { 1, 1 } }));
}

TEST(Topology, IsThatOfFullResolutionForRandomFieldsAndQueries)
{
  int lost = 0;
  const int cases = test::ForRandomSeeds(
    [&lost](std::uint32_t seed)
    {
      Case one(seed);
      one.Check();
      lost += one.IsLost ? 1 : 0;
    });
  // Otherwise the test could not fail.
  EXPECT_GE(lost, cases < 100 ? 0 : cases / 5);
}

namespace
{

/** A random landscape: a single sheet with hills and valleys that a coarse mesh leaves out. */
test::Field RandomLandscape(test::Random& random)
{
  const double level = test::Uniform(random, 2.0, 6.0);
  const double height = test::Uniform(random, 1.0, 4.0);
  const double phase = test::Uniform(random, 0.0, 6.0);
  const std::array<double, 2> frequency = { test::Uniform(random, 0.3, 1.5),
    test::Uniform(random, 0.3, 1.5) };
  test::Field field;
  field.Dims = { 9, 9, 9 };
  for (int z = 0; z < 9; ++z)
  {
    for (int y = 0; y < 9; ++y)
    {
      for (int x = 0; x < 9; ++x)
      {
        const double hill = std::sin(frequency[0] * x + phase) * std::sin(frequency[1] * y);
        field.Samples.push_back(static_cast<float>(z - level - height * hill));
      }
    }
  }
  return field;
}

/** Checks that a landscape without what a hidden cell holds has one topology. @param hits is raised
 *  if the cell holds some of it */
void CheckHiddenCell(unsigned seed, int& hits)
{
  test::Random random(seed);
  const test::Field field = RandomLandscape(random);
  std::vector<std::uint8_t> hidden(8 * 8 * 8, 0);
  hidden[random() % hidden.size()] = 1;
  const HiddenCells cell(std::move(hidden), { 8, 8, 8 });
  BuildOptions options;
  options.PreserveTopology = true;
  options.Hidden = &cell;
  const test::Built built = test::Build(Model::Minimal, field, options);
  const test::AnyMesh full(*built.Hierarchy, Query{});
  const test::AnyMesh left = test::WithoutHidden(full, cell);
  const test::AnyMesh coarse(*built.Hierarchy, Query{ Infinity });
  EXPECT_EQ(test::Topology(test::WithoutHidden(coarse, cell)), test::Topology(left))
    << "seed " << seed;
  hits += left.CellCount() < full.CellCount() ? 1 : 0;
}

}

// A hidden cell may cut off the top of a hill that a coarse mesh leaves out.
TEST(Topology, IsKeptAroundHiddenCells)
{
  int hits = 0;
  for (unsigned seed = 0; seed < 400 && !HasFailure(); ++seed)
  {
    CheckHiddenCell(seed, hits);
  }
  EXPECT_GT(hits, 30);
}
