// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_ScaleZeroDistances_h
#define isodiamond_ScaleZeroDistances_h

#include "DistanceError/Bisection.h"
#include "DistanceError/ErrorMaxima.h"
#include "DistanceError/FarthestSearch.h"
#include "DistanceError/FineDomain.h"
#include "DistanceError/IsovertexClusters.h"
#include "Field/Parallel.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** Raises the distance errors of the diamonds of scale 0, each by itself: a table tells which edges
 *  of full resolution lie in which of its tetrahedra. */
template <typename Lengths>
class ScaleZeroDistances
{
public:
  static void Run(const IsovertexClusters& clusters, const Lengths& lengths, ErrorMaxima& errors,
    const Loops& loops)
  {
    if (clusters.All().empty() && clusters.AreOfAll())
    {
      return; // else others may have some that lie in a domain here
    }
    const std::vector<Brick>& bricks = errors.Hierarchy().Diamonds().Level(0).Bricks;
    loops.Share(static_cast<std::int64_t>(bricks.size()), 16,
      [&](std::int64_t begin, std::int64_t end)
      {
        ScaleZeroDistances some(clusters, lengths, errors);
        for (std::int64_t i = begin; i < end; ++i)
        {
          if (clusters.Has(bricks[i]))
          {
            some.MeasureBrick(bricks[i]);
          }
        }
      });
  }

private:
  ScaleZeroDistances(const IsovertexClusters& clusters, const Lengths& lengths, ErrorMaxima& errors)
    : Clusters(clusters)
    , Errors(errors)
    , Hierarchy(errors.Hierarchy())
    , Search(errors.Hierarchy(), lengths, clusters.Surface())
  {
  }

  void MeasureBrick(const Brick& brick)
  {
    const DiamondSet& set = this->Hierarchy.Diamonds();
    const BrickLevel& level = set.Level(0);
    const BrickWindow window(level, level.Box.Origin(brick.BoxIndex));
    set.ForEachInBrick(0, brick,
      [&](const Place& diamond, std::uint32_t rank)
      {
        this->Located.clear();
        for (const FineDomain::Owner& owner : FineDomainOf(diamond).Owners)
        {
          // The isovertices of older owners are corners of the patches: at a distance of 0.
          if (!owner.IsOlder || this->Clusters.AlwaysSubdivide())
          {
            this->Locate(window, diamond, owner);
          }
        }
        if (!this->Located.empty())
        {
          this->Measure(diamond, rank);
        }
      });
  }

  /** An isovertex in the domain. */
  struct LocatedIsovertex
  {
    const FineDomain::Edge* Edge = nullptr; ///< that it lies on
    FinePosition Position{};
  };

  /** Finds the isovertices on the edges of one owner in the domain of a diamond of scale 0. */
  void Locate(const BrickWindow& window, const Place& diamond, const FineDomain::Owner& owner)
  {
    const Place place{ 0, diamond.Position + owner.Offset };
    const std::int64_t found = window.Rank(place.Position);
    if (found == DiamondSet::None)
    {
      return;
    }
    const auto rank = static_cast<std::uint32_t>(found);
    const std::uint32_t crossed = owner.EdgeMask &
      (this->Clusters.Surface() == 0 ? this->Hierarchy.Edges(rank)
                                     : this->Hierarchy.UpperEdges(rank));
    ForEachBit(crossed,
      [&](int edge)
      {
        if (this->Clusters.IsWanted(place, edge))
        {
          this->Located.push_back({ &owner.Edges[edge],
            IsovertexAt(this->Hierarchy, place, rank, edge, this->Clusters.Surface()) });
        }
      });
  }

  void Measure(const Place& diamond, std::uint32_t rank)
  {
    if (this->Errors.IsAlways(rank))
    {
      return;
    }
    if (this->Clusters.AlwaysSubdivide() || this->Errors.HasNoInterpolant(diamond))
    {
      if (this->IsAnyInGrid(diamond))
      {
        this->Errors.RaiseToAlways(rank);
      }
      return;
    }
    this->Search.Reset(diamond);
    this->Errors.RaiseToFarthest(diamond, rank,
      [&](Farthest& farthest)
      {
        for (const LocatedIsovertex& isovertex : this->Located)
        {
          const FineDomain::Edge& edge = *isovertex.Edge;
          this->Search.Propose(edge.Tetrahedra, edge.Around, isovertex.Position, farthest);
        }
        this->Search.Decide(farthest);
      });
  }

  /** Whether a tetrahedron in the grid holds one of the isovertices. */
  bool IsAnyInGrid(const Place& diamond) const
  {
    std::uint32_t holders = 0;
    for (const LocatedIsovertex& isovertex : this->Located)
    {
      holders |= isovertex.Edge->Tetrahedra;
    }
    bool isAny = false;
    SpineNeighbourhood(this->Hierarchy)
      .ForEachTetrahedron(diamond, false,
        [&](int number, const HalfPlace& tetrahedron)
        {
          isAny = isAny ||
            (((holders >> number) & 1U) != 0 &&
              IsInGrid(this->Hierarchy.SampleGrid(), tetrahedron));
        });
    return isAny;
  }

  const IsovertexClusters& Clusters;
  ErrorMaxima& Errors;
  const IsodiamondHierarchy& Hierarchy;
  FarthestSearch<Lengths> Search;
  std::vector<LocatedIsovertex> Located;
};

}

#endif
