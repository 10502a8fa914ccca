// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_RefinedSet_h
#define isodiamond_RefinedSet_h

#include "IsodiamondHierarchy.h"
#include "Query.h"

#include <vector>

namespace isodiamond
{

/**
 * The subdivided diamonds of a query, a mask for every brick.
 *
 * Without a region of interest that is R(t) = {threshold > t}: no front, no closure, the thresholds
 * have them (see Activation.h). With one it is the smallest closed superset of R(outside tolerance)
 * and of those active and creation diamonds of R(tolerance) that touch the region: inside, the mesh
 * is the uniform one; outside it is what conformity needs.
 *
 * The corners of the base cube always count as subdivided. Leaves of the current mesh are the
 * half-tetrahedra of refined diamonds whose child is not refined.
 */
class RefinedSet
{
public:
  RefinedSet(
    const IsodiamondHierarchy& hierarchy, const Query& query, const ParallelFor& parallelFor);

  const IsodiamondHierarchy& Hierarchy() const { return this->Source; }

  /**
   * Whether this is full resolution. Then all that carries a surface lies at scale 0: the middle of
   * a coarser edge that the surface crosses, and the child of a coarser half-tetrahedron that has a
   * patch, are active diamonds, and refined.
   */
  bool IsFull() const { return this->Full; }

  /** The refined diamonds of a brick. */
  const BrickMask& Mask(int scale, std::int64_t brick) const { return this->Masks[scale][brick]; }

  /** Whether a diamond is refined; those that are not stored are not. */
  bool Contains(const Place& place) const
  {
    const BrickLevel& level = this->Source.Diamonds().Level(place.Scale);
    const std::int64_t index = level.Box.Index(BrickOf(place.Position));
    if (index < 0 || level.Lookup[index] < 0)
    {
      return false;
    }
    const BrickMask& mask = this->Masks[place.Scale][level.Lookup[index]];
    return ((mask[place.Position[2] & 7] >> BitOf(place.Position)) & 1U) != 0;
  }

  /** The same for a place in a brick's window. */
  bool Contains(const BrickWindow& window, const Place& place) const
  {
    const std::int32_t index = window.IndexAt(place.Position);
    return index >= 0 &&
      ((this->Masks[place.Scale][index][place.Position[2] & 7] >> BitOf(place.Position)) & 1U) != 0;
  }

  /** Number of refined diamonds, corners of the base cube not counted. */
  std::int64_t Count() const;

  /**
   * The size of the active front: the diamonds that are not refined but have a refined parent, or
   * the root alone. Of an MI only stored ones count, and of their parents too.
   */
  std::int64_t CountFront() const;

private:
  void RefineUniformly(double tolerance, double interiorTolerance, const ParallelFor& parallelFor);
  void RefineRegion(const Query& query, const ParallelFor& parallelFor);

  const IsodiamondHierarchy& Source;
  bool Full = false;
  std::vector<std::vector<BrickMask>> Masks;
};

/** Of a refined diamond's subdivision edges, those that are edges of the current mesh: the diamond
 *  centred at the edge's midpoint is not refined. */
inline std::uint32_t AliveEdges(const RefinedSet& refined, const Place& place, std::uint32_t edges)
{
  if (place.Scale == 0)
  {
    return edges;
  }
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  std::uint32_t alive = 0;
  ForEachBit(edges,
    [&](int edge)
    {
      const Place middle{ place.Scale - 1, 2 * place.Position + shape.Offsets[edge] };
      alive |= static_cast<std::uint32_t>(!refined.Contains(middle)) << edge;
    });
  return alive;
}

/** The index-space position of the isovertex on a subdivision edge. */
inline std::array<double, 3> IsovertexPosition(
  const Place& place, const Point& offset, std::uint8_t coefficient)
{
  const double along = coefficient / 256.0;
  const double h = 1 << place.Scale;
  return { h * (place.Position[0] + along * offset[0]), h * (place.Position[1] + along * offset[1]),
    h * (place.Position[2] + along * offset[2]) };
}

/** The vertices of a diamond that have a sample, as an edge mask. */
inline std::uint32_t SampledVertices(const Grid& grid, const Place& place, const TypeTable& shape)
{
  std::uint32_t mask = 0;
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    const Point vertex = (1 << place.Scale) * (place.Position + shape.Offsets[i]);
    mask |= static_cast<std::uint32_t>(grid.IsSampled(vertex)) << i;
  }
  return mask;
}

/** A leaf of the current mesh: a half-tetrahedron whose vertices all have samples. */
struct Leaf
{
  Place Parent;           ///< the refined diamond, whose centre is the leaf's youngest vertex
  std::uint32_t Rank = 0; ///< of the parent
  const TypeTable& Shape; ///< of the parent
  const HalfTetrahedron& Half;
  int Scale = 0;             ///< scale of the diamond that the leaf lies in; -1 at full resolution
  const BrickWindow& Window; ///< of the parent's brick
};

/**
 * The rank of the diamond that is centred at a vertex of a leaf's parent. None only if a file is
 * damaged: all vertices of a mesh that carry something are centres of stored diamonds.
 */
inline std::int64_t RankAtVertex(const DiamondSet& set, const Leaf& leaf, int vertex)
{
  Place place{ leaf.Parent.Scale, leaf.Parent.Position + leaf.Shape.Offsets[vertex] };
  if (Parity(place.Position) != 0)
  {
    const std::int32_t index = leaf.Window.IndexAt(place.Position);
    if (index < 0)
    {
      return DiamondSet::None;
    }
    const Brick& brick = set.Level(place.Scale).Bricks[index];
    const int z = place.Position[2] & 7;
    const int bit = BitOf(place.Position);
    return brick.Contains(z, bit) ? std::int64_t{ brick.Rank(z, bit) } : DiamondSet::None;
  }
  while (Parity(place.Position) == 0 && place.Scale < set.ScaleCount() - 1)
  {
    place = { place.Scale + 1,
      { place.Position[0] >> 1, place.Position[1] >> 1, place.Position[2] >> 1 } };
  }
  return set.Rank(place);
}

/** All positions of a brick. */
inline BrickMask EveryPosition()
{
  BrickMask mask{};
  mask.fill(~std::uint64_t{ 0 });
  return mask;
}

/** The positions of a brick that have diamonds of class 2: one coordinate is odd. */
inline BrickMask ClassTwoPositions()
{
  BrickMask mask{};
  for (int z = 0; z < 8; ++z)
  {
    for (int bit = 0; bit < 64; ++bit)
    {
      const int parity = Parity(PositionOf({ 0, 0, 0 }, z, bit));
      mask[z] |= static_cast<std::uint64_t>(tables::Parities[parity].DiamondClass == 2) << bit;
    }
  }
  return mask;
}

/**
 * Calls body(leaf) for the leaves of one brick's refined diamonds.
 *
 * @param crossed(rank) mask of the subdivision edges that make a half-tetrahedron wanted: it is
 *        visited if it has one of them
 * @param among the positions that are looked at
 */
template <typename Crossed, typename Body>
void ForEachLeaf(const RefinedSet& refined, const BrickPlace& brickPlace, Crossed&& crossed,
  Body&& body, const BrickMask& among = EveryPosition())
{
  const IsodiamondHierarchy& hierarchy = refined.Hierarchy();
  const Grid& grid = hierarchy.Domain();
  const BrickLevel& level = hierarchy.Diamonds().Level(brickPlace.Scale);
  const Brick& brick = level.Bricks[brickPlace.Index];
  const BrickMask& mask = refined.Mask(brickPlace.Scale, brickPlace.Index);
  const BrickWindow window(level, brick);
  const Point& origin = window.First();
  const bool interior = origin[0] > 0 && origin[1] > 0 && origin[2] > 0 &&
    grid.IsSampled((1 << brickPlace.Scale) * (origin + Point{ 8, 8, 8 }));
  for (int z = 0; z < 8; ++z)
  {
    ForEachBit(mask[z] & among[z],
      [&](int bit)
      {
        const Place place{ brickPlace.Scale, PositionOf(origin, z, bit) };
        const std::uint32_t rank = brick.Rank(z, bit);
        const std::uint32_t wanted = crossed(rank);
        if (wanted == 0)
        {
          return;
        }
        const TypeTable& shape = ShapeOf(place.Position);
        const std::uint32_t sampled = interior ? 0x3ffU : SampledVertices(grid, place, shape);
        for (int child = 0; child < shape.ChildCount; ++child)
        {
          if ((shape.ChildMasks[child] & wanted) == 0)
          {
            continue;
          }
          const Place childPlace = ChildPlace(shape, place, child);
          const bool isRefined = shape.ChildStep == 0
            ? refined.Contains(window, childPlace)
            : childPlace.Scale >= 0 && refined.Contains(childPlace);
          if (isRefined)
          {
            continue;
          }
          const HalfTetrahedron* half = &shape.HalfTetrahedra[child * shape.HalfTetrahedraPerChild];
          for (int i = 0; i < shape.HalfTetrahedraPerChild; ++i, ++half)
          {
            if ((half->Mask & wanted) != 0 && (half->Mask & ~sampled) == 0)
            {
              body(Leaf{ place, rank, shape, *half, childPlace.Scale, window });
            }
          }
        }
      });
  }
}

}

#endif
