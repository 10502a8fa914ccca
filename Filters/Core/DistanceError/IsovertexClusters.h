// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsovertexClusters_h
#define isodiamond_IsovertexClusters_h

#include "Field/Parallel.h"
#include "Field/Samples.h"
#include "Hierarchy/IsodiamondHierarchy.h"
#include "Lattice/DiamondPortion.h"
#include "Lattice/DiamondTetrahedra.h"
#include "Patches/ExactPlane.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace isodiamond
{

/** The isovertex of a stored diamond on one of its subdivision edges. */
inline FinePosition IsovertexAt(const IsodiamondHierarchy& hierarchy, const Place& place,
  std::uint32_t rank, int edge, int surface)
{
  const std::uint32_t lower = hierarchy.Edges(rank);
  const std::uint32_t before = (1U << edge) - 1U;
  const int index = surface == 0 ? PopCount(lower & before)
                                 : PopCount(lower) + PopCount(hierarchy.UpperEdges(rank) & before);
  const std::int32_t along = hierarchy.Isovertices(rank)[index];
  const Point& offset = tables::Parities[Parity(place.Position)].Offsets[edge];
  return (1 << place.Scale) * (FineUnits * place.Position + along * offset);
}

/** Whether both ends of a subdivision edge of a diamond of scale 0 are finite. */
inline bool AreEndsFinite(const Finiteness& isFinite, const Place& place, int edge)
{
  const Point& offset = tables::Parities[Parity(place.Position)].Offsets[edge];
  return isFinite(place.Position) && isFinite(place.Position + offset);
}

/** The isovertex on a crossed edge of any tetrahedron. */
inline FinePosition IsovertexOn(
  const IsodiamondHierarchy& hierarchy, const HalfPlace& tetrahedron, int edge, int surface)
{
  const OwnedEdge owned = OwnedEdgeOf(tetrahedron, edge);
  const auto rank = static_cast<std::uint32_t>(hierarchy.Diamonds().Rank(owned.Owner));
  return IsovertexAt(hierarchy, owned.Owner, rank, owned.Edge, surface);
}

/** Isovertices of full resolution that lie near each other: those of an eighth of a brick. */
struct IsovertexCluster
{
  std::uint32_t Brick = 0; ///< index in the bricks of scale 0
  std::int32_t Octant = 0; ///< of the brick, bit 0 for x
  FineBox Box;
};

/**
 * The isovertices of full resolution on a surface, those of scale 0, in clusters. Only the clusters
 * are kept; their isovertices are read from the hierarchy when they are asked for.
 */
class IsovertexClusters
{
public:
  /** Those on edges whose ends are both finite, or the others: diamonds that hold these are always
   *  subdivided. */
  enum class Ends
  {
    Finite,
    NotFinite
  };

  /** Hierarchy and finiteness must outlive it.
   *  @param portion whose own isovertices it has; null for all */
  IsovertexClusters(const IsodiamondHierarchy& hierarchy, const Finiteness& isFinite, int surface,
    Ends ends, const ParallelFor& parallelFor, const DiamondPortion* portion = nullptr)
    : Hierarchy(hierarchy)
    , IsFinite(isFinite)
    , OnSurface(surface)
    , Wanted(ends)
    , Portion(portion)
  {
    // Some bricks at a time: most eighths have nothing to keep.
    constexpr std::size_t some = 4096;
    std::vector<std::array<IsovertexCluster, 8>> found;
    const std::size_t bricks = hierarchy.Diamonds().Level(0).Bricks.size();
    for (std::size_t first = 0; first < bricks; first += some)
    {
      found.assign(std::min(some, bricks - first), {});
      ForEachIndex(parallelFor, found.size(), 16,
        [&](std::int64_t i) { this->Find(static_cast<std::uint32_t>(first + i), found[i]); });
      for (const std::array<IsovertexCluster, 8>& eighths : found)
      {
        std::copy_if(eighths.begin(), eighths.end(), std::back_inserter(this->Clusters),
          [](const IsovertexCluster& cluster) { return !cluster.Box.IsEmpty(); });
      }
    }
  }

  int Surface() const { return this->OnSurface; }
  bool AlwaysSubdivide() const { return this->Wanted == Ends::NotFinite; }

  /** Whether it has those of all bricks, not of a portion. */
  bool AreOfAll() const { return this->Portion == nullptr; }

  /** Whether it has those of a brick of scale 0. */
  bool Has(const Brick& brick) const
  {
    return this->Portion == nullptr ||
      this->Portion->Owns(this->Hierarchy.Diamonds().Level(0).Box.Origin(brick.BoxIndex)[2]);
  }

  const std::vector<IsovertexCluster>& All() const { return this->Clusters; }

  /** Calls body(position) for the isovertices of a cluster. */
  template <typename Body>
  void ForEach(const IsovertexCluster& cluster, Body&& body) const
  {
    const BrickLevel& level = this->Hierarchy.Diamonds().Level(0);
    const Brick& brick = level.Bricks[cluster.Brick];
    const Point origin = level.Box.Origin(brick.BoxIndex);
    const std::uint64_t column = 0x0f0f0f0fULL
      << ((cluster.Octant & 1) * 4 + ((cluster.Octant >> 1) & 1) * 32);
    const int first = 4 * (cluster.Octant >> 2);
    for (int z = first; z < first + 4; ++z)
    {
      ForEachBit(brick.Occupancy[z] & column,
        [&](int bit)
        {
          const Place place{ 0, PositionOf(origin, z, bit) };
          const std::uint32_t rank = brick.Rank(z, bit);
          ForEachBit(
            this->OnSurface == 0 ? this->Hierarchy.Edges(rank) : this->Hierarchy.UpperEdges(rank),
            [&](int edge)
            {
              if (this->IsWanted(place, edge))
              {
                body(IsovertexAt(this->Hierarchy, place, rank, edge, this->OnSurface));
              }
            });
        });
    }
  }

  /** Whether the isovertex on an edge of a diamond of scale 0 is one of these. */
  bool IsWanted(const Place& place, int edge) const
  {
    return AreEndsFinite(this->IsFinite, place, edge) == (this->Wanted == Ends::Finite);
  }

private:
  /** Finds the clusters of a brick, some of them empty. */
  void Find(std::uint32_t brick, std::array<IsovertexCluster, 8>& eighths) const
  {
    if (!this->Has(this->Hierarchy.Diamonds().Level(0).Bricks[brick]))
    {
      return;
    }
    for (int octant = 0; octant < 8; ++octant)
    {
      IsovertexCluster& cluster = eighths[octant];
      cluster.Brick = brick;
      cluster.Octant = octant;
      this->ForEach(cluster, [&](const FinePosition& position) { cluster.Box.Add(position); });
    }
  }

  const IsodiamondHierarchy& Hierarchy;
  const Finiteness& IsFinite;
  int OnSurface;
  Ends Wanted;
  const DiamondPortion* Portion;
  std::vector<IsovertexCluster> Clusters;
};

}

#endif
