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

  /** Whether all diamonds do: full resolution. */
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

}

RefinedSet::RefinedSet(
  const IsodiamondHierarchy& hierarchy, const Query& query, const ParallelFor& parallelFor)
  : Source(hierarchy)
  , Masks(hierarchy.Diamonds().ScaleCount())
{
  if (query.Region)
  {
    this->RefineUniformly(query.OutsideTolerance, HUGE_VAL, parallelFor);
    this->RefineRegion(query, parallelFor);
  }
  else
  {
    this->RefineUniformly(query.Tolerance, query.InteriorTolerance, parallelFor);
  }
}

void RefinedSet::RefineUniformly(
  double tolerance, double interiorTolerance, const ParallelFor& parallelFor)
{
  const Exceeds exceeds(this->Source, tolerance, interiorTolerance);
  this->Full = exceeds.All() && !this->Source.Header().IsAnswer;
  for (int scale = 0; scale < this->Source.Diamonds().ScaleCount(); ++scale)
  {
    const std::vector<Brick>& bricks = this->Source.Diamonds().Level(scale).Bricks;
    this->Masks[scale].resize(bricks.size());
    parallelFor(static_cast<std::int64_t>(bricks.size()), 64,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          BrickMask& mask = this->Masks[scale][i];
          mask = bricks[i].Occupancy;
          if (exceeds.All())
          {
            continue;
          }
          std::uint32_t rank = bricks[i].First;
          for (std::uint64_t& word : mask)
          {
            std::uint64_t kept = 0;
            ForEachBit(
              word, [&](int bit) { kept |= static_cast<std::uint64_t>(exceeds(rank++)) << bit; });
            word = kept;
          }
        }
      });
  }
}

/** Adds what the region asks for. Ancestors that an MI does not store lead to others that it does:
 *  closure needs them. */
void RefinedSet::RefineRegion(const Query& query, const ParallelFor& parallelFor)
{
  const DiamondSet& set = this->Source.Diamonds();
  const Exceeds exceeds(this->Source, query.Tolerance, query.InteriorTolerance);
  DiamondMask wanted(this->Source.Domain());
  for (int scale = 0; scale < this->Source.Domain().Depth(); ++scale)
  {
    const BrickLevel& level = set.Level(scale);
    std::vector<BrickMask> added(level.Bricks.size());
    parallelFor(static_cast<std::int64_t>(level.Bricks.size()), 16,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Brick& brick = level.Bricks[i];
          if (!query.Region->MayTouch(scale, level.Box.Origin(brick.BoxIndex)))
          {
            continue;
          }
          set.ForEachInBrick(scale, brick,
            [&](const Place& place, std::uint32_t rank)
            {
              const int z = place.Position[2] & 7;
              const std::uint64_t bit = std::uint64_t{ 1 } << BitOf(place.Position);
              if ((this->Masks[scale][i][z] & bit) == 0 && exceeds(rank) &&
                this->Source.KindOf(rank) != Kind::Relevant && query.Region->Touches(place))
              {
                added[i][z] |= bit;
              }
            });
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
  wanted.CloseOverParents(this->Source.Domain());
  for (int scale = 0; scale < this->Source.Domain().Depth(); ++scale)
  {
    const std::vector<Brick>& bricks = set.Level(scale).Bricks;
    for (std::size_t i = 0; i < bricks.size(); ++i)
    {
      const BrickMask* mask = wanted.Find(scale, bricks[i].BoxIndex);
      for (int z = 0; mask != nullptr && z < 8; ++z)
      {
        this->Masks[scale][i][z] |= (*mask)[z] & bricks[i].Occupancy[z];
      }
    }
  }
}

std::int64_t RefinedSet::Count() const
{
  std::int64_t count = 0;
  for (int scale = 0; scale < this->Source.Domain().Depth(); ++scale)
  {
    for (const BrickMask& mask : this->Masks[scale])
    {
      for (const std::uint64_t word : mask)
      {
        count += PopCount(word);
      }
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
  for (int scale = grid.Depth(); scale >= 0; --scale)
  {
    const BrickLevel& level = this->Source.Diamonds().Level(scale);
    for (std::size_t i = 0; i < level.Bricks.size(); ++i)
    {
      const Point origin = level.Box.Origin(level.Bricks[i].BoxIndex);
      for (int z = 0; z < 8; ++z)
      {
        ForEachBit(this->Masks[scale][i][z],
          [&](int bit)
          {
            const Place parent{ scale, PositionOf(origin, z, bit) };
            const TypeTable& shape = ShapeOf(parent.Position);
            for (int child = 0; child < shape.ChildCount; ++child)
            {
              const Place place = ChildPlace(shape, parent, child);
              count += inFront(place) && isFirst(parent, place) ? 1 : 0;
            }
          });
      }
    }
  }
  return count;
}

}
