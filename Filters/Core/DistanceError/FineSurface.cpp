// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/FineSurface.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isodiamond
{

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

void FineSurface::SomeBricks::MakeRoom()
{
  std::size_t count = 0;
  for (CellBrick& brick : this->Bricks)
  {
    brick.SumUp();
    count += brick.Size();
  }
  this->Triangles.resize(count);
  const CellTriangle* first = this->Triangles.data();
  for (CellBrick& brick : this->Bricks)
  {
    brick.First = first;
    first += brick.Size();
  }
}

FineSurface::FineSurface(const IsodiamondHierarchy& hierarchy, int surface,
  const HiddenCells* hidden, const ParallelFor& parallelFor)
  : FineSurface(hierarchy, surface, hidden, parallelFor, nullptr)
{
  this->Make({ 0, this->TheGrid.Last(2) + 1 });
}

FineSurface::FineSurface(const IsodiamondHierarchy& hierarchy, int surface,
  const HiddenCells* hidden, const ParallelFor& parallelFor, const PeerPortion* portion)
  : Hierarchy(hierarchy)
  , Surface(surface)
  , Hidden(hidden)
  , For(parallelFor)
  , Portion(portion)
  , TheGrid(hierarchy.SampleGrid())
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Count[axis] = (this->TheGrid.Last(axis) + 7) / 8;
  }
  const std::int64_t all = std::int64_t{ 1 } * this->Count[0] * this->Count[1] * this->Count[2];

  // The bricks of cells next to which there are diamonds.
  this->Lookup.assign(all, None);
  this->IsNoted = std::vector<std::atomic<std::uint8_t>>(all);
  const BrickLevel& level = hierarchy.Diamonds().Level(0);
  const auto hasDiamonds = [&](const Point& brick)
  {
    const std::int64_t index = level.Box.Index(brick);
    return index >= 0 &&
      (portion != nullptr ? portion->All().Find(0, index) != nullptr
                          : level.Find(index) != nullptr);
  };
  for (std::int64_t index = 0; index < all; ++index)
  {
    const Point place = this->PlaceOf(index);
    bool any = false;
    for (int i = 0; i < 8 && !any; ++i)
    {
      any = hasDiamonds(place + Point{ i & 1, (i >> 1) & 1, i >> 2 });
    }
    this->Lookup[index] = any ? NotHere : None;
  }
}

void FineSurface::Make(const SliceRange& slices)
{
  InStep(this->Others(),
    [&]
    {
      const std::int64_t layer = std::int64_t{ 1 } * this->Count[0] * this->Count[1];
      std::vector<std::int64_t> indices;
      for (int z = slices.Begin / 8; 8 * z < slices.End && z < this->Count[2]; ++z)
      {
        for (std::int64_t index = z * layer; index < (z + 1) * layer; ++index)
        {
          if (this->Lookup[index] == NotHere && this->Owns(index))
          {
            indices.push_back(index);
          }
        }
      }
      this->Keep(this->MakeSome(std::move(indices)));
      if (slices.Begin < slices.End)
      {
        this->Note({ { 0, 0, slices.Begin - 8 },
          { this->TheGrid.Last(0), this->TheGrid.Last(1),
            std::min(slices.End, this->TheGrid.Last(2)) + 8 } });
      }
    });
  this->Bring();
}

FineSurface::SomeBricks FineSurface::MakeSome(std::vector<std::int64_t> indices) const
{
  SomeBricks made;
  made.Indices = std::move(indices);
  const auto brickCount = static_cast<std::int64_t>(made.Indices.size());
  const auto trianglesOf = [&](std::int64_t i) -> BrickTriangles {
    return { this->Hierarchy, this->Surface, this->Hidden, this->PlaceOf(made.Indices[i]) };
  };

  // Count.
  made.Bricks.resize(made.Indices.size());
  ForEachIndex(this->For, brickCount, 4,
    [&](std::int64_t i)
    {
      trianglesOf(i).ForEachTetrahedron([&](const BrickTriangles::Tetrahedron& tetrahedron)
        { made.Bricks[i].Add(tetrahedron.Cell, tetrahedron.Patch.TriangleCount); });
    });

  // Prefix sum.
  made.MakeRoom();

  // Write.
  ForEachIndex(this->For, brickCount, 4,
    [&](std::int64_t i)
    {
      const CellBrick& brick = made.Bricks[i];
      if (brick.Size() == 0)
      {
        return;
      }
      std::array<CellTriangle*, CellBrick::Cells> write;
      CellTriangle* begin = made.Triangles.data() + (brick.First - made.Triangles.data());
      for (int cell = 0; cell < CellBrick::Cells; ++cell)
      {
        write[cell] = begin;
        begin += brick.Count(cell);
      }
      const BrickTriangles triangles = trianglesOf(i);
      triangles.ForEachTetrahedron(
        [&](const BrickTriangles::Tetrahedron& tetrahedron)
        {
          for (int number = 0; number < tetrahedron.Patch.TriangleCount; ++number)
          {
            *write[tetrahedron.Cell]++ = triangles.TriangleOf(tetrahedron, number);
          }
        });
    });
  return made;
}

void FineSurface::Keep(SomeBricks some)
{
  for (std::size_t i = 0; i < some.Indices.size(); ++i)
  {
    std::int32_t& entry = this->Lookup[some.Indices[i]];
    entry = None;
    if (some.Bricks[i].Size() > 0)
    {
      entry = static_cast<std::int32_t>(this->Bricks.size());
      this->Bricks.push_back(some.Bricks[i]);
    }
  }
  this->Here.insert(this->Here.end(), some.Indices.begin(), some.Indices.end());
  this->Triangles.push_back(std::move(some.Triangles));
}

void FineSurface::Forget()
{
  for (const std::int64_t index : this->Here)
  {
    this->Lookup[index] = NotHere;
  }
  this->Here.clear();
  this->Bricks.clear();
  this->Triangles.clear();
  this->ForgetNotes();
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
        if (this->Lookup[index] == NotHere && this->IsNoted[index].exchange(1) == 0)
        {
          const std::lock_guard<std::mutex> lock(this->Mutex);
          this->Noted.push_back(index);
        }
      }
    }
  }
}

void FineSurface::Bring()
{
  std::vector<std::uint64_t> ofOthers;
  InStep(this->Others(),
    [&]
    {
      std::vector<std::int64_t> own;
      for (const std::int64_t index : this->Noted)
      {
        if (this->Owns(index))
        {
          own.push_back(index);
        }
        else
        {
          ofOthers.push_back(static_cast<std::uint64_t>(index));
        }
      }
      this->Keep(this->MakeSome(std::move(own)));
    });
  if (this->Portion != nullptr)
  {
    this->FetchAll(this->Others()->Gather(ofOthers));
  }
  this->ForgetNotes();
}

void FineSurface::FetchAll(std::vector<std::uint64_t> indices)
{
  // The layers take turns, so that all owners have something to do.
  const std::uint64_t layer = std::uint64_t{ 1 } * this->Count[0] * this->Count[1];
  std::sort(indices.begin(), indices.end(),
    [&](std::uint64_t a, std::uint64_t b)
    { return a % layer != b % layer ? a % layer < b % layer : a < b; });
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  // Some at a time: no process needs more memory for what others want.
  constexpr std::size_t some = 64;
  for (std::size_t first = 0; first < indices.size(); first += some)
  {
    const auto begin = indices.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(some, indices.size() - first));
    this->Keep(this->Fetch({ begin, end }));
  }
}

FineSurface::SomeBricks FineSurface::Fetch(const std::vector<std::int64_t>& indices) const
{
  // How many triangles there are in each cell, and then the triangles.
  std::vector<std::array<std::uint8_t, CellBrick::Cells / 2>> counts;
  std::vector<std::size_t> places; // of those that are made here
  SomeBricks made;
  SomeBricks all;
  InStep(this->Others(),
    [&]
    {
      std::vector<std::int64_t> own;
      for (std::size_t i = 0; i < indices.size(); ++i)
      {
        if (this->Owns(indices[i]))
        {
          places.push_back(i);
          own.push_back(indices[i]);
        }
      }
      made = this->MakeSome(std::move(own));
      counts.resize(indices.size());
      for (std::size_t m = 0; m < places.size(); ++m)
      {
        counts[places[m]] = made.Bricks[m].Counts;
      }
    });
  this->Others()->Or(counts);
  InStep(this->Others(),
    [&]
    {
      all.Indices = indices;
      all.Bricks.resize(indices.size());
      for (std::size_t i = 0; i < indices.size(); ++i)
      {
        all.Bricks[i].Counts = counts[i];
      }
      all.MakeRoom();
      for (std::size_t m = 0; m < places.size(); ++m)
      {
        const CellBrick& brick = made.Bricks[m];
        const auto to = all.Bricks[places[m]].First - all.Triangles.data();
        std::copy_n(brick.First, brick.Size(), all.Triangles.begin() + to);
      }
    });
  this->Others()->Or(all.Triangles);
  return this->WhatIsNoted(all);
}

FineSurface::SomeBricks FineSurface::WhatIsNoted(const SomeBricks& some) const
{
  SomeBricks noted;
  for (std::size_t i = 0; i < some.Indices.size(); ++i)
  {
    if (this->IsNoted[some.Indices[i]] != 0)
    {
      const CellBrick& brick = some.Bricks[i];
      noted.Indices.push_back(some.Indices[i]);
      noted.Bricks.push_back(brick);
      noted.Triangles.insert(noted.Triangles.end(), brick.First, brick.First + brick.Size());
    }
  }
  noted.Triangles.shrink_to_fit();
  noted.MakeRoom();
  return noted;
}

void FineSurface::ForgetNotes()
{
  for (const std::int64_t index : this->Noted)
  {
    this->IsNoted[index] = 0;
  }
  this->Noted.clear();
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
