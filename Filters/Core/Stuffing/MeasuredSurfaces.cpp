// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/MeasuredSurfaces.h"

#include "Patches/IntervalPatches.h"
#include "Simplification/Covering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace isodiamond
{
namespace
{

/** A triangle, and the tetrahedron that it is a face of. */
struct OwnedTriangle
{
  Triangle Sorted{};
  Triangle Points{};
  std::uint32_t Owner = 0;
};

/** Walks over a mesh to the nearest triangle. */
class Walker
{
public:
  Walker(const std::vector<Vector>& positions, const Connectivity& mesh)
    : Mesh(mesh)
    , Cover(positions, mesh.Linked())
  {
  }

  /** Goes from the nearest of some triangles, any of which may be None, to one beside it, as long
   *  as one is nearer. @return None if there is none to start from */
  template <typename Starts>
  std::uint32_t NearestTo(const Vector& position, const Starts& starts)
  {
    this->Least = HUGE_VAL;
    std::uint32_t nearest = this->NearerOf(starts, position, None);
    for (std::uint32_t at = None; at != nearest;)
    {
      at = nearest;
      nearest = this->NearerOf(this->Mesh.Linked().Neighbours[at], position, at);
      if (nearest == at && !this->Cover.IsOver(at, position))
      {
        // The way to a nearer one may lead around a point where all triangles between are as near.
        for (const std::uint32_t point : this->Mesh.Linked().Triangles[at])
        {
          nearest = this->NearerOf(this->Mesh.At(point), position, nearest);
        }
      }
    }
    return nearest;
  }

private:
  template <typename Triangles>
  std::uint32_t NearerOf(const Triangles& triangles, const Vector& position, std::uint32_t nearest)
  {
    for (const std::uint32_t triangle : triangles)
    {
      const double squared =
        triangle == None ? HUGE_VAL : this->Cover.SquaredDistance(triangle, position);
      if (squared < this->Least)
      {
        this->Least = squared;
        nearest = triangle;
      }
    }
    return nearest;
  }

  const Connectivity& Mesh;
  Covering Cover;
  double Least = HUGE_VAL; ///< squared distance of the nearest one so far
};

/** Puts samples over the triangles of the simpler mesh. */
class SampleHomes
{
public:
  /** @param anyIn by triangle of the original: one of the simpler mesh in the same leaf and on
   *         the same surface, or None */
  SampleHomes(MeshPart& part, const Connectivity& simple, std::vector<std::uint32_t> anyIn)
    : Part(part)
    , Simple(simple)
    , AnyAt(AnyTriangleAt(part.Positions.size(), part.Simple))
    , AnyIn(std::move(anyIn))
  {
  }

  /** First for triangles in a leaf that still has one, or with a point that both meshes have; for
   *  the rest from what is beside them. */
  void Find(const ParallelFor& parallelFor)
  {
    const std::vector<Triangle>& originals = this->Part.Original.Triangles;
    this->Walk(
      parallelFor, originals.size(), [&](std::size_t i) -> SurfaceSample& { return MiddleOf(i); },
      [&](std::size_t i) { return this->StartsOf(i); });
    this->FindFromNeighbours();
    std::vector<std::uint32_t> beside(this->Part.Positions.size(), None);
    for (std::uint32_t i = 0; i < originals.size(); ++i)
    {
      for (const std::uint32_t point : originals[i])
      {
        beside[point] = this->MiddleOf(i).Home != None ? i : beside[point];
      }
    }
    this->Walk(
      parallelFor, beside.size(),
      [&](std::size_t i) -> SurfaceSample& { return this->Part.Samples[i]; },
      [&](std::size_t i) -> std::array<std::uint32_t, 1>
      {
        const bool isGone = this->AnyAt[i] == None;
        return { isGone && beside[i] != None ? this->MiddleOf(beside[i]).Home : None };
      });
  }

private:
  SurfaceSample& MiddleOf(std::size_t triangle)
  {
    return this->Part.Samples[this->Part.Positions.size() + triangle];
  }

  /** Triangles in the same leaf, and at the points that are still there. */
  std::array<std::uint32_t, 4> StartsOf(std::size_t original) const
  {
    const auto [a, b, c] = this->Part.Original.Triangles[original];
    return { this->AnyIn[original], this->AnyAt[a], this->AnyAt[b], this->AnyAt[c] };
  }

  template <typename SampleAt, typename Starts>
  void Walk(
    const ParallelFor& parallelFor, std::size_t count, const SampleAt& at, const Starts& startsOf)
  {
    constexpr std::int64_t grain = 1024;
    parallelFor(static_cast<std::int64_t>(count), grain,
      [&](std::int64_t begin, std::int64_t end)
      {
        Walker walker(this->Part.Positions, this->Simple);
        for (std::int64_t i = begin; i < end; ++i)
        {
          at(i).Home = walker.NearestTo(at(i).Position, startsOf(i));
        }
      });
  }

  void FindFromNeighbours()
  {
    const LinkedTriangles& original = this->Part.Original;
    Walker walker(this->Part.Positions, this->Simple);
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t i = 0; i < original.Triangles.size(); ++i)
    {
      if (this->MiddleOf(i).Home != None)
      {
        waiting.push_back(i);
      }
    }
    for (std::size_t at = 0; at < waiting.size(); ++at)
    {
      for (const std::uint32_t neighbour : original.Neighbours[waiting[at]])
      {
        if (neighbour != None && this->MiddleOf(neighbour).Home == None)
        {
          SurfaceSample& sample = this->MiddleOf(neighbour);
          sample.Home = walker.NearestTo(
            sample.Position, std::array<std::uint32_t, 1>{ this->MiddleOf(waiting[at]).Home });
          if (sample.Home != None) // if it is None, no distance is finite
          {
            waiting.push_back(neighbour);
          }
        }
      }
    }
  }

  MeshPart& Part;
  const Connectivity& Simple;
  std::vector<std::uint32_t> AnyAt; ///< by point: a triangle of the simpler mesh, or None
  std::vector<std::uint32_t> AnyIn; ///< by triangle of the original, see above
};

/** Adds points, and then the middles of the original's triangles. */
void AddSamples(const std::vector<double>& allowances, MeshPart& part)
{
  for (const Vector& position : part.Positions)
  {
    part.Samples.push_back({ position, HUGE_VAL, None });
  }
  for (std::uint32_t i = 0; i < part.Original.Triangles.size(); ++i)
  {
    const auto [a, b, c] = part.Original.Corners(part.Positions, i);
    part.Samples.push_back({ (1.0 / 3.0) * (a + b + c), allowances[i], None });
    for (const std::uint32_t point : part.Original.Triangles[i])
    {
      double& least = part.Samples[point].Allowance;
      least = std::min(least, allowances[i]);
    }
  }
}

}

Surfaces SurfacesOf(const TetrahedronMesh& mesh)
{
  std::vector<OwnedTriangle> all;
  for (std::uint32_t i = 0; i < mesh.Tetrahedra.size(); ++i)
  {
    const Corners& corners = mesh.Tetrahedra[i];
    for (const std::array<int, 3>& face : FacesOfTetrahedron)
    {
      const Triangle points = { corners[face[0]], corners[face[1]], corners[face[2]] };
      if (SurfaceOfFace(mesh, points) != 0 && WallsOfFace(mesh, points) == 0)
      {
        all.push_back({ points, points, i });
        std::sort(all.back().Sorted.begin(), all.back().Sorted.end());
      }
    }
  }
  // Faces of two tetrahedra are inside. Each look is at the few triangles with one least point.
  const CellsAtPoints byLeast(mesh.Positions.size(), all.size(),
    [&](std::size_t i) { return std::array<std::uint32_t, 1>{ all[i].Sorted[0] }; });
  Surfaces result;
  for (std::uint32_t point = 0; point < mesh.Positions.size(); ++point)
  {
    const IdRange there = byLeast[point];
    for (const std::uint32_t i : there)
    {
      const bool isShared = std::any_of(there.begin(), there.end(),
        [&](std::uint32_t other) { return other != i && all[other].Sorted == all[i].Sorted; });
      if (!isShared)
      {
        result.Triangles.push_back(all[i].Points);
        result.Origins.push_back(mesh.Origins[all[i].Owner]);
      }
    }
  }
  return result;
}

MeasuredSurfaces::MeasuredSurfaces(const TetrahedronMesh& plain, const TetrahedronMesh& stuffed,
  const std::vector<double>& allowances, const ParallelFor& parallelFor)
{
  const std::size_t points = stuffed.Positions.size();
  std::array<Surfaces, 2> surfaces;
  std::array<std::optional<Connectivity>, 2> links;
  ForEachIndex(parallelFor, 2, 1,
    [&](std::int64_t i)
    {
      surfaces[i] = SurfacesOf(i == 0 ? plain : stuffed);
      links[i].emplace(points, std::move(surfaces[i].Triangles));
    });
  const Connectivity& original = *links[0];
  const Connectivity& simple = *links[1];
  this->AreSound = original.FaultyPoints().empty() && simple.FaultyPoints().empty();
  if (!this->AreSound)
  {
    return;
  }
  this->Origins = std::move(surfaces[0].Origins);
  this->SimpleOrigins = std::move(surfaces[1].Origins);
  MeshPart& part = this->Part;
  part.Positions = stuffed.Positions;
  part.Original = original.Linked();
  part.Simple = simple.Linked();
  part.OnWalls = stuffed.OnWalls;
  part.IsFixed.resize(points);
  part.IsSettled.resize(points);
  part.Near = NearLists(part.Original.Triangles.size());
  for (const std::uint32_t origin : this->Origins)
  {
    part.Allowances.push_back(allowances[origin]);
  }
  AddSamples(part.Allowances, part);
  SampleHomes(part, simple, this->AnyInLeaves(stuffed.Surfaces, allowances.size()))
    .Find(parallelFor);
}

/** By triangle of the first mesh: one of the second in the same leaf and on the same surface, as a
 *  leaf may have both; None if there is none. @param surfaces by point */
std::vector<std::uint32_t> MeasuredSurfaces::AnyInLeaves(
  const std::vector<std::int8_t>& surfaces, std::size_t leafCount) const
{
  const auto placeOf = [&](std::uint32_t leaf, const Triangle& triangle)
  { return 2 * std::size_t{ leaf } + (surfaces[triangle[0]] > 0 ? 1 : 0); };
  std::vector<std::uint32_t> inLeaf(2 * leafCount, None);
  for (std::uint32_t i = 0; i < this->SimpleOrigins.size(); ++i)
  {
    inLeaf[placeOf(this->SimpleOrigins[i], this->Part.Simple.Triangles[i])] = i;
  }
  std::vector<std::uint32_t> any;
  any.reserve(this->Origins.size());
  for (std::uint32_t i = 0; i < this->Origins.size(); ++i)
  {
    any.push_back(inLeaf[placeOf(this->Origins[i], this->Part.Original.Triangles[i])]);
  }
  return any;
}

std::vector<std::uint32_t> MeasuredSurfaces::Homes() const
{
  std::vector<std::uint32_t> homes;
  homes.reserve(this->Part.Samples.size());
  for (const SurfaceSample& sample : this->Part.Samples)
  {
    homes.push_back(sample.Home);
  }
  return homes;
}

}
