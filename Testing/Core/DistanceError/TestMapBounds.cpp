// SPDX-License-Identifier: BSD-3-Clause
// The maps that bound the way back: by brute force, no point of a patch is farther from full
// resolution than its bound; and bounds are found where the surface is simple.
#include "DistanceError/DistanceError.h"
#include "DistanceError/DomainMap.h"
#include "DistanceError/MapBounds.h"
#include "Patches/WorldLengths.h"
#include "Tools/DistanceTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace isodiamond;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** A hierarchy with its full resolution, in a world without right angles. */
struct MapCase
{
  explicit MapCase(const test::Field& field)
    : Relevant(test::Build(Model::Relevant, field))
    , Full(test::Placed(test::Extract(*this->Relevant.Hierarchy, 0.0), this->World))
  {
  }

  const IsodiamondHierarchy& Hierarchy() const { return *this->Relevant.Hierarchy; }

  /** The triangles of a tetrahedron's patch, in the world. */
  test::SurfaceTriangles PatchOfTetrahedron(const HalfPlace& tetrahedron) const
  {
    const SurfacePatch patch = PatchOf(this->Hierarchy(), tetrahedron.Rank, *tetrahedron.Half, 0);
    test::SurfaceTriangles triangles;
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      reference::SurfaceTriangle triangle;
      for (int j = 0; j < 3; ++j)
      {
        const FinePosition corner =
          IsovertexOn(this->Hierarchy(), tetrahedron, patch.Triangles[i][j], 0);
        triangle.Corners[j] = { corner[0] / 256.0, corner[1] / 256.0, corner[2] / 256.0 };
      }
      triangles.push_back(triangle);
    }
    return test::Placed(triangles, this->World);
  }

  /** How far samples of triangles are from full resolution. */
  double Sampled(const test::SurfaceTriangles& triangles) const
  {
    test::SampledDistance sampled;
    for (const reference::SurfaceTriangle& triangle : triangles)
    {
      sampled.Add(triangle, this->Full, 0.125);
    }
    return sampled.Largest;
  }

  AffineMap World{
    { { { 0.8, 0.3, -0.2, 7 }, { 0.1, -1.1, 0.4, -2 }, { -0.3, 0.25, 1.4, 0.5 } } }
  };
  test::Built Relevant;
  test::NearestTriangle Full;
};

std::vector<test::Field> Fields()
{
  return { test::NoiseField({ 9, 9, 9 }, 71), test::SphereField({ 17, 17, 17 }),
    test::WaveField({ 10, 6, 13 }), test::SparseField({ 17, 17, 17 }, 72) };
}

}

TEST(MapBounds, BoundTheWayBackFromEveryFlatPatch)
{
  int count = 0;
  int all = 0;
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const MapCase map(field);
    const IsodiamondHierarchy& hierarchy = map.Hierarchy();
    MapBounds bounds(hierarchy.Diamonds(), 1);
    ASSERT_TRUE(bounds.AreWanted());
    DistanceErrors(hierarchy, Finiteness(field.View()), map.World, true, SerialFor, {}, &bounds);
    const ErrorCode code(DistanceErrorScale(hierarchy.SampleGrid(), map.World));
    const int before = count;
    hierarchy.Diamonds().ForEach(
      [&](const Place& diamond, std::uint32_t rank)
      {
        if (diamond.Scale == 0 || diamond.Scale == hierarchy.SampleGrid().Depth())
        {
          EXPECT_TRUE(bounds.Of(0, rank) == MapBounds::NoneOfDiamond);
          return; // scale 0 and the corners of the base cube have none
        }
        SpineNeighbourhood(hierarchy).ForEachTetrahedron(diamond, true,
          [&](int number, const HalfPlace& tetrahedron)
          {
            const test::SurfaceTriangles patch = map.PatchOfTetrahedron(tetrahedron);
            const ErrorCode::Type found = bounds.Of(0, rank)[number];
            const double bound = found != MapBounds::None ? code.Decode(found) : Infinity;
            ++all;
            if (patch.size() == 1 && bound < Infinity)
            {
              ++count;
              ASSERT_LE(map.Sampled(patch), bound * (1.0 + 1e-9) + 1e-12);
            }
          });
      });
    EXPECT_GT(count, before);
  }
  EXPECT_GT(count, all / 20);
}

TEST(DomainMap, BoundsTheWayBackFromAllPatches)
{
  int coarse = 0;
  for (const test::Field& field : Fields())
  {
    SCOPED_TRACE(field.Name);
    const MapCase map(field);
    const IsodiamondHierarchy& hierarchy = map.Hierarchy();
    const AffineLengths lengths(map.World);
    DomainMap<AffineLengths> domain(hierarchy, lengths, 0);
    int found = 0;
    int inside = 0;
    int all = 0;
    hierarchy.Diamonds().ForEach(
      [&](const Place& diamond, std::uint32_t)
      {
        if (diamond.Scale > 1 || hierarchy.SampleGrid().SticksOut(diamond.Position, diamond.Scale))
        {
          return;
        }
        NumberedPatches around;
        SpineNeighbourhood(hierarchy).FindPatches(diamond, 0, around);
        test::SurfaceTriangles patches;
        for (const NumberedPatch& patch : around)
        {
          for (const reference::SurfaceTriangle& triangle :
            map.PatchOfTetrahedron(patch.Tetrahedron))
          {
            patches.push_back(triangle);
          }
        }
        // Whatever goes to the patches must end up on them, where the lengths put them.
        test::SurfaceTriangles places;
        for (const NumberedPatch& patch : around)
        {
          for (int i = 0; i < patch.Patch.TriangleCount; ++i)
          {
            reference::SurfaceTriangle& triangle = places.emplace_back();
            for (int j = 0; j < 3; ++j)
            {
              triangle.Corners[j] =
                lengths(IsovertexOn(hierarchy, patch.Tetrahedron, patch.Patch.Triangles[i][j], 0));
            }
          }
        }
        const test::NearestTriangle onPatches(places);
        double beside = 0.0;
        const auto mayMove = [&](const Vector& place, double squared)
        {
          beside = squared < Infinity ? std::max(beside, onPatches.Distance(place)) : beside;
          return squared < Infinity;
        };
        // With and without a reason to leave the border of a patch.
        const double least = domain.Bound(
          diamond, around, [](double) { return false; }, mayMove);
        const double bound = domain.Bound(
          diamond, around, [](double) { return true; }, mayMove);
        ASSERT_LE(beside, 1e-9);
        if (patches.empty())
        {
          return;
        }
        const double sampled = map.Sampled(patches);
        ++all;
        found += bound < Infinity ? 1 : 0;
        coarse += bound < Infinity ? diamond.Scale : 0;
        inside += least < bound ? 1 : 0;
        ASSERT_LE(sampled, bound * (1.0 + 1e-9) + 1e-12);
        ASSERT_LE(sampled, least * (1.0 + 1e-9) + 1e-12);
      });
    EXPECT_GT(found, all / 3);
    EXPECT_GT(inside, all / 50);
  }
  EXPECT_GT(coarse, 50);
}
