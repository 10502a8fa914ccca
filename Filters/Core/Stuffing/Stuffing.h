// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Stuffing_h
#define isodiamond_Stuffing_h

#include "Field/GridGeometry.h"
#include "Field/Parallel.h"
#include "Lattice/Lattice.h"
#include "Mesh/CutMesh.h"
#include "Stuffing/KnownChanges.h"
#include "Stuffing/TetrahedronMesh.h"

#include <cmath>
#include <optional>

namespace isodiamond
{

/** What tetrahedra for simulations are made from. */
struct StuffingInput
{
  const CutMesh& Leaves;
  const std::vector<Vector>& Vertices; ///< positions of the leaves' vertices in the world
  const std::vector<Vector>& Points;   ///< of the interval volume's mesh, in the world
  const GridGeometry& World;
  const Grid& SampleGrid;
  ///@{
  /** How far a surface may get from where it was, in one change: see ImprovementOptions; and as a
   *  part of the edge that it cuts, for grids that have no smallest step. */
  double SurfaceMove = 0.0;
  double SurfaceMoveOfEdge = HUGE_VAL;
  ///@}
  ///@{
  /** See CoarseningInput; without allowances nothing is measured or made coarser. */
  std::vector<double> Allowances = {};
  std::vector<bool> CanBeFiner = {}; ///< by leaf
  /** By leaf, or empty: whether nothing is tolerated there. Then no finer or pinned leaf would be
   *  near enough, and vertices there move as everywhere at tolerance 0. */
  std::vector<bool> ToleratesNothing = {};
  bool MayPin = true;      ///< whether leaves that cannot be finer may be pinned
  bool GetsCoarser = true; ///< or is only measured
  bool KeepsInside = false;
  std::optional<double> VolumeAtTolerance = {};
  ///@}
};

/**
 * An interval volume, as tetrahedra without very small or large dihedral angles.
 *
 * Vertices that are near to a surface move onto it before the leaves are cut, or it is pushed away
 * from those that must stay (MovedVertices.h, ReturnedPoints.h); then the few tetrahedra that are
 * still bad are improved one by one (Improvement.h). Points are some of those that the volume's
 * mesh would otherwise have; a few inside are moved or added, and fewer still move off their
 * surface, by a quarter of their edge at most. Tetrahedra are positive and conforming; surfaces
 * keep their topology, and do not intersect unless there is no room for the wanted angles otherwise
 * (BestAttempt.h). The wanted angles, 15 to 165 degrees, are no promise: where so much is bad that
 * the search gives up, some that are worse are left.
 *
 * If there are allowances, the surfaces are measured; where they are too far away, the caller has
 * to refine, or, where leaves cannot be finer, to pin their vertices: then surfaces move less
 * there. If they nowhere are, the mesh is made coarser, as far as allowed (Coarsening.h). Where
 * leaves have been pinned several times and still are too far away, they are left so: angles there
 * would be bad.
 *
 * Angles are those in the world: if steps on the axes differ in length, there is more to improve.
 */
struct StuffedMesh
{
  TetrahedronMesh Mesh;
  ///@{
  /** Those that have to be finer, or pinned. If there are any, the mesh is not finished. */
  std::vector<std::uint32_t> FarLeaves;
  std::vector<std::uint32_t> TightLeaves;
  ///@}
  /** Whether so much is bad that nothing that takes long has been tried (BestAttempt.h). */
  bool IsHopeless = false;
  std::optional<double> ToleranceExcess; ///< of a finished mesh, if there are allowances
};
/** @param parallelFor is given the work in successive steps: it can report progress, and abort
 *  @param known see Improve()
 *  @throws std::invalid_argument if a leaf has a point twice, as in a damaged hierarchy */
StuffedMesh Stuff(
  const StuffingInput& input, const ParallelFor& parallelFor, KnownChanges* known = nullptr);

/** The leaves that tetrahedra with dihedral angles below 15 or above 165 degrees come from, and
 * those that have a vertex in common with them. */
std::vector<std::uint32_t> LeavesOfBad(const CutMesh& leaves, const TetrahedronMesh& mesh);

/**
 * The leaves whose surfaces are too far away once vertices have moved, before tetrahedra are
 * improved: most of those that Stuff() would find, and much faster. Leaves with a fixed vertex are
 * left to Stuff().
 *
 * @param input whose leaves may be some of a mesh's, see NewLeaves.h
 * @throws std::invalid_argument as Stuff()
 */
std::vector<std::uint32_t> FarLeaves(const StuffingInput& input, const ParallelFor& parallelFor);

}

#endif
