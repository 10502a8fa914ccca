// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DomainMap_h
#define isodiamond_DomainMap_h

#include "DistanceError/FineDomain.h"
#include "DistanceError/IsovertexClusters.h"
#include "DistanceError/SpineEdges.h"
#include "DistanceError/SpineNeighbourhood.h"
#include "DistanceError/TriangleWalk.h"
#include "Patches/PatchDistance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace isodiamond
{

/**
 * A map from the surface of full resolution in the domain of a diamond of scale 0 or 1 to the
 * diamond's patches: how far it moves any point bounds the way back.
 *
 * Like that of one tetrahedron (MapBounds), but isovertices inside the domain may go to any
 * triangle in the tetrahedra that hold them; those on its border have to stay on it. Where the ends
 * of an edge go to different triangles, some points of the edge go to the sides between these
 * (TriangleWalk.h). So a triangle of full resolution is mapped in pieces, each to one triangle of
 * the patches, and no point moves farther than the pieces' corners do. As the map takes border to
 * border, all of the patches are covered: they contain no closed surface, as there is no vertex
 * inside the domain of a spine.
 */
template <typename Lengths>
class DomainMap
{
public:
  /** Hierarchy and lengths must outlive it. */
  DomainMap(const IsodiamondHierarchy& hierarchy, const Lengths& lengths, int surface)
    : Hierarchy(hierarchy)
    , InWorld(lengths)
    , Surface(surface)
  {
  }

  /**
   * How far a point of the diamond's patches can be from the surface; infinite if no map is found.
   *
   * @param patches of all tetrahedra around the spine
   * @param isNear tells whether a squared distance is so small that no other place is looked for
   * @param mayMove tells, given a place on the patches and a squared distance, whether something
   *        may go that far to there
   */
  template <typename IsNear, typename MayMove>
  double Bound(const Place& diamond, const NumberedPatches& patches, const IsNear& isNear,
    const MayMove& mayMove)
  {
    this->Greatest = 0.0;
    this->Count = 0;
    this->HasNeighbours = false;
    this->There = 0;
    this->Crossed = 0;
    this->Domain = &FineDomainOf(diamond);
    const SpineEdges& edges = SpineEdgesOf(diamond.Position);
    for (const NumberedPatch& patch : patches)
    {
      this->AddPatch(edges, patch);
    }
    return this->TakeIsovertices(diamond, isNear, mayMove) && this->TakeEdges(mayMove)
      ? std::sqrt(this->Greatest)
      : std::numeric_limits<double>::infinity();
  }

private:
  /** A triangle of the patches. */
  struct PatchTriangle
  {
    int Tetrahedron = 0;
    std::array<int, 3> Corners{}; ///< as SpineEdges counts
    std::uint32_t CornerMask = 0;
    bool HasDistance = false;
    TriangleDistance Distance;
  };

  /** An isovertex of full resolution. */
  struct Isovertex
  {
    Vector Position{};
    std::uint32_t On = 0; ///< the patches' triangles that it is taken to, a mask
  };

  /** A place on the patches, and how far something is from it. */
  struct Image
  {
    Vector Position{};
    double Squared = std::numeric_limits<double>::infinity();
  };

  template <typename MayMove>
  bool IsTaken(const Image& image, const MayMove& mayMove)
  {
    this->Greatest = std::max(this->Greatest, image.Squared);
    return mayMove(image.Position, image.Squared);
  }

  void AddPatch(const SpineEdges& edges, const NumberedPatch& patch)
  {
    this->There |= 1U << patch.Number;
    for (int i = 0; i < patch.Patch.TriangleCount; ++i)
    {
      PatchTriangle& triangle = this->Triangles[this->Count++];
      triangle.Tetrahedron = patch.Number;
      triangle.CornerMask = 0;
      triangle.HasDistance = false;
      for (int j = 0; j < 3; ++j)
      {
        const std::uint8_t edge = patch.Patch.Triangles[i][j];
        const int corner = edges.OfTetrahedron[patch.Number][edge];
        triangle.Corners[j] = corner;
        triangle.CornerMask |= 1U << corner;
        if (((this->Crossed >> corner) & 1U) == 0)
        {
          this->Corners[corner] =
            this->InWorld(IsovertexOn(this->Hierarchy, patch.Tetrahedron, edge, this->Surface));
          this->Crossed |= 1U << corner;
          this->TrianglesAt[corner] = 0;
        }
        this->TrianglesAt[corner] |= 1U << (this->Count - 1);
      }
    }
  }

  /** Decides where the isovertices of full resolution go. @return whether all may go there */
  template <typename IsNear, typename MayMove>
  bool TakeIsovertices(const Place& diamond, const IsNear& isNear, const MayMove& mayMove)
  {
    this->Isovertices.clear();
    const Point centre = Centre(diamond);
    if (const Point brick = BrickOf(centre); !this->Window || brick != this->WindowBrick)
    {
      this->WindowBrick = brick;
      this->Window.emplace(this->Hierarchy.Diamonds().Level(0), centre);
    }
    for (std::size_t i = 0; i < this->Domain->Owners.size(); ++i)
    {
      const FineDomain::Owner& owner = this->Domain->Owners[i];
      const Place place{ 0, centre + owner.Offset };
      this->Ranks[i] = this->Window->Rank(place.Position);
      if (this->Ranks[i] == DiamondSet::None)
      {
        continue;
      }
      const auto rank = static_cast<std::uint32_t>(this->Ranks[i]);
      const std::uint32_t crossed = owner.EdgeMask &
        (this->Surface == 0 ? this->Hierarchy.Edges(rank) : this->Hierarchy.UpperEdges(rank));
      bool isTaken = true;
      ForEachBit(crossed,
        [&](int ownerEdge)
        {
          const FineDomain::Edge& edge = owner.Edges[ownerEdge];
          const std::uint32_t holders = edge.Tetrahedra & this->There;
          if (holders != 0 && isTaken)
          {
            this->Indices[i][ownerEdge] = static_cast<std::uint16_t>(this->Isovertices.size());
            Isovertex& isovertex = this->Isovertices.emplace_back();
            isovertex.Position =
              this->InWorld(IsovertexAt(this->Hierarchy, place, rank, ownerEdge, this->Surface));
            isTaken =
              this->IsTaken(this->ImageOf(edge.Around, holders, isNear, isovertex), mayMove);
          }
        });
      if (!isTaken)
      {
        return false;
      }
    }
    return true;
  }

  /** Where an isovertex goes: to where patches meet the edge or triangle that it lies on, if that
   *  is near or there is no choice. */
  template <typename IsNear>
  Image ImageOf(
    std::uint32_t around, std::uint32_t holders, const IsNear& isNear, Isovertex& isovertex)
  {
    const std::uint32_t crossed = around & this->Crossed;
    const bool isOnEdge = PopCount(around) == 1;
    // In a tetrahedron, between two, or on the spine with tetrahedra all around.
    const bool isInside =
      around == 0 || (isOnEdge ? holders == this->Domain->AllTetrahedra : PopCount(holders) == 2);
    Image image;
    if (PopCount(crossed) == (isOnEdge ? 1 : 2))
    {
      const Vector& first = this->Corners[LowestBit(crossed)];
      const Vector& second = this->Corners[LowestBit(isOnEdge ? crossed : crossed & (crossed - 1))];
      isovertex.On = this->TrianglesWith(crossed);
      image = OnSegment(isovertex.Position, first, second);
    }
    return isInside && !isNear(image.Squared) ? this->NearestIn(holders, isovertex) : image;
  }

  /** Takes an isovertex to the nearest of the patches of some tetrahedra. */
  Image NearestIn(std::uint32_t tetrahedra, Isovertex& isovertex)
  {
    Image nearest;
    for (int i = 0; i < this->Count; ++i)
    {
      if (((tetrahedra >> this->Triangles[i].Tetrahedron) & 1U) != 0)
      {
        const double squared = this->DistanceTo(i).Squared(isovertex.Position);
        if (squared < nearest.Squared)
        {
          nearest.Squared = squared;
          isovertex.On = 1U << i;
        }
      }
    }
    if (nearest.Squared < std::numeric_limits<double>::infinity())
    {
      nearest.Position = this->DistanceTo(LowestBit(isovertex.On)).Nearest(isovertex.Position);
    }
    return nearest;
  }

  const TriangleDistance& DistanceTo(int index)
  {
    PatchTriangle& triangle = this->Triangles[index];
    if (!triangle.HasDistance)
    {
      triangle.HasDistance = true;
      triangle.Distance = { this->Corners[triangle.Corners[0]], this->Corners[triangle.Corners[1]],
        this->Corners[triangle.Corners[2]] };
    }
    return triangle.Distance;
  }

  std::uint32_t TrianglesWith(std::uint32_t corners) const
  {
    std::uint32_t triangles = ~0U;
    ForEachBit(corners, [&](int corner) { triangles &= this->TrianglesAt[corner]; });
    return triangles;
  }

  /** Decides where those edges of full resolution go whose ends go to different triangles. @return
   *  whether all triangles of full resolution are mapped */
  template <typename MayMove>
  bool TakeEdges(const MayMove& mayMove)
  {
    for (const FineDomain::Tetrahedron& tetrahedron : this->Domain->Tetrahedra)
    {
      const std::int64_t rank = this->Ranks[tetrahedron.Owner];
      if (rank == DiamondSet::None || ((this->There >> tetrahedron.Whole) & 1U) == 0)
      {
        continue;
      }
      const SurfacePatch patch = PatchOf(
        this->Hierarchy, static_cast<std::uint32_t>(rank), *tetrahedron.Half, this->Surface);
      for (int i = 0; i < patch.TriangleCount; ++i)
      {
        std::array<const Isovertex*, 3> corners;
        for (int j = 0; j < 3; ++j)
        {
          const auto [owner, edge] = tetrahedron.Edges[patch.Triangles[i][j]];
          corners[j] = &this->Isovertices[this->Indices[owner][edge]];
        }
        if (!this->IsMapped(corners, mayMove))
        {
          return false;
        }
      }
    }
    return true;
  }

  /** Whether all of a triangle of full resolution goes to the patches, in pieces. */
  template <typename MayMove>
  bool IsMapped(const std::array<const Isovertex*, 3>& corners, const MayMove& mayMove)
  {
    if ((corners[0]->On & corners[1]->On & corners[2]->On) != 0)
    {
      return true;
    }
    this->FindNeighbours();
    ReducedWalk border;
    for (int i = 0; i < 3; ++i)
    {
      const Isovertex& from = *corners[i];
      const Isovertex& to = *corners[(i + 1) % 3];
      const bool isForward = &from < &to; // the same way for both triangles at the edge
      TriangleWalk way;
      if (!this->Neighbours.FindWalk(
            isForward ? from.On : to.On, isForward ? to.On : from.On, way) ||
        !this->IsTakenAlong(way, from, to, mayMove))
      {
        return false;
      }
      if (!isForward)
      {
        std::reverse(way.Triangles.begin(), way.Triangles.begin() + way.Count);
      }
      if (!this->GoOn(border, way.Triangles[0], from.On))
      {
        return false;
      }
      std::for_each(way.Triangles.begin(), way.Triangles.begin() + way.Count,
        [&](std::uint8_t triangle) { border.Add(triangle); });
    }
    return this->GoOn(border, border.First(), corners[0]->On) && border.IsNothing();
  }

  /** Whether an edge may go where it passes from triangle to triangle. */
  template <typename MayMove>
  bool IsTakenAlong(
    const TriangleWalk& way, const Isovertex& from, const Isovertex& to, const MayMove& mayMove)
  {
    for (int i = 1; i < way.Count; ++i)
    {
      const std::uint32_t shared = this->Triangles[way.Triangles[i - 1]].CornerMask &
        this->Triangles[way.Triangles[i]].CornerMask;
      if (!this->IsTaken(OnOther(from.Position, to.Position, this->Corners[LowestBit(shared)],
                           this->Corners[LowestBit(shared & (shared - 1))]),
            mayMove))
      {
        return false;
      }
    }
    return true;
  }

  /** Goes on to a triangle at a place on both it and the last, over triangles with that place. */
  bool GoOn(ReducedWalk& walk, std::uint8_t triangle, std::uint32_t place) const
  {
    if (!walk.HasBegun() || walk.Last() == triangle)
    {
      return true;
    }
    TriangleWalk between;
    const bool isThere =
      this->Neighbours.FindWalk(1U << walk.Last(), 1U << triangle, between, place);
    for (int i = 1; isThere && i < between.Count; ++i)
    {
      walk.Add(between.Triangles[i]);
    }
    return isThere;
  }

  /** Finds which of the patches' triangles share a side, that is, two corners. */
  void FindNeighbours()
  {
    if (this->HasNeighbours)
    {
      return;
    }
    this->HasNeighbours = true;
    for (int i = 0; i < this->Count; ++i)
    {
      const std::array<int, 3>& corners = this->Triangles[i].Corners;
      const std::uint32_t first = this->TrianglesAt[corners[0]];
      const std::uint32_t second = this->TrianglesAt[corners[1]];
      const std::uint32_t third = this->TrianglesAt[corners[2]];
      this->Neighbours.Set(i, ((first & second) | (second & third) | (third & first)) & ~(1U << i));
    }
  }

  /** The nearest point of a segment. */
  static Image OnSegment(const Vector& point, const Vector& begin, const Vector& end)
  {
    const Vector way = end - begin;
    const double along = Dot(point - begin, way);
    const Vector place = begin + (along > 0.0 ? std::min(along / Dot(way, way), 1.0) : 0.0) * way;
    return { place, Dot(point - place, point - place) };
  }

  /** The point of another segment that is nearest to a certain point of one: to that which is
   *  nearest to the other's line. */
  static Image OnOther(
    const Vector& begin, const Vector& end, const Vector& otherBegin, const Vector& otherEnd)
  {
    const Vector way = end - begin;
    const Vector other = otherEnd - otherBegin;
    const Vector across = way - (Dot(way, other) / Dot(other, other)) * other;
    const double along = Dot(otherBegin - begin, across) / Dot(way, across);
    return OnSegment(
      begin + (along > 0.0 ? std::min(along, 1.0) : 0.0) * way, otherBegin, otherEnd);
  }

  const IsodiamondHierarchy& Hierarchy;
  const Lengths& InWorld;
  int Surface;
  double Greatest = 0.0; ///< squared, of how far anything moves
  std::uint32_t There = 0;
  std::uint32_t Crossed = 0; ///< of the spine's edges
  std::array<Vector, SpineEdges::MostEdges> Corners{};
  std::array<std::uint32_t, SpineEdges::MostEdges> TrianglesAt{}; ///< the corners, masks
  int Count = 0;
  std::array<PatchTriangle, MostPatchTriangles> Triangles;
  bool HasNeighbours = false;
  TriangleNeighbours Neighbours;
  const FineDomain* Domain = nullptr;
  Point WindowBrick{};
  std::optional<BrickWindow> Window;     ///< of the bricks of scale 0 around that one
  static constexpr int MostOwners = 125; ///< of scale 1
  std::array<std::int64_t, MostOwners> Ranks{};
  std::array<std::array<std::uint16_t, MaximumVertices>, MostOwners> Indices{}; ///< crossed edges'
  std::vector<Isovertex> Isovertices;
};

}

#endif
