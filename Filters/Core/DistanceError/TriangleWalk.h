// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_TriangleWalk_h
#define isodiamond_TriangleWalk_h

#include "Lattice/DiamondSet.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** The patches around a spine have no more triangles than this. */
inline constexpr int MostPatchTriangles = 16;

/** Triangles, each a neighbour of the one before. */
struct TriangleWalk
{
  int Count = 0;
  std::array<std::uint8_t, MostPatchTriangles> Triangles;
};

/** Which triangles share a side. Triangles are named by numbers, sets of them are masks. */
class TriangleNeighbours
{
public:
  void Set(int triangle, std::uint32_t neighbours) { this->Of[triangle] = neighbours; }

  /** The shortest walk from one of some triangles to one of others, both included; of a single
   *  triangle if one is in both sets. Depends on the sets alone.
   *  @param within the set of triangles that may be passed
   *  @return whether there is one */
  bool FindWalk(
    std::uint32_t some, std::uint32_t others, TriangleWalk& walk, std::uint32_t within = ~0U) const
  {
    std::array<std::uint32_t, MostPatchTriangles> reached; // by number of steps
    reached[0] = some;
    std::uint32_t seen = some;
    int last = 0;
    while ((reached[last] & others) == 0)
    {
      const std::uint32_t next = this->OfAny(reached[last]) & within & ~seen;
      if (next == 0)
      {
        return false;
      }
      reached[++last] = next;
      seen |= next;
    }
    walk.Count = last + 1;
    std::uint32_t here = reached[last] & others;
    for (int i = last; i >= 0; --i)
    {
      walk.Triangles[i] = static_cast<std::uint8_t>(LowestBit(here));
      here = i == 0 ? 0 : this->Of[walk.Triangles[i]] & reached[i - 1];
    }
    return true;
  }

private:
  std::uint32_t OfAny(std::uint32_t triangles) const
  {
    std::uint32_t neighbours = 0;
    ForEachBit(triangles, [&](int i) { neighbours |= this->Of[i]; });
    return neighbours;
  }

  std::array<std::uint32_t, MostPatchTriangles> Of{};
};

/**
 * A walk that undoes steps: a step back to where it came from cancels the one before.
 *
 * If the border of something walks over triangles and nothing is left of that walk but its start,
 * the border crosses each side as often in one direction as in the other. So what it encloses can
 * be cut from crossing to crossing, into pieces that each lie over one triangle.
 */
class ReducedWalk
{
public:
  /** Begins, or takes a step to a neighbour or nowhere. */
  void Add(std::uint8_t triangle)
  {
    if (this->Count >= 2 && this->Triangles[this->Count - 2] == triangle)
    {
      --this->Count;
    }
    else if (this->Count == 0 || this->Last() != triangle)
    {
      this->Triangles[this->Count++] = triangle;
    }
  }

  bool HasBegun() const { return this->Count > 0; }
  std::uint8_t First() const { return this->Triangles[0]; }
  std::uint8_t Last() const { return this->Triangles[this->Count - 1]; }

  /** Whether it is where it began, and nothing of it is left. */
  bool IsNothing() const { return this->Count == 1; }

private:
  int Count = 0;
  /** For the border of a triangle: three edges and, between them, three corners. */
  std::array<std::uint8_t, 6 * MostPatchTriangles> Triangles;
};

}

#endif
