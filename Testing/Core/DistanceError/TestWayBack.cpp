// SPDX-License-Identifier: BSD-3-Clause
// The way back of the distance metric: errors of all diamonds against brute force on the
// reference's patches, and the parts that it is made of. Whole meshes are in TestDistanceError.cpp.
#include "Build/ActivationThresholds.h"
#include "DistanceError/DistanceError.h"
#include "DistanceError/FineSurface.h"
#include "DistanceError/IsovertexClusters.h"
#include "DistanceError/SlabTest.h"
#include "DistanceError/SpineNeighbourhood.h"
#include "Patches/ConvexPolygon.h"
#include "Patches/WorldLengths.h"
#include "Tools/DistanceTestTools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>

using namespace isodiamond;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** A world that is mirrored, with no two lengths the same and no right angles. */
AffineMap Sheared()
{
  AffineMap world;
  world.Rows = { { { 0.8, 0.3, -0.2, 7 }, { 0.1, -1.1, 0.4, -2 }, { -0.3, 0.25, 1.4, 0.5 } } };
  return world;
}

std::vector<GridGeometry> Worlds(const std::array<int, 3>& dims)
{
  return { AffineMap(), test::Spacing(0.5, 2.0, 1.25), Sheared(),
    GridGeometry(test::UnevenCoordinates(dims, 4.0)),
    GridGeometry(test::UnevenCoordinates(dims, 100.0)) };
}

/** The length below which errors are not told apart: a part of the longest step. */
double LeastError(const GridGeometry& world)
{
  return std::visit(
    [](const auto& lengths) { return lengths.TypicalStep() / 64.0; }, WorldLengthsOf(world));
}

/** Calls body(tetrahedron, cell) for the finest tetrahedra of the reference that lie in the grid,
 *  and the cells that they lie in. */
template <typename Body>
void ForEachFinest(const reference::Hierarchy& hierarchy, const Body& body)
{
  const reference::DiamondSet all(hierarchy.Size(), true);
  for (const reference::Tetrahedron& tetrahedron : reference::LeafTetrahedra(hierarchy, all))
  {
    Point cell = tetrahedron.Vertices[0];
    bool isSampled = true;
    for (const reference::Point& vertex : tetrahedron.Vertices)
    {
      isSampled = isSampled && hierarchy.IsSampled(vertex);
      for (int axis = 0; axis < 3; ++axis)
      {
        cell[axis] = std::min(cell[axis], vertex[axis]);
      }
    }
    if (isSampled)
    {
      body(tetrahedron, cell);
    }
  }
}

/** Full resolution in index space, without hidden cells. */
test::SurfaceTriangles FinestTriangles(
  const reference::Hierarchy& hierarchy, const test::Field& field, const HiddenCells* hidden)
{
  const reference::ScalarField samples = field.Reference();
  test::SurfaceTriangles all;
  ForEachFinest(hierarchy,
    [&](const reference::Tetrahedron& tetrahedron, const Point& cell)
    {
      if (hidden == nullptr || !(*hidden)(cell))
      {
        for (const reference::SurfaceTriangle& triangle :
          reference::TrianglesOf(hierarchy, samples, field.Isovalue, tetrahedron, true))
        {
          all.push_back(triangle);
        }
      }
    });
  return all;
}

/** Gives the patches of a diamond on a surface, in index space. */
using PatchesOfDiamond = std::function<test::SurfaceTriangles(const Place&, int surface)>;

PatchesOfDiamond PatchesOfReference(
  const reference::Hierarchy& hierarchy, const test::Field& field, bool exact)
{
  return [&hierarchy, samples = field.Reference(), isovalue = field.Isovalue, exact](
           const Place& diamond, int)
  {
    test::SurfaceTriangles patches;
    for (const reference::Tetrahedron& tetrahedron :
      hierarchy.At(hierarchy.Find(Centre(diamond))).Tetrahedra)
    {
      for (const reference::SurfaceTriangle& triangle :
        reference::TrianglesOf(hierarchy, samples, isovalue, tetrahedron, exact))
      {
        patches.push_back(triangle);
      }
    }
    return patches;
  };
}

/** As extraction makes them: see DistanceError.PatchesAreTheSurfacesOfIntervalVolumes. */
PatchesOfDiamond PatchesOfLibrary(const IsodiamondHierarchy& hierarchy)
{
  return [&hierarchy](const Place& diamond, int surface)
  {
    test::SurfaceTriangles patches;
    SpineNeighbourhood(hierarchy).ForEachTetrahedron(diamond, true,
      [&](int, const HalfPlace& tetrahedron)
      {
        const SurfacePatch patch = PatchOf(hierarchy, tetrahedron.Rank, *tetrahedron.Half, surface);
        for (int i = 0; i < patch.TriangleCount; ++i)
        {
          reference::SurfaceTriangle triangle;
          for (int j = 0; j < 3; ++j)
          {
            const OwnedEdge owned = OwnedEdgeOf(tetrahedron, patch.Triangles[i][j]);
            const auto rank = static_cast<std::uint32_t>(hierarchy.Diamonds().Rank(owned.Owner));
            const FinePosition corner =
              IsovertexAt(hierarchy, owned.Owner, rank, owned.Edge, surface);
            triangle.Corners[j] = { corner[0] / 256.0, corner[1] / 256.0, corner[2] / 256.0 };
          }
          patches.push_back(triangle);
        }
      });
    return patches;
  };
}

/** How many errors were compared, and how many of them were raised, or are infinite. */
struct Seen
{
  int Compared = 0;
  int Raised = 0;
  int Always = 0;
};

/** One hierarchy's errors, before and after they are raised, and brute force. */
class WayBackCase
{
public:
  /** @param full the surface of full resolution in index space, or both of a volume */
  WayBackCase(const IsodiamondHierarchy& hierarchy, const AnySamples& samples,
    PatchesOfDiamond patches, const std::vector<test::SurfaceTriangles>& full)
    : Hierarchy(hierarchy)
    , Samples(samples)
    , Patches(std::move(patches))
    , Full(full)
  {
  }

  void Check(const GridGeometry& world, bool preserve, const HiddenCells* hidden, Seen& seen) const
  {
    MapBounds bounds(this->Hierarchy.Diamonds(), this->Hierarchy.Region().SurfaceCount());
    const std::vector<ErrorCode::Type> before = DistanceErrors(
      this->Hierarchy, Finiteness(this->Samples), world, preserve, SerialFor, {}, &bounds);
    const BeforeWayBack known{ hidden, seen.Compared % 3 != 0 ? &bounds : nullptr };
    std::vector<ErrorCode::Type> raised = before;
    RaiseByWayBack(this->Hierarchy, world, known, raised, SerialFor);
    std::vector<ErrorCode::Type> threaded = before;
    RaiseByWayBack(this->Hierarchy, world, known, threaded, test::ThreadedFor(3));
    EXPECT_TRUE(raised == threaded);
    this->CheckThresholds(before, raised, { hidden, &bounds }, world);

    std::vector<test::NearestTriangle> nearest;
    for (const test::SurfaceTriangles& full : this->Full)
    {
      nearest.emplace_back(test::Placed(full, world));
    }
    this->Hierarchy.Diamonds().ForEach(
      [&](const Place& place, std::uint32_t rank)
      {
        ASSERT_GE(raised[rank], before[rank]);
        if (before[rank] == 0 || before[rank] == ErrorCode::Always)
        {
          ASSERT_EQ(raised[rank], before[rank]);
          return;
        }
        seen.Raised += raised[rank] > before[rank] ? 1 : 0;
        seen.Always += raised[rank] == ErrorCode::Always ? 1 : 0;
        if (!testing::Test::HasFailure() && !(hidden != nullptr && hidden->Touch(place)))
        {
          this->Compare(place, world, nearest, { before[rank], raised[rank] }, seen);
        }
      });
  }

private:
  /** The work that thresholds spare the way back changes none of them by more than its rounding. */
  void CheckThresholds(const std::vector<ErrorCode::Type>& before,
    const std::vector<ErrorCode::Type>& raised, const BeforeWayBack& known,
    const GridGeometry& world) const
  {
    const auto thresholds = [&](const std::vector<ErrorCode::Type>& codes)
    {
      return ActivationThresholds(
        this->Hierarchy.SampleGrid(), this->Hierarchy.Diamonds(), codes, SerialFor);
    };
    std::vector<ErrorCode::Type> spared = before;
    RaiseToThresholds(this->Hierarchy.SampleGrid(), this->Hierarchy.Diamonds(), spared, SerialFor);
    EXPECT_EQ(thresholds(spared), thresholds(before));
    EXPECT_EQ(FindFollowers(spared, thresholds(spared)), FindFollowers(before, thresholds(before)));
    RaiseByWayBack(this->Hierarchy, world, known, spared, SerialFor);
    const std::vector<ErrorCode::Type> expected = thresholds(raised);
    const std::vector<ErrorCode::Type> found = thresholds(spared);
    const ErrorCode code(DistanceErrorScale(this->Hierarchy.SampleGrid(), world));
    for (std::size_t rank = 0; rank < found.size(); ++rank)
    {
      ASSERT_EQ(spared[rank] == 0, before[rank] == 0) << "rank " << rank; // there is nothing
      const double least = LeastError(world);
      const double ratio =
        std::max(code.Decode(found[rank]), least) / std::max(code.Decode(expected[rank]), least);
      if (found[rank] != expected[rank])
      {
        ASSERT_GE(ratio, 1.0 / 1.5626) << "rank " << rank; // (5/4)^2 for two surfaces
        ASSERT_LE(ratio, 1.5626) << "rank " << rank;
      }
    }
  }

  void Compare(const Place& place, const GridGeometry& world,
    const std::vector<test::NearestTriangle>& nearest, const std::array<ErrorCode::Type, 2>& codes,
    Seen& seen) const
  {
    const ErrorCode code(DistanceErrorScale(this->Hierarchy.SampleGrid(), world));
    const double least = LeastError(world);
    test::SampledDistance sampled;
    for (std::size_t surface = 0; surface < nearest.size(); ++surface)
    {
      for (const reference::SurfaceTriangle& triangle :
        test::Placed(this->Patches(place, static_cast<int>(surface)), world))
      {
        sampled.Add(triangle, nearest[surface], 8.0 * least); // an eighth of a voxel
      }
    }
    const double found = code.Decode(codes[1]);
    ++seen.Compared;
    ASSERT_GE(found, sampled.Largest * (1.0 - 1e-9)) << Describe(place);
    // The greater of both ways, rounded up by a quarter for each surface, then to a code.
    const double forth = code.Decode(codes[0]);
    const double most =
      std::pow(1.25, nearest.size()) * std::max({ sampled.Largest + sampled.Gap, least, forth });
    ASSERT_LE(codes[1], code.Encode(most * (1.0 + 1e-9))) << Describe(place);
  }

  static std::string Describe(const Place& place)
  {
    const Point centre = Centre(place);
    return "scale " + std::to_string(place.Scale) + " centre " + std::to_string(centre[0]) + " " +
      std::to_string(centre[1]) + " " + std::to_string(centre[2]);
  }

  const IsodiamondHierarchy& Hierarchy;
  AnySamples Samples;
  PatchesOfDiamond Patches;
  const std::vector<test::SurfaceTriangles>& Full;
};

std::vector<test::Field> Fields()
{
  return { test::NoiseField({ 9, 9, 9 }, 61), test::SphereField({ 17, 17, 17 }),
    test::SparseField({ 17, 17, 17 }, 62), test::WaveField({ 10, 6, 13 }),
    test::BrokenField({ 9, 10, 8 }, 63), test::SphereField({ 12, 17, 9 }),
    test::NoiseField({ 11, 2, 6 }, 64), test::SphereField({ 2, 17, 3 }) };
}

}

TEST(WayBack, IsThatOfBruteForceForEveryDiamond)
{
  Seen seen;
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const std::vector<test::SurfaceTriangles> full = { FinestTriangles(hierarchy, field, nullptr) };
    int number = 0;
    for (const GridGeometry& world : Worlds(field.Dims))
    {
      SCOPED_TRACE("world " + std::to_string(number));
      const bool exact = number++ % 2 != 0;
      const test::Built relevant = test::Build(Model::Relevant, field, test::Placement(exact));
      const WayBackCase one(
        *relevant.Hierarchy, field.View(), PatchesOfReference(hierarchy, field, exact), full);
      one.Check(world, number % 3 != 0, nullptr, seen);
      if (HasFailure())
      {
        return;
      }
    }
  }
  EXPECT_GT(seen.Compared, 10000);
  EXPECT_GT(seen.Raised, 3000);
  EXPECT_EQ(seen.Always, 0);
}

// Tall volumes are measured some slices at a time; diamonds that need triangles of others are last.
TEST(WayBack, IsTheSameHoweverManyAreLeftForTheEndAtOnce)
{
  for (const test::Field& field :
    { test::SphereField({ 33, 34, 130 }), test::WaveField({ 33, 20, 97 }) })
  {
    SCOPED_TRACE(field.Name);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const GridGeometry world = AffineMap();
    const std::vector<ErrorCode::Type> before = DistanceErrors(
      *relevant.Hierarchy, Finiteness(field.View()), world, true, SerialFor, {}, nullptr);
    const auto raised = [&](int atOnce)
    {
      BeforeWayBack known;
      known.MostAtOnce = atOnce;
      std::vector<ErrorCode::Type> codes = before;
      RaiseByWayBack(*relevant.Hierarchy, world, known, codes, SerialFor);
      return codes;
    };
    const std::vector<ErrorCode::Type> expected = raised(std::numeric_limits<int>::max());
    EXPECT_TRUE(raised(1) == expected);
    EXPECT_TRUE(raised(3) == expected);
  }
}

TEST(WayBack, IsThatOfBruteForceOnBothSurfaces)
{
  Seen seen;
  for (const test::Field& field : { test::NoiseField({ 9, 9, 9 }, 61),
         test::SphereField({ 17, 17, 17 }), test::WaveField({ 10, 6, 13 }) })
  {
    const std::vector<reference::Isorange> ranges = test::RangesOf(field);
    for (const reference::Isorange& range : { ranges[0], ranges[1] })
    {
      SCOPED_TRACE(field.Name + " from " + std::to_string(range.Lower));
      const test::Built relevant(
        BuildIsodiamonds(Model::Relevant, field.View(), test::RegionOf(range), SerialFor),
        SerialFor);
      const test::Volume whole = test::ExtractVolume(*relevant.Hierarchy, 0.0);
      std::vector<test::SurfaceTriangles> full;
      for (const int surface : { -1, 1 })
      {
        full.push_back(test::Placed(whole, surface, AffineMap()));
      }
      const WayBackCase one(
        *relevant.Hierarchy, field.View(), PatchesOfLibrary(*relevant.Hierarchy), full);
      for (const GridGeometry& world :
        { GridGeometry(Sheared()), GridGeometry(test::UnevenCoordinates(field.Dims, 4.0)) })
      {
        one.Check(world, true, nullptr, seen);
        if (HasFailure())
        {
          return;
        }
      }
    }
  }
  EXPECT_GT(seen.Compared, 10000);
  EXPECT_GT(seen.Raised, 3000);
}

namespace
{

/** Hides one cell in so many, and all of a block. */
HiddenCells SomeHidden(const std::array<int, 3>& dims, unsigned oneIn, int blockEnd)
{
  std::mt19937 random(dims[0] + 7 * dims[1]);
  const std::array<int, 3> cells = { dims[0] - 1, dims[1] - 1, dims[2] - 1 };
  std::vector<std::uint8_t> hidden;
  for (int z = 0; z < cells[2]; ++z)
  {
    for (int y = 0; y < cells[1]; ++y)
    {
      for (int x = 0; x < cells[0]; ++x)
      {
        const bool inBlock = x < blockEnd && y < blockEnd && z < blockEnd;
        hidden.push_back(inBlock || (oneIn > 0 && random() % oneIn == 0) ? 1 : 0);
      }
    }
  }
  return { hidden, cells };
}

}

// Diamonds that touch hidden cells are not compared: whoever builds always subdivides them.
TEST(WayBack, LooksForNothingInHiddenCells)
{
  Seen seen;
  std::vector<test::Field> fields = Fields();
  fields.push_back(test::WaveField({ 17, 14, 11 }));
  for (const test::Field& field : fields)
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const test::Built relevant = test::Build(Model::Relevant, field);
    for (const unsigned oneIn : { 0U, 9U, 60U })
    {
      const HiddenCells hidden = SomeHidden(field.Dims, oneIn, oneIn == 0 ? 6 : 0);
      const std::vector<test::SurfaceTriangles> full = { FinestTriangles(
        hierarchy, field, &hidden) };
      const WayBackCase one(
        *relevant.Hierarchy, field.View(), PatchesOfReference(hierarchy, field, true), full);
      one.Check(oneIn == 9U ? GridGeometry(test::UnevenCoordinates(field.Dims, 4.0))
                            : GridGeometry(Sheared()),
        true, &hidden, seen);
      if (HasFailure())
      {
        return;
      }
    }
  }
  EXPECT_GT(seen.Compared, 3000);
  EXPECT_GT(seen.Raised, 500);
}

namespace
{

/** A triangle: the cell that it lies in, and its corners, sorted. */
using PlacedFine = std::pair<Point, std::array<Point, 3>>;

PlacedFine PlacedIn(const Point& cell, std::array<Point, 3> corners)
{
  std::sort(corners.begin(), corners.end());
  return { cell, corners };
}

std::vector<PlacedFine> TrianglesIn(const FineSurface& surface, const CellBox& box)
{
  std::vector<PlacedFine> found;
  surface.ForEachCell(box,
    [&](const Point& cell, const auto& triangles)
    {
      EXPECT_TRUE(box.Holds(cell));
      triangles(
        [&](const FineSurface::Triangle& triangle) {
          found.push_back(PlacedIn(cell, { triangle[0], triangle[1], triangle[2] }));
        });
      return true;
    });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<PlacedFine> ReferenceTriangles(
  const reference::Hierarchy& hierarchy, const test::Field& field, const HiddenCells& hidden)
{
  const reference::ScalarField samples = field.Reference();
  std::vector<PlacedFine> expected;
  ForEachFinest(hierarchy,
    [&](const reference::Tetrahedron& tetrahedron, const Point& cell)
    {
      for (const reference::SurfaceTriangle& triangle :
        reference::TrianglesOf(hierarchy, samples, field.Isovalue, tetrahedron, false))
      {
        std::array<Point, 3> corners{};
        for (int i = 0; i < 3; ++i)
        {
          for (int axis = 0; axis < 3; ++axis)
          {
            corners[i][axis] = static_cast<int>(std::lround(256.0 * triangle.Corners[i][axis]));
          }
        }
        if (!hidden(cell))
        {
          expected.push_back(PlacedIn(cell, corners));
        }
      }
    });
  std::sort(expected.begin(), expected.end());
  return expected;
}

}

TEST(FineSurface, HoldsTheTrianglesOfFullResolutionByCell)
{
  std::mt19937 random(5);
  std::vector<test::Field> fields = test::SmallFields();
  fields.push_back(test::NoiseField({ 20, 18, 27 }, 8));
  for (const test::Field& field : fields)
  {
    SCOPED_TRACE(field.Name);
    const reference::Hierarchy hierarchy(field.Dims);
    const test::Built relevant = test::Build(Model::Relevant, field);
    const HiddenCells some = SomeHidden(field.Dims, 5, 2);
    for (const HiddenCells& hidden : { HiddenCells(), some })
    {
      const FineSurface surface(
        *relevant.Hierarchy, 0, hidden.Any() ? &hidden : nullptr, test::ThreadedFor(2));
      const std::vector<PlacedFine> expected = ReferenceTriangles(hierarchy, field, hidden);
      ASSERT_TRUE(TrianglesIn(surface, surface.Whole()) == expected);
      for (int i = 0; i < 10; ++i)
      {
        CellBox box;
        for (int axis = 0; axis < 3; ++axis)
        {
          const int last = field.Dims[axis] - 1;
          box.Low[axis] = static_cast<int>(random() % last);
          box.High[axis] = box.Low[axis] + 1 + static_cast<int>(random() % (last - box.Low[axis]));
        }
        std::vector<PlacedFine> inBox;
        std::copy_if(expected.begin(), expected.end(), std::back_inserter(inBox),
          [&](const PlacedFine& triangle) { return box.Holds(triangle.first); });
        ASSERT_TRUE(TrianglesIn(surface, box) == inBox);
      }
    }
  }
}

TEST(FineSurface, StopsWhereItIsToldTo)
{
  const test::Field field = test::WaveField({ 17, 17, 17 });
  const test::Built relevant = test::Build(Model::Relevant, field);
  const FineSurface surface(*relevant.Hierarchy, 0, nullptr, SerialFor);
  int cells = 0;
  const auto count = [&](int most)
  {
    cells = 0;
    return surface.ForEachCell(
      surface.Whole(), [&](const Point&, const auto&) { return ++cells < most; });
  };
  EXPECT_TRUE(count(100000));
  EXPECT_GT(cells, 100);
  EXPECT_FALSE(count(10));
  EXPECT_EQ(cells, 10);
}

namespace
{

/** A field and what a test of slabs needs of it. */
class SlabField
{
public:
  explicit SlabField(const std::function<double(double, double, double)>& function,
    const AffineMap& world = AffineMap(), const HiddenCells* hidden = nullptr)
    : Lengths(world)
    , Balls(Lengths)
    , Relevant(test::Build(Model::Relevant, FieldOf(function)))
    , Fine(*Relevant.Hierarchy, 0, hidden, SerialFor)
  {
  }

  using Test = SlabTest<AffineLengths>;

  /** The test of a square piece around a middle, leaning by slopes along x and y. */
  Test TestOf(const Vector& middle, double half, double limit, const Vector& slopes = {}) const
  {
    this->Piece = {};
    for (const std::array<double, 2>& side : std::array<std::array<double, 2>, 4>{
           { { -half, -half }, { half, -half }, { half, half }, { -half, half } } })
    {
      this->Piece.Add(
        middle + Vector{ side[0], side[1], slopes[0] * side[0] + slopes[1] * side[1] });
    }
    const Vector across = { -slopes[0], -slopes[1], 1.0 };
    const Vector normal = (1.0 / std::sqrt(Dot(across, across))) * across;
    return Test(this->Piece, normal, 0.8 * limit, limit, this->Fine, this->Lengths, this->Balls);
  }

private:
  static test::Field FieldOf(const std::function<double(double, double, double)>& function)
  {
    test::Field field{ "slab", { 17, 17, 17 }, {}, 0.0 };
    for (int i = 0; i < 17 * 17 * 17; ++i)
    {
      field.Samples.push_back(
        static_cast<float>(function(i % 17, i / 17 % 17, i / 17 / 17))); // NOLINT: indices
    }
    return field;
  }

  AffineLengths Lengths;
  CellBalls<AffineLengths> Balls;
  test::Built Relevant;
  FineSurface Fine;
  mutable ConvexPolygon Piece;
};

}

TEST(SlabTest, TellsWhetherAPlanePassesWithinALimit)
{
  const SlabField plane([](double, double, double z) { return z - 8.25; });
  const Vector middle = { 7.3, 8.1, 8.0 };
  for (const double half : { 0.05, 0.5, 3.0, 6.0 })
  {
    const SlabField::Test within = plane.TestOf(middle, half, 0.3);
    EXPECT_TRUE(within.IsBetween());
    EXPECT_NEAR(within.Greatest(), 0.25, 1e-9);
    const SlabField::Test known = plane.TestOf(middle, half, 0.5);
    EXPECT_TRUE(known.IsBetween());
    EXPECT_EQ(known.Greatest(), 0.4);                          // no less than what is near enough
    EXPECT_FALSE(plane.TestOf(middle, half, 0.2).IsBetween()); // beyond
    EXPECT_FALSE(plane.TestOf({ 7.3, 8.1, 4.0 }, half, 1.0).IsBetween()); // far away
    EXPECT_TRUE(plane.TestOf({ 7.3, 8.1, 8.5 }, half, 0.3).IsBetween());
    EXPECT_FALSE(plane.TestOf({ 7.3, 8.1, 8.5 }, half, 0.2).IsBetween());
  }
}

TEST(SlabTest, TakesPiecesThatLean)
{
  // On both sides along x, the plane leaves the space between the copies.
  const SlabField plane([](double x, double, double z) { return z - 8.0 - 0.25 * (x - 8.0); });
  EXPECT_FALSE(plane.TestOf({ 8.0, 8.0, 8.0 }, 4.0, 0.5).IsBetween());
  EXPECT_TRUE(plane.TestOf({ 8.0, 8.0, 8.0 }, 1.0, 0.5).IsBetween());
  // A piece that leans with it.
  EXPECT_TRUE(plane.TestOf({ 8.0, 8.0, 8.0 }, 4.0, 0.02, { 0.25, 0.0, 0.0 }).IsBetween());
  EXPECT_FALSE(plane.TestOf({ 8.0, 8.0, 8.5 }, 4.0, 0.02, { 0.25, 0.0, 0.0 }).IsBetween());
}

TEST(SlabTest, DoesNotTakeTwoSheetsForOne)
{
  const SlabField sheets([](double, double, double z) { return 1.3 - std::abs(z - 8.0); });
  EXPECT_FALSE(sheets.TestOf({ 8.2, 8.1, 8.0 }, 2.0, 1.5).IsBetween());
  EXPECT_TRUE(sheets.TestOf({ 8.2, 8.1, 9.0 }, 2.0, 1.5).IsBetween()); // the upper one alone
}

TEST(SlabTest, SaysNoWhereCopiesLeaveTheGrid)
{
  const SlabField plane([](double, double, double z) { return z - 0.5; });
  EXPECT_TRUE(plane.TestOf({ 8.0, 8.0, 0.6 }, 2.0, 0.5).IsBetween());
  EXPECT_FALSE(plane.TestOf({ 8.0, 8.0, 0.6 }, 2.0, 0.7).IsBetween());
  const SlabField upright([](double x, double, double) { return x - 8.1; });
  EXPECT_FALSE(upright.TestOf({ 8.0, 8.0, 0.6 }, 2.0, 0.7).IsBetween());
  // A surface that ends at the grid's boundary, beside the piece.
  const SlabField ending([](double x, double, double z) { return z - 8.25 + 4.0 * (x - 15.0); });
  EXPECT_FALSE(ending.TestOf({ 14.0, 8.0, 8.0 }, 1.9, 0.6).IsBetween());
}

// Part of a triangle is between the copies, but beside the piece; over the piece it is beyond them.
TEST(SlabTest, CountsNoCrossingBeyondTheCopies)
{
  const SlabField plane([](double x, double, double z) { return z - 8.05 - 0.6 * (x - 8.0); });
  const std::array<double, 2> slopes = { 0.6, 0.0 };
  for (const double x : { 8.45, 8.55, 8.65, 8.75, 8.85 })
  {
    // Over the middle the plane is at this height.
    const double height = 0.05 + slopes[0] * (x - 8.0);
    for (const double part : { 0.3, 0.5, 0.7, 0.8 })
    {
      const SlabField::Test test = plane.TestOf({ x, 8.35, 8.0 }, 0.02, part * height);
      EXPECT_FALSE(test.IsBetween()) << "at " << x << " within " << part * height;
    }
  }
}

namespace
{

double AreaOf(const ConvexPolygon& polygon)
{
  Vector sum{};
  for (int i = 2; i < polygon.Count; ++i)
  {
    sum = sum +
      Cross(polygon.Corners[i - 1] - polygon.Corners[0], polygon.Corners[i] - polygon.Corners[0]);
  }
  return polygon.IsEmpty() ? 0.0 : 0.5 * std::sqrt(Dot(sum, sum));
}

Vector RandomVector(std::mt19937& random)
{
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  return { part(random), part(random), part(random) };
}

}

TEST(ConvexPolygon, IsSplitByPlanes)
{
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i)
  {
    ConvexPolygon whole;
    for (int corner = 0; corner < 3; ++corner)
    {
      whole.Add(RandomVector(random));
    }
    for (int cut = 0; cut < 5; ++cut)
    {
      // Anywhere, and through corners.
      const Vector point = i % 3 == 0 ? whole.Corners[random() % whole.Count] : whole.Middle();
      const Vector normal = RandomVector(random);
      ConvexPolygon above;
      ConvexPolygon below;
      KeepAbove(whole, point, normal, above);
      KeepAbove(whole, point, -1.0 * normal, below);
      ASSERT_NEAR(AreaOf(above) + AreaOf(below), AreaOf(whole), 1e-12);
      ASSERT_LE(above.Count, whole.Count + 1);
      if (!above.IsEmpty())
      {
        ASSERT_GE(above.Sides(point, normal)[0], -1e-12);
        ASSERT_LE(above.Sides(point, normal)[1], whole.Sides(point, normal)[1] + 1e-12);
        ASSERT_LE(above.SquaredRadius(point), whole.SquaredRadius(point) + 1e-12);
      }
      whole = AreaOf(above) > AreaOf(below) ? above : below;
    }
  }
}

// By rounding, its corners may lie on either side in turn.
TEST(ConvexPolygon, StaysWholeInThePlaneItself)
{
  for (const int count : { 5, 6, 7 })
  {
    ConvexPolygon ring;
    for (int i = 0; i < count; ++i)
    {
      ring.Add({ std::cos(2.0 * M_PI * i / count), std::sin(2.0 * M_PI * i / count),
        i % 2 == 0 ? 1e-16 : -1e-16 });
    }
    ConvexPolygon above;
    KeepAbove(ring, {}, { 0.0, 0.0, 1.0 }, above);
    EXPECT_LE(above.Count, ConvexPolygon::MostCorners);
    EXPECT_NEAR(AreaOf(above), AreaOf(ring), AreaOf(ring) / 2.0);
  }
}

TEST(ConvexPolygon, IsWholeOrEmptyBesidePlanes)
{
  ConvexPolygon triangle;
  triangle.Add({ 0.0, 0.0, 1.0 });
  triangle.Add({ 1.0, 0.0, 1.0 });
  triangle.Add({ 0.0, 1.0, 1.0 });
  ConvexPolygon above;
  KeepAbove(triangle, { 0.0, 0.0, 0.5 }, { 0.0, 0.0, 1.0 }, above);
  EXPECT_EQ(AreaOf(above), 0.5);
  KeepAbove(triangle, { 0.0, 0.0, 1.0 }, { 0.0, 0.0, 1.0 }, above); // in the plane
  EXPECT_EQ(AreaOf(above), 0.5);
  KeepAbove(triangle, { 0.0, 0.0, 1.5 }, { 0.0, 0.0, 1.0 }, above);
  EXPECT_TRUE(above.IsEmpty());
  KeepAbove(triangle, { 1.0, 0.0, 1.0 }, { 1.0, 0.0, 0.0 }, above); // a corner alone
  EXPECT_TRUE(above.IsEmpty());
  // A polygon that has the most corners already is not cut.
  ConvexPolygon full;
  for (int i = 0; i < ConvexPolygon::MostCorners; ++i)
  {
    full.Add({ std::cos(i * M_PI / 4.0), std::sin(i * M_PI / 4.0), 0.0 });
  }
  KeepAbove(full, {}, { 1.0, 0.0, 0.0 }, above);
  EXPECT_EQ(AreaOf(above), AreaOf(full));
}

namespace
{

/** Positions come back, and what is within a radius is in the box.
 *  @param last the last sample on each axis */
template <typename Lengths>
void ExpectIndexBoxes(const Lengths& lengths, const Point& last, std::mt19937& random)
{
  const auto anywhere = [&]
  {
    FinePosition position{};
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = static_cast<int>(random() % (FineUnits * last[axis] + 1));
    }
    return position;
  };
  for (int i = 0; i < 200; ++i)
  {
    const FinePosition position = anywhere();
    const Vector place = lengths(position);
    const auto point = lengths.IndexBox(place, 0.0);
    const FinePosition other = anywhere();
    const Vector way = lengths(other) - place;
    const auto box = lengths.IndexBox(place, std::sqrt(Dot(way, way)) * (1.0 + 1e-12));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double index = position[axis] / double{ FineUnits };
      ASSERT_NEAR(point.Low[axis], index, 1e-7);
      ASSERT_NEAR(point.High[axis], index, 1e-7);
      ASSERT_LE(box.Low[axis], other[axis] / double{ FineUnits } + 1e-7);
      ASSERT_GE(box.High[axis], other[axis] / double{ FineUnits } - 1e-7);
    }
  }
}

}

TEST(WorldLengths, IndexBoxHoldsWhatIsWithinARadius)
{
  std::mt19937 random(4);
  const Point last = { 12, 16, 8 };
  for (const AffineMap& map : { AffineMap(), test::Spacing(0.5, 2.0, -1.25), Sheared() })
  {
    ExpectIndexBoxes(AffineLengths(map), last, random);
  }
  for (const double ratio : { 1.0, 4.0, 100.0 })
  {
    const AxisCoordinates axes = test::UnevenCoordinates({ 13, 17, 9 }, ratio);
    ExpectIndexBoxes(AxesLengths(axes, 0), last, random);
    // With a layer of padding on all sides: also positions beyond the first and the last sample.
    ExpectIndexBoxes(AxesLengths(axes, 1), last + Point{ 2, 2, 2 }, random);
  }
}

TEST(WorldLengths, IndexBoxIsNoLargerThanNeedBe)
{
  const AffineLengths sheared(Sheared());
  const Vector middle = sheared(FinePosition{ 1000, 2000, 1500 });
  const auto box = sheared.IndexBox(middle, 1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    // The farthest of many positions on the ball.
    std::mt19937 random(axis);
    double farthest = 0.0;
    for (int i = 0; i < 5000; ++i)
    {
      const Vector any = RandomVector(random);
      const Vector on = middle + (1.0 / std::sqrt(Dot(any, any))) * any;
      farthest = std::max(farthest, sheared.IndexBox(on, 0.0).Low[axis]);
    }
    EXPECT_LE(farthest, box.High[axis]);
    const double reach = box.High[axis] - 0.5 * (box.Low[axis] + box.High[axis]);
    EXPECT_GT(farthest, box.High[axis] - 0.02 * reach);
  }
}
