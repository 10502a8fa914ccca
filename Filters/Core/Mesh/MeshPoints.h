// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshPoints_h
#define isodiamond_MeshPoints_h

#include "Field/AffineMap.h"
#include "Field/Vector.h"
#include "Mesh/ExtractionPasses.h"

#include <cstdint>
#include <utility>

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

/** Calls body(point) for all points of the whole mesh, in those bricks where some are left; bricks
 *  in parallel, the points of each in the order of their ids. */
template <typename Body>
void ForEachPointOfBricks(const ExtractionPasses& passes, Body&& body)
{
  const IsodiamondHierarchy& hierarchy = passes.Hierarchy();
  const bool isVolume = hierarchy.Region().IsVolume();
  passes.ForEachBrickWithPoints(
    [&](std::int64_t brick)
    {
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
    });
}

/** Calls body(point) for those points of a mesh that are left, in the same way. */
template <typename Body>
void ForEachPoint(const ExtractionPasses& passes, Body&& body)
{
  const KeptPoints* const kept = passes.PointsKept();
  if (kept == nullptr)
  {
    ForEachPointOfBricks(passes, body);
    return;
  }
  ForEachPointOfBricks(passes,
    [&](MeshPoint point)
    {
      if (kept->Contains(point.Id))
      {
        point.Id = kept->NewId(point.Id);
        body(point);
      }
    });
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

/** Calls body(point) for points that a hierarchy stores, in parallel; their ids are their numbers.
 *  Visits at least all those between two slices, both included. */
template <typename Body>
void ForEachStoredPointNear(const IsodiamondHierarchy& hierarchy, int firstSlice, int lastSlice,
  const ParallelFor& parallelFor, Body&& body)
{
  const bool isVolume = hierarchy.Region().IsVolume();
  const std::vector<BrickPlace> bricks = AllBricks(hierarchy.Diamonds());
  ForEachIndex(parallelFor, bricks.size(), 16,
    [&](std::int64_t i)
    {
      const BrickLevel& level = hierarchy.Diamonds().Level(bricks[i].Scale);
      // A diamond reaches as far as the next position.
      const int z = level.Box.Origin(level.Bricks[bricks[i].Index].BoxIndex)[2];
      if ((z + 8) << bricks[i].Scale < firstSlice || (z - 1) * (1 << bricks[i].Scale) > lastSlice)
      {
        return;
      }
      std::int64_t inside = isVolume ? hierarchy.FirstInsideValue(i) : 0;
      hierarchy.Diamonds().ForEachInBrick(bricks[i].Scale, level.Bricks[bricks[i].Index],
        [&](const Place& place, std::uint32_t rank)
        {
          const bool hasCentre = isVolume && hierarchy.Sign(rank) == InsideSign;
          DiamondPoints own;
          own.Bits = (hasCentre ? 1U << DiamondPoints::Centre : 0U) |
            hierarchy.Edges(rank) << DiamondPoints::Isovertex(0, 0) |
            (isVolume ? hierarchy.UpperEdges(rank) : 0U) << DiamondPoints::Isovertex(1, 0);
          ForEachPointOf(hierarchy, place, rank, own, inside,
            [&](MeshPoint point)
            {
              point.Id = StoredNumber(hierarchy, point);
              body(point);
            });
          inside += hasCentre ? 1 : 0;
        });
    });
}

/** The same for all points that a hierarchy stores. */
template <typename Body>
void ForEachStoredPoint(
  const IsodiamondHierarchy& hierarchy, const ParallelFor& parallelFor, Body&& body)
{
  ForEachStoredPointNear(
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
