// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/MeasuredSurfaces.h"

#include "Patches/IntervalPatches.h"
#include "Simplification/Covering.h"

#include <algorithm>
#include <cmath>
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

/** Walks over a mesh to what is nearest. */
class Walker
{
public:
  Walker(const std::vector<Vector>& positions, const Connectivity& mesh)
    : Mesh(mesh)
    , Cover(positions, mesh.Linked())
  {
  }

  /** The nearest triangle, as long as one around is nearer. */
  std::uint32_t NearestTo(const Vector& position, std::uint32_t start)
  {
    for (std::uint32_t at = None; at != start;)
    {
      at = start;
      this->Around = { start };
      for (const std::uint32_t point : this->Mesh.Linked().Triangles[start])
      {
        const IdRange there = this->Mesh.At(point);
        this->Around.insert(this->Around.end(), there.begin(), there.end());
      }
      start = this->Cover.NearestOf(this->Around, position);
    }
    return start;
  }

private:
  const Connectivity& Mesh;
  Covering Cover;
  std::vector<std::uint32_t> Around;
};

/** Puts samples over the triangles of the simpler mesh. */
class SampleHomes
{
public:
  SampleHomes(MeshPart& part, const Connectivity& simple)
    : Part(part)
    , Simple(simple)
  {
  }

  /** First of triangles with a point that both meshes have; the rest from what is beside it. */
  void Find(const ParallelFor& parallelFor)
  {
    const std::vector<Triangle>& originals = this->Part.Original.Triangles;
    this->Walk(
      parallelFor, originals.size(), [&](std::size_t i) -> SurfaceSample& { return MiddleOf(i); },
      [&](std::size_t i) { return this->StartOf(i); });
    this->FindFromNeighbours();
    std::vector<std::uint32_t> anyAt(this->Part.Positions.size(), None);
    for (std::uint32_t i = 0; i < originals.size(); ++i)
    {
      for (const std::uint32_t point : originals[i])
      {
        anyAt[point] = this->MiddleOf(i).Home != None ? i : anyAt[point];
      }
    }
    this->Walk(
      parallelFor, anyAt.size(),
      [&](std::size_t i) -> SurfaceSample& { return this->Part.Samples[i]; },
      [&](std::size_t i)
      {
        const bool isGone = !this->Simple.IsUsed(static_cast<std::uint32_t>(i));
        return isGone && anyAt[i] != None ? this->MiddleOf(anyAt[i]).Home : None;
      });
  }

private:
  SurfaceSample& MiddleOf(std::size_t triangle)
  {
    return this->Part.Samples[this->Part.Positions.size() + triangle];
  }

  std::uint32_t StartOf(std::size_t original) const
  {
    for (const std::uint32_t point : this->Part.Original.Triangles[original])
    {
      if (this->Simple.IsUsed(point))
      {
        return *this->Simple.At(point).begin();
      }
    }
    return None;
  }

  template <typename SampleAt, typename Start>
  void Walk(
    const ParallelFor& parallelFor, std::size_t count, const SampleAt& at, const Start& startOf)
  {
    constexpr std::int64_t grain = 1024;
    parallelFor(static_cast<std::int64_t>(count), grain,
      [&](std::int64_t begin, std::int64_t end)
      {
        Walker walker(this->Part.Positions, this->Simple);
        for (std::int64_t i = begin; i < end; ++i)
        {
          const std::uint32_t start = startOf(i);
          if (start != None)
          {
            at(i).Home = walker.NearestTo(at(i).Position, start);
          }
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
          sample.Home = walker.NearestTo(sample.Position, this->MiddleOf(waiting[at]).Home);
          waiting.push_back(neighbour);
        }
      }
    }
  }

  MeshPart& Part;
  const Connectivity& Simple;
};

/** Points, and then the middles of the original's triangles. */
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
  std::sort(all.begin(), all.end(),
    [](const OwnedTriangle& a, const OwnedTriangle& b) { return a.Sorted < b.Sorted; });
  Surfaces result;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    // What two tetrahedra have is inside.
    const bool isShared = (i > 0 && all[i - 1].Sorted == all[i].Sorted) ||
      (i + 1 < all.size() && all[i + 1].Sorted == all[i].Sorted);
    if (!isShared)
    {
      result.Triangles.push_back(all[i].Points);
      result.Origins.push_back(mesh.Origins[all[i].Owner]);
    }
  }
  return result;
}

MeasuredSurfaces::MeasuredSurfaces(const TetrahedronMesh& plain, const TetrahedronMesh& stuffed,
  const std::vector<double>& allowances, const ParallelFor& parallelFor)
{
  const std::size_t points = stuffed.Positions.size();
  Surfaces before = SurfacesOf(plain);
  Surfaces after = SurfacesOf(stuffed);
  const Connectivity original(points, std::move(before.Triangles));
  const Connectivity simple(points, std::move(after.Triangles));
  this->AreSound = original.FaultyPoints().empty() && simple.FaultyPoints().empty();
  if (!this->AreSound)
  {
    return;
  }
  this->Origins = std::move(before.Origins);
  this->SimpleOrigins = std::move(after.Origins);
  MeshPart& part = this->Part;
  part.Positions = stuffed.Positions;
  part.Original = original.Linked();
  part.Simple = simple.Linked();
  part.OnWalls = stuffed.OnWalls;
  part.IsFixed.resize(points);
  part.Near = NearLists(part.Original.Triangles.size());
  for (const std::uint32_t origin : this->Origins)
  {
    part.Allowances.push_back(allowances[origin]);
  }
  AddSamples(part.Allowances, part);
  SampleHomes(part, simple).Find(parallelFor);
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
