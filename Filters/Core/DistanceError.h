// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DistanceError_h
#define isodiamond_DistanceError_h

#include "AffineMap.h"
#include "IsodiamondHierarchy.h"
#include "Samples.h"

#include <vector>

/**
 * @file DistanceError.h
 * The distance metric: how far the surface of full resolution lies from a diamond's patches, in
 * world units.
 *
 * The error of a diamond is the largest distance from a full-resolution isovertex in its closed
 * domain to the patch of the tetrahedron that holds the isovertex, as extraction would make it. An
 * isovertex on a border counts for every tetrahedron that has it. So if every leaf of a mesh lies
 * in a diamond with an error of at most t, no full-resolution isovertex is farther than t from the
 * mesh: the tolerance is a promise. Of an interval volume both surfaces count, each against its
 * own patches.
 *
 * A tetrahedron without a patch can hold isovertices too, where the surface bulges into it. These
 * count with the distance to another tetrahedron of the same diamond, one that is in every mesh
 * that the first is in: its *mate*, which the same parent made. The others, which other parents
 * made, may be replaced by the coarser tetrahedra around the spine that they come from, as long as
 * that parent is not subdivided: there the largest of the distances to what can be in that place
 * counts, and of all places the nearest. If there is none, the diamond is always subdivided:
 * features never vanish.
 */
namespace isodiamond
{

/** The scale of distance error codes: the diagonal of the grid in the world.
 *  @throws std::invalid_argument if the world has no volume */
double DistanceErrorScale(const Grid& grid, const AffineMap& world);

/**
 * The distance errors of all diamonds.
 *
 * @param relevant an RI of the surface, whatever its error codes
 * @param samples that it was built from: a diamond that holds an isovertex on an edge with an end
 *        that is not finite is always subdivided
 * @param world from index space to the world; lengths count there
 * @param preserveFeatures otherwise isovertices without a patch to count with count with the
 *        diameter of the diamond, so that features that are thinner than the tolerance may vanish
 * @return codes by rank, scaled by DistanceErrorScale(); 0 without an isovertex in the domain
 */
std::vector<ErrorCode::Type> DistanceErrors(const IsodiamondHierarchy& relevant,
  const AnySamples& samples, const AffineMap& world, bool preserveFeatures,
  const ParallelFor& parallelFor);

}

#endif
