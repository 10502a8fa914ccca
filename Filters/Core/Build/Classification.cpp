// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Classification.h"

#include "Field/SignBlock.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Masks of positions by kind. */
template <typename Word>
struct KindMasks
{
  Word Active{};
  Word Creation{};
  Word Inside{}; ///< vertices and centre all inside: active if a descendant has a surface
};

struct ClassifiedBrick
{
  std::int64_t Index = 0;
  KindMasks<BrickMask> Kinds;
};

/** On which sides of one surface the vertices of eight positions of a row lie. */
struct VertexSigns
{
  std::uint32_t Above = 0; ///< some vertex lies above
  std::uint32_t Below = 0; ///< some vertex does not
};

/** Classifies the positions of a row that are odd along x, or those that are even. */
template <int Surfaces>
KindMasks<std::uint32_t> ClassifyPositions(const SignBlock& block, int oddX, int y, int z)
{
  const ParityTable& shape = tables::Parities[oddX | ((y & 1) << 1) | ((z & 1) << 2)];
  std::array<VertexSigns, Surfaces> vertices{};
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    const Point& offset = shape.Offsets[i];
    const SignLattice::Row& row = block.RowAt(y, z, offset);
    for (int surface = 0; surface < Surfaces; ++surface)
    {
      vertices[surface].Above |= row.Above[surface] >> (1 + offset[0]);
      vertices[surface].Below |= row.Below(surface) >> (1 + offset[0]);
    }
  }
  const SignLattice::Row& centre = block.Rows[z + 1][y + 1];
  constexpr int top = Surfaces - 1;
  // All vertices below but not the centre, or the other way round.
  KindMasks<std::uint32_t> kinds;
  kinds.Creation = ((centre.Above[0] >> 1) & vertices[0].Below & ~vertices[0].Above) |
    ((centre.Below(top) >> 1) & vertices[top].Above & ~vertices[top].Below);
  for (const VertexSigns& signs : vertices)
  {
    kinds.Active |= signs.Above & signs.Below;
  }
  if constexpr (Surfaces == 2)
  {
    const std::uint32_t inside =
      vertices[0].Above & ~vertices[0].Below & vertices[1].Below & ~vertices[1].Above;
    const std::uint32_t outsideCentre = (centre.Below(0) | centre.Above[1]) >> 1;
    kinds.Active |= inside & outsideCentre;
    kinds.Inside = inside & ~outsideCentre;
  }
  const std::uint32_t positions = oddX != 0 ? 0xaaU : 0x55U;
  return { kinds.Active & positions, kinds.Creation & positions, kinds.Inside & positions };
}

/** Those positions with all vertices inside that stick out of the grid. */
std::uint64_t StickingOut(
  const Grid& grid, int scale, const Point& origin, int z, std::uint64_t mask)
{
  std::uint64_t result = 0;
  ForEachBit(mask,
    [&](int bit)
    {
      const bool sticksOut = grid.SticksOut(PositionOf(origin, z, bit), scale);
      result |= static_cast<std::uint64_t>(sticksOut) << bit;
    });
  return result;
}

/** Finds the kinds of one brick. */
template <int Surfaces>
class BrickClassifier
{
public:
  BrickClassifier(const Grid& grid, const SignLattice& signs, int scale, bool keepInside)
    : TheGrid(grid)
    , Signs(signs)
    , Scale(scale)
    , KeepInside(keepInside)
    , Count(grid.Positions(scale))
  {
  }

  /** Appends the brick if it holds an active or creation diamond. */
  void Classify(const BrickBox& box, std::int64_t index, std::vector<ClassifiedBrick>& result) const
  {
    const Point origin = box.Origin(index);
    const bool wantsInside = this->WantsInside(origin);
    if (!wantsInside && this->Signs.AreEqualAround(this->Scale, origin))
    {
      return;
    }
    const SignBlock block(this->Signs, this->Scale, origin);
    if (!block.IsMixed() && !(block.Signs == 1U << InsideSign && wantsInside))
    {
      return;
    }
    // The last bricks reach past the positions that diamonds can have.
    const int width = std::min(8, this->Count[0] - origin[0]);
    const std::uint64_t valid = (std::uint64_t{ 1 } << width) - 1;
    ClassifiedBrick brick;
    brick.Index = index;
    std::uint64_t any = 0;
    for (int z = 0; z < std::min(8, this->Count[2] - origin[2]); ++z)
    {
      std::uint64_t inside = 0;
      for (int y = 0; y < std::min(8, this->Count[1] - origin[1]); ++y)
      {
        for (int oddX = 0; oddX < 2; ++oddX)
        {
          const KindMasks<std::uint32_t> row = ClassifyPositions<Surfaces>(block, oddX, y, z);
          brick.Kinds.Active[z] |= (row.Active & valid) << (8 * y);
          brick.Kinds.Creation[z] |= (row.Creation & valid) << (8 * y);
          inside |= (row.Inside & valid) << (8 * y);
        }
      }
      if (Surfaces == 2 && inside != 0)
      {
        // Never leaves of the mesh: tetrahedra that reach out of the grid would be missing inside.
        brick.Kinds.Active[z] |=
          this->KeepInside ? inside : StickingOut(this->TheGrid, this->Scale, origin, z, inside);
      }
      any |= brick.Kinds.Active[z] | brick.Kinds.Creation[z];
    }
    if (any != 0)
    {
      result.push_back(brick);
    }
  }

private:
  /** Whether diamonds of the brick can be active with all signs inside. */
  bool WantsInside(const Point& origin) const
  {
    const Point end = (1 << this->Scale) * (origin + Point{ 9, 9, 9 });
    return Surfaces == 2 && (this->KeepInside || !this->TheGrid.IsSampled(end));
  }

  const Grid& TheGrid;
  const SignLattice& Signs;
  int Scale;
  bool KeepInside;
  std::array<int, 3> Count;
};

/** Whether a diamond whose sampled vertices all have one sign lies inside. */
bool IsInside(const Grid& grid, const SignLattice& signs, const Place& place)
{
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    const Point vertex = place.Position + shape.Offsets[i];
    if (grid.IsSampled((1 << place.Scale) * vertex))
    {
      return signs.Sign(place.Scale, vertex) == InsideSign;
    }
  }
  return false;
}

struct InsideBrick
{
  std::int64_t Index = 0;
  BrickMask Inside{};
};

/** The ancestors in one brick that have all vertices inside; all but isodiamonds have one sign. */
InsideBrick FindInside(const Grid& grid, const SignLattice& signs, const Classification& all,
  int scale, std::int64_t index)
{
  const BrickMask* members = all.Members.Find(scale, index);
  const BrickMask* active = all.Active.Find(scale, index);
  const BrickMask* creation = all.Creation.Find(scale, index);
  const Point origin = all.Members.Box(scale).Origin(index);
  InsideBrick brick{ index };
  for (int z = 0; z < 8 && members != nullptr; ++z)
  {
    const std::uint64_t isodiamonds =
      (active != nullptr ? (*active)[z] : 0) | (creation != nullptr ? (*creation)[z] : 0);
    ForEachBit((*members)[z] & ~isodiamonds,
      [&](int bit)
      {
        const bool inside = IsInside(grid, signs, { scale, PositionOf(origin, z, bit) });
        brick.Inside[z] |= static_cast<std::uint64_t>(inside) << bit;
      });
  }
  return brick;
}

/** Ancestors of isodiamonds with all vertices inside are active: a descendant has a surface. */
void ActivateInside(const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor,
  Classification& result)
{
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    const auto find = [&](std::int64_t index, std::vector<InsideBrick>& list)
    {
      const InsideBrick brick = FindInside(grid, signs, result, scale, index);
      if (brick.Inside != BrickMask{})
      {
        list.push_back(brick);
      }
    };
    for (const auto& row : FindInRows<InsideBrick>(result.Members.Box(scale), parallelFor, find))
    {
      for (const InsideBrick& brick : row)
      {
        result.Active.Insert(scale, brick.Index, brick.Inside);
      }
    }
  }
}

template <int Surfaces>
Classification ClassifyBySigns(
  const Grid& grid, const SignLattice& signs, bool keepInside, const ParallelFor& parallelFor)
{
  Classification result{ DiamondMask(grid), DiamondMask(grid), DiamondMask(grid) };
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    const BrickClassifier<Surfaces> classifier(grid, signs, scale, keepInside);
    const BrickBox& box = result.Active.Box(scale);
    const auto classify = [&](std::int64_t index, std::vector<ClassifiedBrick>& list)
    { classifier.Classify(box, index, list); };
    for (const auto& row : FindInRows<ClassifiedBrick>(box, parallelFor, classify))
    {
      for (const ClassifiedBrick& brick : row)
      {
        result.Active.Insert(scale, brick.Index, brick.Kinds.Active);
        result.Creation.Insert(scale, brick.Index, brick.Kinds.Creation);
        result.Members.Insert(scale, brick.Index, brick.Kinds.Active);
        result.Members.Insert(scale, brick.Index, brick.Kinds.Creation);
      }
    }
  }
  result.Members.CloseOverParents(grid);
  if (Surfaces == 2)
  {
    ActivateInside(grid, signs, parallelFor, result);
  }
  return result;
}

}

Classification Classify(
  const Grid& grid, const SignLattice& signs, const ParallelFor& parallelFor, bool keepInside)
{
  return signs.SurfaceCount() == 1 ? ClassifyBySigns<1>(grid, signs, keepInside, parallelFor)
                                   : ClassifyBySigns<2>(grid, signs, keepInside, parallelFor);
}

}
