// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CellCounts.h"

#include "Mesh/CurrentMesh.h"
#include "Mesh/IntervalExtraction.h"
#include "Mesh/SurfaceExtraction.h"

#include <algorithm>
#include <functional>
#include <mutex>

namespace isodiamond
{
namespace
{

/** Differences of the counts from one code to the next. */
using Changes = std::vector<std::int64_t>;

/** Counts the cells in all leaves that ever have a diamond of a brick as parent. */
class BrickCounter
{
public:
  BrickCounter(const IsodiamondHierarchy& hierarchy, double interiorTolerance)
    : Hierarchy(hierarchy)
    , AcceptedInside(hierarchy.InteriorCodes().Accepted(interiorTolerance))
    , CountsTetrahedra(hierarchy.Region().IsVolume())
  {
  }

  void Add(const RefinedBrick& brick, Changes& changes) const
  {
    brick.ForEachDiamond(
      [&](const Place& place, std::uint32_t rank, std::uint32_t /*refinedRank*/)
      {
        const std::uint32_t carrying = this->Hierarchy.CarryingEdges(rank);
        const int type = TypeOf(place.Position);
        const std::uint32_t children =
          ChildrenOfHalves(HalvesWithAny(tables::MasksAsListed[type](carrying)));
        const ErrorCode::Type last = this->Threshold(rank);
        ForEachBit(children,
          [&](int child)
          {
            const ErrorCode::Type first =
              this->ChildThreshold(ChildPlace(tables::Types[type], place, child));
            if (first < last)
            {
              const std::int64_t cells =
                this->CellsOf(MakeLeafParent(brick, place, rank, 1U << child, carrying));
              changes[first] += cells;
              changes[last] -= cells;
            }
          });
      });
  }

private:
  /** One more than the largest code at which a diamond is refined. */
  ErrorCode::Type Threshold(std::int64_t rank) const
  {
    return this->Hierarchy.RefinesInterior() &&
        this->Hierarchy.InteriorThreshold(rank) > this->AcceptedInside
      ? ErrorCode::Always
      : this->Hierarchy.Threshold(rank);
  }

  /** The same for a child; 0 if it is never refined. */
  ErrorCode::Type ChildThreshold(const Place& child) const
  {
    const std::int64_t rank =
      child.Scale >= 0 ? this->Hierarchy.Diamonds().Rank(child) : DiamondSet::None;
    return rank == DiamondSet::None ? ErrorCode::Type{ 0 } : this->Threshold(rank);
  }

  std::int64_t CellsOf(const LeafParent& parent) const
  {
    return this->CountsTetrahedra ? CountTetrahedra(this->Hierarchy, parent)
                                  : CountTriangles(this->Hierarchy, parent);
  }

  const IsodiamondHierarchy& Hierarchy;
  ErrorCode::Type AcceptedInside;
  bool CountsTetrahedra;
};

}

std::int64_t CountCells(const RefinedSet& refined, const ParallelFor& parallelFor)
{
  return refined.Hierarchy().Region().IsVolume()
    ? IntervalExtraction(refined, parallelFor).TetrahedronCount()
    : SurfaceExtraction(refined, parallelFor).TriangleCount();
}

CellCounts::CellCounts(
  const IsodiamondHierarchy& hierarchy, const ParallelFor& parallelFor, double interiorTolerance)
  : Code(hierarchy.Codes())
{
  Changes all(ErrorCode::Always + 1);
  const RefinedSet refined(hierarchy, Query{ 0.0, 0.0 }, parallelFor);
  const std::vector<BrickPlace> bricks = AllBricks(refined.Diamonds());
  const BrickCounter counter(hierarchy, interiorTolerance);
  std::mutex mutex;
  parallelFor(static_cast<std::int64_t>(bricks.size()), 256,
    [&](std::int64_t begin, std::int64_t end)
    {
      Changes changes(all.size());
      for (std::int64_t i = begin; i < end; ++i)
      {
        counter.Add(RefinedBrick(refined, bricks[i]), changes);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      std::transform(changes.begin(), changes.end(), all.begin(), all.begin(), std::plus<>());
    });
  // Most codes change nothing; a filter may keep the counts of thousands of small hierarchies.
  std::int64_t cells = 0;
  for (int code = 0; code <= ErrorCode::Always; ++code)
  {
    cells += all[code];
    if (all[code] != 0)
    {
      this->Counts.push_back({ code, cells });
    }
  }
  this->Counts.shrink_to_fit();
}

}
