// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ExtractionPasses_h
#define isodiamond_ExtractionPasses_h

#include "Field/SystemMemory.h"
#include "Mesh/CurrentMesh.h"
#include "Mesh/KeptPoints.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace isodiamond
{

/**
 * The points of a mesh that belong to one refined diamond, as bits in the order of their ids: its
 * centre if that lies inside an interval volume, the isovertices on those of its edges that are in
 * the current mesh, first on surface 0, then on surface 1.
 */
struct DiamondPoints
{
  std::uint32_t First = 0; ///< id of the first
  std::uint32_t Bits = 0;

  static constexpr int Centre = 0;
  static constexpr int Isovertex(int surface, int edge)
  {
    return 1 + surface * MaximumVertices + edge;
  }

  bool HasCentre() const { return (this->Bits & (1U << Centre)) != 0; }

  /** The edges with an isovertex on a surface. */
  std::uint32_t Edges(int surface) const
  {
    return (this->Bits >> Isovertex(surface, 0)) & AllEdges;
  }

  /** The id of a point that there is not, which only a damaged file asks for, is 0. */
  std::uint32_t Id(int bit) const
  {
    const std::uint32_t before = this->Bits & ((1U << bit) - 1U);
    return ((this->Bits >> bit) & 1U) != 0
      ? this->First + static_cast<std::uint32_t>(PopCount(before))
      : 0;
  }
};

/** Cells of a mesh that follow each other. */
struct CellRange
{
  std::int64_t First = 0;
  std::int64_t Last = 0; ///< not among them

  std::int64_t Count() const { return this->Last - this->First; }
};

/** Cells of a mesh that are dealt out to shares one after the other. */
struct DealtCells
{
  CellRange All;
  CellRange Own; ///< of a share: shares before have those before, shares after those after
};

/** The number of cells in ranges. */
inline std::int64_t TotalOf(const std::vector<CellRange>& ranges)
{
  return std::accumulate(ranges.begin(), ranges.end(), std::int64_t{ 0 },
    [](std::int64_t sum, const CellRange& cells) { return sum + cells.Count(); });
}

/** A share's cells, those that follow each other as one range. */
std::vector<CellRange> OwnCells(const std::vector<DealtCells>& dealt);

/**
 * A share of a mesh: of each scale the cells of some bricks that follow each other. Shares 0 to
 * Count - 1 together have each cell once. As bricks of a scale follow each other in z, a share is
 * about a slab. All have as many refined diamonds of a scale, but for a brick's, which is known
 * without counting; so, where there are many bricks for each, about as many cells.
 */
struct MeshShare
{
  int Number = 0; ///< Count is none
  int Count = 1;
  /** Whether cells and points of the others are counted, too: ids are those of the whole mesh. */
  bool WithIdsOfAll = false;
};

/**
 * What all extractions do: count points and cells in every brick, sum up, write in every brick.
 *
 * Only bricks with refined diamonds are visited. They are independent: every brick has a range of
 * point ids and of cells of its own, and within it everything is in the order of the diamonds, so
 * order and values of the output do not depend on threads. Counting notes a diamond's points and
 * those of its children that are leaves; writing asks no more what is refined. Of a surface of full
 * resolution the hierarchy tells both.
 *
 * Of a share, its bricks' cells are counted, and the points of the layers of bricks in which
 * vertices of theirs can be. Of some cells only, those are written, and then the points that they
 * use: KeepPointsOf() has ids and points of these alone.
 */
class ExtractionPasses
{
public:
  /** What bricks contribute. */
  struct Counts
  {
    std::int64_t Points = 0;
    std::int64_t Cells = 0;
  };

  /**
   * Counts. The refined set must outlive the passes.
   *
   * @param maximumStep how much coarser than a leaf's parent the diamonds can be whose points its
   *        cells have
   * @param cellsOf (leafParent) -> the number of cells in a diamond's leaves
   * @throws std::length_error beyond 2^32 - 1 points
   */
  template <typename CellsOf>
  ExtractionPasses(const RefinedSet& refined, const MeshShare& share, int maximumStep,
    const ParallelFor& parallelFor, CellsOf&& cellsOf)
    : ExtractionPasses(refined, share, maximumStep, parallelFor)
  {
    const std::vector<BrickRange>& counted = share.WithIdsOfAll ? this->All : this->Own;
    this->ForEachBrick(
      [&](std::int64_t brick)
      {
        const int scale = this->Bricks[brick].Scale;
        Counts& counts = this->First[brick + 1];
        if (this->Around[scale].Contains(brick))
        {
          counts.Points = this->CountPoints(this->BrickAt(brick));
        }
        if (counted[scale].Contains(brick))
        {
          this->ForEachLeafParent(
            brick, [&](const LeafParent& parent) { counts.Cells += cellsOf(parent); });
        }
      });
    this->SumUp();
  }

  const RefinedSet& Refined() const { return this->Set; }
  const IsodiamondHierarchy& Hierarchy() const { return this->Set.Hierarchy(); }

  /** How much coarser diamonds can be whose points a brick's cells have. */
  int MaximumStep() const { return this->Step; }

  /** Points and cells of all bricks that were counted. */
  const Counts& Total() const { return this->First.back(); }

  CellRange AllCells() const { return { 0, this->Total().Cells }; }

  /** How they are dealt out, scale by scale, from coarse to fine. */
  std::vector<DealtCells> Dealt() const;

  /** Leaves the points that some cells use, whose ids become those among these. */
  template <typename Id>
  void KeepPointsOf(Id* ids, std::int64_t size)
  {
    this->Kept.emplace(this->Total().Points, ids, size, this->Parallel);
    this->Kept->Rename(ids, size, this->Parallel);
  }

  /** Those that are left; null if all are. */
  const KeptPoints* PointsKept() const { return this->Kept ? &*this->Kept : nullptr; }

  /** The number of points that are left. */
  std::int64_t PointCount() const
  {
    return this->Kept ? this->Kept->Count() : this->Total().Points;
  }

  std::int64_t BrickCount() const { return static_cast<std::int64_t>(this->Bricks.size()); }

  bool HasPoints(std::int64_t brick) const
  {
    return this->First[brick + 1].Points > this->First[brick].Points;
  }

  RefinedBrick BrickAt(std::int64_t brick) const { return { this->Set, this->Bricks[brick] }; }

  /** The points of a diamond. @param rank among the refined diamonds @param brick that it is in */
  DiamondPoints PointsOf(std::int64_t brick, std::uint32_t rank) const
  {
    if (this->IsFinest)
    {
      return { static_cast<std::uint32_t>(
                 this->Hierarchy().FirstIsovertexOf(rank) - this->FirstFinest),
        this->Hierarchy().Edges(rank) << DiamondPoints::Isovertex(0, 0) };
    }
    const Slot& slot = this->Slots[rank];
    return { static_cast<std::uint32_t>(this->First[brick].Points) + slot.First, slot.Points };
  }

  /** Calls body(brick) for every brick with points that are left, in parallel. */
  template <typename Body>
  void ForEachBrickWithPoints(Body&& body) const
  {
    this->ForEachBrick(
      [&](std::int64_t brick)
      {
        if (this->HasPoints(brick) &&
          (!this->Kept ||
            this->Kept->AnyBetween(this->First[brick].Points, this->First[brick + 1].Points)))
        {
          body(brick);
        }
      });
  }

  /** Calls body(place, rank among the stored ones, points) for every diamond with points. */
  template <typename Body>
  void ForEachDiamondWithPoints(std::int64_t brick, Body&& body) const
  {
    this->BrickAt(brick).ForEachDiamond(
      [&](const Place& place, std::uint32_t rank, std::uint32_t refinedRank)
      {
        if (const DiamondPoints points = this->PointsOf(brick, refinedRank); points.Bits != 0)
        {
          body(place, rank, points);
        }
      });
  }

  /** Calls body(brick, its cells) for every brick with cells of a range, in parallel. */
  template <typename Body>
  void ForEachBrickWithCells(const CellRange& range, Body&& body) const
  {
    this->ForEachBrick(
      [&](std::int64_t brick)
      {
        const CellRange own = { this->First[brick].Cells, this->First[brick + 1].Cells };
        if (std::max(own.First, range.First) < std::min(own.Last, range.Last))
        {
          body(brick, own);
        }
      });
  }

  /** Calls body(leafParent) for every parent of leaves that carry something in a brick. */
  template <typename Body>
  void ForEachLeafParent(std::int64_t number, Body&& body) const
  {
    const RefinedBrick brick = this->BrickAt(number);
    if (this->IsFinest)
    {
      brick.ForEachDiamondOfClass(2, // whose children would be finer
        [&](const Place& place, std::uint32_t rank)
        {
          if (const std::uint32_t crossed = this->Hierarchy().Edges(rank))
          {
            body(MakeLeafParent(brick, place, rank, crossed));
          }
        });
      return;
    }
    brick.ForEachDiamond(
      [&](const Place& place, std::uint32_t rank, std::uint32_t refinedRank)
      {
        if (const std::uint32_t children = this->Slots[refinedRank].LeafChildren)
        {
          body(MakeLeafParent(brick, place, rank, children, this->Hierarchy().CarryingEdges(rank)));
        }
      });
  }

private:
  /** What is kept of a refined diamond. */
  struct Slot
  {
    std::uint32_t Points; ///< bits of DiamondPoints
    std::uint16_t First;  ///< of them among the points of the brick
    std::uint8_t LeafChildren;
  };

  /** Bricks, or bricks of a level, that follow each other. */
  struct BrickRange
  {
    std::int64_t First = 0;
    std::int64_t Last = 0; ///< not among them

    bool Contains(std::int64_t brick) const { return this->First <= brick && brick < this->Last; }

    /** Adds others, and what is between. */
    void Include(const BrickRange& others)
    {
      const bool isEmpty = this->First == this->Last;
      this->First = isEmpty ? others.First : std::min(this->First, others.First);
      this->Last = isEmpty ? others.Last : std::max(this->Last, others.Last);
    }
  };

  ExtractionPasses(const RefinedSet& refined, const MeshShare& share, int maximumStep,
    const ParallelFor& parallelFor);

  /** A share's bricks of each scale that has anything to do with the mesh. */
  std::vector<BrickRange> BricksOf(const MeshShare& share) const;

  /** Bricks of a level, from one layer in z to another. */
  static BrickRange BricksBetween(const BrickLevel& level, int first, int last);

  /** By scale: whole layers of bricks that have all points of some bricks' cells. */
  std::vector<BrickRange> BricksAround(const std::vector<BrickRange>& bricks) const;

  /** Calls body(brick) for every brick, in parallel. */
  template <typename Body>
  void ForEachBrick(Body&& body) const
  {
    ForEachIndex(this->Parallel, this->Bricks.size(), 16, [&](std::int64_t brick) { body(brick); });
  }

  /** The number of a brick's points; fills its slots, if there are any. */
  std::int64_t CountPoints(const RefinedBrick& brick);

  void SumUp();

  const RefinedSet& Set;
  ParallelFor Parallel;
  /** Whether all that carries something is of scale 0: an interval volume has its inside at all. */
  bool IsFinest;
  int Step;
  std::vector<BrickPlace> Bricks;
  std::vector<BrickRange> All;    ///< by scale
  std::vector<BrickRange> Own;    ///< of the share, by scale
  std::vector<BrickRange> Around; ///< whose points are counted, by scale
  std::vector<Counts> First;      ///< by brick, and the total
  std::int64_t FirstFinest = 0;   ///< if all is of scale 0: isovertices before those counted
  LargeArray<Slot> Slots;         ///< if it is not: by rank among the refined diamonds
  std::optional<KeptPoints> Kept;
};

}

#endif
