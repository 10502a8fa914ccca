// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceExtraction.h"

#include "SurfacePatch.h"

namespace isodiamond
{
SurfaceExtraction::SurfaceExtraction(const RefinedSet& refined, const ParallelFor& parallelFor)
  : Refined(refined)
  , Source(refined.Hierarchy())
  , Passes(refined, parallelFor)
  , Among(refined.IsFull() ? ClassTwoPositions() : EveryPosition())
  , Slots(refined.Hierarchy().Diamonds().Size())
{
  this->Passes.CountPoints(this->Slots, [this](std::int64_t i) { return this->CountBrick(i); });
}

template <typename Body>
void SurfaceExtraction::ForEachCrossedLeaf(const BrickPlace& place, Body&& body) const
{
  ForEachLeaf(
    this->Refined, place, [this](std::uint32_t rank) { return this->Source.Edges(rank); }, body,
    this->Among);
}

ExtractionPasses::Counts SurfaceExtraction::CountBrick(std::int64_t brickNumber)
{
  const BrickPlace& place = this->Passes.PlaceOf(brickNumber);
  if (this->IsIdle(place))
  {
    return {};
  }
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
  this->ForEachCrossedLeaf(place,
    [&](const Leaf& leaf)
    { triangles += IsosurfacePatch(leaf.Half, this->Source.Edges(leaf.Rank)).TriangleCount; });
  return { points, triangles };
}

void SurfaceExtraction::WritePoints(const AffineMap& world, float* points) const
{
  this->Passes.ForEachBrick(16,
    [&](std::int64_t i)
    {
      if (this->IsIdle(this->Passes.PlaceOf(i)))
      {
        return;
      }
      const Brick& brick = this->Passes.BrickAt(i);
      float* next = points + 3 * this->Passes.FirstOf(i).Points;
      this->Source.Diamonds().ForEachInBrick(this->Passes.PlaceOf(i).Scale, brick,
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
    const SurfacePatch& patch = IsosurfacePatch(leaf.Half, this->Edges);
    for (int i = 0; i < patch.TriangleCount; ++i)
    {
      const std::array<std::uint8_t, 3>& edges = patch.Triangles[i];
      this->Next[0] = this->IdOf(leaf, edges[0]);
      this->Next[1] = this->IdOf(leaf, edges[this->Flip ? 2 : 1]);
      this->Next[2] = this->IdOf(leaf, edges[this->Flip ? 1 : 2]);
      this->Next += 3;
      *this->NextLevel++ = static_cast<std::int8_t>(this->Source.Domain().Depth() - 1 - leaf.Scale);
    }
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

  /** The point on a leaf's edge; the outer edges belong to older diamonds. */
  Id IdOf(const Leaf& leaf, int ofLeaf)
  {
    if (ofLeaf < OwnEdgeCount)
    {
      return static_cast<Id>(this->Own.Id(leaf.Half.Vertices[ofLeaf]));
    }
    const OuterEdge& edge = leaf.Half.OuterEdges[ofLeaf - OwnEdgeCount];
    const int vertex = edge.OwnerVertex;
    if (((this->Known >> vertex) & 1U) == 0)
    {
      this->Known |= 1U << vertex;
      const std::int64_t rank = RankAtVertex(this->Source.Diamonds(), leaf, vertex);
      this->Owners[vertex] = rank == DiamondSet::None ? Slot() : this->Extraction.Slots[rank];
    }
    return static_cast<Id>(this->Owners[vertex].Id(edge.OwnerEdge));
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
  this->Passes.ForEachBrick(16,
    [&](std::int64_t i)
    {
      if (this->IsIdle(this->Passes.PlaceOf(i)))
      {
        return;
      }
      TriangleWriter<Id> writer(*this, mirrored, connectivity + 3 * this->Passes.FirstOf(i).Cells,
        levels + this->Passes.FirstOf(i).Cells);
      this->ForEachCrossedLeaf(
        this->Passes.PlaceOf(i), [&](const Leaf& leaf) { writer.Write(leaf); });
    });
}

template void SurfaceExtraction::WriteTriangles(bool, std::int32_t*, std::int8_t*) const;
template void SurfaceExtraction::WriteTriangles(bool, long long*, std::int8_t*) const;

}
