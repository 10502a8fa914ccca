// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondPatches_h
#define isodiamond_DiamondPatches_h

#include "DistanceError/IsovertexClusters.h"
#include "DistanceError/SpineEdges.h"
#include "DistanceError/SpineNeighbourhood.h"
#include "Patches/PatchBound.h"
#include "Patches/PatchDistance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

namespace isodiamond
{

/**
 * The patches that can be in a mesh around the spine of one diamond, while the diamond itself is
 * not subdivided: those of its tetrahedra, and those of the coarser ones that stand in for them.
 * Each is made when first asked for; the object is used for one diamond after another.
 */
template <typename Lengths>
class DiamondPatches
{
public:
  DiamondPatches(const IsodiamondHierarchy& hierarchy, const Lengths& lengths, int surface)
    : Hierarchy(hierarchy)
    , Neighbourhood(hierarchy)
    , InWorld(lengths)
    , InBounds(lengths)
    , Surface(surface)
  {
  }

  /** Goes on to another diamond. */
  void Reset(const Place& diamond)
  {
    this->Diamond = diamond;
    this->Edges = &SpineEdgesOf(diamond.Position);
    this->There = 0;
    this->KnownOwners = 0;
    this->KnownCorners = 0;
    this->Count = 0;
    this->Neighbourhood.ForEachTetrahedron(diamond, true,
      [&](int number, const HalfPlace& tetrahedron)
      {
        this->There |= 1U << number;
        for (int i = this->Count; i < number; ++i)
        {
          this->Entries[i].Tetrahedron.Half = nullptr; // is not there
        }
        this->Count = number + 1;
        Entry& entry = this->Entries[number];
        entry.Tetrahedron = tetrahedron;
        entry.HasOwn = false;
        entry.HasBound = false;
        entry.Coarsest = tetrahedron;
        entry.HasCoarsest = false;
        entry.CoarserCount = 0;
      });
  }

  /** The number of one of the diamond's tetrahedra. */
  int Find(const HalfPlace& tetrahedron) const
  {
    int i = 0;
    while (this->Entries[i].Tetrahedron.Rank != tetrahedron.Rank ||
      this->Entries[i].Tetrahedron.Half != tetrahedron.Half)
    {
      ++i;
      assert(i < this->Count && "a tetrahedron of the diamond");
    }
    return i;
  }

  /** Whether the diamond has a tetrahedron of this number, with samples at all of its vertices. */
  bool IsThere(int tetrahedron) const
  {
    return tetrahedron < this->Count && this->Entries[tetrahedron].Tetrahedron.Half != nullptr;
  }

  /** The tetrahedra that are there, as a mask. */
  std::uint32_t AreThere() const { return this->There; }

  /** Where the patches of all tetrahedra that share an edge or a triangle meet it: at a point, in a
   *  line or nowhere. */
  struct Border
  {
    int Count = 0; ///< of its ends
    Vector Start{};
    Vector Side{}; ///< from there to the other end

    /** The squared distance of a point; infinite if they meet nowhere. */
    double Squared(const Vector& point) const
    {
      if (this->Count == 0)
      {
        return std::numeric_limits<double>::infinity();
      }
      const Vector p = point - this->Start;
      const double along = Dot(p, this->Side);
      const double place = along > 0.0 ? std::min(along / Dot(this->Side, this->Side), 1.0) : 0.0;
      const Vector rest = p - place * this->Side;
      return Dot(rest, rest);
    }
  };

  /** @param around the edge, or the triangle's edges, as a mask */
  Border BorderIn(std::uint32_t around)
  {
    Border border;
    ForEachBit(around,
      [&](int edge)
      {
        if (this->IsCrossed(edge))
        {
          const Vector crossing = this->InWorld(this->Corner(edge));
          (border.Count == 0 ? border.Start : border.Side) = crossing;
          ++border.Count;
        }
      });
    border.Side = border.Count > 1 ? border.Side - border.Start : Vector{};
    return border;
  }

  /** The same, with the edges numbered as those of one tetrahedron. */
  Border BorderIn(int tetrahedron, std::uint32_t edges)
  {
    std::uint32_t around = 0;
    ForEachBit(
      edges, [&](int edge) { around |= 1U << this->Edges->OfTetrahedron[tetrahedron][edge]; });
    return this->BorderIn(around);
  }

  /** Bounds of the distances to the patch of a tetrahedron; null if it has none. */
  const PatchBound<Lengths>* Bound(int tetrahedron)
  {
    Entry& entry = this->Entries[tetrahedron];
    if (!entry.HasBound)
    {
      entry.HasBound = true;
      const SurfacePatch patch = this->Patch(entry.Tetrahedron);
      entry.IsEmpty = patch.TriangleCount == 0;
      const std::array<std::uint8_t, 6>& edges = this->Edges->OfTetrahedron[tetrahedron];
      if (!entry.IsEmpty)
      {
        entry.Bound.Reset(this->InBounds, patch,
          [&](int edge) -> const FinePosition& { return this->Corner(edges[edge]); });
      }
    }
    return entry.IsEmpty ? nullptr : &entry.Bound;
  }
  const BoundLengths<Lengths>& LengthsOfBounds() const { return this->InBounds; }

  /** The squared distance to the patch of a tetrahedron; infinite if it has none. */
  double SquaredTo(int tetrahedron, const Vector& point)
  {
    return SquaredTo(this->Own(this->Entries[tetrahedron]), point);
  }

  /**
   * The squared distance to the nearest patch that is in every mesh with a tetrahedron, or to one
   * that is near enough.
   *
   * @param own the squared distance to the tetrahedron's own patch
   */
  double SquaredToNearest(int tetrahedron, const Vector& point, double own, double enough)
  {
    const std::uint32_t parent = this->Entries[tetrahedron].Tetrahedron.Rank;
    double nearest = own;
    for (int i = 0; i < this->Count && nearest > enough; ++i) // the mate: in the mesh as well
    {
      if (this->IsThere(i) && this->Entries[i].Tetrahedron.Rank == parent && i != tetrahedron)
      {
        nearest = std::min(nearest, this->SquaredTo(i, point));
      }
    }
    for (int i = 0; i < this->Count && nearest > enough; ++i)
    {
      if (this->IsThere(i) && this->Entries[i].Tetrahedron.Rank != parent)
      {
        nearest = std::min(nearest, this->SquaredToFarthest(this->Entries[i], point, nearest));
      }
    }
    return nearest;
  }

private:
  /** Edges are as long as the spine for at most three generations. */
  static constexpr int MostCoarser = 3;

  struct Entry
  {
    HalfPlace Tetrahedron;
    bool HasOwn = false;
    bool HasBound = false;
    bool IsEmpty = false; ///< whether there is no patch to bound
    HalfPlace Coarsest;   ///< the last of Coarser, at first the tetrahedron itself
    bool HasCoarsest = false;
    int CoarserCount = 0;
    PatchBound<Lengths> Bound;
    PatchDistance Own;
    std::array<PatchDistance, MostCoarser> Coarser; ///< what can be in its place
  };

  static double SquaredTo(const PatchDistance& patch, const Vector& point)
  {
    return patch.IsEmpty() ? std::numeric_limits<double>::infinity() : patch.Squared(point);
  }

  const PatchDistance& Own(Entry& entry)
  {
    if (!entry.HasOwn)
    {
      entry.HasOwn = true;
      const std::array<std::uint8_t, 6>& edges =
        this->Edges->OfTetrahedron[&entry - this->Entries.data()];
      entry.Own.Reset(this->Patch(entry.Tetrahedron),
        [&](int edge) { return this->InWorld(this->Corner(edges[edge])); });
    }
    return entry.Own;
  }

  SurfacePatch Patch(const HalfPlace& tetrahedron) const
  {
    return PatchOf(this->Hierarchy, tetrahedron.Rank, *tetrahedron.Half, this->Surface);
  }

  /** The rank of an owner of the spine's edges. */
  std::uint32_t OwnerRank(int owner)
  {
    if (((this->KnownOwners >> owner) & 1U) == 0)
    {
      this->KnownOwners |= 1U << owner;
      this->OwnerRanks[owner] = static_cast<std::uint32_t>(
        this->Hierarchy.Diamonds().Rank(OwnerOf(this->Diamond, this->Edges->Owners[owner])));
    }
    return this->OwnerRanks[owner];
  }

  /** Whether the surface crosses one of the spine's edges. */
  bool IsCrossed(int index)
  {
    const SpineEdges::Edge& edge = this->Edges->Edges[index];
    const std::uint32_t rank = this->OwnerRank(edge.Owner);
    if (rank == static_cast<std::uint32_t>(DiamondSet::None))
    {
      return false;
    }
    const std::uint32_t crossed =
      this->Surface == 0 ? this->Hierarchy.Edges(rank) : this->Hierarchy.UpperEdges(rank);
    return ((crossed >> edge.OwnerEdge) & 1U) != 0;
  }

  /** The isovertex on a crossed one of the spine's edges; neighbours share it. */
  const FinePosition& Corner(int index)
  {
    if (((this->KnownCorners >> index) & 1U) == 0)
    {
      this->KnownCorners |= 1U << index;
      const SpineEdges::Edge& edge = this->Edges->Edges[index];
      this->Corners[index] =
        IsovertexAt(this->Hierarchy, OwnerOf(this->Diamond, this->Edges->Owners[edge.Owner]),
          this->OwnerRank(edge.Owner), edge.OwnerEdge, this->Surface);
    }
    return this->Corners[index];
  }

  /** The isovertex on a crossed edge of any tetrahedron. */
  Vector Corner(const HalfPlace& tetrahedron, int edge) const
  {
    return this->InWorld(IsovertexOn(this->Hierarchy, tetrahedron, edge, this->Surface));
  }

  /** The squared distance to the farthest patch that can be in a tetrahedron's place, or to one
   *  that is no nearer than `others`. */
  double SquaredToFarthest(Entry& entry, const Vector& point, double others)
  {
    double farthest = SquaredTo(this->Own(entry), point);
    for (int i = 0; farthest < others && (i < entry.CoarserCount || this->AddCoarser(entry)); ++i)
    {
      farthest = std::max(farthest, SquaredTo(entry.Coarser[i], point));
    }
    return farthest;
  }

  /** Makes one more of the coarser patches. @return whether there is one */
  bool AddCoarser(Entry& entry)
  {
    entry.HasCoarsest = entry.HasCoarsest || entry.CoarserCount == MostCoarser ||
      !this->Neighbourhood.Coarsen(entry.Coarsest, this->Diamond);
    if (!entry.HasCoarsest)
    {
      entry.Coarser[entry.CoarserCount++].Reset(
        this->Patch(entry.Coarsest), [&](int edge) { return this->Corner(entry.Coarsest, edge); });
    }
    return !entry.HasCoarsest;
  }

  const IsodiamondHierarchy& Hierarchy;
  SpineNeighbourhood Neighbourhood;
  const Lengths& InWorld;
  BoundLengths<Lengths> InBounds;
  int Surface;
  Place Diamond;
  int Count = 0;
  std::uint32_t There = 0; ///< a mask
  std::array<Entry, 8> Entries;
  const SpineEdges* Edges = nullptr;
  std::uint32_t KnownOwners = 0;  ///< whose rank is known, a mask
  std::uint32_t KnownCorners = 0; ///< isovertices that are known, a mask
  std::array<std::uint32_t, MaximumVertices> OwnerRanks{};
  std::array<FinePosition, SpineEdges::MostEdges> Corners{};
};

}

#endif
