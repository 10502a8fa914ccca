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
 * centre if that lies inside an interval volume, then the isovertices on those of its edges that
 * are in the current mesh, first on surface 0, then on surface 1.
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

  /** The id of a point; 0 if there is none, which is asked for only if a file is damaged. */
  std::uint32_t Id(int bit) const
  {
    const std::uint32_t before = this->Bits & ((1U << bit) - 1U);
    return ((this->Bits >> bit) & 1U) != 0
      ? this->First + static_cast<std::uint32_t>(PopCount(before))
      : 0;
  }
};

/** Consecutive cells of a mesh. */
struct CellRange
{
  std::int64_t First = 0;
  std::int64_t Last = 0; ///< not among them

  std::int64_t Count() const { return this->Last - this->First; }
};

/** Cells of a mesh that are dealt out to shares in order. */
struct DealtCells
{
  CellRange All;
  CellRange Own; ///< those of one share: earlier shares have those before, later ones those after
};

/** The number of cells in ranges. */
inline std::int64_t TotalOf(const std::vector<CellRange>& ranges)
{
  return std::accumulate(ranges.begin(), ranges.end(), std::int64_t{ 0 },
    [](std::int64_t sum, const CellRange& cells) { return sum + cells.Count(); });
}

/** A share's cells; consecutive ones are one range. */
std::vector<CellRange> OwnCells(const std::vector<DealtCells>& dealt);

/**
 * A share of a mesh: at each scale, the cells of some consecutive bricks. Shares 0 to Count - 1
 * together have each cell once. As the bricks of a scale are in the order of z, a share is about a
 * slab. All have equally many refined diamonds of a scale, to within a brick's: a number known
 * without counting. So, if each has many bricks, they have about equally many cells.
 */
struct MeshShare
{
  int Number = 0; ///< if this is Count, the share is empty
  int Count = 1;
  /** Whether cells and points of the others are counted, too: ids are those of the whole mesh. */
  bool WithIdsOfAll = false;
};

/**
 * What all extractions do: count points and cells in every brick, sum up, write in every brick.
 *
 * Only bricks with refined diamonds are visited. They are independent: every brick has a range of
 * point ids and of cells of its own, and within it everything is in the order of the diamonds, so
 * the order and values of the output do not depend on threads. Counting notes each diamond's points
 * and which of its children are leaves; writing need not ask what is refined. For a surface at full
 * resolution the hierarchy itself gives both.
 *
 * For a share, its bricks' cells are counted, and the points of the layers of bricks in which these
 * can have vertices. If only some cells are wanted, these are written, then the points that they
 * use: after KeepPointsOf() there are ids and points of these alone.
 */
class ExtractionPasses
{
public:
  /** What a brick contributes. */
  struct Counts
  {
    std::int64_t Points = 0;
    std::int64_t Cells = 0;
  };

  /**
   * Counts. The refined set must outlive the passes.
   *
   * @param maximumStep by how many scales the diamonds that own the points of a leaf's cells can be
   *        coarser than its parent
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

  /** By how many scales the diamonds that own the points of a brick's cells can be coarser. */
  int MaximumStep() const { return this->Step; }

  /** Points and cells of all bricks that were counted. */
  const Counts& Total() const { return this->First.back(); }

  CellRange AllCells() const { return { 0, this->Total().Cells }; }

  /** How cells are dealt out, scale by scale, from coarse to fine. */
  std::vector<DealtCells> Dealt() const;

  /** Leaves only the points that some cells use; ids become those among these points. */
  template <typename Id>
  void KeepPointsOf(Id* ids, std::int64_t size)
  {
    this->Kept.emplace(this->Total().Points, ids, size, this->Parallel);
    this->Kept->Rename(ids, size, this->Parallel);
  }

  /** The points that are left; null if all are. */
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

  /** The points of a diamond. @param rank among the refined diamonds @param brick its brick */
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

  /** Calls body(brick, its cells) for every brick with cells in a range, in parallel. */
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

  /** Calls body(leafParent) for every parent, in a brick, of leaves that carry something. */
  template <typename Body>
  void ForEachLeafParent(std::int64_t number, Body&& body) const
  {
    const RefinedBrick brick = this->BrickAt(number);
    if (this->IsFinest)
    {
      brick.ForEachDiamondOfClass(2, // class 2: its children would be finer
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
    std::uint16_t First;  ///< number of the first among the brick's points
    std::uint8_t LeafChildren;
  };

  /** Consecutive bricks, of all or of a level. */
  struct BrickRange
  {
    std::int64_t First = 0;
    std::int64_t Last = 0; ///< not among them

    bool Contains(std::int64_t brick) const { return this->First <= brick && brick < this->Last; }

    /** Adds others, and what is in between. */
    void Include(const BrickRange& others)
    {
      const bool isEmpty = this->First == this->Last;
      this->First = isEmpty ? others.First : std::min(this->First, others.First);
      this->Last = isEmpty ? others.Last : std::max(this->Last, others.Last);
    }
  };

  ExtractionPasses(const RefinedSet& refined, const MeshShare& share, int maximumStep,
    const ParallelFor& parallelFor);

  /** A share's bricks, for each scale that has anything to do with the mesh. */
  std::vector<BrickRange> BricksOf(const MeshShare& share) const;

  /** The bricks of a level from one layer in z to another. */
  static BrickRange BricksBetween(const BrickLevel& level, int first, int last);

  /** By scale: whole layers of bricks that together have all points of some bricks' cells. */
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
  /** Whether all that carries something is of scale 0; the inside of a volume is of all scales. */
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
