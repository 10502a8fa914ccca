// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceExtraction.h"

#include <limits>
#include <stdexcept>

namespace isodiamond
{
namespace
{

/** Triangles of a leaf by the number of its vertices whose sign differs from the centre's. */
constexpr std::array<int, 4> TrianglesOfLeaf = { 0, 1, 2, 1 };

}

template <typename Body>
void SurfaceExtraction::ForEachBrick(std::int64_t grain, Body&& body) const
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

SurfaceExtraction::SurfaceExtraction(const RefinedSet& refined, const ParallelFor& parallelFor)
  : Refined(refined)
  , Source(refined.Hierarchy())
  , Parallel(parallelFor)
  , Bricks(AllBricks(refined.Hierarchy().Diamonds()))
  , Slots(refined.Hierarchy().Diamonds().Size())
  , FirstPoint(this->Bricks.size() + 1, 0)
  , FirstTriangle(this->Bricks.size() + 1, 0)
{
  // Count the alive isovertices and the triangles of every brick.
  this->ForEachBrick(16, [this](std::int64_t i) { this->CountBrick(i); });

  // Prefix sums over the bricks.
  for (std::size_t i = 0; i < this->Bricks.size(); ++i)
  {
    this->FirstPoint[i + 1] += this->FirstPoint[i];
    this->FirstTriangle[i + 1] += this->FirstTriangle[i];
  }
  if (this->PointCount() > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("more than 2^32 - 1 points");
  }

  // Turn the offsets within bricks into ids.
  this->ForEachBrick(64,
    [this](std::int64_t i)
    {
      const Brick& brick =
        this->Source.Diamonds().Level(this->Bricks[i].Scale).Bricks[this->Bricks[i].Index];
      for (std::uint32_t rank = brick.First; rank < brick.First + brick.Size(); ++rank)
      {
        this->Slots[rank].First += static_cast<std::uint32_t>(this->FirstPoint[i]);
      }
    });
}

std::uint32_t SurfaceExtraction::AliveEdges(const Place& place, std::uint32_t edges) const
{
  if (place.Scale == 0)
  {
    return edges;
  }
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  std::uint32_t alive = 0;
  ForEachBit(edges,
    [&](int edge)
    {
      const Place middle{ place.Scale - 1, 2 * place.Position + shape.Offsets[edge] };
      alive |= static_cast<std::uint32_t>(!this->Refined.Contains(middle)) << edge;
    });
  return alive;
}

void SurfaceExtraction::CountBrick(std::int64_t brickNumber)
{
  const BrickPlace& place = this->Bricks[brickNumber];
  const BrickLevel& level = this->Source.Diamonds().Level(place.Scale);
  const Brick& brick = level.Bricks[place.Index];
  const BrickMask& mask = this->Refined.Mask(place.Scale, place.Index);
  const Point origin = level.Box.Origin(brick.BoxIndex);
  std::uint32_t points = 0;
  for (int z = 0; z < 8; ++z)
  {
    ForEachBit(mask[z],
      [&](int bit)
      {
        const std::uint32_t rank = brick.Rank(z, bit);
        const std::uint32_t alive =
          this->AliveEdges({ place.Scale, PositionOf(origin, z, bit) }, this->Source.Edges(rank));
        this->Slots[rank] = { points, alive };
        points += static_cast<std::uint32_t>(PopCount(alive));
      });
  }
  std::int64_t triangles = 0;
  ForEachLeaf(
    this->Refined, place, [this](std::uint32_t rank) { return this->Source.Edges(rank); },
    [&](const Leaf& leaf)
    { triangles += TrianglesOfLeaf[PopCount(this->Source.Edges(leaf.Rank) & leaf.Half.Mask)]; });
  this->FirstPoint[brickNumber + 1] = points;
  this->FirstTriangle[brickNumber + 1] = triangles;
}

void SurfaceExtraction::WritePoints(const AffineMap& world, float* points) const
{
  this->ForEachBrick(16,
    [&](std::int64_t i)
    {
      const BrickPlace& brickPlace = this->Bricks[i];
      const Brick& brick = this->Source.Diamonds().Level(brickPlace.Scale).Bricks[brickPlace.Index];
      float* next = points + 3 * this->FirstPoint[i];
      this->Source.Diamonds().ForEachInBrick(brickPlace.Scale, brick,
        [&](const Place& place, std::uint32_t rank)
        {
          const std::uint32_t edges = this->Source.Edges(rank);
          const std::uint8_t* coefficients = this->Source.Isovertices(rank);
          const ParityTable& shape = tables::Parities[Parity(place.Position)];
          ForEachBit(this->Slots[rank].Alive,
            [&](int edge)
            {
              const Point& offset = shape.Offsets[edge];
              const double along = coefficients[PopCount(edges & ((1U << edge) - 1U))] / 256.0;
              const double h = 1 << place.Scale;
              const std::array<double, 3> position =
                world(h * (place.Position[0] + along * offset[0]),
                  h * (place.Position[1] + along * offset[1]),
                  h * (place.Position[2] + along * offset[2]));
              for (int axis = 0; axis < 3; ++axis)
              {
                *next++ = static_cast<float>(position[axis]);
              }
            });
        });
    });
}

template <typename Id>
Id* SurfaceExtraction::WriteLeaf(const Leaf& leaf, bool mirrored, Id* next) const
{
  const std::array<std::uint8_t, 3>& v = leaf.Half.Vertices;
  const std::uint32_t edges = this->Source.Edges(leaf.Rank);
  const Slot& slot = this->Slots[leaf.Rank];
  const auto differs = [&](int i) { return ((edges >> v[i]) & 1U) != 0; };
  const auto own = [&](int i) { return static_cast<Id>(slot.Id(v[i])); };
  const auto outer = [&](int opposite)
  {
    const OuterEdge& edge = leaf.Half.OuterEdges[opposite];
    const Point vertex = leaf.Parent.Position + leaf.Shape.Offsets[edge.OwnerVertex];
    const int step = edge.OwnerStep;
    const Place owner{ leaf.Parent.Scale + step,
      { vertex[0] >> step, vertex[1] >> step, vertex[2] >> step } };
    return static_cast<Id>(this->Slots[this->Source.Diamonds().Rank(owner)].Id(edge.OwnerEdge));
  };
  // For a centre above the isovalue these wind with normals away from it, to lower values.
  const bool flip = (this->Source.Sign(leaf.Rank) == 0) != mirrored;
  const auto triangle = [&](Id a, Id b, Id c)
  {
    *next++ = a;
    *next++ = flip ? c : b;
    *next++ = flip ? b : c;
  };
  const int count = PopCount(edges & leaf.Half.Mask);
  if (count == 3)
  {
    triangle(own(0), own(1), own(2));
    return next;
  }
  // Turn the vertices so that the ones that differ come first: i alone, or i and j.
  int i = 0;
  while (!(differs(i) && (count == 1 || differs((i + 1) % 3))))
  {
    ++i;
  }
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  if (count == 1)
  {
    triangle(own(i), outer(k), outer(j));
  }
  else
  {
    const Id a = own(i);
    const Id c = outer(i);
    triangle(a, own(j), c);
    triangle(a, c, outer(j));
  }
  return next;
}

template <typename Id>
void SurfaceExtraction::WriteTriangles(bool mirrored, Id* connectivity) const
{
  this->ForEachBrick(16,
    [&](std::int64_t i)
    {
      Id* next = connectivity + 3 * this->FirstTriangle[i];
      ForEachLeaf(
        this->Refined, this->Bricks[i],
        [this](std::uint32_t rank) { return this->Source.Edges(rank); },
        [&](const Leaf& leaf) { next = this->WriteLeaf(leaf, mirrored, next); });
    });
}

template void SurfaceExtraction::WriteTriangles(bool, std::int32_t*) const;
template void SurfaceExtraction::WriteTriangles(bool, std::int64_t*) const;

void SurfaceExtraction::WriteLevels(std::uint8_t* levels) const
{
  const int rootScale = this->Source.Domain().Depth() - 1;
  this->ForEachBrick(16,
    [&](std::int64_t i)
    {
      std::uint8_t* next = levels + this->FirstTriangle[i];
      ForEachLeaf(
        this->Refined, this->Bricks[i],
        [this](std::uint32_t rank) { return this->Source.Edges(rank); },
        [&](const Leaf& leaf)
        {
          const int count = PopCount(this->Source.Edges(leaf.Rank) & leaf.Half.Mask);
          for (int triangle = 0; triangle < TrianglesOfLeaf[count]; ++triangle)
          {
            *next++ = static_cast<std::uint8_t>(rootScale - leaf.Scale);
          }
        });
    });
}

}
