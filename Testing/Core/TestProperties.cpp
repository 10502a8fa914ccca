// SPDX-License-Identifier: BSD-3-Clause
// What must hold for any samples, regions and queries, tested on random ones. The seed is printed:
// with ISODIAMONDS_SEED the same cases come again; ISODIAMONDS_CASES says how many there are.
#include "Refinement/ScalarQuery.h"
#include "Tools/DistanceTestTools.h"
#include "Tools/TopologyTestTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

using namespace isodiamond;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** One random field, and all that must hold for it, with some queries. */
class Case
{
public:
  explicit Case(std::uint32_t seed)
    : Numbers(seed)
    , Field(Numbers, 40, 6000)
    , Region(test::RandomRegion(Numbers, Field))
    , Options(test::RandomOptions(Numbers, Field.Dimensions))
    , Minimal(BuildIsodiamonds(Model::Minimal, Field.View(), Region, SerialFor, Options), SerialFor)
    , Relevant(
        BuildIsodiamonds(Model::Relevant, Field.View(), Region, SerialFor, Options), SerialFor)
  {
  }

  void Check()
  {
    SCOPED_TRACE(test::Describe(this->Field, this->Region));
    const test::Built threaded(BuildIsodiamonds(Model::Minimal, this->Field.View(), this->Region,
                                 this->Threads, this->Options),
      this->Threads);
    EXPECT_EQ(threaded.Encoding.Arrays.Records, this->Minimal.Encoding.Arrays.Records);
    EXPECT_EQ(threaded.Encoding.Arrays.Isovertices, this->Minimal.Encoding.Arrays.Isovertices);
    EXPECT_EQ(threaded.Encoding.Arrays.InteriorCodes, this->Minimal.Encoding.Arrays.InteriorCodes);
    EXPECT_EQ(threaded.Encoding.Arrays.Followers, this->Minimal.Encoding.Arrays.Followers);
    this->CheckQuery(Query{});
    for (int i = 0; i < 3; ++i)
    {
      this->CheckQuery(
        test::RandomQuery(this->Numbers, *this->Minimal.Hierarchy, this->Options.World));
    }
    this->CheckScalars();
    this->CheckHalves();
  }

private:
  /** The mesh conforms, and is the same from two models and with threads; if topology is preserved,
   *  all meshes have the same. */
  void CheckQuery(const Query& query)
  {
    const test::AnyMesh mesh(*this->Minimal.Hierarchy, query);
    EXPECT_EQ(mesh.Fault(this->Field.Dimensions), "") << "tolerance " << query.Tolerance;
    EXPECT_TRUE(mesh == test::AnyMesh(*this->Minimal.Hierarchy, query, this->Threads));
    EXPECT_TRUE(mesh.IsSameInAnyOrder(test::AnyMesh(*this->Relevant.Hierarchy, query)));
    if (this->Options.PreserveTopology)
    {
      const test::Topology topology(mesh);
      EXPECT_EQ(topology, this->First.value_or(topology)) << "tolerance " << query.Tolerance;
      this->First = topology;
    }
    if (this->Options.Metric == ErrorMetric::Distance && this->Options.World.Positions() == nullptr)
    {
      EXPECT_EQ(test::CountOverturned(mesh.Interval, this->Options.World), 0)
        << "of " << mesh.Interval.Tetrahedra.size() << ", tolerance " << query.Tolerance;
    }
    if (this->Options.Metric == ErrorMetric::Distance && !query.View)
    {
      this->CheckDistances(query, mesh);
    }
  }

  /** No point of the mesh is farther from full resolution than the tolerance and, unless features
   *  may vanish, no vertex of full resolution from the mesh. Looks at some, or at all if few. */
  void CheckDistances(const Query& query, const test::AnyMesh& mesh) const
  {
    const test::AnyMesh full(*this->Minimal.Hierarchy, Query{});
    test::Promise promise;
    promise.Forth = this->Options.PreserveFeatures;
    promise.MostSamples = 5000;
    promise.Tolerance =
      query.Region ? std::max(query.Tolerance, query.OutsideTolerance) : query.Tolerance;
    for (const int surface : { -1, 1 })
    {
      EXPECT_EQ(
        FaultOf(promise, this->TrianglesOf(full, surface), this->TrianglesOf(mesh, surface)), "")
        << "surface " << surface;
    }
  }

  /** The triangles of a surface, in the world. */
  test::SurfaceTriangles TrianglesOf(const test::AnyMesh& mesh, int surface) const
  {
    return this->Region.IsVolume() ? test::Placed(mesh.Interval, surface, this->Options.World)
                                   : test::Placed(mesh.Surface, this->Options.World);
  }

  /** The HD gives the same, with field errors. */
  void CheckScalars()
  {
    const ScalarEncoding encoding = BuildScalarHierarchy(this->Field.View(), SerialFor);
    const ScalarHierarchy scalars(this->Field.View(), encoding.ErrorScale, encoding.Codes.data(),
      static_cast<std::int64_t>(encoding.Codes.size()), ViewOf(encoding.Minima),
      ViewOf(encoding.Maxima));
    this->Options.Metric = ErrorMetric::Field;
    this->Options.RefineInterior = true;
    this->Options.MinimumPieceSize = 0; // an HD keeps all pieces
    const test::Built minimal(
      BuildIsodiamonds(Model::Minimal, scalars, this->Region, SerialFor, this->Options), SerialFor);
    Query query = test::RandomQuery(this->Numbers, *minimal.Hierarchy, this->Options.World);
    query.PreserveTopology = this->Options.PreserveTopology;
    const test::Built answer(
      EncodeQuery(scalars, this->Region, query, this->Options.ExactIsovertices, SerialFor),
      SerialFor);
    const test::AnyMesh mesh(*answer.Hierarchy, Query{});
    EXPECT_EQ(mesh.Fault(this->Field.Dimensions), "") << "HD, tolerance " << query.Tolerance;
    EXPECT_TRUE(mesh.IsSameInAnyOrder(test::AnyMesh(*minimal.Hierarchy, query)));
  }

  /** What lies below a value and what lies above it fill the grid, except where four linear
   *  isovertices form a quadrilateral: steps of 1/256 leave these not quite in a plane, and the two
   *  sides may cut it along different diagonals. */
  void CheckHalves()
  {
    this->Options.ExactIsovertices = false;
    const double value = test::RandomValue(this->Numbers, this->Field);
    for (std::size_t i = 0; i < this->Field.Size(); ++i)
    {
      const double sample = this->Field.At(i);
      if (std::isnan(sample) || sample == value || std::isinf(value))
      {
        return; // there are samples in neither half, or in both
      }
    }
    double sum = 0.0;
    for (const Isoregion& half : { Isoregion(-Infinity, value), Isoregion(value, Infinity) })
    {
      const test::Built built(
        BuildIsodiamonds(Model::Minimal, this->Field.View(), half, SerialFor, this->Options),
        SerialFor);
      sum += test::TotalVolume(test::ExtractVolume(*built.Hierarchy, 0.0));
    }
    const std::array<int, 3>& d = this->Field.Dimensions;
    const double whole = (d[0] - 1.0) * (d[1] - 1.0) * (d[2] - 1.0);
    EXPECT_NEAR(sum, whole, 2.0 / 256.0 * whole);
  }

  test::Random Numbers;
  ParallelFor Threads = test::ThreadedFor(3);
  test::RandomSamples Field;
  Isoregion Region;
  test::OwningOptions Options;
  test::Built Minimal;
  test::Built Relevant;
  std::optional<test::Topology> First; ///< of the first query
};

}

TEST(Properties, HoldForRandomFieldsAndQueries)
{
  test::ForRandomSeeds([](std::uint32_t seed) { Case(seed).Check(); });
}
