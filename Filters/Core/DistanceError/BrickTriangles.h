// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BrickTriangles_h
#define isodiamond_BrickTriangles_h

#include "DistanceError/CellBox.h"
#include "Field/HiddenCells.h"
#include "Lattice/HalfTetrahedronMasks.h"
#include "Patches/ExactPlane.h"
#include "Patches/SurfacePatch.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** A corner of a triangle of full resolution, relative to its cell's first sample: it lies between
 *  two samples of the cell, each given by one bit per axis, some 256ths of the way along. */
struct CellCorner
{
  std::uint8_t Ends = 0; ///< bits 0 to 2: where the edge begins; 3 to 5: where it leads to
  std::uint8_t Along = 0;

  FinePosition After(const FinePosition& origin) const
  {
    FinePosition position = origin;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int begin = (this->Ends >> axis) & 1;
      const int end = (this->Ends >> (3 + axis)) & 1;
      position[axis] += FineUnits * begin + this->Along * (end - begin);
    }
    return position;
  }
};

using CellTriangle = std::array<CellCorner, 3>;
static_assert(sizeof(CellTriangle) == 6, "of dense surfaces there are more than of all else");

/** What the type of a diamond of class 2 says about one of its halves at full resolution. */
struct CellHalf
{
  /** Where the isovertex on an edge comes from; edges are numbered as in SurfacePatch. */
  struct Corner
  {
    Point Owner{}; ///< of the edge, relative to the diamond
    std::uint8_t Edge = 0;
    std::uint8_t Ends = 0; ///< as in CellCorner
  };

  Point Cell{}; ///< that the half lies in, relative to the diamond
  std::array<Corner, 6> Corners;
};

/** By type, then by half; for the types of class 2 only. */
using CellHalves = std::array<std::array<CellHalf, MaximumHalfTetrahedra>, 64>;
const CellHalves& AllCellHalves();

/**
 * Reads the triangles of a surface of full resolution in a brick of 8 x 8 x 8 cells off the
 * diamonds of scale 0.
 *
 * Each tetrahedron of a cell is a half of the diamond of class 2 at its youngest vertex. The type
 * of that diamond determines its triangles, except for how far along their edges the corners are.
 * That is stored with the owners of the edges, which are looked up once for the whole brick.
 */
class BrickTriangles
{
public:
  static constexpr int Cells = 512;

  /** All must outlive it. @param hidden cells that count as empty; null for none */
  BrickTriangles(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const Point& brick);

  /** A tetrahedron with triangles. */
  struct Tetrahedron
  {
    int Cell = 0;     ///< of the brick, x fastest
    Point Youngest{}; ///< of its vertices, relative to the brick's first sample
    const CellHalf* Half = nullptr;
    SurfacePatch Patch;
  };

  /** Calls body(tetrahedron) for all of them, in the order of their youngest vertices. */
  template <typename Body>
  void ForEachTetrahedron(const Body& body) const
  {
    for (Point sample{}; sample[2] < Width; ++sample[2])
    {
      for (sample[1] = 0; sample[1] < Width; ++sample[1])
      {
        for (sample[0] = 0; sample[0] < Width; ++sample[0])
        {
          if (this->At(sample).Edges != 0 &&
            tables::Parities[Parity(sample)].DiamondClass == 2) // the brick's origin is even
          {
            this->ForEachHalf(sample, body);
          }
        }
      }
    }
  }

  /** A triangle of a tetrahedron's patch. */
  CellTriangle TriangleOf(const Tetrahedron& tetrahedron, int number) const
  {
    CellTriangle triangle;
    for (int i = 0; i < 3; ++i)
    {
      const CellHalf::Corner& corner =
        tetrahedron.Half->Corners[tetrahedron.Patch.Triangles[number][i]];
      const Owner& owner = this->At(tetrahedron.Youngest + corner.Owner);
      const std::uint32_t before = owner.Edges & ((1U << corner.Edge) - 1U);
      triangle[i] = { corner.Ends, this->Hierarchy.Isovertex(owner.First + PopCount(before)) };
    }
    return triangle;
  }

private:
  static constexpr int Width = 9; ///< samples of the brick's cells along an axis

  /** A diamond that owns edges which the surface crosses. */
  struct Owner
  {
    std::uint32_t Rank = 0;
    std::uint32_t Edges = 0; ///< these edges; none where there is no diamond
    std::int64_t First = 0;  ///< number of the isovertex on the first of them
  };

  static constexpr int IndexOf(const Point& sample)
  {
    return sample[0] + Width * (sample[1] + Width * sample[2]);
  }
  const Owner& At(const Point& sample) const { return this->Owners[IndexOf(sample)]; }

  template <typename Body>
  void ForEachHalf(const Point& sample, const Body& body) const
  {
    const Owner& owner = this->At(sample);
    const int type = TypeOf(this->Origin + sample);
    const HalfTetrahedronMask crossed = tables::MasksAsListed[type](owner.Edges);
    ForEachBit(HalvesWithAny(crossed),
      [&](int bit)
      {
        const int half = bit / 4;
        Tetrahedron found{ 0, sample, &this->Halves[type][half], {} };
        const Point cell = sample + found.Half->Cell;
        if (this->IsThere(cell))
        {
          found.Cell = cell[0] + 8 * (cell[1] + 8 * cell[2]);
          found.Patch = this->Hierarchy.Region().IsVolume()
            ? PatchOf(this->Hierarchy, owner.Rank, tables::Types[type].HalfTetrahedra[half],
                this->Surface)
            : tables::IsosurfacePatches[(crossed >> bit) & 7U];
          if (found.Patch.TriangleCount > 0)
          {
            body(found);
          }
        }
      });
  }

  bool IsThere(const Point& cell) const
  {
    return this->There.Holds(cell) &&
      (this->Hidden == nullptr || !(*this->Hidden)(this->Origin + cell));
  }

  const IsodiamondHierarchy& Hierarchy;
  int Surface;
  const HiddenCells* Hidden;
  const CellHalves& Halves;
  Point Origin;  ///< the brick's first sample
  CellBox There; ///< the brick's cells that are in the grid
  std::array<Owner, Width * Width * Width> Owners{};
};

}

#endif
