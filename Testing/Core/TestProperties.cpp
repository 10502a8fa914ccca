// SPDX-License-Identifier: BSD-3-Clause
// What must hold for any samples, regions and queries, on random ones. The seed is printed; with
// ISODIAMONDS_SEED the same cases come again, ISODIAMONDS_CASES is how many.
#include "DistanceTestTools.h"
#include "Refinement/ScalarQuery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

using namespace isodiamond;

namespace
{

using Random = std::mt19937;

constexpr double Infinity = std::numeric_limits<double>::infinity();

double Uniform(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}
int Pick(Random& random, int count)
{
  return static_cast<int>(random() % static_cast<std::uint32_t>(count));
}

/** 2 to 40 samples an axis, not too many in all. */
std::array<int, 3> RandomDimensions(Random& random)
{
  std::array<int, 3> dimensions{};
  do
  {
    for (int& size : dimensions)
    {
      size = 2 + Pick(random, 39);
    }
  } while (dimensions[0] * dimensions[1] * dimensions[2] > 6000);
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

/** Samples of a random type. */
struct Samples
{
  std::array<int, 3> Dimensions{};
  AnyValues Values;

  template <typename T>
  void Set(const std::vector<double>& pattern)
  {
    std::vector<T> cut;
    for (const double value : pattern)
    {
      cut.push_back(Cut<T>(value));
    }
    this->Values = std::move(cut);
  }

  explicit Samples(Random& random)
    : Dimensions(RandomDimensions(random))
  {
    std::vector<double> pattern = RandomPattern(random, this->Dimensions);
    if (Pick(random, 3) == 0)
    {
      AddSpecials(random, pattern);
    }
    const std::array<void (Samples::*)(const std::vector<double>&), 10> setters = {
      &Samples::Set<float>, &Samples::Set<double>, &Samples::Set<std::int8_t>,
      &Samples::Set<std::uint8_t>, &Samples::Set<std::int16_t>, &Samples::Set<std::uint16_t>,
      &Samples::Set<std::int32_t>, &Samples::Set<std::uint32_t>, &Samples::Set<std::int64_t>,
      &Samples::Set<std::uint64_t>
    };
    (this->*setters[Pick(random, 10)])(pattern);
  }

  AnySamples View() const
  {
    return std::visit([&](const auto& values) -> AnySamples
      { return SampleView(values.data(), this->Dimensions); },
      this->Values);
  }
  double At(std::size_t index) const
  {
    return std::visit(
      [&](const auto& values) { return static_cast<double>(values[index]); }, this->Values);
  }
  std::size_t Size() const
  {
    return std::visit([](const auto& values) { return values.size(); }, this->Values);
  }
};

/** A sample's value, or one near to it. */
double RandomValue(Random& random, const Samples& samples)
{
  const double value = samples.At(random() % samples.Size());
  const double other = samples.At(random() % samples.Size());
  const double chosen = Pick(random, 2) == 0 ? value : 0.5 * value + 0.5 * other;
  return std::isnan(chosen) ? 0.0 : chosen;
}

Isoregion RandomRegion(Random& random, const Samples& samples)
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

BuildOptions RandomOptions(Random& random, const std::array<int, 3>& dimensions)
{
  BuildOptions options;
  options.Metric = Pick(random, 2) == 0 ? ErrorMetric::Field : ErrorMetric::Distance;
  options.ExactIsovertices = Pick(random, 2) == 0;
  options.PreserveFeatures = Pick(random, 2) == 0;
  options.RefineInterior = Pick(random, 2) == 0;
  if (Pick(random, 3) == 0)
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
    options.World = GridGeometry(axes);
  }
  else
  {
    AffineMap map;
    for (int axis = 0; axis < 3; ++axis)
    {
      map.Rows[axis][axis] = Uniform(random, 0.1, 4.0);
    }
    options.World = map;
  }
  return options;
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

/** A query, and the box that its region is, if it has one. */
struct BoxedQuery : Query
{
  Box Inside;
};

BoxedQuery RandomQuery(Random& random, const IsodiamondHierarchy& hierarchy)
{
  BoxedQuery query;
  query.Tolerance = RandomTolerance(random, hierarchy.Codes().Scale());
  query.InteriorTolerance = RandomTolerance(random, hierarchy.InteriorCodes().Scale());
  if (Pick(random, 2) == 0)
  {
    Box& box = query.Inside;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = Uniform(random, -2.0, hierarchy.SampleGrid().Last(axis) + 2.0);
      const double b = Uniform(random, -2.0, hierarchy.SampleGrid().Last(axis) + 2.0);
      box.Minimum[axis] = std::min(a, b);
      box.Maximum[axis] = std::max(a, b);
    }
    query.Region.emplace(box, hierarchy.SampleGrid(), AffineMap());
    query.OutsideTolerance = RandomTolerance(random, hierarchy.Codes().Scale());
  }
  return query;
}

/** The mesh of a query, whatever it is made of. */
struct AnyMesh
{
  test::Mesh Surface;
  test::Volume Volume;

  AnyMesh(const IsodiamondHierarchy& hierarchy, const Query& query,
    const ParallelFor& parallelFor = SerialFor)
  {
    if (hierarchy.Region().IsVolume())
    {
      this->Volume = test::ExtractVolume(hierarchy, query, parallelFor);
    }
    else
    {
      this->Surface = test::Extract(hierarchy, query, parallelFor);
    }
  }

  bool operator==(const AnyMesh& other) const
  {
    return this->Surface == other.Surface && this->Volume == other.Volume;
  }
  bool IsSameInAnyOrder(const AnyMesh& other) const
  {
    return test::PlacedTriangles(this->Surface) == test::PlacedTriangles(other.Surface) &&
      test::PlacedTetrahedra(this->Volume) == test::PlacedTetrahedra(other.Volume);
  }
  std::string Fault(const std::array<int, 3>& dimensions) const
  {
    return test::FindFault(this->Surface, dimensions) + test::FindFault(this->Volume, dimensions);
  }
};

/** One random field: all that must hold, for some queries. */
class Case
{
public:
  explicit Case(std::uint32_t seed)
    : Numbers(seed)
    , Field(Numbers)
    , Region(RandomRegion(Numbers, Field))
    , Options(RandomOptions(Numbers, Field.Dimensions))
    , Minimal(BuildIsodiamonds(Model::Minimal, Field.View(), Region, SerialFor, Options), SerialFor)
    , Relevant(
        BuildIsodiamonds(Model::Relevant, Field.View(), Region, SerialFor, Options), SerialFor)
  {
  }

  void Check()
  {
    const test::Built threaded(BuildIsodiamonds(Model::Minimal, this->Field.View(), this->Region,
                                 this->Threads, this->Options),
      this->Threads);
    EXPECT_EQ(threaded.Encoding.Arrays.Records, this->Minimal.Encoding.Arrays.Records);
    EXPECT_EQ(threaded.Encoding.Arrays.Isovertices, this->Minimal.Encoding.Arrays.Isovertices);
    EXPECT_EQ(threaded.Encoding.Arrays.InteriorCodes, this->Minimal.Encoding.Arrays.InteriorCodes);
    this->CheckQuery({});
    for (int i = 0; i < 3; ++i)
    {
      this->CheckQuery(RandomQuery(this->Numbers, *this->Minimal.Hierarchy));
    }
    this->CheckScalars();
    this->CheckHalves();
  }

  std::string Describe() const
  {
    std::ostringstream text;
    text << this->Field.Dimensions[0] << " x " << this->Field.Dimensions[1] << " x "
         << this->Field.Dimensions[2] << " samples of type " << this->Field.Values.index()
         << (this->Region.IsVolume() ? ", volume " : ", surface ") << this->Region.Isovalue(0);
    if (this->Region.IsVolume())
    {
      text << " to " << this->Region.Isovalue(1);
    }
    return text.str();
  }

private:
  /** Conforming, and the same by two models and with threads. */
  void CheckQuery(const BoxedQuery& query)
  {
    const AnyMesh mesh(*this->Minimal.Hierarchy, query);
    EXPECT_EQ(mesh.Fault(this->Field.Dimensions), "") << "tolerance " << query.Tolerance;
    EXPECT_TRUE(mesh == AnyMesh(*this->Minimal.Hierarchy, query, this->Threads));
    EXPECT_TRUE(mesh.IsSameInAnyOrder(AnyMesh(*this->Relevant.Hierarchy, query)));
    if (this->Options.Metric == ErrorMetric::Distance)
    {
      this->CheckDistances(query, mesh);
    }
  }

  /** No point of the mesh is farther from full resolution than the tolerance, and no vertex of that
   *  from the mesh; the former also where features vanish. Looks at some, or all if few. */
  void CheckDistances(const BoxedQuery& query, const AnyMesh& mesh) const
  {
    const AnyMesh full(*this->Minimal.Hierarchy, Query{});
    for (const int surface : { -1, 1 })
    {
      const test::SurfaceTriangles expected = this->TrianglesOf(full, surface);
      const test::SurfaceTriangles found = this->TrianglesOf(mesh, surface);
      test::Promise promise;
      promise.Forth = this->Options.PreserveFeatures;
      promise.MostSamples = 5000;
      promise.Tolerance = query.Tolerance;
      if (query.Region)
      {
        promise.Within = test::Placed(query.Inside, this->Options.World);
      }
      EXPECT_EQ(FaultOf(promise, expected, found), "") << "surface " << surface;
      if (query.Region)
      {
        promise.Within = test::Promise().Within;
        promise.Tolerance = std::max(query.Tolerance, query.OutsideTolerance);
        EXPECT_EQ(FaultOf(promise, expected, found), "") << "outside, surface " << surface;
      }
    }
  }

  /** In the world. */
  test::SurfaceTriangles TrianglesOf(const AnyMesh& mesh, int surface) const
  {
    return this->Region.IsVolume() ? test::Placed(mesh.Volume, surface, this->Options.World)
                                   : test::Placed(mesh.Surface, this->Options.World);
  }

  /** The HD gives the same, of errors in the field. */
  void CheckScalars()
  {
    const ScalarEncoding encoding = BuildScalarHierarchy(this->Field.View(), SerialFor);
    const ScalarHierarchy scalars(this->Field.View(), encoding.ErrorScale, encoding.Codes.data(),
      static_cast<std::int64_t>(encoding.Codes.size()), ViewOf(encoding.Minima),
      ViewOf(encoding.Maxima));
    this->Options.Metric = ErrorMetric::Field;
    this->Options.RefineInterior = true;
    const test::Built minimal(
      BuildIsodiamonds(Model::Minimal, scalars, this->Region, SerialFor, this->Options), SerialFor);
    const BoxedQuery query = RandomQuery(this->Numbers, *minimal.Hierarchy);
    const test::Built answer(
      EncodeQuery(scalars, this->Region, query, this->Options.ExactIsovertices, SerialFor),
      SerialFor);
    const AnyMesh mesh(*answer.Hierarchy, Query{});
    EXPECT_EQ(mesh.Fault(this->Field.Dimensions), "") << "HD, tolerance " << query.Tolerance;
    EXPECT_TRUE(mesh.IsSameInAnyOrder(AnyMesh(*minimal.Hierarchy, query)));
  }

  /** What lies below a value and what lies above it fill the grid; but for four linear isovertices
   *  in a face, which steps of 1/256 leave not quite in a plane: both sides may cut it otherwise.
   */
  void CheckHalves()
  {
    this->Options.ExactIsovertices = false;
    const double value = RandomValue(this->Numbers, this->Field);
    for (std::size_t i = 0; i < this->Field.Size(); ++i)
    {
      const double sample = this->Field.At(i);
      if (std::isnan(sample) || sample == value || std::isinf(value))
      {
        return; // is in none, or in both
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

  Random Numbers;
  ParallelFor Threads = test::ThreadedFor(3);
  Samples Field;
  Isoregion Region;
  BuildOptions Options;
  test::Built Minimal;
  test::Built Relevant;
};

std::uint32_t NumberFrom(const char* variable, std::uint32_t otherwise)
{
  const char* text = std::getenv(variable);
  return text != nullptr ? static_cast<std::uint32_t>(std::strtoul(text, nullptr, 10)) : otherwise;
}

}

TEST(Properties, HoldForRandomFieldsAndQueries)
{
  const std::uint32_t seed = NumberFrom("ISODIAMONDS_SEED", std::random_device()());
  const std::uint32_t cases = NumberFrom("ISODIAMONDS_CASES", 200);
  std::cout << "ISODIAMONDS_SEED=" << seed << std::endl;
  for (std::uint32_t i = 0; i < cases; ++i)
  {
    // A case by itself: ISODIAMONDS_CASES=1 and its own seed.
    Case one(seed + i);
    SCOPED_TRACE("ISODIAMONDS_SEED=" + std::to_string(seed + i) + ": " + one.Describe());
    one.Check();
    if (HasFailure())
    {
      return;
    }
  }
}
