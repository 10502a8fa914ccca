// SPDX-License-Identifier: BSD-3-Clause
#include "RefinedSet.h"

namespace isodiamond
{
namespace
{

/** Which stored diamonds exceed a tolerance, or an interior tolerance. */
class Exceeds
{
public:
  Exceeds(const IsodiamondHierarchy& hierarchy, double tolerance, double interiorTolerance)
    : Hierarchy(hierarchy)
    , Accepted(hierarchy.Codes().Accepted(tolerance))
    , AcceptedInside(hierarchy.InteriorCodes().Accepted(interiorTolerance))
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

/** The diamonds of a brick that exceed. */
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

/** Of a brick's diamonds those that exceed, are no relevant ones and touch the region. */
BrickMask ExceedingInRegion(const IsodiamondHierarchy& hierarchy, int scale, const Brick& brick,
  const Exceeds& exceeds, const RegionOfInterest& region)
{
  BrickMask mask{};
  hierarchy.Diamonds().ForEachInBrick(scale, brick,
    [&](const Place& place, std::uint32_t rank)
    {
      const bool wanted =
        exceeds(rank) && hierarchy.KindOf(rank) != Kind::Relevant && region.Touches(place);
      mask[place.Position[2] & 7] |= static_cast<std::uint64_t>(wanted) << BitOf(place.Position);
    });
  return mask;
}

/**
 * What a region asks for beyond the diamonds that exceed outside of it, with all ancestors: those
 * that an MI does not store lead to others that it does.
 */
DiamondMask WantedInRegion(const IsodiamondHierarchy& hierarchy, const Query& query,
  const Exceeds& exceedsOutside, const ParallelFor& parallelFor)
{
  const Exceeds exceeds(hierarchy, query.Tolerance, query.InteriorTolerance);
  DiamondMask wanted(hierarchy.Domain());
  for (int scale = 0; scale < hierarchy.Domain().Depth(); ++scale)
  {
    const BrickLevel& level = hierarchy.Diamonds().Level(scale);
    std::vector<BrickMask> added(level.Bricks.size());
    parallelFor(static_cast<std::int64_t>(level.Bricks.size()), 16,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Brick& brick = level.Bricks[i];
          if (query.Region->MayTouch(scale, level.Box.Origin(brick.BoxIndex)))
          {
            added[i] = ExceedingInRegion(hierarchy, scale, brick, exceeds, *query.Region);
            const BrickMask outside = ExceedingIn(brick, exceedsOutside);
            for (int z = 0; z < 8; ++z)
            {
              added[i][z] &= ~outside[z];
            }
          }
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
  wanted.CloseOverParents(hierarchy.Domain());
  return wanted;
}

/** The stored diamonds that exceed, and those that are wanted. @param wanted may be null */
DiamondSet Select(const IsodiamondHierarchy& hierarchy, const Exceeds& exceeds,
  const DiamondMask* wanted, const ParallelFor& parallelFor)
{
  DiamondSet selected(hierarchy.Domain());
  std::int64_t number = 0;
  for (int scale = hierarchy.Domain().Depth(); scale >= 0; --scale)
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
    parallelFor(static_cast<std::int64_t>(candidates.size()), 64,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Brick& brick = *candidates[i];
          masks[i] = ExceedingIn(brick, exceeds);
          const BrickMask* more = wanted != nullptr ? wanted->Find(scale, brick.BoxIndex) : nullptr;
          for (int z = 0; more != nullptr && z < 8; ++z)
          {
            masks[i][z] |= (*more)[z] & brick.Occupancy[z];
          }
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
  const Exceeds exceeds = query.Region
    ? Exceeds(hierarchy, query.OutsideTolerance, HUGE_VAL)
    : Exceeds(hierarchy, query.Tolerance, query.InteriorTolerance);
  this->All = exceeds.All();
  if (!this->All && query.Region)
  {
    const DiamondMask wanted = WantedInRegion(hierarchy, query, exceeds, parallelFor);
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
  for (int scale = 0; scale < this->Source.Domain().Depth(); ++scale)
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
  const Grid& grid = this->Source.Domain();
  const bool onlyStored = this->Source.Header().Kind == Model::Minimal;
  const auto inFront = [&](const Place& child)
  {
    return child.Scale >= 0 && child.Scale < grid.Depth() &&
      grid.IsValid(child.Position, child.Scale) && !this->Contains(child) &&
      !(onlyStored && !this->Source.Diamonds().Contains(child));
  };
  // The first of its refined parents counts a child.
  const auto isFirst = [&](const Place& parent, const Place& child)
  {
    const TypeTable& shape = ShapeOf(child.Position);
    int i = 0;
    while (!this->Contains(ParentPlace(shape, child, i)))
    {
      ++i;
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
