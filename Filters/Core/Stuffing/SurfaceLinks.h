// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceLinks_h
#define isodiamond_SurfaceLinks_h

#include "Stuffing/Background.h"

namespace isodiamond
{

/**
 * Tells whether a vertex can lie on a surface without a change of topology.
 *
 * Count a vertex on a surface as outside of it, together with those that are: then the surface
 * crosses the edges from there to vertices inside, near the vertex, and pulling these crossings
 * into the vertex makes the mesh. That keeps the topology if what is pulled together is a disc, and
 * what remains a surface:
 *
 * - in the link of the vertex, the sides change along exactly one cycle (on a wall, one path);
 * which is also when a vertex inside may change sides at all, the rule of CriticalDiamonds.h;
 * - around an edge with both ends on the surface, vertices inside make one run at most, and never
 *   the whole cycle (on a wall, the path's end is among them, but not both ends);
 * - a triangle on the surface has vertices inside on one side only.
 *
 * Of vertices outside some tetrahedra may be missing, those that lie outside as a whole: they do
 * not change sides.
 */
class SurfaceLinks
{
public:
  /** @param background,states must outlive it; states may change */
  SurfaceLinks(const Background& background, const std::vector<std::uint8_t>& states)
    : Mesh(background)
    , States(states)
  {
  }

  /** Whether a vertex, which is on a surface now, can be there.
   *  @param wasInside whether it was inside before */
  bool CanBeOn(std::uint32_t vertex, int surface, bool wasInside) const;

private:
  bool IsInside(std::uint32_t vertex, int surface) const;
  bool HasOneCycle(std::uint32_t vertex, int surface) const;
  bool HasOneRun(std::uint32_t vertex, std::uint32_t other, int surface) const;
  bool HaveOneRunEach(std::uint32_t vertex, int surface) const;

  const Background& Mesh;
  const std::vector<std::uint8_t>& States;
};

}

#endif
