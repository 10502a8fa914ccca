// SPDX-License-Identifier: BSD-3-Clause
#include "Tools/CoreTestTools.h"

#include "ReferenceExact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

namespace test
{
namespace
{

std::string NameOf(const char* kind, const std::array<int, 3>& dims)
{
  std::ostringstream name;
  name << kind << " " << dims[0] << "x" << dims[1] << "x" << dims[2];
  return name.str();
}

template <typename Function>
Field MakeField(
  const char* kind, const std::array<int, 3>& dims, double isovalue, Function&& function)
{
  Field field{ NameOf(kind, dims), dims, {}, isovalue };
  for (int z = 0; z < dims[2]; ++z)
  {
    for (int y = 0; y < dims[1]; ++y)
    {
      for (int x = 0; x < dims[0]; ++x)
      {
        field.Samples.push_back(static_cast<float>(function(x, y, z)));
      }
    }
  }
  return field;
}

}

Field NoiseField(const std::array<int, 3>& dims, unsigned seed)
{
  std::mt19937 random(seed);
  return MakeField("noise", dims, 4.0, [&](int, int, int) { return random() % 9; });
}

Field SphereField(const std::array<int, 3>& dims)
{
  const double radius = 0.35 * *std::max_element(dims.begin(), dims.end());
  return MakeField("sphere", dims, 0.25,
    [&](int x, int y, int z)
    {
      const double r = std::hypot(x - 0.5 * dims[0], y - 0.5 * dims[1], z - 0.45 * dims[2]);
      return radius - r + 0.7 * std::sin(0.9 * x) * std::sin(1.1 * y);
    });
}

Field SparseField(const std::array<int, 3>& dims, unsigned seed)
{
  std::mt19937 random(seed);
  return MakeField(
    "sparse", dims, 0.5, [&](int, int, int) { return random() % 40 == 0 ? 1 + random() % 5 : 0; });
}

Field BrokenField(const std::array<int, 3>& dims, unsigned seed)
{
  std::mt19937 random(seed);
  return MakeField("broken", dims, 4.0,
    [&](int, int, int) -> double
    {
      switch (random() % 30)
      {
        case 0:
          return std::numeric_limits<double>::quiet_NaN();
        case 1:
          return std::numeric_limits<double>::infinity();
        case 2:
          return -std::numeric_limits<double>::infinity();
        default:
          return random() % 9;
      }
    });
}

Field WaveField(const std::array<int, 3>& dims)
{
  return MakeField("wave", dims, 0.1,
    [](int x, int y, int z)
    { return std::sin(0.5 * x) + std::sin(0.6 * y + 0.2 * x) + std::cos(0.45 * z); });
}

Field SpikeField(const std::array<int, 3>& dims, double spike)
{
  return MakeField("spike", dims, 3.0,
    [&](int x, int y, int z)
    {
      const bool isMiddle = x == dims[0] / 2 && y == dims[1] / 2 && z == dims[2] / 2;
      return isMiddle ? spike : std::hypot(x - 3.3, y - 4.1, z - 3.8);
    });
}

std::vector<Field> SmallFields()
{
  std::vector<Field> fields;
  unsigned seed = 1;
  for (const std::array<int, 3>& dims : std::vector<std::array<int, 3>>{ { 2, 2, 2 }, { 3, 3, 3 },
         { 4, 4, 4 }, { 5, 5, 5 }, { 9, 9, 9 }, { 5, 4, 7 }, { 10, 6, 13 }, { 6, 4, 5 },
         { 6, 8, 4 }, { 11, 2, 6 }, { 2, 17, 3 }, { 10, 12, 6 }, { 14, 13, 9 } })
  {
    fields.push_back(NoiseField(dims, seed++));
    fields.push_back(SphereField(dims));
    fields.push_back(SparseField(dims, seed++));
    fields.push_back(BrokenField(dims, seed++));
    fields.push_back(WaveField(dims));
  }
  for (const double spike : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    fields.push_back(SpikeField({ 9, 9, 9 }, spike));
    fields.push_back(SpikeField({ 12, 17, 10 }, spike));
  }
  return fields;
}

isodiamond::ParallelFor ThreadedFor(int threads)
{
  return [threads](std::int64_t count, std::int64_t grain,
           const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    std::atomic<std::int64_t> next{ 0 };
    std::vector<std::thread> pool;
    for (int i = 0; i < threads; ++i)
    {
      pool.emplace_back(
        [&]
        {
          for (std::int64_t begin = next.fetch_add(grain); begin < count;
               begin = next.fetch_add(grain))
          {
            body(begin, std::min(begin + grain, count));
          }
        });
    }
    for (std::thread& thread : pool)
    {
      thread.join();
    }
  };
}

Built::Built(isodiamond::Encoding encoding, const isodiamond::ParallelFor& parallelFor)
  : Encoding(std::move(encoding))
  , Hierarchy(std::make_unique<isodiamond::IsodiamondHierarchy>(this->Encoding, parallelFor))
{
}

Built::Built(isodiamond::Encoded encoded, const isodiamond::ParallelFor& parallelFor)
  : Built(std::move(encoded.Encoding), parallelFor)
{
  const isodiamond::IsodiamondHierarchy handedOver(
    this->Encoding, std::move(encoded.Diamonds), std::move(encoded.Edges));
  const bool isVolume = handedOver.Region().IsVolume();
  EXPECT_EQ(handedOver.Diamonds().Size(), this->Hierarchy->Diamonds().Size());
  handedOver.Diamonds().ForEach([&](const isodiamond::Place& place, std::uint32_t rank)
    { EXPECT_EQ(this->Hierarchy->Diamonds().Rank(place), rank); });
  for (std::int64_t rank = 0; rank < handedOver.Diamonds().Size(); ++rank)
  {
    EXPECT_EQ(handedOver.FirstIsovertexOf(rank), this->Hierarchy->FirstIsovertexOf(rank));
    EXPECT_EQ(handedOver.Edges(rank), this->Hierarchy->Edges(rank));
    EXPECT_EQ(handedOver.KindOf(rank), this->Hierarchy->KindOf(rank));
    EXPECT_TRUE(!isVolume || handedOver.UpperEdges(rank) == this->Hierarchy->UpperEdges(rank));
  }
}

Built Build(isodiamond::Model model, const Field& field, const isodiamond::BuildOptions& options)
{
  return { isodiamond::BuildIsodiamonds(
             model, field.View(), field.Isovalue, isodiamond::SerialFor, options),
    isodiamond::SerialFor };
}

isodiamond::BuildOptions Placement(bool exact)
{
  isodiamond::BuildOptions options;
  options.ExactIsovertices = exact;
  return options;
}

isodiamond::BuildOptions Interior(bool refine)
{
  isodiamond::BuildOptions options;
  options.RefineInterior = refine;
  return options;
}

isodiamond::BuildOptions Distance(const isodiamond::GridGeometry& world)
{
  isodiamond::BuildOptions options;
  options.Metric = isodiamond::ErrorMetric::Distance;
  options.World = world;
  return options;
}

namespace
{

/** Of NaNs, too, which are not equal to themselves. */
bool HaveSameBytes(const isodiamond::AnyValues& a, const isodiamond::AnyValues& b)
{
  return a.index() == b.index() &&
    std::visit(
      [&](const auto& values)
      {
        const auto& others = std::get<std::decay_t<decltype(values)>>(b);
        return values.size() == others.size() &&
          (values.empty() ||
            std::memcmp(values.data(), others.data(), values.size() * sizeof(values[0])) == 0);
      },
      a);
}

}

void ExpectSame(const isodiamond::Encoding& found, const isodiamond::Encoding& expected)
{
  EXPECT_EQ(found.Arrays.BrickCounts, expected.Arrays.BrickCounts);
  EXPECT_EQ(found.Arrays.BrickIndices, expected.Arrays.BrickIndices);
  EXPECT_EQ(found.Arrays.BrickMasks, expected.Arrays.BrickMasks);
  EXPECT_EQ(found.Arrays.Records, expected.Arrays.Records);
  EXPECT_EQ(found.Arrays.Isovertices, expected.Arrays.Isovertices);
  EXPECT_EQ(found.Arrays.InteriorCodes, expected.Arrays.InteriorCodes);
  EXPECT_EQ(found.Arrays.Followers, expected.Arrays.Followers);
  EXPECT_TRUE(HaveSameBytes(found.InsideValues, expected.InsideValues));
  EXPECT_EQ(found.Header.TheModel, expected.Header.TheModel);
  EXPECT_EQ(found.Header.ErrorScale, expected.Header.ErrorScale);
  EXPECT_EQ(found.Header.FieldScale, expected.Header.FieldScale);
  EXPECT_EQ(found.Header.RemovedPieces, expected.Header.RemovedPieces);
  EXPECT_EQ(found.Header.ActiveCount, expected.Header.ActiveCount);
  EXPECT_EQ(found.Header.CreationCount, expected.Header.CreationCount);
  EXPECT_EQ(found.Header.RelevantCount, expected.Header.RelevantCount);
}

BuiltScalars BuildScalars(const Field& field)
{
  BuiltScalars built{ isodiamond::BuildScalarHierarchy(field.View(), isodiamond::SerialFor), {} };
  built.Hierarchy =
    std::make_unique<isodiamond::ScalarHierarchy>(field.View(), built.Encoding.ErrorScale,
      built.Encoding.Codes.data(), static_cast<std::int64_t>(built.Encoding.Codes.size()),
      isodiamond::ViewOf(built.Encoding.Minima), isodiamond::ViewOf(built.Encoding.Maxima));
  return built;
}

Mesh Extract(const isodiamond::IsodiamondHierarchy& hierarchy, double tolerance,
  const isodiamond::ParallelFor& parallelFor)
{
  return Extract(hierarchy, isodiamond::Query{ tolerance }, parallelFor);
}

Mesh Extract(const isodiamond::IsodiamondHierarchy& hierarchy, const isodiamond::Query& query,
  const isodiamond::ParallelFor& parallelFor)
{
  const isodiamond::RefinedSet refined(hierarchy, query, parallelFor);
  const isodiamond::SurfaceExtraction extraction(refined, parallelFor);
  Mesh mesh;
  mesh.Points.resize(extraction.PointCount());
  mesh.Triangles.resize(extraction.TriangleCount());
  mesh.Levels.resize(extraction.TriangleCount());
  if (!mesh.Triangles.empty())
  {
    extraction.WritePoints(isodiamond::AffineMap(), mesh.Points[0].data());
    extraction.WriteTriangles(false, mesh.Triangles[0].data(), mesh.Levels.data());
  }
  return mesh;
}

namespace
{

bool OnBoundary(const std::array<int, 3>& dims, const Corner& a, const Corner& b)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto last = static_cast<float>(dims[axis] - 1);
    if ((a[axis] == 0.0F && b[axis] == 0.0F) || (a[axis] == last && b[axis] == last))
    {
      return true;
    }
  }
  return false;
}

}

std::string FindFault(const Mesh& mesh, const std::array<int, 3>& dims)
{
  std::map<std::pair<int, int>, int> directed;
  std::vector<bool> used(mesh.Points.size(), false);
  for (const std::array<std::int32_t, 3>& t : mesh.Triangles)
  {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
    {
      return "a triangle has a point twice";
    }
    for (int i = 0; i < 3; ++i)
    {
      ++directed[{ t[i], t[(i + 1) % 3] }];
      used.at(t[i]) = true;
    }
  }
  for (const auto& [edge, count] : directed)
  {
    if (count != 1)
    {
      return "two triangles are on the same side of an edge";
    }
    if (directed.count({ edge.second, edge.first }) == 0 &&
      !OnBoundary(dims, mesh.Points[edge.first], mesh.Points[edge.second]))
    {
      return "an edge inside of the grid has one triangle";
    }
  }
  if (std::count(used.begin(), used.end(), false) > 0)
  {
    return "a point without use";
  }
  const std::set<Corner> distinct(mesh.Points.begin(), mesh.Points.end());
  if (distinct.size() != mesh.Points.size())
  {
    return "two points are in one place";
  }
  for (const Corner& point : mesh.Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(point[axis] >= 0.0F && point[axis] <= static_cast<float>(dims[axis] - 1)))
      {
        return "a point outside of the grid";
      }
    }
  }
  return "";
}

PlacedTriangle Place(const Corner& a, const Corner& b, const Corner& c, int level)
{
  PlacedTriangle placed{ { a, b, c }, level };
  std::rotate(placed.Corners.begin(),
    std::min_element(placed.Corners.begin(), placed.Corners.end()), placed.Corners.end());
  return placed;
}

std::vector<PlacedTriangle> PlacedTriangles(const Mesh& mesh)
{
  std::vector<PlacedTriangle> placed;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const std::array<std::int32_t, 3>& t = mesh.Triangles[i];
    placed.push_back(
      Place(mesh.Points[t[0]], mesh.Points[t[1]], mesh.Points[t[2]], mesh.Levels[i]));
  }
  std::sort(placed.begin(), placed.end());
  return placed;
}

std::string CompareWithPatches(const Mesh& mesh, const std::vector<reference::Patch>& patches,
  const reference::ScalarField& field, double isovalue, bool exact)
{
  const std::vector<PlacedTriangle> placed = PlacedTriangles(mesh);
  std::multiset<PlacedTriangle> left(placed.begin(), placed.end());
  const auto remove = [&left](const PlacedTriangle& triangle)
  {
    const auto found = left.find(triangle);
    if (found == left.end())
    {
      return false;
    }
    left.erase(found);
    return true;
  };
  for (const reference::Patch& patch : patches)
  {
    std::vector<Corner> c;
    for (const reference::Isovertex& isovertex : patch.Corners)
    {
      const std::array<double, 3> position = exact
        ? reference::ExactPosition(field, isovalue, isovertex)
        : reference::Position(isovertex, reference::Coefficient(field, isovalue, isovertex));
      c.push_back({ static_cast<float>(position[0]), static_cast<float>(position[1]),
        static_cast<float>(position[2]) });
    }
    bool found = false;
    if (c.size() == 3)
    {
      found = remove(Place(c[0], c[1], c[2], patch.Level));
    }
    else
    {
      const bool first = left.count(Place(c[0], c[1], c[2], patch.Level)) > 0;
      found = first ? remove(Place(c[0], c[1], c[2], patch.Level)) &&
          remove(Place(c[0], c[2], c[3], patch.Level))
                    : remove(Place(c[0], c[1], c[3], patch.Level)) &&
          remove(Place(c[1], c[2], c[3], patch.Level));
    }
    if (!found)
    {
      std::ostringstream text;
      text << "missing a patch of " << c.size() << " corners at " << c[0][0] << " " << c[0][1]
           << " " << c[0][2] << " level " << patch.Level;
      return text.str();
    }
  }
  return left.empty() ? "" : std::to_string(left.size()) + " triangles too many";
}

isodiamond::Place PlaceOf(const isodiamond::Grid& grid, const reference::Point& centre)
{
  const int scale = grid.Scale(centre);
  return { scale, { centre[0] >> scale, centre[1] >> scale, centre[2] >> scale } };
}

std::vector<double> Tolerances(double scale)
{
  return { 0.0, 1e-4 * scale, 0.01 * scale, 0.05 * scale, 0.1 * scale, 0.2 * scale, 0.4 * scale,
    0.8 * scale, 2.0 * scale, std::numeric_limits<double>::infinity() };
}

}
