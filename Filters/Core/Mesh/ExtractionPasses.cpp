// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/ExtractionPasses.h"

#include <limits>
#include <stdexcept>

namespace isodiamond
{

ExtractionPasses::ExtractionPasses(const RefinedSet& refined, const ParallelFor& parallelFor)
  : Set(refined)
  , Parallel(parallelFor)
  , Bricks(AllBricks(refined.Diamonds()))
  , First(this->Bricks.size() + 1)
  , IsFinest(refined.IsFull() && !refined.Hierarchy().Region().IsVolume())
{
  if (!this->IsFinest)
  {
    this->Slots = LargeArray<Slot>(refined.Diamonds().Size());
  }
  else if (const std::vector<Brick>& finest = refined.Diamonds().Level(0).Bricks; !finest.empty())
  {
    this->FirstFinest = this->Hierarchy().FirstIsovertexOf(finest.front().First);
  }
}

std::int64_t ExtractionPasses::CountPoints(const RefinedBrick& brick)
{
  const IsodiamondHierarchy& hierarchy = this->Hierarchy();
  if (this->IsFinest)
  {
    const Brick& stored = brick.StoredBrick();
    const std::int64_t last = stored.First + stored.Size() - 1;
    return hierarchy.FirstIsovertexOf(last) + hierarchy.EdgesByRank().IsovertexCount(last) -
      hierarchy.FirstIsovertexOf(stored.First);
  }
  const bool isVolume = hierarchy.Region().IsVolume();
  const LeafFinder finder(this->Set, brick);
  std::int64_t points = 0;
  brick.ForEachDiamond(
    [&](const Place& place, std::uint32_t rank, std::uint32_t refinedRank)
    {
      const bool isInside = isVolume && hierarchy.Sign(rank) == InsideSign;
      const std::uint32_t lower = hierarchy.Edges(rank);
      const std::uint32_t upper = isVolume ? hierarchy.UpperEdges(rank) : 0;
      const std::uint32_t alive = finder.AliveEdges(place, lower | upper);
      Slot& slot = this->Slots[refinedRank];
      slot.Points = (isInside ? 1U << DiamondPoints::Centre : 0U) |
        (alive & lower) << DiamondPoints::Isovertex(0, 0) |
        (alive & upper) << DiamondPoints::Isovertex(1, 0);
      slot.First = static_cast<std::uint16_t>(points);
      slot.LeafChildren =
        static_cast<std::uint8_t>(finder.LeafChildren(place, isInside ? AllEdges : lower | upper));
      points += PopCount(slot.Points);
    });
  return points;
}

/** Counts become sums of all before. */
void ExtractionPasses::SumUp()
{
  for (std::size_t i = 0; i < this->Bricks.size(); ++i)
  {
    this->First[i + 1].Points += this->First[i].Points;
    this->First[i + 1].Cells += this->First[i].Cells;
  }
  if (this->Total().Points > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("more than 2^32 - 1 points");
  }
}

}
