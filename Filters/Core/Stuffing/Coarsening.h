// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Coarsening_h
#define isodiamond_Coarsening_h

#include "Field/Parallel.h"
#include "Stuffing/TetrahedronMesh.h"

#include <optional>

namespace isodiamond
{

/** What determines how coarse a mesh may get. */
struct CoarseningInput
{
  const TetrahedronMesh& Plain; ///< the volume's mesh, with its leaves as origins
  /** By leaf: how far from its part of the surfaces the result's surfaces may be. */
  const std::vector<double>& Allowances;
  /** By leaf: whether its surfaces could be nearer, if it were finer, or pinned. */
  const std::vector<bool>& CanBeNearer;
  bool KeepsInside = false; ///< whether points inside stay
  /** What part of allowances samples may use; what turns out to be too much is undone. */
  double UsedPart = 0.75;
  /** The directions in which points on the grid's boundary can move, by axis; 0 for not at all. */
  std::array<Vector, 3> Axes{};
  /** The volume of a mesh that uses the whole tolerance already: the result's may lie anywhere
   *  between this and that of Plain. None if it has to be near the latter. */
  std::optional<double> VolumeAtTolerance = {};
};

/** The leaves that could be nearer and where a surface of a stuffed mesh is too far away, sorted.
 */
std::vector<std::uint32_t> FarLeaves(
  const TetrahedronMesh& mesh, const CoarseningInput& input, const ParallelFor& parallelFor);

/**
 * Makes a stuffed mesh coarser, within what is allowed: edges collapse, on surfaces as Simplify
 * collapses them (EdgeCollapses.h), and inside where the resulting tetrahedra have a good shape
 * (TetrahedronCollapses.h). All of both surfaces is measured against those of the volume's mesh,
 * both ways (PartDistance.h), and what is too far away is undone. Then points inside move to better
 * places (Relaxation.h), and more edges inside collapse.
 *
 * @return the FarLeaves() before any change. If there are any, the mesh stays as it is: the caller
 *         has to refine, or pin, and begin again. What is too far away but cannot be nearer is left
 *         as it is.
 */
std::vector<std::uint32_t> Coarsen(
  TetrahedronMesh& mesh, const CoarseningInput& input, const ParallelFor& parallelFor);

}

#endif
