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
        const std::uint32_t alive = AliveEdges(
          this->Refined, { place.Scale, PositionOf(origin, z, bit) }, this->Source.Edges(rank));
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
              const std::array<double, 3> inside = IsovertexPosition(
                place, shape.Offsets[edge], coefficients[PopCount(edges & ((1U << edge) - 1U))]);
              const std::array<double, 3> position = world(inside[0], inside[1], inside[2]);
              for (int axis = 0; axis < 3; ++axis)
              {
                *next++ = static_cast<float>(position[axis]);
              }
            });
        });
    });
}

/** Writes the triangles of one brick's leaves, one after the other. */
template <typename Id>
class SurfaceExtraction::TriangleWriter
{
public:
  TriangleWriter(
    const SurfaceExtraction& extraction, bool mirrored, Id* connectivity, std::int8_t* levels)
    : Extraction(extraction)
    , Source(extraction.Source)
    , Mirrored(mirrored)
    , Next(connectivity)
    , NextLevel(levels)
  {
  }

  void Write(const Leaf& leaf)
  {
    if (leaf.Rank != this->Rank)
    {
      this->Enter(leaf);
    }
    const std::array<std::uint8_t, 3>& v = leaf.Half.Vertices;
    const auto own = [&](int i) { return static_cast<Id>(this->Own.Id(v[i])); };
    const auto outer = [&](int opposite) { return this->OuterId(leaf, opposite); };
    const int count = PopCount(this->Edges & leaf.Half.Mask);
    if (count == 3)
    {
      this->Triangle(leaf, own(0), own(1), own(2));
      return;
    }
    // Turn the vertices so that the ones that differ from the centre come first: i, or i and j.
    const auto differs = [&](int i) { return ((this->Edges >> v[i]) & 1U) != 0; };
    int i = 0;
    while (!(differs(i) && (count == 1 || differs(i == 2 ? 0 : i + 1))))
    {
      ++i;
    }
    const int j = i == 2 ? 0 : i + 1;
    const int k = 3 - i - j;
    if (count == 1)
    {
      this->Triangle(leaf, own(i), outer(k), outer(j));
      return;
    }
    const Id a = own(i);
    const Id c = outer(i);
    this->Triangle(leaf, a, own(j), c);
    this->Triangle(leaf, a, c, outer(j));
  }

private:
  /** A new parent: its slot, and nothing known yet of the owners around it. */
  void Enter(const Leaf& leaf)
  {
    this->Rank = leaf.Rank;
    this->Edges = this->Source.Edges(leaf.Rank);
    this->Own = this->Extraction.Slots[leaf.Rank];
    this->Known = 0;
    // For a centre above the isovalue triangles wind with normals away from it.
    this->Flip = (this->Source.Sign(leaf.Rank) == 0) != this->Mirrored;
  }

  /** The point on a leaf's edge that belongs to an older diamond. */
  Id OuterId(const Leaf& leaf, int opposite)
  {
    const OuterEdge& edge = leaf.Half.OuterEdges[opposite];
    const int vertex = edge.OwnerVertex;
    if (((this->Known >> vertex) & 1U) == 0)
    {
      this->Known |= 1U << vertex;
      this->Owners[vertex] = this->Extraction.Slots[this->OwnerRank(leaf, edge)];
    }
    return static_cast<Id>(this->Owners[vertex].Id(edge.OwnerEdge));
  }

  std::int64_t OwnerRank(const Leaf& leaf, const OuterEdge& edge) const
  {
    const Point vertex = leaf.Parent.Position + leaf.Shape.Offsets[edge.OwnerVertex];
    const DiamondSet& set = this->Source.Diamonds();
    if (edge.OwnerStep != 0)
    {
      return set.Rank(
        { leaf.Parent.Scale + 1, { vertex[0] >> 1, vertex[1] >> 1, vertex[2] >> 1 } });
    }
    const BrickLevel& level = set.Level(leaf.Parent.Scale);
    return level.Bricks[leaf.Window.IndexAt(vertex)].Rank(vertex[2] & 7, BitOf(vertex));
  }

  void Triangle(const Leaf& leaf, Id a, Id b, Id c)
  {
    this->Next[0] = a;
    this->Next[1] = this->Flip ? c : b;
    this->Next[2] = this->Flip ? b : c;
    this->Next += 3;
    *this->NextLevel++ = static_cast<std::int8_t>(this->Source.Domain().Depth() - 1 - leaf.Scale);
  }

  const SurfaceExtraction& Extraction;
  const IsodiamondHierarchy& Source;
  bool Mirrored;
  Id* Next;
  std::int8_t* NextLevel;

  // Of the current parent.
  std::int64_t Rank = DiamondSet::None;
  std::uint32_t Edges = 0;
  Slot Own;
  bool Flip = false;
  std::uint32_t Known = 0; ///< vertices whose slots are in Owners
  std::array<Slot, MaximumVertices> Owners{};
};

template <typename Id>
void SurfaceExtraction::WriteTriangles(bool mirrored, Id* connectivity, std::int8_t* levels) const
{
  this->ForEachBrick(16,
    [&](std::int64_t i)
    {
      TriangleWriter<Id> writer(*this, mirrored, connectivity + 3 * this->FirstTriangle[i],
        levels + this->FirstTriangle[i]);
      ForEachLeaf(
        this->Refined, this->Bricks[i],
        [this](std::uint32_t rank) { return this->Source.Edges(rank); },
        [&](const Leaf& leaf) { writer.Write(leaf); });
    });
}

template void SurfaceExtraction::WriteTriangles(bool, std::int32_t*, std::int8_t*) const;
template void SurfaceExtraction::WriteTriangles(bool, long long*, std::int8_t*) const;

}
