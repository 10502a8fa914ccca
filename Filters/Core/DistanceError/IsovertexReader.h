// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsovertexReader_h
#define isodiamond_IsovertexReader_h

#include "DistanceError/FineDomain.h"
#include "DistanceError/IsovertexClusters.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace isodiamond
{

/**
 * Reads the isovertices of full resolution in the domain of a diamond off the hierarchy, for cases
 * where few diamonds need theirs and none are handed down.
 *
 * Isovertices are never at an end of their edge. So one that lies in a tetrahedron, a union of
 * those of full resolution, lies on an edge in it, and the edge's owner lies in it too.
 */
class IsovertexReader
{
public:
  /** Both must outlive it. */
  IsovertexReader(const IsodiamondHierarchy& hierarchy, const Finiteness& isFinite, int surface)
    : Hierarchy(hierarchy)
    , Level(hierarchy.Diamonds().Level(0))
    , IsFinite(isFinite)
    , Surface(surface)
  {
  }

  /** Calls body(eighth, its origin) for eighths of the bricks that have owners in a box of lattice
   *  points, ends included, until it returns false; eighth(use) calls use(position, whether both
   *  ends of its edge are finite) for these owners' isovertices. @return whether it never did */
  template <typename Body>
  bool ForEachEighth(const Point& low, const Point& high, const Body& body) const
  {
    bool goesOn = true;
    this->Level.ForEachBrickBetween(low, high,
      [&](std::int32_t brick, const Point& origin)
      {
        for (int octant = 0; octant < 8 && goesOn; ++octant)
        {
          const Point first = origin + 4 * Point{ octant & 1, octant >> 1 & 1, octant >> 2 };
          Point from{};
          Point to{};
          bool isEmpty = false;
          for (int axis = 0; axis < 3; ++axis)
          {
            from[axis] = std::max(low[axis], first[axis]);
            to[axis] = std::min(high[axis], first[axis] + 3);
            isEmpty = isEmpty || from[axis] > to[axis];
          }
          goesOn = isEmpty ||
            body([&](const auto& use) { this->ForEachBetween(brick, from, to, use); }, first);
        }
      });
    return goesOn;
  }

  /** Calls body(position, whether both ends are finite, edge of the domain) for the isovertices in
   *  the domain of a diamond of scale 0 or 1, except corners of its patches: these are at a
   *  distance of 0 and, as the centre has an edge to both ends of theirs, never the only ones. */
  template <typename Body>
  void ForEachInDomain(const Place& diamond, const Body& body)
  {
    const Point centre = Centre(diamond);
    if (!this->Window || BrickOf(this->WindowAt) != BrickOf(centre))
    {
      this->Window.emplace(this->Level, centre);
      this->WindowAt = centre;
    }
    for (const FineDomain::Owner& owner : FineDomainOf(diamond).Owners)
    {
      const Place place{ 0, centre + owner.Offset };
      const std::int64_t rank = this->Window->Rank(place.Position);
      if (rank != DiamondSet::None && !owner.IsOlder)
      {
        this->ForEachOf(place, static_cast<std::uint32_t>(rank), owner.EdgeMask,
          [&](const FinePosition& position, int edge)
          { body(position, AreEndsFinite(this->IsFinite, place, edge), owner.Edges[edge]); });
      }
    }
  }

private:
  /** Those of owners in a brick and in a box. */
  template <typename Body>
  void ForEachBetween(
    std::int32_t brickIndex, const Point& low, const Point& high, const Body& body) const
  {
    const Brick& brick = this->Level.Bricks[brickIndex];
    const Point origin = this->Level.Box.Origin(brick.BoxIndex);
    ForEachWordBetween(brick.Occupancy, origin, low, high,
      [&](int z, std::uint64_t bits)
      {
        ForEachBit(bits,
          [&](int bit)
          {
            const Place owner{ 0, PositionOf(origin, z, bit) };
            this->ForEachOf(owner, brick.Rank(z, bit), AllEdges,
              [&](const FinePosition& position, int edge)
              { body(position, AreEndsFinite(this->IsFinite, owner, edge)); });
          });
      });
  }

  template <typename Body>
  void ForEachOf(
    const Place& owner, std::uint32_t rank, std::uint32_t edges, const Body& body) const
  {
    ForEachBit(
      edges & (this->Surface == 0 ? this->Hierarchy.Edges(rank) : this->Hierarchy.UpperEdges(rank)),
      [&](int edge)
      { body(IsovertexAt(this->Hierarchy, owner, rank, edge, this->Surface), edge); });
  }

  const IsodiamondHierarchy& Hierarchy;
  const BrickLevel& Level;
  const Finiteness& IsFinite;
  int Surface;
  std::optional<BrickWindow> Window; ///< the one used last
  Point WindowAt{};
};

}

#endif
