// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/BrickTriangles.h"

#include "Lattice/DiamondTetrahedra.h"

#include <algorithm>
#include <cassert>

namespace isodiamond
{
namespace
{

/** The first sample of the cell that a half lies in, relative to its diamond's centre. */
Point CellOf(const TypeTable& shape, const HalfTetrahedron& half)
{
  Point cell{};
  for (const std::uint8_t vertex : half.Vertices)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      cell[axis] = std::min(cell[axis], shape.Offsets[vertex][axis]);
    }
  }
  return cell;
}

/** Bits of a corner of the cell. */
int BitsOf(const Point& corner)
{
  assert(((corner[0] | corner[1] | corner[2]) & ~1) == 0 && "a corner of the cell");
  return corner[0] | corner[1] << 1 | corner[2] << 2;
}

CellHalf HalfOf(const Point& position, const HalfTetrahedron& half)
{
  CellHalf made;
  made.Cell = CellOf(ShapeOf(position), half);
  for (int edge = 0; edge < 6; ++edge)
  {
    const auto [owner, ownerEdge] = OwnedEdgeOf({ { 0, position }, 0, &half }, edge);
    assert(owner.Scale == 0 && "one of an edge's ends is odd on some axis");
    const Point offset = owner.Position + -1 * position;
    const Point begin = offset + -1 * made.Cell;
    const Point end = begin + tables::Parities[Parity(owner.Position)].Offsets[ownerEdge];
    made.Corners[edge] = { offset, ownerEdge,
      static_cast<std::uint8_t>(BitsOf(begin) | BitsOf(end) << 3) };
  }
  return made;
}

}

const CellHalves& AllCellHalves()
{
  static const CellHalves all = []
  {
    CellHalves halves{};
    for (int type = 0; type < 64; ++type)
    {
      const Point example = PositionOfType(type);
      const TypeTable& shape = ShapeOf(example);
      for (int i = 0; shape.DiamondClass == 2 && i < shape.HalfTetrahedronCount; ++i)
      {
        halves[type][i] = HalfOf(example, shape.HalfTetrahedra[i]);
      }
    }
    return halves;
  }();
  return all;
}

BrickTriangles::BrickTriangles(
  const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden, const Point& brick)
  : Hierarchy(hierarchy)
  , Surface(surface)
  , Hidden(hidden)
  , Halves(AllCellHalves())
  , Origin(8 * brick)
{
  const BrickLevel& level = hierarchy.Diamonds().Level(0);
  const Point last = this->Origin + Point{ 8, 8, 8 };
  level.ForEachBrickBetween(this->Origin, last,
    [&](std::int32_t index, const Point& origin)
    {
      const Brick& of = level.Bricks[index];
      ForEachWordBetween(of.Occupancy, origin, this->Origin, last,
        [&](int z, std::uint64_t bits)
        {
          ForEachBit(bits,
            [&](int bit)
            {
              const std::uint32_t rank = of.Rank(z, bit);
              const std::uint32_t lower = hierarchy.Edges(rank);
              const std::int64_t first = hierarchy.FirstIsovertexOf(rank);
              const Point sample = PositionOf(origin, z, bit) + -1 * this->Origin;
              this->Owners[IndexOf(sample)] = surface == 0
                ? Owner{ rank, lower, first }
                : Owner{ rank, hierarchy.UpperEdges(rank), first + PopCount(lower) };
            });
        });
    });
  for (int axis = 0; axis < 3; ++axis)
  {
    this->There.High[axis] = std::min(hierarchy.SampleGrid().Last(axis) - this->Origin[axis], 8);
  }
}

}
