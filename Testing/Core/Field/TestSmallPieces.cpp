// SPDX-License-Identifier: BSD-3-Clause
// Small pieces removed: signs against flood fills, hierarchies against fields that never had them.
#include "Field/SignLattice.h"
#include "Field/SmallPieces.h"
#include "Tools/IntervalTestTools.h"

#include "ReferenceLattice.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

using namespace isodiamond;

namespace
{

/** Whether each sample lies above a surface, x fastest. */
struct Signs
{
  std::array<int, 3> Dims{};
  std::vector<char> Above;

  bool operator==(const Signs& other) const { return this->Above == other.Above; }
  std::size_t Index(const Point& p) const
  {
    return (static_cast<std::size_t>(p[2]) * this->Dims[1] + p[1]) * this->Dims[0] + p[0];
  }
  bool At(const Point& p) const { return this->Above[this->Index(p)] != 0; }
};

bool IsIn(const std::array<int, 3>& dims, const Point& p)
{
  return std::min({ p[0], p[1], p[2] }) >= 0 && p[0] < dims[0] && p[1] < dims[1] && p[2] < dims[2];
}

template <typename Body>
void ForEachPoint(const std::array<int, 3>& dims, Body&& body)
{
  for (int z = 0; z < dims[2]; ++z)
  {
    for (int y = 0; y < dims[1]; ++y)
    {
      for (int x = 0; x < dims[0]; ++x)
      {
        body(Point{ x, y, z });
      }
    }
  }
}

/** The points that edges of full resolution join to a point. */
std::vector<Point> Neighbours(const std::array<int, 3>& dims, const Point& p)
{
  std::vector<Point> neighbours;
  ForEachPoint({ 3, 3, 3 },
    [&](const Point& shifted)
    {
      const Point q = p + shifted + Point{ -1, -1, -1 };
      std::set<int> parities;
      for (int axis = 0; axis < 3; ++axis)
      {
        if (q[axis] != p[axis])
        {
          parities.insert(p[axis] % 2);
        }
      }
      if (parities.size() == 1 && IsIn(dims, q))
      {
        neighbours.push_back(q);
      }
    });
  return neighbours;
}

/** The connected sets of one side, by flooding. */
std::vector<std::vector<Point>> PiecesOf(const Signs& signs, bool above)
{
  std::vector<std::vector<Point>> pieces;
  std::vector<char> seen(signs.Above.size(), 0);
  ForEachPoint(signs.Dims,
    [&](const Point& seed)
    {
      if (signs.At(seed) != above || seen[signs.Index(seed)] != 0)
      {
        return;
      }
      std::vector<Point> piece = { seed };
      seen[signs.Index(seed)] = 1;
      for (std::size_t i = 0; i < piece.size(); ++i)
      {
        for (const Point& next : Neighbours(signs.Dims, piece[i]))
        {
          if (signs.At(next) == above && seen[signs.Index(next)] == 0)
          {
            seen[signs.Index(next)] = 1;
            piece.push_back(next);
          }
        }
      }
      pieces.push_back(std::move(piece));
    });
  return pieces;
}

/** Removes solids, then cavities. @return how many were removed */
std::int64_t RemoveByFlooding(Signs& signs, std::int64_t minimumSize)
{
  std::int64_t removed = 0;
  for (const bool above : { true, false })
  {
    for (const std::vector<Point>& piece : PiecesOf(signs, above))
    {
      if (static_cast<std::int64_t>(piece.size()) < minimumSize)
      {
        ++removed;
        for (const Point& p : piece)
        {
          signs.Above[signs.Index(p)] = above ? 0 : 1;
        }
      }
    }
  }
  return removed;
}

/** The same by the core, for which signs are packed as bits. */
std::int64_t RemoveByRuns(Signs& signs, std::int64_t minimumSize, const ParallelFor& parallelFor)
{
  const std::int64_t words = (signs.Dims[0] + 63) / 64;
  std::vector<std::uint64_t> bits(words * signs.Dims[1] * signs.Dims[2]);
  const auto wordOf = [&](const Point& p) -> std::uint64_t&
  { return bits[(std::int64_t{ p[2] } * signs.Dims[1] + p[1]) * words + p[0] / 64]; };
  ForEachPoint(
    signs.Dims, [&](const Point& p) { wordOf(p) |= std::uint64_t{ signs.At(p) } << (p[0] % 64); });
  const std::int64_t removed =
    RemoveSmallPieces({ bits.data(), signs.Dims, words }, minimumSize, parallelFor);
  ForEachPoint(signs.Dims,
    [&](const Point& p)
    {
      const std::uint64_t bit = std::uint64_t{ 1 } << (p[0] % 64);
      signs.Above[signs.Index(p)] = (wordOf(p) & bit) != 0 ? 1 : 0;
      wordOf(p) &= ~bit;
    });
  for (const std::uint64_t word : bits)
  {
    EXPECT_EQ(word, 0U) << "a bit beyond the row";
  }
  return removed;
}

Signs RandomSigns(const std::array<int, 3>& dims, double density, std::mt19937& random)
{
  Signs signs{ dims, {} };
  std::bernoulli_distribution isAbove(density);
  ForEachPoint(dims, [&](const Point&) { signs.Above.push_back(isAbove(random) ? 1 : 0); });
  return signs;
}

const std::vector<std::array<int, 3>> Sizes = { { 1, 1, 1 }, { 5, 1, 1 }, { 1, 7, 1 }, { 1, 1, 6 },
  { 70, 1, 3 }, { 1, 20, 17 }, { 64, 3, 2 }, { 2, 2, 2 }, { 3, 4, 5 }, { 9, 8, 7 }, { 63, 5, 4 },
  { 64, 6, 5 }, { 65, 4, 6 }, { 128, 3, 3 }, { 130, 5, 6 }, { 12, 70, 5 }, { 6, 9, 66 },
  { 17, 18, 19 }, { 24, 23, 21 } };

}

TEST(SmallPieces, AreConnectedByTheEdgesOfFullResolution)
{
  const std::array<int, 3> dims = { 6, 5, 7 };
  const reference::Hierarchy hierarchy(dims);
  std::set<std::pair<Point, Point>> edges;
  for (const reference::Diamond& diamond : hierarchy.Diamonds())
  {
    for (const reference::Tetrahedron& tetrahedron : diamond.Tetrahedra)
    {
      for (const reference::Tetrahedron& half : reference::Hierarchy::Bisect(tetrahedron))
      {
        const bool isFinest = hierarchy.DiamondOf(half) == -1 && hierarchy.BelongsToGrid(half);
        for (int i = 0; i < 16 && isFinest; ++i)
        {
          const std::pair<Point, Point> edge(half.Vertices[i / 4], half.Vertices[i % 4]);
          if (edge.first != edge.second && IsIn(dims, edge.first) && IsIn(dims, edge.second))
          {
            edges.insert(edge);
          }
        }
      }
    }
  }
  std::set<std::pair<Point, Point>> byParity;
  ForEachPoint(dims,
    [&](const Point& p)
    {
      for (const Point& q : Neighbours(dims, p))
      {
        byParity.emplace(p, q);
      }
    });
  EXPECT_EQ(byParity, edges);
}

TEST(SmallPieces, AreThoseThatFloodingFinds)
{
  std::mt19937 random(11);
  std::int64_t sum = 0;
  for (const std::array<int, 3>& dims : Sizes)
  {
    for (const double density : { 0.03, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97 })
    {
      const Signs signs = RandomSigns(dims, density, random);
      for (const std::int64_t minimum : { 2, 3, 5, 20, 200 })
      {
        SCOPED_TRACE(::testing::Message()
          << dims[0] << "x" << dims[1] << "x" << dims[2] << ", " << density << ", " << minimum);
        Signs expected = signs;
        const std::int64_t removed = RemoveByFlooding(expected, minimum);
        for (const int threads : { 0, 3 })
        {
          Signs found = signs;
          ASSERT_EQ(RemoveByRuns(found, minimum,
                      threads == 0 ? ParallelFor(SerialFor) : test::ThreadedFor(threads)),
            removed);
          ASSERT_EQ(found, expected);
        }
        sum += removed;
      }
    }
  }
  EXPECT_GT(sum, 10000);
}

// One piece from end to end, in runs that many threads join at once: large enough, or just not.
TEST(SmallPieces, CanWindThroughTheWholeGrid)
{
  Signs snake{ { 130, 71, 3 }, std::vector<char>(130 * 71 * 3, 0) };
  std::int64_t size = 0;
  ForEachPoint(snake.Dims,
    [&](const Point& p)
    {
      const bool turns = p[1] % 4 == 1 ? p[0] == 128 : p[0] == 0;
      if (p[2] == 1 && (p[1] % 2 == 0 || turns))
      {
        snake.Above[snake.Index(p)] = 1;
        ++size;
      }
    });
  for (int repetition = 0; repetition < 10; ++repetition)
  {
    for (const bool stays : { true, false })
    {
      Signs found = snake;
      EXPECT_EQ(RemoveByRuns(found, stays ? size : size + 1, test::ThreadedFor(4)), stays ? 0 : 1);
      EXPECT_EQ(std::count(found.Above.begin(), found.Above.end(), 1), stays ? size : 0);
    }
  }
}

namespace
{

void ExpectSameForThreads(const Signs& signs, std::int64_t minimum, std::int64_t least)
{
  Signs expected = signs;
  const std::int64_t removed = RemoveByRuns(expected, minimum, SerialFor);
  EXPECT_GE(removed, least);
  for (int repetition = 0; repetition < 15; ++repetition)
  {
    Signs found = signs;
    ASSERT_EQ(RemoveByRuns(found, minimum, test::ThreadedFor(4)), removed);
    ASSERT_EQ(found, expected);
  }
}

}

// Where threads are likely to meet: large pieces with few ways through them, so that one lost join
// parts them, and a piece that all threads add to, and that needs its last sample to stay.
TEST(SmallPieces, AreTheSameForManyThreads)
{
  std::mt19937 random(18);
  Signs layers = RandomSigns({ 128, 64, 256 }, 0.5, random);
  Signs comb = layers;
  ForEachPoint(layers.Dims,
    [&](const Point& p)
    {
      layers.Above[layers.Index(p)] &= p[0] % 2 == 0 ? 1 : 0;
      comb.Above[comb.Index(p)] = p[2] == 0 || (p[0] % 4 == 0 && p[1] % 2 == 0) ? 1 : 0;
    });
  ExpectSameForThreads(layers, 100, 10000);
  ExpectSameForThreads(RandomSigns({ 128, 64, 256 }, 0.2, random), 1000, 10000);
  ExpectSameForThreads(comb, std::count(comb.Above.begin(), comb.Above.end(), 1), 0);
}

TEST(SmallPieces, AreGoneAfterwards)
{
  std::mt19937 random(12);
  for (const std::array<int, 3>& dims : Sizes)
  {
    for (const double density : { 0.1, 0.3, 0.5, 0.9 })
    {
      for (const std::int64_t minimum : { 3, 30 })
      {
        Signs signs = RandomSigns(dims, density, random);
        RemoveByRuns(signs, minimum, SerialFor);
        const Signs once = signs;
        const bool holdsOne = dims[0] * dims[1] * dims[2] >= minimum;
        for (const bool above : { true, false })
        {
          for (const std::vector<Point>& piece : PiecesOf(signs, above))
          {
            EXPECT_EQ(static_cast<std::int64_t>(piece.size()) >= minimum, holdsOne);
          }
        }
        // A grid that is too small for any piece ends up above, each time.
        EXPECT_EQ(RemoveByRuns(signs, minimum, SerialFor), holdsOne ? 0 : 2);
        EXPECT_EQ(signs, once);
        EXPECT_TRUE(holdsOne || std::count(signs.Above.begin(), signs.Above.end(), 0) == 0);
      }
    }
  }
}

TEST(SmallPieces, LeaveNestedSurfacesNested)
{
  std::mt19937 random(13);
  std::int64_t between = 0;
  for (const std::array<int, 3>& dims : Sizes)
  {
    for (const double density : { 0.2, 0.5, 0.8, 0.95 })
    {
      for (const std::int64_t minimum : { 2, 6, 40 })
      {
        Signs lower = RandomSigns(dims, density, random);
        Signs upper = RandomSigns(dims, 0.9, random);
        std::transform(lower.Above.begin(), lower.Above.end(), upper.Above.begin(),
          upper.Above.begin(), [](char a, char b) { return static_cast<char>(a & b); });
        RemoveByRuns(lower, minimum, SerialFor);
        RemoveByRuns(upper, minimum, SerialFor);
        for (std::size_t i = 0; i < lower.Above.size(); ++i)
        {
          ASSERT_LE(upper.Above[i], lower.Above[i]);
          between += lower.Above[i] - upper.Above[i];
        }
      }
    }
  }
  EXPECT_GT(between, 1000);
}

namespace
{

/** A field, a region, and what is left of its surfaces. */
struct Case
{
  test::Field Field;
  Isoregion Region;
  std::int64_t Minimum = 0;
  std::array<Signs, 2> Left; ///< by surface
  std::int64_t Removed = 0;

  Case(const test::Field& field, const Isoregion& region, std::int64_t minimum)
    : Field(field)
    , Region(region)
    , Minimum(minimum)
  {
    for (int surface = 0; surface < region.SurfaceCount(); ++surface)
    {
      this->Left[surface].Dims = field.Dims;
      for (const float value : field.Samples)
      {
        this->Left[surface].Above.push_back(region.IsAbove(surface, value) ? 1 : 0);
      }
      this->Removed += RemoveByFlooding(this->Left[surface], minimum);
    }
  }

  float Value(const Point& p) const { return this->Field.Samples[this->Left[0].Index(p)]; }
  bool IsAbove(int surface, const Point& p) const { return this->Left[surface].At(p); }
  int Sign(const Point& p) const
  {
    return (this->IsAbove(0, p) ? 1 : 0) + (this->Region.IsVolume() && this->IsAbove(1, p) ? 1 : 0);
  }
  bool IsFlipped(const Point& p) const
  {
    return this->Sign(p) != this->Region.SignOf(this->Value(p));
  }

  /** A field that has the signs that are left, and otherwise the same values. */
  test::Field LeftField() const
  {
    test::Field field = this->Field;
    const double lower = this->Region.Isovalue(0);
    const double upper = this->Region.Isovalue(this->Region.SurfaceCount() - 1);
    const std::array<double, 3> volumeValues = { lower - 1.0, 0.5 * (lower + upper), upper + 1.0 };
    ForEachPoint(field.Dims,
      [&](const Point& p)
      {
        if (this->IsFlipped(p))
        {
          const int sign = this->Sign(p);
          field.Samples[this->Left[0].Index(p)] = static_cast<float>(
            this->Region.IsVolume() ? volumeValues[sign] : lower + (sign > 0 ? 1.0 : -1.0));
        }
      });
    return field;
  }

  test::Built Build(BuildOptions options, const ParallelFor& parallelFor = SerialFor,
    Model model = Model::Minimal) const
  {
    options.MinimumPieceSize = this->Minimum;
    return { BuildIsodiamonds(model, this->Field.View(), this->Region, parallelFor, options),
      parallelFor };
  }
};

std::vector<Case> Cases()
{
  std::vector<test::Field> fields = { test::NoiseField({ 21, 18, 26 }, 5),
    test::NoiseField({ 17, 17, 17 }, 6), test::NoiseField({ 70, 7, 9 }, 7),
    test::SparseField({ 14, 13, 9 }, 8), test::BrokenField({ 17, 12, 15 }, 9),
    test::NoiseField({ 11, 2, 6 }, 10), test::WaveField({ 33, 20, 27 }) };
  std::mt19937 random(14);
  for (float& value : fields.back().Samples)
  {
    value += random() % 12 == 0 ? (random() % 2 == 0 ? 4.0F : -4.0F) : 0.0F;
  }
  std::vector<Case> cases;
  for (const test::Field& field : fields)
  {
    const double value = field.Isovalue;
    for (const std::int64_t minimum : { 2, 12, 100 })
    {
      cases.emplace_back(field, Isoregion(value), minimum);
      cases.emplace_back(field, Isoregion(value + 2.5), minimum);
      cases.emplace_back(field, Isoregion(value - 2.5), minimum);
      cases.emplace_back(field, Isoregion(value - 2.5, value + 2.0), minimum);
      cases.emplace_back(field, Isoregion(value - 0.5, value + 0.3), minimum);
    }
  }
  return cases;
}

std::string NameOf(const Case& one)
{
  std::ostringstream name;
  name << one.Field.Name << ", " << one.Region.Isovalue(0) << " to "
       << one.Region.Isovalue(one.Region.SurfaceCount() - 1) << ", minimum " << one.Minimum;
  return name.str();
}

std::vector<int> SignsOf(const Encoding& encoding)
{
  std::vector<int> signs;
  for (const std::uint16_t record : encoding.Arrays.Records)
  {
    signs.push_back(Record::Sign(record));
  }
  return signs;
}

}

TEST(SmallPieces, AreGoneOnAllScalesOfTheSigns)
{
  std::int64_t flipped = 0;
  for (const Case& one : Cases())
  {
    SCOPED_TRACE(NameOf(one));
    const Grid grid(one.Field.Dims);
    const SignLattice signs(grid, one.Field.View(), one.Region, test::ThreadedFor(2), one.Minimum);
    EXPECT_EQ(signs.RemovedPieces(), one.Removed);
    for (int scale = 0; scale <= grid.Depth(); ++scale)
    {
      ForEachPoint(grid.SampledPositions(scale),
        [&](const Point& position)
        {
          const Point p = (1 << scale) * position;
          ASSERT_EQ(signs.Sign(scale, position), one.Sign(p));
          flipped += one.IsFlipped(p) ? 1 : 0;
        });
    }
  }
  EXPECT_GT(flipped, 10000);
}

// Everything but errors, values inside and isovertices of long edges is as for a field that has the
// signs that are left.
TEST(SmallPieces, LeaveTheHierarchyOfAFieldWithoutThem)
{
  std::int64_t removed = 0;
  for (const Case& one : Cases())
  {
    SCOPED_TRACE(NameOf(one));
    const test::Field left = one.LeftField();
    for (const Model model : { Model::Relevant, Model::Minimal })
    {
      const test::Built found = one.Build({}, SerialFor, model);
      const test::Built expected(
        BuildIsodiamonds(model, left.View(), one.Region, SerialFor), SerialFor);
      EXPECT_EQ(found.Encoding.Header.MinimumPieceSize, one.Minimum);
      EXPECT_EQ(found.Encoding.Header.RemovedPieces, one.Removed);
      EXPECT_EQ(expected.Encoding.Header.RemovedPieces, 0);
      EXPECT_EQ(found.Encoding.Header.ActiveCount, expected.Encoding.Header.ActiveCount);
      EXPECT_EQ(found.Encoding.Header.CreationCount, expected.Encoding.Header.CreationCount);
      EXPECT_EQ(found.Encoding.Header.RelevantCount, expected.Encoding.Header.RelevantCount);
      EXPECT_EQ(found.Encoding.Arrays.BrickIndices, expected.Encoding.Arrays.BrickIndices);
      EXPECT_EQ(found.Encoding.Arrays.BrickMasks, expected.Encoding.Arrays.BrickMasks);
      EXPECT_EQ(SignsOf(found.Encoding), SignsOf(expected.Encoding));
      EXPECT_EQ(
        found.Encoding.Arrays.Isovertices.size(), expected.Encoding.Arrays.Isovertices.size());
      removed += one.Removed;
    }
  }
  EXPECT_GT(removed, 1000);
}

TEST(SmallPieces, LeaveTheMeshOfFullResolutionOfAFieldWithoutThem)
{
  std::size_t triangles = 0;
  for (const Case& one : Cases())
  {
    SCOPED_TRACE(NameOf(one));
    const test::Field left = one.LeftField();
    const test::Built expected(
      BuildIsodiamonds(Model::Minimal, left.View(), one.Region, SerialFor), SerialFor);
    for (const BuildOptions& options : { BuildOptions(), test::Placement(false) })
    {
      const test::Built found = one.Build(options);
      if (one.Region.IsVolume())
      {
        const test::Volume a = test::ExtractVolume(*found.Hierarchy, 0.0);
        const test::Volume b = test::ExtractVolume(*expected.Hierarchy, 0.0);
        EXPECT_EQ(a.Surfaces, b.Surfaces);
        EXPECT_EQ(a.Levels, b.Levels);
        EXPECT_EQ(a.Tetrahedra, b.Tetrahedra);
        continue;
      }
      const test::Mesh mesh = test::Extract(*found.Hierarchy, 0.0);
      EXPECT_TRUE(mesh == test::Extract(*expected.Hierarchy, 0.0));
      std::size_t ends = 0;
      ForEachPoint(one.Field.Dims,
        [&](const Point& p)
        {
          for (const Point& q : Neighbours(one.Field.Dims, p))
          {
            ends += one.Sign(p) != one.Sign(q) ? 1 : 0;
          }
        });
      EXPECT_EQ(mesh.Points.size(), ends / 2);
      triangles += mesh.Triangles.size();
    }
  }
  EXPECT_GT(triangles, 10000U);
}

namespace
{

/** An edge of the hierarchy from its centre on: its steps, or one step for linear isovertices. */
struct Edge
{
  std::vector<double> Values;
  std::vector<int> Signs;

  int Steps() const { return static_cast<int>(this->Values.size()) - 1; }
  bool Crosses(int surface, int step) const
  {
    return (this->Signs[step] > surface) != (this->Signs[step + 1] > surface);
  }
  /** Whether two values are both on the sides that the signs say. */
  bool AreTrue(const Isoregion& region, int surface, int first, int last) const
  {
    return region.IsAbove(surface, this->Values[first]) == (this->Signs[first] > surface) &&
      region.IsAbove(surface, this->Values[last]) == (this->Signs[last] > surface);
  }
  double LinearPlace(const Isoregion& region, int surface, int first, int last) const
  {
    const double place =
      (region.Isovalue(surface) - this->Values[first]) / (this->Values[last] - this->Values[first]);
    const bool isFinite = std::isfinite(this->Values[first]) && std::isfinite(this->Values[last]);
    return isFinite && this->AreTrue(region, surface, first, last) ? place : 0.5;
  }
};

Edge EdgeOf(const Case& one, const Place& place, int edge, bool exact)
{
  const Point offset = tables::Parities[Parity(place.Position)].Offsets[edge];
  const int length = 1 << place.Scale;
  Edge result;
  for (int i = 0; i <= length; i += exact ? 1 : length)
  {
    result.Values.push_back(one.Value(Centre(place) + i * offset));
    result.Signs.push_back(one.Sign(Centre(place) + i * offset));
  }
  return result;
}

int CodeOf(double position)
{
  return static_cast<int>(std::clamp(std::floor(256.0 * position + 0.5), 1.0, 255.0));
}

/** The crossing nearest to the guess, which is the middle if the sign of an end has changed. */
int ExpectedCoefficient(const Edge& edge, const Isoregion& region, int surface)
{
  const int steps = edge.Steps();
  if (!std::isfinite(edge.Values.front()) || !std::isfinite(edge.Values.back()))
  {
    return 128;
  }
  const double guess = steps * edge.LinearPlace(region, surface, 0, steps);
  double best = -1e9;
  for (int i = 0; i < steps; ++i)
  {
    const double crossing = i + edge.LinearPlace(region, surface, i, i + 1);
    if (edge.Crosses(surface, i) && std::abs(crossing - guess) < std::abs(best - guess) - 1e-9)
    {
      best = crossing;
    }
  }
  return CodeOf(best / steps);
}

/** For an edge from below to above, seen from below: the first crossing of the upper surface, and
 *  the last one of the lower surface before it. */
std::array<int, 2> ExpectedCoefficients(Edge edge, const Isoregion& region)
{
  const bool falling = edge.Signs.front() == 2;
  const int steps = edge.Steps();
  std::array<int, 2> codes = { 128, 128 };
  if (std::isfinite(edge.Values.front()) && std::isfinite(edge.Values.back()))
  {
    if (falling)
    {
      std::reverse(edge.Values.begin(), edge.Values.end());
      std::reverse(edge.Signs.begin(), edge.Signs.end());
    }
    const auto firstAbove = std::find(edge.Signs.begin(), edge.Signs.end(), 2);
    const int upper = static_cast<int>(firstAbove - edge.Signs.begin()) - 1;
    int lower = upper;
    while (edge.Signs[lower] != 0)
    {
      --lower;
    }
    const double onLower = (lower + edge.LinearPlace(region, 0, lower, lower + 1)) / steps;
    const double onUpper = (upper + edge.LinearPlace(region, 1, upper, upper + 1)) / steps;
    codes = falling ? std::array<int, 2>{ CodeOf(1.0 - onLower), CodeOf(1.0 - onUpper) }
                    : std::array<int, 2>{ CodeOf(onLower), CodeOf(onUpper) };
  }
  int& near = codes[falling ? 1 : 0];
  int& far = codes[falling ? 0 : 1];
  if (far <= near)
  {
    near = std::min(near, 254);
    far = near + 1;
  }
  return codes;
}

/** How many isovertices there are on edges with an end whose sign has changed. */
struct Changed
{
  std::int64_t Single = 0;
  std::int64_t Both = 0;
};

void ExpectCoefficients(const Case& one, bool exact, Changed& changed)
{
  const test::Built built = one.Build(test::Placement(exact));
  const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
  hierarchy.Diamonds().ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      const std::uint8_t* found = hierarchy.Isovertices(rank);
      const std::uint32_t upper = one.Region.IsVolume() ? hierarchy.UpperEdges(rank) : 0;
      for (int surface = 0; surface < one.Region.SurfaceCount(); ++surface)
      {
        ForEachBit(surface == 0 ? hierarchy.Edges(rank) : upper,
          [&](int number)
          {
            const Edge edge = EdgeOf(one, place, number, exact);
            const bool isBoth = ((hierarchy.Edges(rank) & upper) >> number & 1U) != 0;
            const int expected = isBoth ? ExpectedCoefficients(edge, one.Region)[surface]
                                        : ExpectedCoefficient(edge, one.Region, surface);
            ASSERT_EQ(int{ *found++ }, expected) << place.Scale << ", edge " << number;
            const bool isChanged = !edge.AreTrue(one.Region, surface, 0, edge.Steps());
            (isBoth ? changed.Both : changed.Single) += isChanged ? 1 : 0;
            ASSERT_TRUE(place.Scale > 0 || !isChanged); // never at full resolution
          });
      }
    });
}

}

TEST(SmallPieces, LeaveIsoverticesWhereTheSignsThatAreLeftChange)
{
  for (const bool exact : { true, false })
  {
    Changed changed;
    for (const Case& one : Cases())
    {
      SCOPED_TRACE(NameOf(one));
      ExpectCoefficients(one, exact, changed);
    }
    EXPECT_GT(changed.Single, 1000);
    EXPECT_GT(changed.Both, 30);
  }
}

TEST(SmallPieces, LeaveMeshesThatConformAtEveryTolerance)
{
  for (const Case& one : Cases())
  {
    if (one.Minimum != 12)
    {
      continue;
    }
    SCOPED_TRACE(NameOf(one));
    for (BuildOptions options : { BuildOptions(), test::Interior(true), test::Distance() })
    {
      options.RefineInterior = options.RefineInterior && one.Region.IsVolume();
      const test::Built built = one.Build(options);
      const IsodiamondHierarchy& hierarchy = *built.Hierarchy;
      for (const double part : { 0.0, 0.02, 0.1, 0.3, HUGE_VAL })
      {
        const double tolerance = part * hierarchy.Codes().Scale();
        ASSERT_EQ(one.Region.IsVolume()
            ? test::FindFault(test::ExtractVolume(hierarchy, tolerance, tolerance), one.Field.Dims)
            : test::FindFault(test::Extract(hierarchy, tolerance), one.Field.Dims),
          "");
      }
    }
  }
}

// Diamonds that reach beyond the grid, and had all their samples above the range or all below it,
// come to lie inside: their tetrahedra must not be missing.
TEST(SmallPieces, FillTheGridWhereTheyWereAtItsBoundary)
{
  for (const double outside : { -1.0, 3.0 })
  {
    test::Field field = test::WaveField({ 11, 11, 11 });
    ForEachPoint(field.Dims,
      [&](const Point& p)
      {
        field.Samples[p[0] + 11 * (p[1] + 11 * p[2])] =
          static_cast<float>(p[0] > 6 ? outside : 0.9 + 0.02 * (p[0] % 3 + p[1] % 5));
      });
    const Case one(field, Isoregion(0.0, 2.0), 500);
    ASSERT_EQ(one.Removed, 1);
    for (const BuildOptions& options : { BuildOptions(), test::Interior(true), test::Distance() })
    {
      const test::Built built = one.Build(options);
      for (const double tolerance : test::Tolerances(built.Hierarchy->Codes().Scale()))
      {
        const test::Volume volume = test::ExtractVolume(*built.Hierarchy, tolerance, tolerance);
        ASSERT_EQ(test::FindFault(volume, field.Dims), "");
        ASSERT_NEAR(test::TotalVolume(volume), 1000.0, 1e-6);
      }
    }
  }
}

// Values inside are the samples, even those that are not in the range.
TEST(SmallPieces, DoNotChangeTheSamples)
{
  std::int64_t flipped = 0;
  for (const Case& one : Cases())
  {
    if (!one.Region.IsVolume())
    {
      continue;
    }
    const test::Built built = one.Build(test::Interior(true));
    const auto& values = std::get<std::vector<float>>(built.Encoding.InsideValues);
    std::size_t next = 0;
    built.Hierarchy->Diamonds().ForEach(
      [&](const Place& place, std::uint32_t rank)
      {
        if (built.Hierarchy->Sign(rank) == InsideSign)
        {
          const float expected = one.Value(Centre(place));
          ASSERT_TRUE(values.at(next) == expected || std::isnan(expected));
          ++next;
          flipped += one.IsFlipped(Centre(place)) ? 1 : 0;
        }
      });
    EXPECT_EQ(next, values.size());
  }
  EXPECT_GT(flipped, 100);
}

TEST(SmallPieces, DoNotDependOnThreads)
{
  const test::Field field = test::NoiseField({ 40, 33, 64 }, 15);
  for (const Isoregion& region : { Isoregion(6.5), Isoregion(1.5, 6.0) })
  {
    const Case one(field, region, 30);
    ASSERT_GT(one.Removed, 100);
    for (const BuildOptions& options : { BuildOptions(), test::Interior(true) })
    {
      test::ExpectSame(
        one.Build(options).Encoding, one.Build(options, test::ThreadedFor(3)).Encoding);
    }
  }
}

TEST(SmallPieces, OfNoneOrOneSampleAreNone)
{
  const test::Field field = test::NoiseField({ 17, 18, 19 }, 16);
  for (const Isoregion& region : { Isoregion(6.5), Isoregion(1.5, 6.0) })
  {
    BuildOptions options;
    const Encoding expected =
      BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options);
    options.MinimumPieceSize = 1;
    const Encoding found =
      BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options);
    test::ExpectSame(found, expected);
    EXPECT_EQ(found.Header.RemovedPieces, 0);
  }
}

TEST(SmallPieces, AreNotRemovedFromAHierarchyOfDiamonds)
{
  const test::Field field = test::NoiseField({ 9, 9, 9 }, 17);
  const test::BuiltScalars scalars = test::BuildScalars(field);
  const auto build = [&](std::int64_t minimum)
  {
    BuildOptions options;
    options.MinimumPieceSize = minimum;
    return BuildIsodiamonds(Model::Minimal, *scalars.Hierarchy, field.Isovalue, SerialFor, options);
  };
  EXPECT_NO_THROW(build(0));
  EXPECT_NO_THROW(build(1));
  EXPECT_THROW(build(2), std::invalid_argument);
  EXPECT_THROW(build(-1), std::invalid_argument);
  BuildOptions options;
  options.MinimumPieceSize = -1;
  EXPECT_THROW(BuildIsodiamonds(Model::Minimal, field.View(), field.Isovalue, SerialFor, options),
    std::invalid_argument);
}
