// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ExtractionPasses_h
#define isodiamond_ExtractionPasses_h

#include "RefinedSet.h"

#include <limits>
#include <stdexcept>
#include <vector>

namespace isodiamond
{

/**
 * What all extractions do: count points and cells in every brick, sum up, write in every brick.
 *
 * Bricks are independent. Every brick has a range of point ids and of cells of its own, and within
 * it everything is in the order of the diamonds, so order and values of the output do not depend
 * on threads.
 */
class ExtractionPasses
{
public:
  /** What one brick contributes. */
  struct Counts
  {
    std::int64_t Points = 0;
    std::int64_t Cells = 0;
  };

  ExtractionPasses(const RefinedSet& refined, const ParallelFor& parallelFor)
    : Diamonds(refined.Hierarchy().Diamonds())
    , Parallel(parallelFor)
    , Bricks(AllBricks(refined.Hierarchy().Diamonds()))
    , First(this->Bricks.size() + 1)
  {
  }

  /**
   * The first pass and the sum: count(i) returns the counts of brick i and fills its diamonds'
   * slots, whose member First is the first point of the diamond in the brick, and in all after.
   *
   * @throws std::length_error beyond 2^32 - 1 points
   */
  template <typename Slot, typename Count>
  void CountPoints(std::vector<Slot>& slots, Count&& count)
  {
    this->ForEachBrick(16, [&](std::int64_t i) { this->First[i + 1] = count(i); });
    for (std::size_t i = 0; i < this->Bricks.size(); ++i)
    {
      this->First[i + 1].Points += this->First[i].Points;
      this->First[i + 1].Cells += this->First[i].Cells;
    }
    if (this->Total().Points > std::numeric_limits<std::uint32_t>::max())
    {
      throw std::length_error("more than 2^32 - 1 points");
    }
    this->ForEachBrick(64,
      [&](std::int64_t i)
      {
        const Brick& brick = this->BrickAt(i);
        for (std::uint32_t rank = brick.First; rank < brick.First + brick.Size(); ++rank)
        {
          slots[rank].First += static_cast<std::uint32_t>(this->First[i].Points);
        }
      });
  }

  /** Calls body(i) for every brick, in parallel. */
  template <typename Body>
  void ForEachBrick(std::int64_t grain, Body&& body) const
  {
    this->Parallel(static_cast<std::int64_t>(this->Bricks.size()), grain,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          body(i);
        }
      });
  }

  const BrickPlace& PlaceOf(std::int64_t brick) const { return this->Bricks[brick]; }
  const Brick& BrickAt(std::int64_t brick) const
  {
    const BrickPlace& place = this->Bricks[brick];
    return this->Diamonds.Level(place.Scale).Bricks[place.Index];
  }

  /** The first point and cell of a brick, and the numbers of all. */
  const Counts& FirstOf(std::int64_t brick) const { return this->First[brick]; }
  const Counts& Total() const { return this->First.back(); }

private:
  const DiamondSet& Diamonds;
  ParallelFor Parallel;
  std::vector<BrickPlace> Bricks;
  std::vector<Counts> First; ///< by brick, and the total
};

}

#endif
