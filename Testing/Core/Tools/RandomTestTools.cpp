// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/RandomTestTools.h"

#include "Tools/DistanceTestTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <sstream>

namespace test
{

using namespace isodiamond;

double Uniform(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}
int Pick(Random& random, int count)
{
  return static_cast<int>(random() % static_cast<std::uint32_t>(count));
}

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

std::array<int, 3> RandomDimensions(Random& random, int longest, int most)
{
  std::array<int, 3> dimensions{};
  do
  {
    for (int& size : dimensions)
    {
      size = 2 + Pick(random, longest - 1);
    }
  } while (dimensions[0] * dimensions[1] * dimensions[2] > most);
  return dimensions;
}

/** The values of one pattern; what a type cannot hold is cut off later. */
std::vector<double> RandomPattern(Random& random, const std::array<int, 3>& dimensions)
{
  const int kind = Pick(random, 6);
  const double frequency = Uniform(random, 0.1, 1.5);
  const std::array<double, 3> phase = { Uniform(random, 0.0, 6.0), Uniform(random, 0.0, 6.0),
    Uniform(random, 0.0, 6.0) };
  std::vector<double> values;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x)
      {
        const double wave = std::sin(frequency * x + phase[0]) +
          std::sin(frequency * y + phase[1]) + std::sin(frequency * z + phase[2]);
        const std::array<double, 6> all = {
          10.0 * wave,                                          // smooth
          std::floor(3.0 * wave),                               // plateaus
          static_cast<double>(Pick(random, 7)),                 // noise, many equal
          Uniform(random, -100.0, 100.0),                       // noise
          Pick(random, 40) == 0 ? 50.0 : 0.0,                   // single samples
          wave * std::pow(10.0, Uniform(random, -300.0, 300.0)) // of all magnitudes
        };
        values.push_back(all[kind]);
      }
    }
  }
  return values;
}

/** Puts some special values among the samples. */
void AddSpecials(Random& random, std::vector<double>& values)
{
  const std::array<double, 8> specials = { std::nan(""), Infinity, -Infinity, 5e-324, -1e-310,
    1.7e308, -1.7e308, -0.0 };
  const int share = 1 + Pick(random, 30); // of 100
  for (double& value : values)
  {
    value = Pick(random, 100) < share ? specials[Pick(random, 8)] : value;
  }
}

template <typename T>
T Cut(double value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return static_cast<T>(value);
  }
  else
  {
    const double low = static_cast<double>(std::numeric_limits<T>::lowest());
    const double high = static_cast<double>(std::numeric_limits<T>::max());
    return std::isnan(value) ? T{ 0 }
      : value <= low         ? std::numeric_limits<T>::lowest()
      : value >= high        ? std::numeric_limits<T>::max()
                             : static_cast<T>(value);
  }
}

template <typename T>
AnyValues CutAll(const std::vector<double>& pattern)
{
  std::vector<T> cut;
  for (const double value : pattern)
  {
    cut.push_back(Cut<T>(value));
  }
  return cut;
}

World RandomWorld(Random& random, const std::array<int, 3>& dimensions)
{
  const int kind = Pick(random, 9);
  if (kind < 2)
  {
    return kind == 0 ? Bent(dimensions) : Wound(dimensions);
  }
  if (kind < 5)
  {
    AxisCoordinates axes;
    for (int axis = 0; axis < 3; ++axis)
    {
      double at = Uniform(random, -10.0, 10.0);
      for (int i = 0; i < dimensions[axis]; ++i)
      {
        axes[axis].push_back(at);
        at += Uniform(random, 0.01, 3.0);
      }
    }
    return GridGeometry(axes);
  }
  AffineMap map;
  for (int axis = 0; axis < 3; ++axis)
  {
    map.Rows[axis][axis] = Uniform(random, 0.1, 4.0);
  }
  return GridGeometry(map);
}

double RandomTolerance(Random& random, double scale)
{
  switch (Pick(random, 5))
  {
    case 0:
      return 0.0;
    case 1:
      return Infinity;
    default:
      return scale * std::pow(2.0, -Uniform(random, 0.0, 12.0));
  }
}

RegionOfInterest RandomBox(Random& random, const Grid& grid)
{
  Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = Uniform(random, -2.0, grid.Last(axis) + 2.0);
    const double b = Uniform(random, -2.0, grid.Last(axis) + 2.0);
    box.Minimum[axis] = std::min(a, b);
    box.Maximum[axis] = std::max(a, b);
  }
  return { box, grid, AffineMap() };
}

/** In the grid, or not far from it. */
Viewpoint RandomViewpoint(Random& random, const Grid& grid, const GridGeometry& world)
{
  Vector index{};
  for (int axis = 0; axis < 3; ++axis)
  {
    index[axis] = Uniform(random, -10.0, grid.Last(axis) + 10.0);
  }
  return { world(index), std::pow(2.0, -Uniform(random, -1.0, 8.0)), world };
}

std::uint32_t NumberFrom(const char* variable, std::uint32_t otherwise)
{
  const char* text = std::getenv(variable);
  return text != nullptr ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

}

RandomSamples::RandomSamples(Random& random, int longest, int most)
  : Dimensions(RandomDimensions(random, longest, most))
{
  std::vector<double> pattern = RandomPattern(random, this->Dimensions);
  if (Pick(random, 3) == 0)
  {
    AddSpecials(random, pattern);
  }
  const std::array<AnyValues (*)(const std::vector<double>&), 10> cuts = { &CutAll<float>,
    &CutAll<double>, &CutAll<std::int8_t>, &CutAll<std::uint8_t>, &CutAll<std::int16_t>,
    &CutAll<std::uint16_t>, &CutAll<std::int32_t>, &CutAll<std::uint32_t>, &CutAll<std::int64_t>,
    &CutAll<std::uint64_t> };
  this->Values = cuts[Pick(random, 10)](pattern);
}

AnySamples RandomSamples::View() const
{
  return std::visit([&](const auto& values) -> AnySamples
    { return SampleView(values.data(), this->Dimensions); },
    this->Values);
}

double RandomSamples::At(std::size_t index) const
{
  return std::visit(
    [&](const auto& values) { return static_cast<double>(values[index]); }, this->Values);
}

std::size_t RandomSamples::Size() const
{
  return std::visit([](const auto& values) { return values.size(); }, this->Values);
}

double RandomValue(Random& random, const RandomSamples& samples)
{
  const double value = samples.At(random() % samples.Size());
  const double other = samples.At(random() % samples.Size());
  const double chosen = Pick(random, 2) == 0 ? value : 0.5 * value + 0.5 * other;
  return std::isnan(chosen) ? 0.0 : chosen;
}

Isoregion RandomRegion(Random& random, const RandomSamples& samples)
{
  if (Pick(random, 2) == 0)
  {
    return RandomValue(random, samples);
  }
  const double a = Pick(random, 6) == 0 ? -Infinity : RandomValue(random, samples);
  const double b = Pick(random, 6) == 0 ? Infinity : RandomValue(random, samples);
  if (a == b)
  {
    return { -Infinity, Infinity };
  }
  return { std::min(a, b), std::max(a, b) };
}

OwningOptions RandomOptions(Random& random, const std::array<int, 3>& dimensions)
{
  OwningOptions options;
  const World world = RandomWorld(random, dimensions);
  options.World = world;
  options.Positions = world.Positions;
  options.Metric = Pick(random, 2) == 0 ? ErrorMetric::Field : ErrorMetric::Distance;
  options.ExactIsovertices = Pick(random, 2) == 0;
  options.PreserveFeatures = Pick(random, 2) == 0;
  options.RefineInterior = Pick(random, 2) == 0;
  options.PreserveTopology = Pick(random, 2) == 0;
  options.MinimumPieceSize = Pick(random, 2) == 0 ? 0 : Pick(random, 10);
  return options;
}

HiddenCells RandomHidden(Random& random, const std::array<int, 3>& dimensions)
{
  const std::array<int, 3> cells = { dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 };
  const int kind = Pick(random, 6);
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = Pick(random, cells[axis]);
    high[axis] = low[axis] + Pick(random, cells[axis] - low[axis]);
  }
  std::vector<std::uint8_t> hidden;
  for (int z = 0; z < cells[2]; ++z)
  {
    for (int y = 0; y < cells[1]; ++y)
    {
      for (int x = 0; x < cells[0]; ++x)
      {
        const bool isSingle = Pick(random, 30) == 0;
        const bool isInBlock =
          x >= low[0] && x <= high[0] && y >= low[1] && y <= high[1] && z >= low[2] && z <= high[2];
        hidden.push_back((kind == 0 && isSingle) || (kind == 1 && isInBlock) ? 1 : 0);
      }
    }
  }
  return { std::move(hidden), cells };
}

Query RandomQuery(Random& random, const IsodiamondHierarchy& hierarchy, const GridGeometry& world)
{
  Query query{ RandomTolerance(random, hierarchy.Codes().Scale()),
    RandomTolerance(random, hierarchy.InteriorCodes().Scale()) };
  if (Pick(random, 2) == 0)
  {
    query.Region = RandomBox(random, hierarchy.SampleGrid());
    query.OutsideTolerance = RandomTolerance(random, hierarchy.Codes().Scale());
  }
  if (hierarchy.Header().Metric == ErrorMetric::Distance && Pick(random, 3) == 0)
  {
    query.View = RandomViewpoint(random, hierarchy.SampleGrid(), world);
  }
  return query;
}

std::string Describe(const RandomSamples& samples, const Isoregion& region)
{
  std::ostringstream text;
  text << samples.Dimensions[0] << " x " << samples.Dimensions[1] << " x " << samples.Dimensions[2]
       << " samples of type " << samples.Values.index()
       << (region.IsVolume() ? ", volume " : ", surface ") << region.Isovalue(0);
  if (region.IsVolume())
  {
    text << " to " << region.Isovalue(1);
  }
  return text.str();
}

AnyMesh::AnyMesh(
  const IsodiamondHierarchy& hierarchy, const Query& query, const ParallelFor& parallelFor)
{
  if (hierarchy.Region().IsVolume())
  {
    this->Interval = ExtractVolume(hierarchy, query, parallelFor);
  }
  else
  {
    this->Surface = Extract(hierarchy, query, parallelFor);
  }
}

bool AnyMesh::IsSameInAnyOrder(const AnyMesh& other) const
{
  return PlacedTriangles(this->Surface) == PlacedTriangles(other.Surface) &&
    PlacedTetrahedra(this->Interval) == PlacedTetrahedra(other.Interval);
}

std::string AnyMesh::Fault(const std::array<int, 3>& dimensions) const
{
  return FindFault(this->Surface, dimensions) + FindFault(this->Interval, dimensions);
}

int ForRandomSeeds(const std::function<void(std::uint32_t)>& check)
{
  const std::uint32_t seed = NumberFrom("ISODIAMONDS_SEED", std::random_device()());
  const std::uint32_t cases = NumberFrom("ISODIAMONDS_CASES", 200);
  const std::uint32_t known = std::getenv("ISODIAMONDS_SEED") != nullptr ? 0 : cases / 2;
  std::cout << "ISODIAMONDS_SEED=" << seed << std::endl;
  std::uint32_t done = 0;
  for (; done < cases && !testing::Test::HasFailure(); ++done)
  {
    // To run a case by itself: ISODIAMONDS_CASES=1 and its own seed.
    const std::uint32_t own = done < known ? 1 + done : seed + (done - known);
    SCOPED_TRACE("ISODIAMONDS_SEED=" + std::to_string(own));
    check(own);
  }
  return static_cast<int>(done);
}

}
