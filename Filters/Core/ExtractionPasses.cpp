// SPDX-License-Identifier: BSD-3-Clause
#include "ExtractionPasses.h"

#include <limits>
#include <stdexcept>

namespace isodiamond
{

ExtractionPasses::ExtractionPasses(const RefinedSet& refined, const ParallelFor& parallelFor)
  : Set(refined)
  , Parallel(parallelFor)
  , Bricks(AllBricks(refined.Diamonds()))
  , First(this->Bricks.size() + 1)
  , Slots(refined.Diamonds().Size())
{
}

ExtractionPasses::Slot ExtractionPasses::MakeSlot(
  const LeafFinder& finder, const Place& place, std::uint32_t rank) const
{
  const IsodiamondHierarchy& hierarchy = this->Hierarchy();
  const bool isVolume = hierarchy.Region().IsVolume();
  const bool isInside = isVolume && hierarchy.Sign(rank) == InsideSign;
  const std::uint32_t lower = hierarchy.Edges(rank);
  const std::uint32_t upper = isVolume ? hierarchy.UpperEdges(rank) : 0;
  std::uint32_t crossed = lower | upper;
  std::uint32_t alive = crossed;
  if (this->Set.IsFull())
  {
    // Only at scale 0 are there crossed edges, and crossed leaves in diamonds of class 2.
    const bool isFinest = place.Scale == 0;
    alive = isFinest ? alive : 0;
    crossed = isFinest && ShapeOf(place.Position).DiamondClass == 2 ? crossed : 0;
  }
  else
  {
    alive = finder.AliveEdges(place, crossed);
  }
  Slot slot;
  slot.Points = (isInside ? 1U << DiamondPoints::Centre : 0U) |
    (alive & lower) << DiamondPoints::Isovertex(0, 0) |
    (alive & upper) << DiamondPoints::Isovertex(1, 0);
  slot.LeafChildren =
    static_cast<std::uint8_t>(finder.LeafChildren(place, isInside ? AllEdges : crossed));
  return slot;
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
