// SPDX-License-Identifier: BSD-3-Clause
#include "IntervalExtraction.h"

#include "IntervalPatches.h"
#include "SurfacePatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isodiamond
{
namespace
{

/** A case of IntervalPatches() with every point listed once. */
struct PatchTable
{
  std::vector<PatchPoint> Points;
  std::vector<std::array<std::uint8_t, 4>> Tetrahedra; ///< indices of the points

  PatchTable() = default;
  explicit PatchTable(const std::vector<PatchTetrahedron>& patch)
  {
    for (const PatchTetrahedron& tetrahedron : patch)
    {
      std::array<std::uint8_t, 4> indices{};
      for (int i = 0; i < 4; ++i)
      {
        const auto point = std::find(this->Points.begin(), this->Points.end(), tetrahedron[i]);
        indices[i] = static_cast<std::uint8_t>(point - this->Points.begin());
        if (point == this->Points.end())
        {
          this->Points.push_back(tetrahedron[i]);
        }
      }
      this->Tetrahedra.push_back(indices);
    }
  }
};

const std::array<PatchTable, 81>& PatchTables()
{
  static const std::array<PatchTable, 81> tables = []
  {
    std::array<PatchTable, 81> all;
    for (int code = 0; code < 81; ++code)
    {
      all[code] = PatchTable(IntervalPatches()[code]);
    }
    return all;
  }();
  return tables;
}

}

IntervalExtraction::IntervalExtraction(const RefinedSet& refined, const ParallelFor& parallelFor)
  : Refined(refined)
  , Source(refined.Hierarchy())
  , Passes(refined, parallelFor)
  , Slots(refined.Hierarchy().Diamonds().Size())
{
  this->Passes.CountPoints(this->Slots, [this](std::int64_t i) { return this->CountBrick(i); });
}

ExtractionPasses::Counts IntervalExtraction::CountBrick(std::int64_t brickNumber)
{
  const BrickPlace& place = this->Passes.PlaceOf(brickNumber);
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
        const std::array<std::uint32_t, 2> edges = { this->Source.Edges(rank),
          this->Source.UpperEdges(rank) };
        const std::uint32_t alive = AliveEdges(
          this->Refined, { place.Scale, PositionOf(origin, z, bit) }, edges[0] | edges[1]);
        Slot& slot = this->Slots[rank];
        slot.First = points;
        slot.HasCentre = this->Source.Sign(rank) == InsideSign ? 1 : 0;
        slot.Alive = { static_cast<std::uint16_t>(alive & edges[0]),
          static_cast<std::uint16_t>(alive & edges[1]) };
        points += slot.Size();
      });
  }
  std::int64_t tetrahedra = 0;
  ForEachLeaf(
    this->Refined, place, [this](std::uint32_t rank) { return this->Source.CarryingEdges(rank); },
    [&](const Leaf& leaf)
    {
      tetrahedra += static_cast<std::int64_t>(
        PatchTables()[IntervalCase(this->Source, leaf.Rank, leaf.Half)].Tetrahedra.size());
    });
  return { points, tetrahedra };
}

/** Calls body(id, position in index space, surface or -1 inside, brick's inside values so far). */
template <typename Body>
void IntervalExtraction::ForEachPoint(Body&& body) const
{
  this->Passes.ForEachBrick(16,
    [&](std::int64_t i)
    {
      const Brick& brick = this->Passes.BrickAt(i);
      std::int64_t id = this->Passes.FirstOf(i).Points;
      std::int64_t insideValue = this->Source.FirstInsideValue(i);
      this->Source.Diamonds().ForEachInBrick(this->Passes.PlaceOf(i).Scale, brick,
        [&](const Place& place, std::uint32_t rank)
        {
          const Slot& slot = this->Slots[rank];
          if (slot.HasCentre != 0)
          {
            const Point centre = Centre(place);
            const std::array<double, 3> position = { 1.0 * centre[0], 1.0 * centre[1],
              1.0 * centre[2] };
            body(id++, position, -1, insideValue);
          }
          insideValue += this->Source.Sign(rank) == InsideSign ? 1 : 0;
          const std::uint8_t* coefficients = this->Source.Isovertices(rank);
          const ParityTable& shape = tables::Parities[Parity(place.Position)];
          for (int surface = 0; surface < 2; ++surface)
          {
            const std::uint32_t edges =
              surface == 0 ? this->Source.Edges(rank) : this->Source.UpperEdges(rank);
            ForEachBit(slot.Alive[surface],
              [&](int edge)
              {
                const std::uint8_t coefficient =
                  coefficients[PopCount(edges & ((1U << edge) - 1U))];
                body(id++, IsovertexPosition(place, shape.Offsets[edge], coefficient), surface,
                  insideValue);
              });
            coefficients += PopCount(edges);
          }
        });
    });
}

template <typename Coordinate>
void IntervalExtraction::WritePoints(const AffineMap& world, Coordinate* points) const
{
  this->ForEachPoint(
    [&](std::int64_t id, const std::array<double, 3>& inside, int /*surface*/, std::int64_t)
    {
      const std::array<double, 3> position = world(inside[0], inside[1], inside[2]);
      for (int axis = 0; axis < 3; ++axis)
      {
        points[3 * id + axis] = static_cast<Coordinate>(position[axis]);
      }
    });
}

template <typename Value>
void IntervalExtraction::WriteValues(Value* values, std::int8_t* surfaces) const
{
  std::array<Value, 2> isovalues{};
  for (int surface = 0; surface < 2; ++surface)
  {
    const double isovalue = this->Source.Region().Isovalue(surface);
    isovalues[surface] = std::isfinite(isovalue) ? static_cast<Value>(isovalue)
                                                 : std::numeric_limits<Value>::quiet_NaN();
  }
  std::visit(
    [&](const auto& insideValues)
    {
      this->ForEachPoint(
        [&](std::int64_t id, const std::array<double, 3>&, int surface, std::int64_t insideValue)
        {
          values[id] = surface < 0 ? static_cast<Value>(insideValues.Pointer()[insideValue])
                                   : isovalues[surface];
          surfaces[id] = static_cast<std::int8_t>(surface < 0 ? 0 : 2 * surface - 1);
        });
    },
    this->Source.InsideValues());
}

/** Writes the tetrahedra of one brick's leaves, one after the other. */
template <typename Id>
class IntervalExtraction::TetrahedronWriter
{
public:
  TetrahedronWriter(
    const IntervalExtraction& extraction, bool mirrored, Id* connectivity, std::int8_t* levels)
    : Extraction(extraction)
    , Mirrored(mirrored)
    , Next(connectivity)
    , NextLevel(levels)
  {
  }

  void Write(const Leaf& leaf)
  {
    if (leaf.Rank != this->Rank)
    {
      this->Rank = leaf.Rank;
      this->Own = this->Extraction.Slots[leaf.Rank];
      this->Known = 0;
    }
    const PatchTable& patch =
      PatchTables()[IntervalCase(this->Extraction.Source, leaf.Rank, leaf.Half)];
    for (std::size_t i = 0; i < patch.Points.size(); ++i)
    {
      this->Ids[i] = static_cast<Id>(this->IdOf(leaf, patch.Points[i]));
    }
    const bool flip = leaf.Half.OddByAge != this->Mirrored;
    const int level = this->Extraction.Source.Domain().Depth() - 1 - leaf.Scale;
    for (const std::array<std::uint8_t, 4>& tetrahedron : patch.Tetrahedra)
    {
      this->Next[0] = this->Ids[tetrahedron[0]];
      this->Next[1] = this->Ids[tetrahedron[1]];
      this->Next[2] = this->Ids[tetrahedron[flip ? 3 : 2]];
      this->Next[3] = this->Ids[tetrahedron[flip ? 2 : 3]];
      this->Next += 4;
      *this->NextLevel++ = static_cast<std::int8_t>(level);
    }
  }

private:
  std::uint32_t IdOf(const Leaf& leaf, const PatchPoint& point)
  {
    if (point.IsVertex())
    {
      return point.Younger() == 0 ? this->Own.CentreId()
                                  : this->SlotAt(leaf, VertexOf(leaf, point.Younger())).CentreId();
    }
    if (point.Younger() == 0)
    {
      return this->Own.Id(point.Surface(), VertexOf(leaf, point.Older()));
    }
    // An outer edge lies opposite to the outer vertex that is none of its ends.
    const int opposite = leaf.Half.ByAge[6 - point.Younger() - point.Older() - 1];
    const OuterEdge& edge = leaf.Half.OuterEdges[opposite];
    return this->SlotAt(leaf, edge.OwnerVertex).Id(point.Surface(), edge.OwnerEdge);
  }

  /** The parent's vertex that is a patch's vertex 1, 2 or 3. */
  static int VertexOf(const Leaf& leaf, int vertex)
  {
    return leaf.Half.Vertices[leaf.Half.ByAge[vertex - 1]];
  }

  /** The points of the diamond that is centred at a vertex of the parent. */
  const Slot& SlotAt(const Leaf& leaf, int vertex)
  {
    if (((this->Known >> vertex) & 1U) == 0)
    {
      this->Known |= 1U << vertex;
      const std::int64_t rank = RankAtVertex(this->Extraction.Source.Diamonds(), leaf, vertex);
      this->Owners[vertex] = rank == DiamondSet::None ? Slot() : this->Extraction.Slots[rank];
    }
    return this->Owners[vertex];
  }

  const IntervalExtraction& Extraction;
  bool Mirrored;
  Id* Next;
  std::int8_t* NextLevel;
  std::array<Id, 16> Ids{};

  // Of the current parent.
  std::int64_t Rank = DiamondSet::None;
  Slot Own;
  std::uint32_t Known = 0; ///< vertices whose slots are in Owners
  std::array<Slot, MaximumVertices> Owners{};
};

template <typename Id>
void IntervalExtraction::WriteTetrahedra(bool mirrored, Id* connectivity, std::int8_t* levels) const
{
  this->Passes.ForEachBrick(16,
    [&](std::int64_t i)
    {
      TetrahedronWriter<Id> writer(*this, mirrored,
        connectivity + 4 * this->Passes.FirstOf(i).Cells, levels + this->Passes.FirstOf(i).Cells);
      ForEachLeaf(
        this->Refined, this->Passes.PlaceOf(i),
        [this](std::uint32_t rank) { return this->Source.CarryingEdges(rank); },
        [&](const Leaf& leaf) { writer.Write(leaf); });
    });
}

template void IntervalExtraction::WritePoints(const AffineMap&, float*) const;
template void IntervalExtraction::WritePoints(const AffineMap&, double*) const;
template void IntervalExtraction::WriteValues(float*, std::int8_t*) const;
template void IntervalExtraction::WriteValues(double*, std::int8_t*) const;
template void IntervalExtraction::WriteTetrahedra(bool, std::int32_t*, std::int8_t*) const;
template void IntervalExtraction::WriteTetrahedra(bool, long long*, std::int8_t*) const;

}
