// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/SurfaceLinks.h"

#include "Patches/IntervalPatches.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Walks from a triangle over one of the two edges where its sides change, which stand for it.
 *  @return how many triangles it passes, negative if it does not come back */
int Walk(const std::vector<std::array<Edge, 2>>& triangles, int side)
{
  std::size_t at = 0;
  Edge through = triangles[0][side];
  int length = 1;
  while (length <= static_cast<int>(triangles.size()))
  {
    std::size_t next = 0;
    while (next < triangles.size() &&
      (next == at || (triangles[next][0] != through && triangles[next][1] != through)))
    {
      ++next;
    }
    if (next == triangles.size())
    {
      return -length;
    }
    if (next == 0)
    {
      return length;
    }
    ++length;
    through = triangles[next][triangles[next][0] == through ? 1 : 0];
    at = next;
  }
  return 0; // a triangle has more than one neighbour there: not a link
}

}

bool SurfaceLinks::IsInside(std::uint32_t vertex, int surface) const
{
  return surface == 0 ? this->Vertices.StateOf(vertex) > StateOn(0)
                      : this->Vertices.StateOf(vertex) < StateOn(1);
}

/** Whether sides change in the link of a vertex along one cycle, or on a wall along one path. */
bool SurfaceLinks::HasOneCycle(std::uint32_t vertex, int surface) const
{
  std::vector<std::array<Edge, 2>> mixed;
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    const auto others = Without(this->Mesh.CornersOf(tetrahedron), vertex);
    for (int i = 0; i < 3; ++i)
    {
      // The one that is not on the side of the two others.
      const std::uint32_t lone = others[i];
      const std::uint32_t a = others[(i + 1) % 3];
      const std::uint32_t b = others[(i + 2) % 3];
      const bool side = this->IsInside(lone, surface);
      if (this->IsInside(a, surface) != side && this->IsInside(b, surface) != side)
      {
        mixed.push_back({ SortedEdge(lone, a), SortedEdge(lone, b) });
      }
    }
  }
  if (mixed.empty())
  {
    return false;
  }
  const int count = static_cast<int>(mixed.size());
  const int around = Walk(mixed, 0);
  if (this->Mesh.WallsOf(vertex) == 0)
  {
    return around == count;
  }
  return around < 0 && -around + -Walk(mixed, 1) - 1 == count;
}

/** Whether vertices inside make at most one run around an edge on a surface, and are on only one
 *  side of each triangle there. */
bool SurfaceLinks::HasOneRun(std::uint32_t vertex, std::uint32_t other, int surface) const
{
  const Walls::Type walls = this->Mesh.WallsOf(vertex) & this->Mesh.WallsOf(other);
  bool anyInside = false;
  int changes = 0;
  std::vector<std::uint32_t> seen; // vertices on the surface with a neighbour inside
  bool isOneSided = true;
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    const Corners& corners = this->Mesh.CornersOf(tetrahedron);
    if (!Has(corners, other))
    {
      continue;
    }
    const Edge ends = Without(corners, vertex, other);
    const std::array<bool, 2> inside = { this->IsInside(ends[0], surface),
      this->IsInside(ends[1], surface) };
    anyInside = anyInside || inside[0] || inside[1];
    changes += inside[0] != inside[1] ? 1 : 0;
    for (int i = 0; i < 2; ++i)
    {
      if (inside[i] && this->Vertices.StateOf(ends[1 - i]) == StateOn(surface))
      {
        const std::uint32_t third = ends[1 - i];
        const bool isTwice = std::find(seen.begin(), seen.end(), third) != seen.end();
        isOneSided = isOneSided && !isTwice && (walls & this->Mesh.WallsOf(third)) == 0;
        seen.push_back(third);
      }
    }
  }
  return !anyInside || (isOneSided && changes == (walls == 0 ? 2 : 1));
}

/** The same for all edges on a surface opposite to a vertex, in its tetrahedra. */
bool SurfaceLinks::HaveOneRunEach(std::uint32_t vertex, int surface) const
{
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    const Face others = Without(this->Mesh.CornersOf(tetrahedron), vertex);
    for (int i = 0; i < 3; ++i)
    {
      const std::uint32_t a = others[i];
      const std::uint32_t b = others[(i + 1) % 3];
      if (this->Vertices.StateOf(a) == StateOn(surface) &&
        this->Vertices.StateOf(b) == StateOn(surface) && !this->HasOneRun(a, b, surface))
      {
        return false;
      }
    }
  }
  return true;
}

bool SurfaceLinks::CanBeOn(std::uint32_t vertex, int surface, bool wasInside) const
{
  if (!this->HasOneCycle(vertex, surface))
  {
    return false;
  }
  std::vector<std::uint32_t> others; // on the surface
  for (const std::uint32_t tetrahedron : this->Mesh.StarOf(vertex))
  {
    for (const std::uint32_t corner : this->Mesh.CornersOf(tetrahedron))
    {
      if (corner != vertex && this->Vertices.StateOf(corner) == StateOn(surface) &&
        std::find(others.begin(), others.end(), corner) == others.end())
      {
        others.push_back(corner);
      }
    }
  }
  return std::all_of(others.begin(), others.end(),
           [&](std::uint32_t other)
           {
             return this->HasOneRun(vertex, other, surface) &&
               (!wasInside || this->HasOneCycle(other, surface));
           }) &&
    (!wasInside || this->HaveOneRunEach(vertex, surface));
}

}
