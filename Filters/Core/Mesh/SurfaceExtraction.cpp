// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/SurfaceExtraction.h"

#include "Mesh/CellWriting.h"
#include "Mesh/PatchPoints.h"
#include "Mesh/VertexWindow.h"
#include "Patches/SurfacePatch.h"

#include <cassert>

namespace isodiamond
{
namespace
{

/** How much coarser than a leaf's parent the owner of one of its edges can be. */
constexpr int MaximumOwnerStep = 1;

/** The vertices on the opposite side from the centre. */
HalfTetrahedronMask CrossedVertices(const IsodiamondHierarchy& hierarchy, const LeafParent& parent)
{
  return tables::MasksAsListed[parent.Type](hierarchy.Edges(parent.Rank));
}

/** The triangles in a diamond's leaves: bit 0 of the four of a half-tetrahedron stands for the
 * first one of its patch, bit 1 for the second. */
HalfTetrahedronMask TrianglesOf(const LeafParent& parent, HalfTetrahedronMask crossed)
{
  // There are two where two vertices lie on the opposite side from the third and the centre.
  return parent.Leaves | ((parent.Leaves & HalvesWithTwo(crossed)) << 1);
}

/** The threshold of the diamond that a leaf with triangles lies in; 0 at full resolution. */
ErrorCode::Type ThresholdOfLeaf(
  const IsodiamondHierarchy& hierarchy, const LeafParent& parent, int half)
{
  if (parent.LeafScale() < 0)
  {
    return 0;
  }
  const TypeTable& shape = parent.Shape();
  const int child = shape.HalfTetrahedra[half].Child;
  const std::int64_t rank = hierarchy.Diamonds().Rank(ChildPlace(shape, parent.At, child));
  assert(rank >= 0); // it is active, so it is stored
  return hierarchy.Threshold(rank);
}

/** Writes the triangles of one brick's leaves, one after the other. */
template <typename Id>
class TriangleWriter
{
public:
  TriangleWriter(const IsodiamondHierarchy& hierarchy, const VertexWindow& window, bool mirrored,
    Id* connectivity, std::int16_t* levels)
    : Hierarchy(hierarchy)
    , Window(window)
    , Places(PointsOfTriangles())
    , Mirrored(mirrored)
    , Next(connectivity)
    , NextLevel(levels)
  {
  }

  void Write(const LeafParent& parent)
  {
    const HalfTetrahedronMask crossed = CrossedVertices(this->Hierarchy, parent);
    // For a centre above the isovalue triangles wind with normals away from it.
    const int flip = (this->Hierarchy.Sign(parent.Rank) == 0) != this->Mirrored ? 1 : 0;
    const int level = this->Hierarchy.SampleGrid().Depth() - 1 - parent.LeafScale();
    const DiamondPoints* own = this->Window.At(parent.At.Position);
    const auto& places = this->Places[parent.Type];
    ForEachBit(TrianglesOf(parent, crossed),
      [&](int bit)
      {
        const auto& corners = places[bit / 4][(crossed >> (bit & ~3)) & 7U][bit & 1];
        const auto idOf = [&](const PatchPointPlace& corner)
        { return static_cast<Id>(own[corner.Distance].Id(corner.Bit)); };
        this->Next[0] = idOf(corners[0]);
        this->Next[1 + flip] = idOf(corners[1]);
        this->Next[2 - flip] = idOf(corners[2]);
        this->Next += 3;
        *this->NextLevel++ = static_cast<std::int16_t>(level);
      });
  }

private:
  const IsodiamondHierarchy& Hierarchy;
  const VertexWindow& Window;
  const PatchPointTable<TrianglePointPlaces>& Places;
  bool Mirrored;
  Id* Next;
  std::int16_t* NextLevel;
};

}

int CountTriangles(const IsodiamondHierarchy& hierarchy, const LeafParent& parent)
{
  return PopCount(TrianglesOf(parent, CrossedVertices(hierarchy, parent)));
}

SurfaceExtraction::SurfaceExtraction(
  const RefinedSet& refined, const ParallelFor& parallelFor, const MeshShare& share)
  : MeshExtraction({ refined, share, MaximumOwnerStep, parallelFor,
      [&](const LeafParent& parent) { return CountTriangles(refined.Hierarchy(), parent); } })
{
}

template <typename Id>
void SurfaceExtraction::WriteTriangles(
  const CellRange& range, bool mirrored, Id* connectivity, std::int16_t* levels) const
{
  WriteCellsOf<3>(this->Passes, range, connectivity, levels,
    [&](std::int64_t brick, Id* ids, std::int16_t* levelsOfIds)
    {
      const VertexWindow window(this->Passes, brick);
      TriangleWriter<Id> writer(this->Passes.Hierarchy(), window, mirrored, ids, levelsOfIds);
      this->Passes.ForEachLeafParent(
        brick, [&](const LeafParent& parent) { writer.Write(parent); });
    });
}

void SurfaceExtraction::WriteThresholds(ErrorCode::Type* codes) const
{
  const IsodiamondHierarchy& hierarchy = this->Passes.Hierarchy();
  this->Passes.ForEachBrickWithCells(this->Passes.AllCells(),
    [&](std::int64_t brick, const CellRange& own)
    {
      ErrorCode::Type* next = codes + own.First;
      this->Passes.ForEachLeafParent(brick,
        [&](const LeafParent& parent)
        {
          ForEachBit(TrianglesOf(parent, CrossedVertices(hierarchy, parent)),
            [&](int bit) { *next++ = ThresholdOfLeaf(hierarchy, parent, bit / 4); });
        });
    });
}

template void SurfaceExtraction::WriteTriangles(
  const CellRange&, bool, std::int32_t*, std::int16_t*) const;
template void SurfaceExtraction::WriteTriangles(
  const CellRange&, bool, long long*, std::int16_t*) const;

}
