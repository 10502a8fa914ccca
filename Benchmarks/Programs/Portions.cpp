// SPDX-License-Identifier: BSD-3-Clause
// Measures what it costs if many processes build a hierarchy together, each a portion of it: how
// many diamonds the largest portion has, and how much each process exchanges. The processes are
// threads here, so a run takes the time of all of them together.
//
// Usage: IsodiamondPortions [samples on an axis, or XxYxZ] [period of the gyroid, or 0 for an
// ellipsoid] [portions ...]
#include "Build/Classification.h"
#include "Build/StagedBuild.h"
#include "Field/PeerPortion.h"
#include "Tools/ThreadPeers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace isodiamond;

namespace
{

/** @param text the number of samples on all axes, or those on each, as XxYxZ */
std::array<int, 3> DimensionsOf(const char* text)
{
  std::array<int, 3> dimensions{};
  const int count = std::sscanf(text, "%dx%dx%d", &dimensions[0], &dimensions[1], &dimensions[2]);
  return count == 3 ? dimensions : std::array{ dimensions[0], dimensions[0], dimensions[0] };
}

/** A dense surface, the gyroid, if there is a period; else an ellipsoid. */
std::vector<float> MakeVolume(const std::array<int, 3>& dimensions, double period)
{
  const double angle = period > 0.0 ? 2.0 * std::acos(-1.0) / period : 0.0;
  const auto gyroid = [&](int x, int y, int z)
  {
    return std::sin(angle * x) * std::cos(angle * y) + std::sin(angle * y) * std::cos(angle * z) +
      std::sin(angle * z) * std::cos(angle * x) + 0.6;
  };
  const auto squared = [&](int i, int axis)
  { return std::pow(2.0 * i / (dimensions[axis] - 1) - 1.0, 2); };
  std::vector<float> values;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x)
      {
        values.push_back(static_cast<float>(period > 0.0
            ? gyroid(x, y, z)
            : std::sqrt(squared(x, 0) + squared(y, 1) + squared(z, 2))));
      }
    }
  }
  return values;
}

/** The diamonds of the largest portion, as a fraction of all. */
double LargestPortion(const AnySamples& samples, const Isoregion& region, int portions)
{
  const Grid grid(std::visit([](const auto& view) { return view.Dimensions(); }, samples));
  const DiamondMask all =
    Classify(grid, SignLattice(grid, samples, region, SerialFor), SerialFor).Members;
  std::int64_t largest = 0;
  test::ForEachPeer(
    portions, [&](Peers& own) { return PeerPortion(grid, all, own).TakeMembers().Size(); },
    [&](std::int64_t size) { largest = std::max(largest, size); });
  return static_cast<double>(largest) / static_cast<double>(all.Size());
}

void Build(const std::vector<float>& values, const std::array<int, 3>& dimensions,
  const Isoregion& region, const BuildOptions& options)
{
  const Peers& peers = *options.Together;
  const std::vector<StreamedBuild::Slices> cut = StreamedBuild::Cut(dimensions, peers.Count());
  const StreamedBuild::Slices& own = cut[peers.Rank()];
  const std::int64_t slice = std::int64_t{ dimensions[0] } * dimensions[1];
  const SampleSlab slab{ SampleView<float>(values.data() + own.First * slice,
                           { dimensions[0], dimensions[1], own.Last + 1 - own.First }),
    own.First };
  StreamedBuild build(dimensions, region, SerialFor, options);
  build.AddSigns(slab, own);
  build.Classify();
  for (const StreamedBuild::Slices& slices : cut)
  {
    if (slices.Begin == own.Begin)
    {
      build.AddValues(slab, own);
    }
    else
    {
      build.SkipValues(slices);
    }
  }
  build.Finish().Finish(Model::Minimal, SampleView<float>(), SerialFor, options);
}

}

int main(int argc, char** argv)
{
  const std::array<int, 3> dimensions = DimensionsOf(argc > 1 ? argv[1] : "128");
  const double period = argc > 2 ? std::atof(argv[2]) : 24.0;
  std::vector<int> counts;
  std::transform(argv + std::min(argc, 3), argv + argc, std::back_inserter(counts),
    [](const char* text) { return std::atoi(text); });
  if (counts.empty())
  {
    counts = { 1, 2, 4, 8, 16 };
  }
  const std::vector<float> values = MakeVolume(dimensions, period);
  const Isoregion region(0.6);
  const AnySamples all = SampleView<float>(values.data(), dimensions);
  std::printf("portions | diamonds of the largest, of all | MiB that each exchanges | meetings\n");
  for (const int count : counts)
  {
    test::ThreadPeers peers(count);
    peers.Run(
      [&](Peers& own)
      {
        BuildOptions options;
        options.Metric = ErrorMetric::Distance;
        options.Together = &own;
        options.InPortions = true;
        Build(values, dimensions, region, options);
      });
    const test::ThreadPeers::Traffic& traffic = peers.TrafficOf(0);
    std::printf("%5d | %.3f | %.1f | %lld\n", count, LargestPortion(all, region, count),
      static_cast<double>(traffic.Bytes) / (1 << 20), static_cast<long long>(traffic.Meetings));
    std::fflush(stdout);
  }
  return EXIT_SUCCESS;
}
