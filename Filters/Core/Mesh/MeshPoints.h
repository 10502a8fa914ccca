// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshPoints_h
#define isodiamond_MeshPoints_h

#include "Field/AffineMap.h"
#include "Field/Vector.h"
#include "Mesh/ExtractionPasses.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/**
 * @file MeshPoints.h
 * The points of an extracted mesh one by one, for code that needs to know more about them than
 * their positions.
 */
namespace isodiamond
{

/** The index-space position of the isovertex on a subdivision edge. */
inline std::array<double, 3> IsovertexPosition(
  const Place& place, const Point& offset, std::uint8_t coefficient)
{
  const double along = coefficient / 256.0;
  const double h = 1 << place.Scale;
  return { h * (place.Position[0] + along * offset[0]), h * (place.Position[1] + along * offset[1]),
    h * (place.Position[2] + along * offset[2]) };
}

/** A point of a mesh. */
struct MeshPoint
{
  std::int64_t Id = 0;     ///< in the mesh
  Vector Index{};          ///< position in index space
  int Surface = 0;         ///< -1 on the lower surface, or the isosurface; 1 on the upper; 0 inside
  std::int64_t Stored = 0; ///< its number among the stored isovertices, or inside values
};

/**
 * Calls body(point) for the points of one diamond.
 *
 * @param rank among the stored diamonds @param insideValue number of the diamond's inside value, if
 * it has one
 */
template <typename Body>
void ForEachPointOf(const IsodiamondHierarchy& hierarchy, const Place& place, std::uint32_t rank,
  const DiamondPoints& own, std::int64_t insideValue, Body&& body)
{
  MeshPoint point;
  point.Id = own.First;
  if (own.HasCentre())
  {
    const Point centre = Centre(place);
    point.Index = { 1.0 * centre[0], 1.0 * centre[1], 1.0 * centre[2] };
    point.Stored = insideValue;
    body(point);
    ++point.Id;
  }
  std::int64_t first = hierarchy.FirstIsovertexOf(rank);
  const auto visit = [&](int surface, std::uint32_t edges)
  {
    point.Surface = 2 * surface - 1;
    ForEachBit(own.Edges(surface),
      [&](int edge)
      {
        point.Stored = first + PopCount(edges & ((1U << edge) - 1U));
        point.Index =
          IsovertexPosition(place, tables::Parities[Parity(place.Position)].Offsets[edge],
            hierarchy.Isovertex(point.Stored));
        body(point);
        ++point.Id;
      });
    first += PopCount(edges);
  };
  visit(0, hierarchy.Edges(rank));
  if (hierarchy.Region().IsVolume())
  {
    visit(1, hierarchy.UpperEdges(rank));
  }
}

/** Calls body(point) for the points of one brick of the whole mesh, in the order of their ids. */
template <typename Body>
void ForEachPointOfBrick(const ExtractionPasses& passes, std::int64_t brick, Body&& body)
{
  const IsodiamondHierarchy& hierarchy = passes.Hierarchy();
  const bool isVolume = hierarchy.Region().IsVolume();
  const RefinedBrick refined = passes.BrickAt(brick);
  std::uint32_t next = refined.StoredBrick().First;
  std::int64_t inside = isVolume ? hierarchy.FirstInsideValue(refined.StoredNumber()) : 0;
  passes.ForEachDiamondWithPoints(brick,
    [&](const Place& place, std::uint32_t rank, const DiamondPoints& own)
    {
      for (; isVolume && next < rank; ++next)
      {
        inside += hierarchy.Sign(next) == InsideSign ? 1 : 0;
      }
      ForEachPointOf(hierarchy, place, rank, own, inside, body);
    });
}

/** Calls body(point) for those points of one brick that are left, in the same way. */
template <typename Body>
void ForEachKeptPointOfBrick(const ExtractionPasses& passes, std::int64_t brick, Body&& body)
{
  const KeptPoints* const kept = passes.PointsKept();
  if (kept == nullptr)
  {
    ForEachPointOfBrick(passes, brick, body);
    return;
  }
  ForEachPointOfBrick(passes, brick,
    [&](MeshPoint point)
    {
      if (kept->Contains(point.Id))
      {
        point.Id = kept->NewId(point.Id);
        body(point);
      }
    });
}

/** Calls body(point) for those points of a mesh that are left; bricks in parallel, the points of
 *  each in the order of their ids. */
template <typename Body>
void ForEachPoint(const ExtractionPasses& passes, Body&& body)
{
  passes.ForEachBrickWithPoints(
    [&](std::int64_t brick) { ForEachKeptPointOfBrick(passes, brick, body); });
}

/** Points that are near each other: some of one brick's. */
using PointGroup = std::vector<MeshPoint>;
/** No group has more: what is around one, such as gradients, fits into the processor's cache. */
inline constexpr std::size_t MostInGroup = 256;

/** Calls body(group) for the points that visit(each) calls each(point) with, in order. */
template <typename Visit, typename Body>
void InGroups(Visit&& visit, Body&& body)
{
  PointGroup group;
  group.reserve(MostInGroup);
  visit(
    [&](const MeshPoint& point)
    {
      group.push_back(point);
      if (group.size() == MostInGroup)
      {
        body(group);
        group.clear();
      }
    });
  if (!group.empty())
  {
    body(group);
  }
}

/** Calls body(group) for groups of the points that are left, in parallel. */
template <typename Body>
void ForEachPointGroup(const ExtractionPasses& passes, Body&& body)
{
  passes.ForEachBrickWithPoints([&](std::int64_t brick)
    { InGroups([&](auto&& each) { ForEachKeptPointOfBrick(passes, brick, each); }, body); });
}

/** The number of points that a hierarchy stores: its isovertices, then its inside values. */
inline std::int64_t StoredPointCount(const IsodiamondHierarchy& hierarchy)
{
  return hierarchy.IsovertexCount() +
    (hierarchy.Region().IsVolume() ? SizeOf(hierarchy.InsideValues()) : 0);
}

/** The number of a point among these. */
inline std::int64_t StoredNumber(const IsodiamondHierarchy& hierarchy, const MeshPoint& point)
{
  return point.Surface == 0 ? hierarchy.IsovertexCount() + point.Stored : point.Stored;
}

/** Calls body(point) for the points that a hierarchy stores in one brick; their ids are their
 *  numbers. @param number of the brick */
template <typename Body>
void ForEachStoredPointOfBrick(
  const IsodiamondHierarchy& hierarchy, const BrickPlace& place, std::int64_t number, Body&& body)
{
  const bool isVolume = hierarchy.Region().IsVolume();
  std::int64_t inside = isVolume ? hierarchy.FirstInsideValue(number) : 0;
  const DiamondSet& diamonds = hierarchy.Diamonds();
  diamonds.ForEachInBrick(place.Scale, diamonds.Level(place.Scale).Bricks[place.Index],
    [&](const Place& diamond, std::uint32_t rank)
    {
      const bool hasCentre = isVolume && hierarchy.Sign(rank) == InsideSign;
      DiamondPoints own;
      own.Bits = (hasCentre ? 1U << DiamondPoints::Centre : 0U) |
        hierarchy.Edges(rank) << DiamondPoints::Isovertex(0, 0) |
        (isVolume ? hierarchy.UpperEdges(rank) : 0U) << DiamondPoints::Isovertex(1, 0);
      ForEachPointOf(hierarchy, diamond, rank, own, inside,
        [&](MeshPoint point)
        {
          point.Id = StoredNumber(hierarchy, point);
          body(point);
        });
      inside += hasCentre ? 1 : 0;
    });
}

/** Calls body(group) for groups of the points that a hierarchy stores, in parallel; their ids are
 *  their numbers. Visits at least all those between two slices, both included. */
template <typename Body>
void ForEachStoredPointGroupNear(const IsodiamondHierarchy& hierarchy, int firstSlice,
  int lastSlice, const ParallelFor& parallelFor, Body&& body)
{
  const std::vector<BrickPlace> bricks = AllBricks(hierarchy.Diamonds());
  ForEachIndex(parallelFor, bricks.size(), 16,
    [&](std::int64_t i)
    {
      const auto [scale, index] = bricks[i];
      const BrickLevel& level = hierarchy.Diamonds().Level(scale);
      // A diamond reaches as far as the next position.
      const int z = level.Box.Origin(level.Bricks[index].BoxIndex)[2];
      if ((z + 8) << scale >= firstSlice && (z - 1) * (1 << scale) <= lastSlice)
      {
        InGroups(
          [&](auto&& each) { ForEachStoredPointOfBrick(hierarchy, bricks[i], i, each); }, body);
      }
    });
}

/** The same for all points that a hierarchy stores. */
template <typename Body>
void ForEachStoredPointGroup(
  const IsodiamondHierarchy& hierarchy, const ParallelFor& parallelFor, Body&& body)
{
  ForEachStoredPointGroupNear(
    hierarchy, 0, hierarchy.SampleGrid().Last(2), parallelFor, std::forward<Body>(body));
}

/** Writes 3 coordinates per point. */
template <typename Coordinate>
void WritePoints(const ExtractionPasses& passes, const AffineMap& world, Coordinate* points)
{
  ForEachPoint(passes,
    [&](const MeshPoint& point)
    {
      const Vector position = world(point.Index[0], point.Index[1], point.Index[2]);
      for (int axis = 0; axis < 3; ++axis)
      {
        points[3 * point.Id + axis] = static_cast<Coordinate>(position[axis]);
      }
    });
}

}

#endif
