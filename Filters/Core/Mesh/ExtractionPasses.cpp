// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/ExtractionPasses.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace isodiamond
{

std::vector<CellRange> OwnCells(const std::vector<DealtCells>& dealt)
{
  std::vector<CellRange> ranges;
  for (const DealtCells& cells : dealt)
  {
    if (!ranges.empty() && ranges.back().Last == cells.Own.First)
    {
      ranges.back().Last = cells.Own.Last;
    }
    else if (cells.Own.Count() > 0)
    {
      ranges.push_back(cells.Own);
    }
  }
  return ranges;
}

/** The bricks of a level from one layer in z to another, numbered among all bricks. */
ExtractionPasses::BrickRange ExtractionPasses::BricksBetween(
  const BrickLevel& level, int first, int last)
{
  const std::int64_t layer = std::int64_t{ 1 } * level.Box.Count[0] * level.Box.Count[1];
  const auto numberOf = [&](std::int64_t z)
  {
    return level.FirstNumber +
      (std::partition_point(level.Bricks.begin(), level.Bricks.end(),
         [&](const Brick& brick) { return brick.BoxIndex < layer * z; }) -
        level.Bricks.begin());
  };
  return { numberOf(first), numberOf(last + 1) };
}

ExtractionPasses::ExtractionPasses(const RefinedSet& refined, const MeshShare& share,
  int maximumStep, const ParallelFor& parallelFor)
  : Set(refined)
  , Parallel(parallelFor)
  , IsFinest(refined.IsFull() && !refined.Hierarchy().Region().IsVolume())
  , Step(IsFinest ? 0 : maximumStep)
  , Bricks(AllBricks(refined.Diamonds()))
  , All(BricksOf({}))
  , Own(BricksOf(share))
  , Around(BricksAround(share.WithIdsOfAll ? All : Own))
  , First(this->Bricks.size() + 1)
{
  if (!this->IsFinest)
  {
    this->Slots = LargeArray<Slot>(refined.Diamonds().Size());
  }
  else if (const BrickRange& finest = this->Around[0]; finest.First < finest.Last)
  {
    this->FirstFinest =
      this->Hierarchy().FirstIsovertexOf(this->BrickAt(finest.First).StoredBrick().First);
  }
}

std::vector<ExtractionPasses::BrickRange> ExtractionPasses::BricksOf(const MeshShare& share) const
{
  const DiamondSet& diamonds = this->Set.Diamonds();
  std::vector<BrickRange> bricks(diamonds.ScaleCount());
  for (int scale = 0; scale < (this->IsFinest ? 1 : diamonds.ScaleCount()); ++scale)
  {
    const BrickLevel& level = diamonds.Level(scale);
    if (level.Bricks.empty())
    {
      continue;
    }
    const std::int64_t begin = level.Bricks.front().First;
    const std::int64_t size = level.Bricks.back().First + level.Bricks.back().Size() - begin;
    const auto firstBrick = [&](int number)
    {
      const std::int64_t rank = begin + size * number / share.Count;
      return level.FirstNumber +
        (std::partition_point(level.Bricks.begin(), level.Bricks.end(),
           [&](const Brick& brick) { return brick.First < rank; }) -
          level.Bricks.begin());
    };
    bricks[scale] = { firstBrick(share.Number), firstBrick(share.Number + 1) };
  }
  return bricks;
}

std::vector<ExtractionPasses::BrickRange> ExtractionPasses::BricksAround(
  const std::vector<BrickRange>& bricks) const
{
  const DiamondSet& diamonds = this->Set.Diamonds();
  std::vector<BrickRange> around(bricks.size());
  for (int scale = 0; scale < diamonds.ScaleCount(); ++scale)
  {
    if (bricks[scale].First == bricks[scale].Last)
    {
      continue;
    }
    // As far as the windows of vertices reach from bricks that have any.
    const int from = this->BrickAt(bricks[scale].First).Origin()[2] - 1;
    const int to = this->BrickAt(bricks[scale].Last - 1).Origin()[2] + 8;
    for (int step = 0; step <= std::min(this->Step, diamonds.ScaleCount() - 1 - scale); ++step)
    {
      around[scale + step].Include(
        BricksBetween(diamonds.Level(scale + step), (from >> step) >> 3, (to >> step) >> 3));
    }
  }
  return around;
}

std::vector<DealtCells> ExtractionPasses::Dealt() const
{
  const auto cellsOf = [&](const BrickRange& bricks) {
    return CellRange{ this->First[bricks.First].Cells, this->First[bricks.Last].Cells };
  };
  std::vector<DealtCells> dealt;
  for (std::size_t scale = this->All.size(); scale-- > 0;)
  {
    dealt.push_back({ cellsOf(this->All[scale]), cellsOf(this->Own[scale]) });
  }
  return dealt;
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

/** Turns counts into the sums of all before. */
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
