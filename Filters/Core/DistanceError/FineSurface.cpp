// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/FineSurface.h"

#include <algorithm>

namespace isodiamond
{

/** Reads the triangles of one brick of cells off the diamonds of scale 0. */
class FineSurface::Reader
{
public:
  Reader(const IsodiamondHierarchy& hierarchy, int surface, const HiddenCells* hidden,
    const Point& brick)
    : Hierarchy(hierarchy)
    , Surface(surface)
    , Hidden(hidden)
    , Origin(8 * brick)
    , Window(hierarchy.Diamonds().Level(0), 8 * brick)
  {
  }

  /** Calls body(cell, tetrahedron, patch) for the tetrahedra that have one, cells as in a brick. */
  template <typename Body>
  void ForEachPatch(const Body& body) const
  {
    // A tetrahedron is half of one of the diamonds of class 2 at its youngest vertex, which can be
    // the last of its cell on each axis.
    for (Point offset{}; offset[2] <= 8; ++offset[2])
    {
      for (offset[1] = 0; offset[1] <= 8; ++offset[1])
      {
        for (offset[0] = 0; offset[0] <= 8; ++offset[0])
        {
          const int parity = Parity(offset); // the origin is even
          if (parity != 0 && tables::Parities[parity].DiamondClass == 2)
          {
            this->ForEachPatchOf({ 0, this->Origin + offset }, body);
          }
        }
      }
    }
  }

  /** @param cell as in a brick */
  StoredTriangle Place(
    int cell, const HalfPlace& tetrahedron, const std::array<std::uint8_t, 3>& edges) const
  {
    const Point inBrick = { cell & 7, (cell >> 3) & 7, cell >> 6 };
    StoredTriangle triangle;
    for (int i = 0; i < 3; ++i)
    {
      const auto [owner, edge] = OwnedEdgeOf(tetrahedron, edges[i]);
      const auto rank = static_cast<std::uint32_t>(this->Window.Rank(owner.Position));
      triangle[i] = { IsovertexAt(this->Hierarchy, owner, rank, edge, this->Surface),
        this->Origin + inBrick, owner.Position,
        tables::Parities[Parity(owner.Position)].Offsets[edge] };
    }
    return triangle;
  }

private:
  template <typename Body>
  void ForEachPatchOf(const isodiamond::Place& youngest, const Body& body) const
  {
    const std::int64_t found = this->Window.Rank(youngest.Position);
    if (found == DiamondSet::None)
    {
      return;
    }
    const auto rank = static_cast<std::uint32_t>(found);
    const TypeTable& shape = ShapeOf(youngest.Position);
    for (int i = 0; i < shape.HalfTetrahedronCount; ++i)
    {
      const HalfTetrahedron& half = shape.HalfTetrahedra[i];
      Point cell = youngest.Position;
      for (const std::uint8_t vertex : half.Vertices)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          cell[axis] = std::min(cell[axis], youngest.Position[axis] + shape.Offsets[vertex][axis]);
        }
      }
      const Point inBrick = cell + -1 * this->Origin;
      if (CellBox{ {}, { 8, 8, 8 } }.Holds(inBrick) && this->IsThere(cell))
      {
        const SurfacePatch patch = PatchOf(this->Hierarchy, rank, half, this->Surface);
        if (patch.TriangleCount > 0)
        {
          body(inBrick[0] + 8 * inBrick[1] + 64 * inBrick[2], HalfPlace{ youngest, rank, &half },
            patch);
        }
      }
    }
  }

  bool IsThere(const Point& cell) const
  {
    const Point& last = cell + Point{ 1, 1, 1 };
    return this->Hierarchy.SampleGrid().IsSampled(cell) &&
      this->Hierarchy.SampleGrid().IsSampled(last) &&
      !(this->Hidden != nullptr && (*this->Hidden)(cell));
  }

  const IsodiamondHierarchy& Hierarchy;
  int Surface;
  const HiddenCells* Hidden;
  Point Origin;
  BrickWindow Window;
};

void FineSurface::CellBrick::SumUp()
{
  for (int row = 0; row < Rows; ++row)
  {
    int sum = this->Before[row];
    for (int x = 0; x < 8; ++x)
    {
      sum += this->Count(x + 8 * row);
    }
    this->Before[row + 1] = static_cast<std::uint16_t>(sum);
  }
}

FineSurface::FineSurface(const IsodiamondHierarchy& hierarchy, int surface,
  const HiddenCells* hidden, const ParallelFor& parallelFor)
  : TheGrid(hierarchy.SampleGrid())
  , Hidden(hidden)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Count[axis] = (this->TheGrid.Last(axis) + 7) / 8;
  }
  const std::int64_t all = std::int64_t{ 1 } * this->Count[0] * this->Count[1] * this->Count[2];
  const auto placeOf = [&](std::int64_t index)
  {
    return Point{ static_cast<int>(index % this->Count[0]),
      static_cast<int>(index / this->Count[0] % this->Count[1]),
      static_cast<int>(index / this->Count[0] / this->Count[1]) };
  };

  // The bricks of cells next to which there are diamonds.
  this->Lookup.assign(all, -1);
  const BrickLevel& level = hierarchy.Diamonds().Level(0);
  std::vector<std::int64_t> indices;
  for (std::int64_t index = 0; index < all; ++index)
  {
    bool any = false;
    for (int i = 0; i < 8 && !any; ++i)
    {
      any = level.Find(8 * (placeOf(index) + Point{ i & 1, (i >> 1) & 1, i >> 2 })) != nullptr;
    }
    if (any)
    {
      this->Lookup[index] = static_cast<std::int32_t>(indices.size());
      indices.push_back(index);
    }
  }

  // Count.
  this->Bricks.resize(indices.size());
  const auto brickCount = static_cast<std::int64_t>(indices.size());
  ForEachIndex(parallelFor, brickCount, 16,
    [&](std::int64_t i)
    {
      CellBrick& brick = this->Bricks[i];
      Reader(hierarchy, surface, hidden, placeOf(indices[i]))
        .ForEachPatch([&](int cell, const HalfPlace&, const SurfacePatch& patch)
          { brick.Add(cell, patch.TriangleCount); });
      brick.SumUp();
    });

  // Prefix sum.
  std::int64_t next = 0;
  for (CellBrick& brick : this->Bricks)
  {
    brick.First = next;
    next += brick.Before[CellBrick::Rows];
  }
  this->Triangles.resize(next);

  // Write.
  ForEachIndex(parallelFor, brickCount, 16,
    [&](std::int64_t i)
    {
      const CellBrick& brick = this->Bricks[i];
      if (brick.Before[CellBrick::Rows] == 0)
      {
        return;
      }
      std::array<StoredTriangle*, CellBrick::Cells> write;
      StoredTriangle* begin = this->Triangles.data() + brick.First;
      for (int cell = 0; cell < CellBrick::Cells; ++cell)
      {
        write[cell] = begin;
        begin += brick.Count(cell);
      }
      const Reader reader(hierarchy, surface, hidden, placeOf(indices[i]));
      reader.ForEachPatch(
        [&](int cell, const HalfPlace& tetrahedron, const SurfacePatch& patch)
        {
          for (int t = 0; t < patch.TriangleCount; ++t)
          {
            *write[cell]++ = reader.Place(cell, tetrahedron, patch.Triangles[t]);
          }
        });
    });
}

bool FineSurface::AnyHidden(const CellBox& box) const
{
  bool any = false;
  for (int z = box.Low[2]; this->Hidden != nullptr && z < box.High[2] && !any; ++z)
  {
    for (int y = box.Low[1]; y < box.High[1] && !any; ++y)
    {
      for (int x = box.Low[0]; x < box.High[0] && !any; ++x)
      {
        any = (*this->Hidden)({ x, y, z });
      }
    }
  }
  return any;
}

}
