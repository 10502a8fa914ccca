// SPDX-License-Identifier: BSD-3-Clause
#include "Build/StagedBuild.h"

#include "Tools/CoreTestTools.h"
#include "Tools/RandomTestTools.h"
#include "Tools/ThreadPeers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace isodiamond;

namespace
{

/** The slices of a slab, and nothing else, in memory of their own. */
AnyValues CopySlices(const AnySamples& samples, const StreamedBuild::Slices& slices)
{
  return std::visit(
    [&](const auto& view) -> AnyValues
    {
      using T = typename std::decay_t<decltype(view)>::Value;
      const T* const begin = view.Pointer() + view.Index({ 0, 0, slices.First });
      const T* const end = view.Pointer() + view.Index({ 0, 0, slices.Last + 1 });
      return std::vector<T>(begin, end);
    },
    samples);
}

/** Calls body with a slab of a volume, as a reader would give it. */
template <typename Body>
void WithSlab(const AnySamples& samples, const StreamedBuild::Slices& slices, const Body& body)
{
  const AnyValues values = CopySlices(samples, slices);
  std::visit(
    [&](const auto& array)
    {
      using T = typename std::decay_t<decltype(array)>::value_type;
      const auto [x, y, z] = std::get<SampleView<T>>(samples).Dimensions();
      body(SampleSlab{
        SampleView<T>(array.data(), { x, y, slices.Last + 1 - slices.First }), slices.First });
    },
    values);
}

/** @param options with peers, if there are any */
StagedBuild BuildInSlabs(const AnySamples& samples, const Isoregion& region, int slabs,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  const auto dimensions = std::visit([](const auto& view) { return view.Dimensions(); }, samples);
  StreamedBuild build(dimensions, region, parallelFor, options);
  const std::vector<StreamedBuild::Slices> cut = StreamedBuild::Cut(dimensions, slabs);
  const Peers* peers = options.Together;
  const auto isOwn = [&](std::size_t slab)
  {
    return peers == nullptr ||
      static_cast<int>(slab * peers->Count() / cut.size()) == peers->Rank();
  };
  for (std::size_t i = 0; i < cut.size(); ++i)
  {
    if (isOwn(i))
    {
      WithSlab(samples, cut[i], [&](const SampleSlab& slab) { build.AddSigns(slab, cut[i]); });
    }
  }
  build.Classify();
  for (std::size_t i = 0; i < cut.size(); ++i)
  {
    if (isOwn(i))
    {
      WithSlab(samples, cut[i], [&](const SampleSlab& slab) { build.AddValues(slab, cut[i]); });
    }
    else
    {
      build.SkipValues(cut[i]);
    }
  }
  return build.Finish();
}

/** An encoding and its mesh of full resolution. */
struct Whole
{
  Encoding TheEncoding;
  test::AnyMesh Mesh;

  Whole(
    Model model, const AnySamples& samples, const Isoregion& region, const BuildOptions& options)
    : TheEncoding(BuildIsodiamonds(model, samples, region, SerialFor, options))
    , Mesh(IsodiamondHierarchy(this->TheEncoding, SerialFor), Query{})
  {
  }
};

/** Volumes larger than memory come in slabs: the result is that of the whole, to the bit. */
void Compare(
  const AnySamples& samples, int slabs, const BuildOptions& options, const Whole& expected)
{
  const ParallelFor threads = test::ThreadedFor(2);
  const EncodingHeader& header = expected.TheEncoding.Header;
  StagedBuild staged = BuildInSlabs(samples, header.Region, slabs, threads, options);
  if (!header.Region.IsVolume() || !options.RefineInterior) // otherwise refined inside, too
  {
    EXPECT_TRUE(test::AnyMesh(staged.OneMesh(), Query{}).IsSameInAnyOrder(expected.Mesh));
  }
  // Any samples will do: they are not looked at.
  test::ExpectSame(
    staged.Finish(header.TheModel, SampleView<float>(), threads, options), expected.TheEncoding);
}

/** The same for each of some peers, each of which has at least one slab. */
void ComparePeers(const AnySamples& samples, int peers, int slabs, const BuildOptions& options,
  const Encoding& expected)
{
  const EncodingHeader& header = expected.Header;
  test::ForEachPeer(
    peers,
    [&](Peers& own)
    {
      BuildOptions together = options;
      together.Together = &own;
      return BuildInSlabs(samples, header.Region, slabs, SerialFor, together)
        .Finish(header.TheModel, SampleView<float>(), SerialFor, together);
    },
    [&](const Encoding& found) { test::ExpectSame(found, expected); });
}

/** What a hierarchy is built from, in slabs or at once, and what is expected of it. */
struct RandomCase
{
  test::RandomSamples Samples;
  Isoregion Region;
  test::OwningOptions Options;
  Whole Expected;

  RandomCase(test::Random& random, int longest, int most)
    : Samples(random, longest, most)
    , Region(test::RandomRegion(random, this->Samples))
    , Options(test::RandomOptions(random, this->Samples.Dimensions))
    , Expected(test::Pick(random, 2) == 0 ? Model::Relevant : Model::Minimal, this->Samples.View(),
        this->Region, this->Options)
  {
  }
};

}

TEST(Slabs, MakeTheHierarchyOfTheWholeVolume)
{
  const int cases = test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      const RandomCase whole(random, 24, 6000);
      Compare(whole.Samples.View(), 1 + test::Pick(random, 27), whole.Options, whole.Expected);
    });
  EXPECT_GT(cases, 0);
}

TEST(Slabs, OfPeersMakeTheSameForEachOfThem)
{
  const int cases = test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      RandomCase whole(random, 40, 4000);
      whole.Options.InPortions = test::Pick(random, 4) != 0;
      const int peers = 1 + test::Pick(random, std::min(4, whole.Samples.Dimensions[2]));
      const int slabs = peers + test::Pick(random, 5);
      ComparePeers(whole.Samples.View(), peers, slabs, whole.Options, whole.Expected.TheEncoding);
    });
  EXPECT_GT(cases, 0);
}

// Most of a tall volume is elsewhere: isovertices, errors and triangles that a portion needs come
// from its neighbours and, for large diamonds, from beyond these.
TEST(Slabs, OfPeersMakeTheSameInPortionsOfATallVolume)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const test::Field& field : { test::WaveField({ 17, 20, 131 }),
         test::NoiseField({ 9, 12, 129 }, 3), test::SphereField({ 40, 33, 100 }),
         test::SparseField({ 33, 17, 120 }, 4), test::SpikeField({ 12, 40, 97 }, nan) })
  {
    SCOPED_TRACE(field.Name);
    for (const Isoregion& region :
      { Isoregion(field.Isovalue), Isoregion(field.Isovalue - 1.0, field.Isovalue + 0.5) })
    {
      BuildOptions options = test::Distance();
      options.InPortions = true;
      options.RefineInterior = region.IsVolume();
      options.PreserveFeatures = !region.IsVolume();
      const Encoding expected =
        BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options);
      for (const int peers : { 2, 5 })
      {
        ComparePeers(field.View(), peers, peers + 1, options, expected);
      }
    }
  }
}

// Many large diamonds need triangles of both portions.
TEST(Slabs, OfPeersMakeTheSameInPortionsOfAWideVolume)
{
  for (const test::Field& field :
    { test::SphereField({ 65, 65, 65 }), test::WaveField({ 65, 65, 65 }) })
  {
    SCOPED_TRACE(field.Name);
    BuildOptions options = test::Distance();
    options.InPortions = true;
    ComparePeers(field.View(), 2, 2, options,
      BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, SerialFor, options));
  }
}

// A portion without an isovertex of its own has diamonds that hold some of its neighbour's.
TEST(Slabs, OfPeersMakeTheSameOfASpeckWhereTheyAreCut)
{
  test::Field field{ "speck", { 17, 17, 40 }, std::vector<float>(17 * 17 * 40, 0.0F), 0.5 };
  const auto at = [&](int x, int y, int z) -> float& {
    return field.Samples[SampleIndex(field.Dims, { x, y, z })];
  };
  for (const int length : { 1, 2 })
  {
    for (int y = 9; y < 9 + length; ++y)
    {
      at(9, y, 16) = 1.0F;
    }
    for (const bool preserve : { true, false })
    {
      BuildOptions options = test::Distance();
      options.InPortions = true;
      options.PreserveFeatures = preserve;
      ComparePeers(field.View(), 2, 2, options,
        BuildIsodiamonds(Model::Relevant, field.View(), field.Isovalue, SerialFor, options));
    }
  }
}

// In whichever loop one of them is stopped after the slabs are read, as by a user who aborts.
TEST(Slabs, OfPeersStopForAllOfThemInAnyLoop)
{
  const test::Field field = test::WaveField({ 9, 10, 33 });
  int stopped = 0;
  bool isDone = false;
  for (int last = 1; !isDone; ++last)
  {
    std::atomic<int> failed(0);
    std::atomic<int> finished(0);
    test::ThreadPeers(3).Run(
      [&](Peers& own)
      {
        BuildOptions together = test::Distance();
        together.Together = &own;
        together.InPortions = true;
        int loops = 0;
        const ParallelFor stopping = [&](std::int64_t count, std::int64_t grain,
                                       const std::function<void(std::int64_t, std::int64_t)>& body)
        {
          if (own.Rank() == 1 && ++loops == last)
          {
            throw std::runtime_error("stopped");
          }
          SerialFor(count, grain, body);
        };
        try
        {
          BuildInSlabs(field.View(), field.Isovalue, 3, SerialFor, together)
            .Finish(Model::Minimal, SampleView<float>(), stopping, together);
          ++finished;
        }
        catch (const std::runtime_error& problem)
        {
          failed += (std::string(problem.what()) == "stopped") == (own.Rank() == 1) ? 1 : 0;
        }
      });
    isDone = finished == 3;
    stopped += isDone ? 0 : 1;
    ASSERT_TRUE(isDone || failed == 3) << last;
  }
  EXPECT_GT(stopped, 30);
}

TEST(Slabs, OfPeersRefineToTheSameMesh)
{
  const int cases = test::ForRandomSeeds(
    [](std::uint32_t seed)
    {
      SCOPED_TRACE(seed);
      test::Random random(seed);
      RandomCase whole(random, 40, 2000);
      whole.Options.Metric = ErrorMetric::Distance;
      whole.Options.RefineInterior = false;
      const double tolerance = test::Uniform(random, 0.0, 3.0);
      const auto meshOf = [&](StagedBuild staged, const BuildOptions& options)
      {
        staged.RefineTo(
          [&](const Place&) { return tolerance; }, whole.Samples.View(), SerialFor, options);
        return test::AnyMesh(staged.OneMesh(), Query{ tolerance });
      };
      const test::AnyMesh expected =
        meshOf({ whole.Samples.View(), whole.Region, SerialFor, whole.Options }, whole.Options);
      const int peers = 1 + test::Pick(random, std::min(4, whole.Samples.Dimensions[2]));
      test::ForEachPeer(
        peers,
        [&](Peers& own)
        {
          BuildOptions together = whole.Options;
          together.Together = &own;
          return meshOf(
            BuildInSlabs(whole.Samples.View(), whole.Region, peers + 2, SerialFor, together),
            together);
        },
        [&](const test::AnyMesh& found) { EXPECT_TRUE(found == expected); });
    });
  EXPECT_GT(cases, 0);
}

// If only one failed, the others would wait forever.
TEST(Slabs, OfPeersFailForAllOfThem)
{
  const test::Field field = test::WaveField({ 9, 10, 33 });
  for (const std::string phase :
    { "Classifying diamonds", "Measuring errors", "Finding thresholds", "of one tolerance" })
  {
    const bool isOne = phase == "of one tolerance";
    for (const bool inPortions : { false, true })
    {
      if (isOne && inPortions)
      {
        continue; // there is no mesh before the end
      }
      std::atomic<int> failed(0);
      test::ThreadPeers(3).Run(
        [&](Peers& own)
        {
          BuildOptions together = test::Distance();
          together.Together = &own;
          together.InPortions = inPortions;
          together.Report = [&](const char* current, double, double)
          {
            if (own.Rank() == 1 && current == (isOne ? "Measuring errors" : phase))
            {
              throw std::runtime_error("stopped");
            }
          };
          try
          {
            StagedBuild staged = BuildInSlabs(field.View(), field.Isovalue, 5, SerialFor, together);
            if (isOne)
            {
              staged.RefineTo(
                [](const Place&) { return 0.5; }, SampleView<float>(), SerialFor, together);
            }
            staged.Finish(Model::Minimal, SampleView<float>(), SerialFor, together);
          }
          catch (const std::runtime_error& problem)
          {
            failed += (std::string(problem.what()) == "stopped") == (own.Rank() == 1) ? 1 : 0;
          }
        });
      EXPECT_EQ(failed, 3) << phase << (inPortions ? " in portions" : "");
    }
  }
}

TEST(Slabs, PlaceIsoverticesOfEdgesThatAreLongerThanASlab)
{
  // Edges of 64 steps, in slabs of 2 slices; surfaces that cross a long edge often, or seldom.
  for (const test::Field& field :
    { test::WaveField({ 7, 9, 66 }), test::NoiseField({ 4, 5, 66 }, 3),
      test::SparseField({ 9, 7, 67 }, 4), test::BrokenField({ 5, 4, 67 }, 5) })
  {
    SCOPED_TRACE(field.Name);
    for (const bool exact : { true, false })
    {
      BuildOptions options = test::Distance();
      options.ExactIsovertices = exact;
      for (const Isoregion& region :
        { Isoregion(field.Isovalue), Isoregion(field.Isovalue - 1.0, field.Isovalue + 0.5) })
      {
        const Whole expected(Model::Minimal, field.View(), region, options);
        for (const int slabs : { 2, 33 })
        {
          Compare(field.View(), slabs, options, expected);
        }
      }
    }
  }
}

TEST(Slabs, MeasureErrorsOfDomainsThatLeadThroughMany)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const test::Field& field :
    { test::NoiseField({ 20, 33, 70 }, 3), test::WaveField({ 40, 21, 66 }),
      test::SphereField({ 66, 49, 65 }), test::SpikeField({ 33, 40, 65 }, nan) })
  {
    SCOPED_TRACE(field.Name);
    for (const Isoregion& region :
      { Isoregion(field.Isovalue), Isoregion(field.Isovalue - 1.0, field.Isovalue + 0.5) })
    {
      BuildOptions options;
      options.RefineInterior = true;
      const Whole expected(Model::Relevant, field.View(), region, options);
      for (const int slabs : { 2, 5, 33 })
      {
        Compare(field.View(), slabs, options, expected);
      }
      ComparePeers(field.View(), 3, 4, options, expected.TheEncoding);
    }
  }
}

TEST(Slabs, AreCutSoThatEachSliceIsInOne)
{
  for (const int slices : { 2, 3, 20, 71 })
  {
    for (const int slabs : { 0, 1, 2, 3, 7, 100 })
    {
      int next = 0;
      for (const StreamedBuild::Slices& cut : StreamedBuild::Cut({ 5, 6, slices }, slabs))
      {
        EXPECT_EQ(cut.Begin, next);
        EXPECT_LT(cut.Begin, cut.End);
        EXPECT_EQ(cut.First, std::max(cut.Begin - 8, 0));
        EXPECT_EQ(cut.Last, std::min(cut.End + 7, slices - 1));
        next = cut.End;
      }
      EXPECT_EQ(next, slices);
    }
  }
}

TEST(Slabs, RefuseWhatTheyCannotDo)
{
  const auto build = [](const Isoregion& region, const BuildOptions& options) {
    return StreamedBuild({ 9, 9, 9 }, region, SerialFor, options);
  };
  EXPECT_NO_THROW(build(1.0, BuildOptions()));
  const HiddenCells hidden(std::vector<std::uint8_t>(512, 1), { 8, 8, 8 });
  BuildOptions blanked = test::Distance();
  blanked.Hidden = &hidden;
  EXPECT_THROW(build(1.0, blanked), std::invalid_argument);
  BuildOptions pieces = test::Distance();
  pieces.MinimumPieceSize = -1;
  EXPECT_THROW(build(1.0, pieces), std::invalid_argument);
}
