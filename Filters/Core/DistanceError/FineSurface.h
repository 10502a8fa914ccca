// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FineSurface_h
#define isodiamond_FineSurface_h

#include "DistanceError/BrickTriangles.h"
#include "DistanceError/CellBox.h"
#include "Field/HiddenCells.h"
#include "Field/PeerPortion.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace isodiamond
{

/**
 * The triangles of a surface of full resolution by cell: 6 bytes per triangle, and 0.8 per cell of
 * the bricks of 8 x 8 x 8 cells that have some.
 *
 * All of a dense surface takes more memory than its hierarchy, so it can be made a few slices at a
 * time. Looking at other triangles throws Elsewhere, and is noted for the next Bring(): this makes
 * them too or, for a portion of a hierarchy, fetches them from the peers that own them.
 */
class FineSurface
{
public:
  using Triangle = std::array<FinePosition, 3>;

  /** Thrown where triangles are wanted that are not here yet. */
  struct Elsewhere
  {
  };

  /** All of it is here. @param hidden cells that count as empty; null for none; must outlive it */
  FineSurface(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const ParallelFor& parallelFor);

  /** All of it is elsewhere.
   *  @param portion the hierarchy's; null for all. All but the loops must outlive it */
  FineSurface(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const ParallelFor& parallelFor, const PeerPortion* portion);

  ///@{
  /** For a portion, called by all peers together. Make() makes what it owns in some slices, in
   * steps of bricks, and brings what is next to these; Bring() brings what has been noted. */
  void Make(const SliceRange& slices);
  void Bring();
  ///@}

  /** Forgets what is here, which is elsewhere again, and what has been noted. */
  void Forget();

  /** Calls body(cell, triangles) for the cells of a box that have some; triangles(use) calls
   *  use(triangle) for each. Stops when body returns false. @return whether it never did
   *  @throws Elsewhere */
  template <typename Body>
  bool ForEachCell(const CellBox& box, const Body& body) const
  {
    for (int z = box.Low[2] >> 3; z <= (box.High[2] - 1) >> 3; ++z)
    {
      for (int y = box.Low[1] >> 3; y <= (box.High[1] - 1) >> 3; ++y)
      {
        for (int x = box.Low[0] >> 3; x <= (box.High[0] - 1) >> 3; ++x)
        {
          const std::int32_t brick = this->Lookup[this->Index({ x, y, z })];
          if (brick == NotHere)
          {
            this->Note(box);
            throw Elsewhere{};
          }
          if (brick >= 0 && !this->ForEachCellOfBrick({ x, y, z }, this->Bricks[brick], box, body))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  /** All cells there are. */
  CellBox Whole() const
  {
    return { {}, { this->TheGrid.Last(0), this->TheGrid.Last(1), this->TheGrid.Last(2) } };
  }

  /** Whether a cell of a box counts as empty because it is hidden. */
  bool AnyHidden(const CellBox& box) const;

private:
  struct CellBrick
  {
    static constexpr int Cells = BrickTriangles::Cells;
    static constexpr int Rows = 64; ///< of 8 cells along x

    const CellTriangle* First = nullptr;          ///< its triangles
    std::array<std::uint16_t, Rows + 1> Before{}; ///< how many of them precede a row
    std::array<std::uint8_t, Cells / 2> Counts{}; ///< of two cells each: a cell has 12 at most

    int Size() const { return this->Before[Rows]; }
    int Count(int cell) const { return (this->Counts[cell / 2] >> (4 * (cell & 1))) & 15; }
    void Add(int cell, int count)
    {
      this->Counts[cell / 2] += static_cast<std::uint8_t>(count << (4 * (cell & 1)));
    }
    /** Fills Before, once all are counted. */
    void SumUp();
  };

  /** The triangles of one cell. */
  struct TriangleRange
  {
    const CellTriangle* Begin;
    const CellTriangle* End;
    FinePosition Origin;

    template <typename Body>
    void operator()(const Body& body) const
    {
      for (const CellTriangle* stored = this->Begin; stored != this->End; ++stored)
      {
        body(Triangle{ (*stored)[0].After(this->Origin), (*stored)[1].After(this->Origin),
          (*stored)[2].After(this->Origin) });
      }
    }
  };

  template <typename Body>
  bool ForEachCellOfBrick(
    const Point& place, const CellBrick& brick, const CellBox& box, const Body& body) const
  {
    const Point origin = 8 * place;
    Point low{};
    Point high{};
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::max(box.Low[axis] - origin[axis], 0);
      high[axis] = std::min(box.High[axis] - origin[axis], 8);
    }
    for (int z = low[2]; z < high[2]; ++z)
    {
      for (int y = low[1]; y < high[1]; ++y)
      {
        const int row = y + 8 * z;
        if (brick.Before[row] == brick.Before[row + 1])
        {
          continue;
        }
        const CellTriangle* next = brick.First + brick.Before[row];
        for (int x = 0; x < high[0]; ++x)
        {
          const CellTriangle* const begin = next;
          next += brick.Count(x + 8 * row);
          const Point position = origin + Point{ x, y, z };
          if (x >= low[0] && begin != next &&
            !body(position, TriangleRange{ begin, next, FineUnits * position }))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  std::int64_t Index(const Point& brick) const
  {
    return (std::int64_t{ brick[2] } * this->Count[1] + brick[1]) * this->Count[0] + brick[0];
  }

  Point PlaceOf(std::int64_t index) const
  {
    return { static_cast<int>(index % this->Count[0]),
      static_cast<int>(index / this->Count[0] % this->Count[1]),
      static_cast<int>(index / this->Count[0] / this->Count[1]) };
  }

  /** Notes the bricks of a box that are elsewhere. By any thread. */
  void Note(const CellBox& box) const;

  /** Some bricks, each with its triangles. */
  struct SomeBricks
  {
    std::vector<std::int64_t> Indices;
    std::vector<CellBrick> Bricks;
    std::vector<CellTriangle> Triangles;

    /** Gives the triangles their places, once they are counted. */
    void MakeRoom();
  };

  bool Owns(std::int64_t index) const
  {
    return this->Portion == nullptr || this->Portion->Diamonds().Owns(8 * this->PlaceOf(index)[2]);
  }
  SomeBricks MakeSome(std::vector<std::int64_t> indices) const;
  ///@{
  /** Gets bricks that peers make, some at a time: those that are noted here. */
  void FetchAll(std::vector<std::uint64_t> indices);
  SomeBricks Fetch(const std::vector<std::int64_t>& indices) const;
  SomeBricks WhatIsNoted(const SomeBricks& some) const;
  ///@}
  void Keep(SomeBricks some);
  void ForgetNotes();
  /** The peers with the other portions; null without a portion. */
  Peers* Others() const { return this->Portion != nullptr ? &this->Portion->Others() : nullptr; }

  static constexpr std::int32_t None = -1;    ///< in the lookup: there are no triangles
  static constexpr std::int32_t NotHere = -2; ///< there may be some, elsewhere

  const IsodiamondHierarchy& Hierarchy;
  int Surface;
  const HiddenCells* Hidden;
  ParallelFor For;
  const PeerPortion* Portion;
  Grid TheGrid;
  std::array<int, 3> Count{};
  std::vector<std::int32_t> Lookup; ///< of all bricks of cells: index in Bricks, or one of these
  mutable std::vector<std::atomic<std::uint8_t>> IsNoted; ///< of all bricks, too
  mutable std::vector<std::int64_t> Noted;
  mutable std::mutex Mutex;                         ///< guards what is noted
  std::vector<std::int64_t> Here;                   ///< the bricks that are not elsewhere
  std::vector<CellBrick> Bricks;                    ///< those of these that have triangles
  std::vector<std::vector<CellTriangle>> Triangles; ///< each of some bricks
};

}

#endif
