// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FineSurface_h
#define isodiamond_FineSurface_h

#include "DistanceError/BrickTriangles.h"
#include "Field/HiddenCells.h"
#include "Field/PeerPortion.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

namespace isodiamond
{

/** Cells, each of eight samples, from a first one to before a last one. */
struct CellBox
{
  Point Low{};
  Point High{};

  bool Holds(const Point& cell) const
  {
    bool holds = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      holds = holds && cell[axis] >= this->Low[axis] && cell[axis] < this->High[axis];
    }
    return holds;
  }
  bool Holds(const CellBox& box) const
  {
    return this->Holds(box.Low) && this->Holds(box.High + Point{ -1, -1, -1 });
  }
  std::int64_t Size() const
  {
    const Point size = this->High + -1 * this->Low;
    return std::int64_t{ size[0] } * size[1] * size[2];
  }
};

/**
 * The triangles of a surface of full resolution by cell: 6 bytes a triangle, and 0.8 for each cell
 * of bricks of 8 x 8 x 8 cells that have some.
 *
 * All of a dense surface takes more memory than its hierarchy, so it can be made for some slices
 * after the others. Who looks at other triangles learns that they are Elsewhere, and that is noted,
 * for the next Bring(): they are made, too, or, of a portion of a hierarchy, fetched from the peers
 * who own them.
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
   *  @param portion that the hierarchy is; null for all. All but the loops must outlive it */
  FineSurface(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const ParallelFor& parallelFor, const PeerPortion* portion);

  ///@{
  /** Of a portion by all peers together. Makes what it owns in some slices, in steps of bricks, and
   * brings what is next to these; brings what has been noted. */
  void Make(const SliceRange& slices);
  void Bring();
  ///@}

  /** Forgets what is here: it is elsewhere again. And what has been noted. */
  void Forget();

  /** Calls body(cell, triangles) for the cells of a box that have some, where `triangles` calls
   *  what it is given with each. Stops where body returns false. @return whether it did not
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
    std::array<std::uint16_t, Rows + 1> Before{}; ///< those of rows before a row, from there on
    std::array<std::uint8_t, Cells / 2> Counts{}; ///< those of two cells: each has 12 at the most

    int Size() const { return this->Before[Rows]; }
    int Count(int cell) const { return (this->Counts[cell / 2] >> (4 * (cell & 1))) & 15; }
    void Add(int cell, int count)
    {
      this->Counts[cell / 2] += static_cast<std::uint8_t>(count << (4 * (cell & 1)));
    }
    /** Once all are counted. */
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

  /** Wants what is elsewhere of the bricks of a box. By any thread. */
  void Note(const CellBox& box) const;

  /** Some bricks, each with its triangles. */
  struct SomeBricks
  {
    std::vector<std::int64_t> Indices;
    std::vector<CellBrick> Bricks;
    std::vector<CellTriangle> Triangles;

    /** Once triangles are counted: where they are. */
    void MakeRoom();
  };

  bool Owns(std::int64_t index) const
  {
    return this->Portion == nullptr || this->Portion->Diamonds().Owns(8 * this->PlaceOf(index)[2]);
  }
  SomeBricks MakeSome(std::vector<std::int64_t> indices) const;
  ///@{
  /** Has what peers make of bricks, of some at once: what is noted here. */
  void FetchAll(std::vector<std::uint64_t> indices);
  SomeBricks Fetch(const std::vector<std::int64_t>& indices) const;
  SomeBricks WhatIsNoted(const SomeBricks& some) const;
  ///@}
  void Keep(SomeBricks some);
  void ForgetNotes();
  /** Those with the other portions; null without. */
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
  mutable std::vector<std::atomic<std::uint8_t>> IsNoted; ///< of these
  mutable std::vector<std::int64_t> Noted;
  mutable std::mutex Mutex;                         ///< of what is noted
  std::vector<std::int64_t> Here;                   ///< the bricks that are not elsewhere
  std::vector<CellBrick> Bricks;                    ///< those of these that have triangles
  std::vector<std::vector<CellTriangle>> Triangles; ///< of some bricks each
};

}

#endif
