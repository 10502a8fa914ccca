// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceError_h
#define isodiamond_DistanceError_h

#include "DistanceError/MapBounds.h"
#include "Field/GridGeometry.h"
#include "Field/HiddenCells.h"
#include "Field/PeerPortion.h"
#include "Field/Samples.h"
#include "Hierarchy/IsodiamondHierarchy.h"

#include <vector>

/**
 * @file DistanceError.h
 * The distance metric: how far the surface of full resolution lies from a diamond's patches, and
 * these from it, in world units. The error of a diamond is the greater of the two ways.
 *
 * The way forth of a diamond is the largest distance from a full-resolution isovertex in its closed
 * domain to the nearest patch of the diamond, as extraction would make it, that is sure to be in a
 * mesh together with the tetrahedron that holds the isovertex. So if every leaf of a mesh lies in a
 * diamond with an error of at most t, no full-resolution isovertex is farther than t from the mesh:
 * the tolerance is a promise. An isovertex on a border counts for every tetrahedron that has it;
 * for an interval volume both surfaces count, each against its own patches.
 *
 * Sure to be there are the tetrahedron itself and its *mate*, made by the same parent. In place of
 * one made by another parent there can be coarser tetrahedra around the spine, those that it comes
 * from, as long as that parent is not subdivided: of all that can be in one place, the farthest
 * patch counts. A place that may have no patch does not count. If no place is left, the diamond is
 * always subdivided: features never vanish.
 *
 * Also always subdivided are diamonds that stick out of the grid, have a vertex that is not finite,
 * or hold an isovertex on an edge with such an end.
 */
namespace isodiamond
{

/** The scale of distance error codes: the diagonal of the grid in the world.
 *  @throws std::invalid_argument if there are no distances in the world: FaultOfLengths() */
double DistanceErrorScale(const Grid& grid, const GridGeometry& world);

/**
 * The distance errors of all diamonds.
 *
 * @param relevant an RI of the surface, whatever its error codes
 * @param isFinite tells which of the samples that the RI was built from are finite
 * @param world maps index space to the world, where lengths are measured
 * @param preserveFeatures if false, isovertices without a patch to be measured against count with
 *        the diameter of the diamond, so that features thinner than the tolerance may vanish
 * @param codes by rank, below which no error is to be: what is always subdivided need not be
 *        measured; empty for none
 * @param bounds of the way back, to be filled if they are wanted; null for none
 * @param loops each of several peers finds a part of the errors and bounds: these are to be put
 *        together, the greatest of each
 * @param portion only its own isovertices count, for all diamonds that it has; null if all are here
 * @return codes by rank, scaled by DistanceErrorScale(); 0 without an isovertex in the domain
 */
std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const Finiteness& isFinite, const GridGeometry& world, bool preserveFeatures, const Loops& loops,
  std::vector<ErrorCode::Type> codes = {}, MapBounds* bounds = nullptr,
  const DiamondPortion* portion = nullptr);

/** What is known before the way back is measured: the more it is, the less work is left. */
struct BeforeWayBack
{
  const HiddenCells* Hidden = nullptr; ///< cells without any surface; null for none
  const MapBounds* Bounds = nullptr;   ///< of DistanceErrors(); null for none
  /** The portion that the diamonds are of: its own are measured, by all peers together, in steps of
   * its own. Null if all are here. */
  const PeerPortion* Portion = nullptr;
  /** How many of the diamonds that need triangles from farther away are measured at once: the more,
   *  the more of these triangles are kept; the fewer, the more often some are brought, for portions
   *  by all peers together. */
  int MostAtOnce = 64;
};

/**
 * Raises distance errors to the way back: how far a point of a diamond's patches can be from the
 * surface of full resolution, for an interval volume from the one that the patches belong to. So if
 * every leaf of a mesh lies in a diamond with an error of at most t, no point of the mesh is
 * farther than t from full resolution. Rounded up by 1/4 at most; and what is above zero is never
 * less than 1/64 of a lattice step. See WayBack.h.
 *
 * @param relevant, world as above
 * @param codes of DistanceErrors(). What is below an activation threshold of these changes none:
 * the work for it can be spared by RaiseToThresholds()
 */
void RaiseByWayBack(const IsodiamondHierarchy& relevant, const GridGeometry& world,
  const BeforeWayBack& known, std::vector<ErrorCode::Type>& codes, const Loops& loops);

}

#endif
