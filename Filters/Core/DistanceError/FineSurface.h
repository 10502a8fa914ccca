// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_FineSurface_h
#define isodiamond_FineSurface_h

#include "DistanceError/IsovertexClusters.h"
#include "Field/HiddenCells.h"
#include "Field/Parallel.h"
#include "Lattice/DiamondTetrahedra.h"
#include "Patches/SurfacePatch.h"

#include <array>
#include <cassert>
#include <cstdint>
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
 * The triangles of a surface of full resolution by cell: 18 bytes a triangle, and two for each cell
 * of bricks of 8 x 8 x 8 cells that have some.
 */
class FineSurface
{
public:
  using Triangle = std::array<FinePosition, 3>;

  /** @param hidden cells that count as empty; null for none; must outlive it */
  FineSurface(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const ParallelFor& parallelFor);

  /** Calls body(cell, triangles) for the cells of a box that have some, where `triangles` calls
   *  what it is given with each. Stops where body returns false. @return whether it did not */
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
  /** Corners from the brick's first sample on. */
  using StoredTriangle = std::array<std::array<std::int16_t, 3>, 3>;

  struct CellBrick
  {
    std::int64_t First = 0;                  ///< its triangles in the list of all
    std::array<std::uint16_t, 513> Before{}; ///< those of cells before a cell, from there on
  };

  /** The triangles of one cell. */
  struct TriangleRange
  {
    const StoredTriangle* Begin;
    const StoredTriangle* End;
    FinePosition Origin;

    template <typename Body>
    void operator()(const Body& body) const
    {
      for (const StoredTriangle* stored = this->Begin; stored != this->End; ++stored)
      {
        Triangle triangle;
        for (int i = 0; i < 3; ++i)
        {
          triangle[i] =
            this->Origin + FinePosition{ (*stored)[i][0], (*stored)[i][1], (*stored)[i][2] };
        }
        body(triangle);
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
    const StoredTriangle* all = this->Triangles.data() + brick.First;
    for (int z = low[2]; z < high[2]; ++z)
    {
      for (int y = low[1]; y < high[1]; ++y)
      {
        for (int x = low[0]; x < high[0]; ++x)
        {
          const int cell = x + 8 * y + 64 * z;
          if (brick.Before[cell] < brick.Before[cell + 1] &&
            !body(origin + Point{ x, y, z },
              TriangleRange{
                all + brick.Before[cell], all + brick.Before[cell + 1], FineUnits * origin }))
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

  class Reader;

  Grid TheGrid;
  const HiddenCells* Hidden;
  std::array<int, 3> Count{};
  std::vector<std::int32_t> Lookup; ///< of all bricks of cells: index in Bricks, or -1
  std::vector<CellBrick> Bricks;
  std::vector<StoredTriangle> Triangles;
};

}

#endif
