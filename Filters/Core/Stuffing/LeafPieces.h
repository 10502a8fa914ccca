// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_LeafPieces_h
#define isodiamond_LeafPieces_h

#include "Field/Parallel.h"
#include "Patches/IntervalPatches.h"
#include "Stuffing/VertexPlaces.h"

#include <vector>

namespace isodiamond
{

/** The pieces that surfaces cut leaves into, some of whose vertices may be on a surface. */
class LeafPieces
{
public:
  /** @param background must outlive it, like the places that vertices are seen at
   *  @param points where the points of the mesh are; must outlive it */
  LeafPieces(
    const Background& background, const PlacesView& vertices, const std::vector<Vector>& points)
    : Mesh(background)
    , Vertices(vertices)
    , Points(points)
  {
  }

  /** Whether there is a way to cut a leaf into positive pieces. */
  bool ArePositive(std::uint32_t leaf) const;

  /** Of several ways to cut a leaf, the one whose worst piece is best; where it is pinned, the one
   *  that is measured. */
  std::uint8_t BestWay(std::uint32_t leaf) const;

  /** How many pieces of a leaf are in range. */
  std::size_t Count(std::uint32_t leaf, std::uint8_t way) const
  {
    const Ways& ways = this->WaysOf(leaf);
    return ways.empty() ? 0 : ways[way].size();
  }

  /** Calls use(corners), points of the mesh, for all pieces of a leaf that are in range. */
  template <typename Use>
  void ForEach(std::uint32_t leaf, std::uint8_t way, Use&& use) const
  {
    const Ways& ways = this->WaysOf(leaf);
    for (std::size_t i = 0; !ways.empty() && i < ways[way].size(); ++i)
    {
      use(this->CornersOf(leaf, ways[way][i]));
    }
  }

  /** Of several ways to cut a leaf, the only one that IntervalPatches() knows: errors of diamonds
   *  are measured by it. */
  static constexpr std::uint8_t MeasuredWay = 0;

private:
  using Ways = std::vector<std::vector<PatchTetrahedron>>;

  const Ways& WaysOf(std::uint32_t leaf) const;
  bool IsPinned(std::uint32_t leaf) const { return PinsOf(this->Mesh.Leaves(), leaf) > 0; }
  std::uint32_t PointOf(std::uint32_t leaf, const PatchPoint& point) const;
  Corners CornersOf(std::uint32_t leaf, const PatchTetrahedron& piece) const;
  double SineOf(std::uint32_t leaf, const PatchTetrahedron& piece) const;

  const Background& Mesh;
  PlacesView Vertices;
  const std::vector<Vector>& Points;
};

///@{
/** What is in range, as tetrahedra of points; each leaf cut in the best way, or in the one that is
 *  measured: if no vertex has been moved, that gives the interval volume's mesh.
 *  @param places of points: one that is not where it was in the background becomes a new point,
 *         blended from the old one, which tells where the surface was */
TetrahedronMesh CutInBestWay(const Background& background, const VertexPlaces& vertices,
  const std::vector<Vector>& places, const ParallelFor& parallelFor);
TetrahedronMesh CutAsMeasured(const Background& background, const ParallelFor& parallelFor);
///@}

}

#endif
