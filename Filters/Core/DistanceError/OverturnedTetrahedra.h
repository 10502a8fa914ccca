// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_OverturnedTetrahedra_h
#define isodiamond_OverturnedTetrahedra_h

#include "DistanceError/SpineNeighbourhood.h"
#include "Field/GridGeometry.h"
#include "Field/Vector.h"
#include "Hierarchy/IsodiamondHierarchy.h"
#include "Patches/ExactPlane.h"
#include "Patches/IntervalPatches.h"

namespace isodiamond
{

/**
 * Tells which diamonds, if they were not subdivided, would give a mesh tetrahedra of an interval
 * volume that are turned over in the world.
 *
 * In index space all are positive, as isovertices lie on edges, and so in an affine world. Where
 * steps differ or the grid is bent, a long edge is not straight in the world, and an isovertex on
 * it may be so far to its side that a tetrahedron turns over. At full resolution, in a single cell,
 * that does not happen along axes; in cells that are bent it may.
 */
class OverturnedTetrahedra
{
public:
  /** Both must outlive it. @param relevant an RI of an interval volume */
  OverturnedTetrahedra(const IsodiamondHierarchy& relevant, const GridGeometry& world);

  /** Whether there are any around a diamond's spine. */
  bool AreAround(const Place& diamond) const;

private:
  bool AreIn(const HalfPlace& tetrahedron) const;
  Vector VertexOf(const HalfPlace& tetrahedron, int age) const;
  Vector IsovertexOf(const HalfPlace& tetrahedron, const PatchPoint& point) const;
  Vector At(const FinePosition& p) const;

  const IsodiamondHierarchy& Hierarchy;
  const GridGeometry& World;
  double Orientation; ///< of the world, 1 or -1
  SpineNeighbourhood Neighbourhood;
};

}

#endif
