// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Relaxation_h
#define isodiamond_Relaxation_h

#include "Field/Parallel.h"
#include "Stuffing/LocalMesh.h"

#include <functional>
#include <vector>

namespace isodiamond
{

/** How points are moved. */
struct RelaxationOptions
{
  double Wanted = 0.0; ///< a point whose worst sine is at least this stays where it is
  /** The directions in which points on the grid's boundary can move, by axis; 0 for not at all. */
  std::array<Vector, 3> Axes{};
  /** Whether a point may move to a place. */
  std::function<bool(std::uint32_t point, const Vector& place)> Allows;
};

/**
 * Moves the points that are on no surface, one after another, each to where the worst angle around
 * it is best, until that angle is as wanted. The result does not depend on threads.
 *
 * @return the points that have moved
 */
std::vector<std::uint32_t> RelaxInside(
  LocalMesh& mesh, const RelaxationOptions& options, const ParallelFor& parallelFor);

}

#endif
