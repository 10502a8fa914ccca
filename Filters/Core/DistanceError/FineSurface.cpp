// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/FineSurface.h"

#include <algorithm>
#include <functional>
#include <numeric>

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
  const HiddenCells* hidden, const ParallelFor& parallelFor, const PeerPortion* portion)
  : TheGrid(hierarchy.SampleGrid())
  , Hidden(hidden)
  , Portion(portion)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Count[axis] = (this->TheGrid.Last(axis) + 7) / 8;
  }
  const std::int64_t all = std::int64_t{ 1 } * this->Count[0] * this->Count[1] * this->Count[2];

  // The bricks of cells next to which there are diamonds.
  this->Lookup.assign(all, None);
  const BrickLevel& level = hierarchy.Diamonds().Level(0);
  const auto hasDiamonds = [&](const Point& brick)
  {
    const std::int64_t index = level.Box.Index(brick);
    return index >= 0 &&
      (portion != nullptr ? portion->All().Find(0, index) != nullptr
                          : level.Find(index) != nullptr);
  };
  std::vector<std::int64_t> indices;
  for (std::int64_t index = 0; index < all; ++index)
  {
    const Point place = this->PlaceOf(index);
    bool any = false;
    for (int i = 0; i < 8 && !any; ++i)
    {
      any = hasDiamonds(place + Point{ i & 1, (i >> 1) & 1, i >> 2 });
    }
    if (any && portion != nullptr && !portion->Diamonds().Owns(8 * place[2]))
    {
      this->Lookup[index] = NotHere;
    }
    else if (any)
    {
      this->Lookup[index] = static_cast<std::int32_t>(indices.size());
      indices.push_back(index);
    }
  }
  if (portion != nullptr)
  {
    this->Wanted = std::vector<std::atomic<std::uint8_t>>(all);
    this->Note({ { 0, 0, portion->Diamonds().Begin() - 8 },
      { this->TheGrid.Last(0), this->TheGrid.Last(1),
        std::min(portion->Diamonds().End(), this->TheGrid.Last(2)) + 8 } });
  }

  // Count.
  this->Bricks.resize(indices.size());
  const auto brickCount = static_cast<std::int64_t>(indices.size());
  ForEachIndex(parallelFor, brickCount, 16,
    [&](std::int64_t i)
    {
      CellBrick& brick = this->Bricks[i];
      Reader(hierarchy, surface, hidden, this->PlaceOf(indices[i]))
        .ForEachPatch([&](int cell, const HalfPlace&, const SurfacePatch& patch)
          { brick.Add(cell, patch.TriangleCount); });
      brick.SumUp();
    });

  // Prefix sum.
  std::int64_t next = 0;
  for (const CellBrick& brick : this->Bricks)
  {
    next += brick.Before[CellBrick::Rows];
  }
  this->Triangles.resize(next);
  const StoredTriangle* first = this->Triangles.data();
  for (CellBrick& brick : this->Bricks)
  {
    brick.First = first;
    first += brick.Before[CellBrick::Rows];
  }

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
      StoredTriangle* begin = this->Triangles.data() + (brick.First - this->Triangles.data());
      for (int cell = 0; cell < CellBrick::Cells; ++cell)
      {
        write[cell] = begin;
        begin += brick.Count(cell);
      }
      const Reader reader(hierarchy, surface, hidden, this->PlaceOf(indices[i]));
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

void FineSurface::Note(const CellBox& box) const
{
  for (int z = std::max(box.Low[2] >> 3, 0);
       z <= std::min((box.High[2] - 1) >> 3, this->Count[2] - 1); ++z)
  {
    for (int y = box.Low[1] >> 3; y <= (box.High[1] - 1) >> 3; ++y)
    {
      for (int x = box.Low[0] >> 3; x <= (box.High[0] - 1) >> 3; ++x)
      {
        const std::int64_t index = this->Index({ x, y, z });
        if (this->Lookup[index] == NotHere)
        {
          this->Wanted[index].store(1, std::memory_order_relaxed);
        }
      }
    }
  }
}

void FineSurface::Fetch()
{
  std::vector<std::uint8_t> wanted(this->Wanted.begin(), this->Wanted.end());
  this->Portion->Others().Or(wanted);
  // Some at once: nobody needs more memory for what others want.
  constexpr std::size_t some = 64;
  std::vector<std::int64_t> indices;
  for (std::size_t index = 0; index < wanted.size(); ++index)
  {
    if (wanted[index] != 0)
    {
      indices.push_back(static_cast<std::int64_t>(index));
    }
    if (indices.size() == some || (index + 1 == wanted.size() && !indices.empty()))
    {
      this->Fetch(indices);
      indices.clear();
    }
  }
}

void FineSurface::Fetch(const std::vector<std::int64_t>& indices)
{
  // How many triangles each has.
  std::vector<std::uint16_t> sizes(indices.size(), 0);
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    if (const std::int32_t brick = this->Lookup[indices[i]]; brick >= 0)
    {
      sizes[i] = this->Bricks[brick].Before[CellBrick::Rows];
    }
  }
  this->Portion->Others().Max(sizes.data(), static_cast<std::int64_t>(sizes.size()));

  // Prefix sum.
  std::vector<std::size_t> begins(indices.size() + 1, 0);
  std::inclusive_scan(
    sizes.begin(), sizes.end(), begins.begin() + 1, std::plus<>(), std::size_t{ 0 });

  // The triangles, and how many there are in each cell.
  constexpr std::size_t counts = CellBrick::Cells / 2;
  std::vector<StoredTriangle> triangles(begins.back());
  std::vector<std::uint8_t> inCells(indices.size() * counts, 0);
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    if (const std::int32_t brick = this->Lookup[indices[i]]; brick >= 0)
    {
      const CellBrick& own = this->Bricks[brick];
      std::copy_n(own.First, sizes[i], triangles.begin() + begins[i]);
      std::copy(own.Counts.begin(), own.Counts.end(), inCells.begin() + i * counts);
    }
  }
  this->Portion->Others().Or(triangles);
  this->Portion->Others().Or(inCells);

  // Keep what was wanted here.
  std::vector<StoredTriangle> kept;
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    if (this->Wanted[indices[i]] != 0)
    {
      kept.insert(kept.end(), triangles.begin() + begins[i], triangles.begin() + begins[i + 1]);
    }
  }
  kept.shrink_to_fit();
  const StoredTriangle* next = kept.data();
  this->OfOthers.push_back(std::move(kept));
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    if (this->Wanted[indices[i]].exchange(0) == 0)
    {
      continue;
    }
    std::int32_t& entry = this->Lookup[indices[i]];
    entry = None;
    if (sizes[i] > 0)
    {
      entry = static_cast<std::int32_t>(this->Bricks.size());
      CellBrick brick;
      brick.First = next;
      next += sizes[i];
      std::copy_n(inCells.begin() + i * counts, counts, brick.Counts.begin());
      brick.SumUp();
      this->Bricks.push_back(brick);
    }
  }
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
