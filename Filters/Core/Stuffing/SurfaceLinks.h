// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceLinks_h
#define isodiamond_SurfaceLinks_h

#include "Stuffing/VertexPlaces.h"

namespace isodiamond
{

/**
 * Tells whether a vertex can lie on a surface without a change of topology.
 *
 * Count a vertex on a surface as outside it, like those that are: then the surface crosses the
 * edges from the vertex to vertices inside, near the vertex, and pulling these crossings into the
 * vertex gives the mesh. That keeps the topology if what is pulled together is a disc, and what
 * remains is a surface:
 *
 * - in the link of the vertex, the sides change along exactly one cycle (on a wall, one path);
 * this is also when a vertex inside may change sides at all, the rule of CriticalDiamonds.h;
 * - around an edge with both ends on the surface, vertices inside form at most one run, and never
 *   the whole cycle (on a wall, one end of the path is among them, but not both);
 * - a triangle on the surface has vertices inside on one side only.
 *
 * Vertices outside may lack some of their tetrahedra, those that lie outside as a whole: they do
 * not change sides.
 */
class SurfaceLinks
{
public:
  /** @param background must outlive it, like the places that vertices are seen at */
  SurfaceLinks(const Background& background, const PlacesView& vertices)
    : Mesh(background)
    , Vertices(vertices)
  {
  }

  /** Whether a vertex that is seen on a surface can be there.
   *  @param wasInside whether it was inside before */
  bool CanBeOn(std::uint32_t vertex, int surface, bool wasInside) const;

private:
  bool IsInside(std::uint32_t vertex, int surface) const;
  bool HasOneCycle(std::uint32_t vertex, int surface) const;
  bool HasOneRun(std::uint32_t vertex, std::uint32_t other, int surface) const;
  bool HaveOneRunEach(std::uint32_t vertex, int surface) const;

  const Background& Mesh;
  PlacesView Vertices;
};

}

#endif
