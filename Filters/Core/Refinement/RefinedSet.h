// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_RefinedSet_h
#define isodiamond_RefinedSet_h

#include "Hierarchy/IsodiamondHierarchy.h"
#include "Refinement/Query.h"

namespace isodiamond
{

/**
 * The subdivided diamonds of a query: a set with ranks of its own, so that passes keep data for,
 * and visit the bricks of, only as many diamonds as the query needs.
 *
 * Where the tolerance is the same everywhere, this is R(t) = {threshold > t}: it takes no front and
 * no closure, as thresholds include them (see ActivationThresholds.h). With a region of interest or
 * a viewpoint it is the smallest closed superset of R(what is tolerated everywhere), of the active
 * and creation diamonds whose threshold exceeds their tolerance (see RefinedSet.cpp), and of those
 * that follow their parents: inside a region, the mesh is the uniform one; outside, it is what
 * conformity and the tolerance there need.
 *
 * The corners of the base cube always count as subdivided.
 */
class RefinedSet
{
public:
  RefinedSet(
    const IsodiamondHierarchy& hierarchy, const Query& query, const ParallelFor& parallelFor);

  const IsodiamondHierarchy& Hierarchy() const { return this->Source; }

  /** The refined diamonds. */
  const DiamondSet& Diamonds() const { return this->All ? this->Source.Diamonds() : this->Some; }

  /**
   * Whether this is full resolution. Then all that carries a surface is at scale 0: wherever the
   * surface crosses a coarser edge, the diamond at its middle is active, and so refined, as is the
   * child of every coarser half-tetrahedron that has a patch.
   */
  bool IsFull() const { return this->All && !this->Source.Header().IsAnswer; }

  /** Whether a diamond is refined; those that are not stored are not. */
  bool Contains(const Place& place) const
  {
    const Brick* brick = this->Diamonds().Level(place.Scale).Find(place.Position);
    return brick != nullptr && brick->Contains(place.Position[2] & 7, BitOf(place.Position));
  }

  /** Number of refined diamonds, not counting the corners of the base cube. */
  std::int64_t Count() const;

  /**
   * The size of the active front: the diamonds that are not refined but have a refined parent, or
   * the root alone. Of an MI, only stored diamonds and stored parents count.
   */
  std::int64_t CountFront() const;

private:
  const IsodiamondHierarchy& Source;
  bool All = false; ///< whether all stored diamonds are refined
  DiamondSet Some;  ///< the refined diamonds, unless they are all
};

/** A brick of a refined set. Its diamonds have two ranks: among the stored and the refined ones. */
class RefinedBrick
{
public:
  /** @param place of a brick of refined.Diamonds() */
  RefinedBrick(const RefinedSet& refined, const BrickPlace& place)
    : Source(refined.Hierarchy())
    , Refined(refined.Diamonds().Level(place.Scale).Bricks[place.Index])
    , Stored(*this->StoredLevel(place.Scale).Find(this->Refined.BoxIndex))
    , BrickScale(place.Scale)
    , First(this->StoredLevel(place.Scale).Box.Origin(this->Refined.BoxIndex))
  {
    const std::array<int, 3>& dimensions = this->Source.SampleGrid().Dimensions();
    for (int axis = 0; axis < 3; ++axis)
    {
      this->LastInner[axis] = ((dimensions[axis] - 1) >> place.Scale) - 1;
    }
  }

  const IsodiamondHierarchy& Hierarchy() const { return this->Source; }
  int Scale() const { return this->BrickScale; }
  const Point& Origin() const { return this->First; }

  /** The brick of stored diamonds at the same place, and its number in the order of AllBricks(). */
  const Brick& StoredBrick() const { return this->Stored; }
  std::int64_t StoredNumber() const
  {
    const BrickLevel& level = this->StoredLevel(this->BrickScale);
    return level.FirstNumber + level.Lookup[this->Refined.BoxIndex];
  }

  /** Calls body(place, rank among the stored ones, rank among the refined ones), in order. */
  template <typename Body>
  void ForEachDiamond(Body&& body) const
  {
    std::uint32_t refinedRank = this->Refined.First;
    for (int z = 0; z < 8; ++z)
    {
      ForEachBit(this->Refined.Occupancy[z],
        [&](int bit)
        {
          body(Place{ this->BrickScale, PositionOf(this->First, z, bit) },
            this->Stored.Rank(z, bit), refinedRank++);
        });
    }
  }

  /** Calls body(place, rank among the stored ones) for the diamonds of a class, in order. */
  template <typename Body>
  void ForEachDiamondOfClass(int diamondClass, Body&& body) const
  {
    for (int z = 0; z < 8; ++z)
    {
      ForEachBit(this->Refined.Occupancy[z] & tables::ClassBits[diamondClass][z & 1],
        [&](int bit) {
          body(
            Place{ this->BrickScale, PositionOf(this->First, z, bit) }, this->Stored.Rank(z, bit));
        });
    }
  }

  /** Whether all vertices of a diamond of this brick have samples, whatever its class. */
  bool IsInner(const Place& place) const
  {
    const Point& at = place.Position;
    return at[0] > 0 && at[1] > 0 && at[2] > 0 && at[0] <= this->LastInner[0] &&
      at[1] <= this->LastInner[1] && at[2] <= this->LastInner[2];
  }

private:
  const BrickLevel& StoredLevel(int scale) const { return this->Source.Diamonds().Level(scale); }

  const IsodiamondHierarchy& Source;
  const Brick& Refined;
  const Brick& Stored;
  int BrickScale;
  Point First;
  Point LastInner{}; ///< the last position all of whose neighbours have samples
};

}

#endif
