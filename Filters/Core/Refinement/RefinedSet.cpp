// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/RefinedSet.h"

#include "Refinement/LocalTolerance.h"

#include <algorithm>
#include <cassert>

namespace isodiamond
{
namespace
{

/** Which stored diamonds exceed what is tolerated. */
class Exceeds
{
public:
  Exceeds(const IsodiamondHierarchy& hierarchy, const Tolerances& tolerated)
    : Hierarchy(hierarchy)
    , Accepted(hierarchy.Codes().Accepted(tolerated.Surface))
    , AcceptedInside(hierarchy.InteriorCodes().Accepted(tolerated.Interior))
    , Interior(hierarchy.RefinesInterior() && this->AcceptedInside < ErrorCode::Always - 1)
  {
  }

  bool operator()(std::uint32_t rank) const
  {
    return this->Hierarchy.Threshold(rank) > this->Accepted ||
      (this->Interior && this->Hierarchy.InteriorThreshold(rank) > this->AcceptedInside);
  }

  /** Whether a brick can have such diamonds. @param brick numbered as AllBricks() does */
  bool InBrick(std::int64_t brick) const
  {
    const IsodiamondHierarchy::Thresholds& highest = this->Hierarchy.HighestOfBrick(brick);
    return highest.Surface > this->Accepted ||
      (this->Interior && highest.Interior > this->AcceptedInside);
  }

  /** Whether all diamonds do. */
  bool All() const
  {
    return this->Accepted < ErrorCode::Least && !this->Hierarchy.RefinesInterior();
  }

private:
  const IsodiamondHierarchy& Hierarchy;
  ErrorCode::Type Accepted;
  ErrorCode::Type AcceptedInside;
  bool Interior;
};

/** The diamonds of a brick that exceed what is tolerated. */
BrickMask ExceedingIn(const Brick& brick, const Exceeds& exceeds)
{
  BrickMask mask{};
  std::uint32_t rank = brick.First;
  for (int z = 0; z < 8; ++z)
  {
    ForEachBit(brick.Occupancy[z],
      [&](int bit) { mask[z] |= static_cast<std::uint64_t>(exceeds(rank++)) << bit; });
  }
  return mask;
}

/** Those of a brick's candidates that are not relevant and exceed what is tolerated of them.
 *  @param areSure whether they exceed that wherever they are in the brick */
BrickMask ExceedingLocally(const IsodiamondHierarchy& hierarchy, const BrickPlace& place,
  const BrickMask& candidates, const LocalTolerance& tolerance, bool areSure)
{
  const BrickLevel& level = hierarchy.Diamonds().Level(place.Scale);
  const Brick& brick = level.Bricks[place.Index];
  const Point origin = level.Box.Origin(brick.BoxIndex);
  BrickMask mask{};
  for (int z = 0; z < 8; ++z)
  {
    ForEachBit(candidates[z],
      [&](int bit)
      {
        const std::uint32_t rank = brick.Rank(z, bit);
        const bool wanted = hierarchy.KindOf(rank) != Kind::Relevant &&
          (areSure ||
            Exceeds(hierarchy, tolerance.At({ place.Scale, PositionOf(origin, z, bit) }))(rank));
        mask[z] |= static_cast<std::uint64_t>(wanted) << bit;
      });
  }
  return mask;
}

/** Whether a parent of a diamond is in a set. */
bool HasParentIn(const DiamondMask& set, const Place& place)
{
  const TypeTable& shape = ShapeOf(place.Position);
  bool has = false;
  for (int i = 0; i < shape.ParentCount && !has; ++i)
  {
    has = set.Contains(ParentPlace(shape, place, i));
  }
  return has;
}

/** Adds a diamond to a closed set, which stays closed. For few diamonds: CloseOverParents() goes
 *  over all. */
void InsertWithAncestors(const Grid& grid, const Place& place, DiamondMask& set)
{
  if (place.Scale == grid.Depth() || !grid.IsValid(place.Position, place.Scale) ||
    !set.Insert(place))
  {
    return;
  }
  const TypeTable& shape = ShapeOf(place.Position);
  for (int i = 0; i < shape.ParentCount; ++i)
  {
    InsertWithAncestors(grid, ParentPlace(shape, place, i), set);
  }
}

/** Adds followers to a closed set, with all ancestors, until there are none to add. */
void AddFollowers(const IsodiamondHierarchy& hierarchy, DiamondMask& set)
{
  const ArrayView<std::uint64_t>& followers = hierarchy.Followers();
  std::vector<Place> waiting(followers.Size);
  std::transform(followers.Data, followers.Data + followers.Size, waiting.begin(), PlaceOfCentre);
  bool hasGrown = true;
  while (hasGrown)
  {
    const auto end = std::partition(waiting.begin(), waiting.end(),
      [&](const Place& place) { return set.Contains(place) || !HasParentIn(set, place); });
    hasGrown = end != waiting.end();
    std::for_each(end, waiting.end(),
      [&](const Place& place) { InsertWithAncestors(hierarchy.SampleGrid(), place, set); });
    waiting.erase(end, waiting.end());
  }
}

/**
 * The diamonds wanted beyond those that exceed what is tolerated everywhere, with all ancestors,
 * even those that an MI does not store, and with the followers of these. Followers whose parents
 * exceed what is tolerated everywhere need no care: they have the same threshold.
 */
DiamondMask WantedLocally(const IsodiamondHierarchy& hierarchy, const LocalTolerance& tolerance,
  const Exceeds& exceedsEverywhere, const ParallelFor& parallelFor)
{
  DiamondMask wanted(hierarchy.SampleGrid());
  for (int scale = 0; scale < hierarchy.SampleGrid().Depth(); ++scale)
  {
    const BrickLevel& level = hierarchy.Diamonds().Level(scale);
    std::vector<BrickMask> added(level.Bricks.size());
    ForEachIndex(parallelFor, level.Bricks.size(), 16,
      [&](std::int64_t i)
      {
        const Brick& brick = level.Bricks[i];
        const LocalTolerance::OfBrick own = tolerance.In(scale, level.Box.Origin(brick.BoxIndex));
        const Exceeds exceedsLeast(hierarchy, own.Least);
        if (exceedsLeast.InBrick(level.FirstNumber + i))
        {
          BrickMask candidates = ExceedingIn(brick, exceedsLeast);
          const BrickMask everywhere = ExceedingIn(brick, exceedsEverywhere);
          for (int z = 0; z < 8; ++z)
          {
            candidates[z] &= ~everywhere[z];
          }
          added[i] = ExceedingLocally(hierarchy, { scale, i }, candidates, tolerance, own.AreEqual);
        }
      });
    for (std::size_t i = 0; i < added.size(); ++i)
    {
      if (added[i] != BrickMask{})
      {
        wanted.Insert(scale, level.Bricks[i].BoxIndex, added[i]);
      }
    }
  }
  for (const Place& place : tolerance.Also())
  {
    wanted.Insert(place);
  }
  wanted.CloseOverParents(hierarchy.SampleGrid());
  AddFollowers(hierarchy, wanted);
  return wanted;
}

/** The stored diamonds that exceed what is tolerated, and wanted ones. @param wanted may be null */
DiamondSet Select(const IsodiamondHierarchy& hierarchy, const Exceeds& exceeds,
  const DiamondMask* wanted, const ParallelFor& parallelFor)
{
  DiamondSet selected(hierarchy.SampleGrid());
  std::int64_t number = 0;
  for (int scale = hierarchy.SampleGrid().Depth(); scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = hierarchy.Diamonds().Level(scale).Bricks;
    std::vector<const Brick*> candidates;
    for (const Brick& brick : bricks)
    {
      if (exceeds.InBrick(number++) ||
        (wanted != nullptr && wanted->Find(scale, brick.BoxIndex) != nullptr))
      {
        candidates.push_back(&brick);
      }
    }
    std::vector<BrickMask> masks(candidates.size());
    ForEachIndex(parallelFor, candidates.size(), 64,
      [&](std::int64_t i)
      {
        const Brick& brick = *candidates[i];
        masks[i] = ExceedingIn(brick, exceeds);
        const BrickMask* more = wanted != nullptr ? wanted->Find(scale, brick.BoxIndex) : nullptr;
        for (int z = 0; more != nullptr && z < 8; ++z)
        {
          masks[i][z] |= (*more)[z] & brick.Occupancy[z];
        }
      });
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      selected.Append(scale, candidates[i]->BoxIndex, masks[i]);
    }
  }
  return selected;
}

}

RefinedSet::RefinedSet(
  const IsodiamondHierarchy& hierarchy, const Query& query, const ParallelFor& parallelFor)
  : Source(hierarchy)
{
  const LocalTolerance tolerance(query, hierarchy.SampleGrid());
  const Exceeds exceeds(hierarchy, tolerance.Everywhere());
  this->All = exceeds.All();
  if (!this->All && !tolerance.IsUniform())
  {
    const DiamondMask wanted = WantedLocally(hierarchy, tolerance, exceeds, parallelFor);
    this->Some = Select(hierarchy, exceeds, &wanted, parallelFor);
  }
  else if (!this->All)
  {
    this->Some = Select(hierarchy, exceeds, nullptr, parallelFor);
  }
}

std::int64_t RefinedSet::Count() const
{
  std::int64_t count = 0;
  for (int scale = 0; scale < this->Source.SampleGrid().Depth(); ++scale)
  {
    for (const Brick& brick : this->Diamonds().Level(scale).Bricks)
    {
      count += brick.Size();
    }
  }
  return count;
}

std::int64_t RefinedSet::CountFront() const
{
  const Grid& grid = this->Source.SampleGrid();
  const bool onlyStored = this->Source.Header().TheModel == Model::Minimal;
  const auto inFront = [&](const Place& child)
  {
    return child.Scale >= 0 && child.Scale < grid.Depth() &&
      grid.IsValid(child.Position, child.Scale) && !this->Contains(child) &&
      !(onlyStored && !this->Source.Diamonds().Contains(child));
  };
  // A child is counted by the first of its refined parents.
  const auto isFirst = [&](const Place& parent, const Place& child)
  {
    const TypeTable& shape = ShapeOf(child.Position);
    int i = 0;
    while (!this->Contains(ParentPlace(shape, child, i)))
    {
      ++i;
      assert(i < shape.ParentCount && "the child of a refined parent");
    }
    return ParentPlace(shape, child, i).Position == parent.Position;
  };
  std::int64_t count = 0;
  this->Diamonds().ForEach(
    [&](const Place& parent, std::uint32_t)
    {
      const TypeTable& shape = ShapeOf(parent.Position);
      for (int child = 0; child < shape.ChildCount; ++child)
      {
        const Place place = ChildPlace(shape, parent, child);
        count += inFront(place) && isFirst(parent, place) ? 1 : 0;
      }
    });
  return count;
}

}
