// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_IsovertexClusters_h
#define isodiamond_IsovertexClusters_h

#include "FinePlane.h"
#include "IsodiamondHierarchy.h"
#include "Samples.h"

#include <cstdint>
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

/** Isovertices of full resolution that lie near to each other: those of an eighth of a brick. */
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
  /** Those on edges whose ends both are finite, or the others: these always subdivide the diamonds
   *  that hold them. */
  enum class Ends
  {
    Finite,
    NotFinite
  };

  /** Hierarchy and finiteness must outlive it. */
  IsovertexClusters(
    const IsodiamondHierarchy& hierarchy, const Finiteness& isFinite, int surface, Ends ends)
    : Hierarchy(hierarchy)
    , IsFinite(isFinite)
    , OnSurface(surface)
    , Wanted(ends)
  {
    const std::vector<Brick>& bricks = hierarchy.Diamonds().Level(0).Bricks;
    for (std::uint32_t brick = 0; brick < bricks.size(); ++brick)
    {
      for (int octant = 0; octant < 8; ++octant)
      {
        IsovertexCluster cluster{ brick, octant, {} };
        this->ForEach(cluster, [&](const FinePosition& position) { cluster.Box.Add(position); });
        if (cluster.Box.Low[0] <= cluster.Box.High[0])
        {
          this->Clusters.push_back(cluster);
        }
      }
    }
  }

  int Surface() const { return this->OnSurface; }
  bool AlwaysSubdivide() const { return this->Wanted == Ends::NotFinite; }
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
    const Point& offset = tables::Parities[Parity(place.Position)].Offsets[edge];
    const bool isFinite = this->IsFinite(place.Position) && this->IsFinite(place.Position + offset);
    return isFinite == (this->Wanted == Ends::Finite);
  }

private:
  const IsodiamondHierarchy& Hierarchy;
  const Finiteness& IsFinite;
  int OnSurface;
  Ends Wanted;
  std::vector<IsovertexCluster> Clusters;
};

}

#endif
