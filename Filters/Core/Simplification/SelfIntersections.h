// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SelfIntersections_h
#define isodiamond_SelfIntersections_h

#include "Field/Parallel.h"
#include "Simplification/BoundsTree.h"
#include "Simplification/EdgeCollapses.h"
#include "Simplification/MeshPart.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace isodiamond
{

/** Numbers of two triangles that intersect (TriangleIntersection.h). */
using IntersectingPair = std::pair<std::uint32_t, std::uint32_t>;

/** All triangles of a mesh that intersect. */
std::vector<IntersectingPair> IntersectionsOf(const std::vector<Vector>& positions,
  const std::vector<Triangle>& triangles, const ParallelFor& parallelFor);

/**
 * Finds where a part of a simpler mesh cuts or touches itself, or what other parts have.
 *
 * Distances and topology do not tell: two sheets that are less than a tolerance apart may pass
 * through each other, and each is still near enough and in one piece. Triangles that are as they
 * were at the start are not compared with each other.
 */
class SelfIntersections
{
public:
  /** @param part must outlive it */
  explicit SelfIntersections(const MeshPart& part);

  /**
   * Compares what has changed with all that is there.
   *
   * @param simple the mesh to look at in place of the part's simpler one, with the same numbers
   * @param isTouched by number: whether a triangle has changed, or gone, since the last time
   * @return pairs of which at least one triangle is not what it was at the start; the second one is
   *         None if it is another part's
   */
  std::vector<IntersectingPair> Find(
    const LinkedTriangles& simple, const std::vector<bool>& isTouched) const;

  /** Undoes the last collapses and flips that led to intersections, until there are none.
   *  @param collapses of the part's simpler mesh
   *  @param isTouched see Find(); also receives what this changes */
  void Undo(EdgeCollapses& collapses, std::vector<bool>& isTouched) const;

private:
  const MeshPart& Part;
  BoundsTree Others; ///< around triangles of other parts
};

}

#endif
