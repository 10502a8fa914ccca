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

/** Puts samples over the triangles of the simpler mesh. */
class SampleHomes
{
public:
  SampleHomes(MeshPart& part, const Connectivity& simple)
    : Part(part)
    , Simple(simple)
    , Cover(part.Positions, simple.Linked())
  {
  }

  /** From points that both meshes have on, over the original. */
  void Find()
  {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t i = 0; i < this->Part.Original.Triangles.size(); ++i)
    {
      for (const std::uint32_t point : this->Part.Original.Triangles[i])
      {
        if (this->MiddleOf(i).Home == None && this->Simple.IsUsed(point))
        {
          this->WalkTo(this->MiddleOf(i), this->Simple.At(point)[0]);
          waiting.push_back(i);
        }
      }
    }
    for (std::size_t at = 0; at < waiting.size(); ++at)
    {
      const std::uint32_t home = this->MiddleOf(waiting[at]).Home;
      for (const std::uint32_t point : this->Part.Original.Triangles[waiting[at]])
      {
        if (!this->Simple.IsUsed(point) && this->Part.Samples[point].Home == None)
        {
          this->WalkTo(this->Part.Samples[point], home);
        }
      }
      for (const std::uint32_t neighbour : this->Part.Original.Neighbours[waiting[at]])
      {
        if (neighbour != None && this->MiddleOf(neighbour).Home == None)
        {
          this->WalkTo(this->MiddleOf(neighbour), home);
          waiting.push_back(neighbour);
        }
      }
    }
  }

private:
  SurfaceSample& MiddleOf(std::uint32_t triangle)
  {
    return this->Part.Samples[this->Part.Positions.size() + triangle];
  }

  /** To the nearest triangle, as long as one around is nearer. */
  void WalkTo(SurfaceSample& sample, std::uint32_t start)
  {
    std::vector<std::uint32_t> around;
    for (sample.Home = None; sample.Home != start;)
    {
      sample.Home = start;
      around = { start };
      for (const std::uint32_t point : this->Simple.Linked().Triangles[start])
      {
        const IdRange there = this->Simple.At(point);
        around.insert(around.end(), there.begin(), there.end());
      }
      start = this->Cover.NearestOf(around, sample.Position);
    }
  }

  MeshPart& Part;
  const Connectivity& Simple;
  Covering Cover;
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
  const std::vector<double>& allowances)
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
  SampleHomes(part, simple).Find();
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
