// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Stuffing_h
#define isodiamond_Stuffing_h

#include "Field/GridGeometry.h"
#include "Field/Parallel.h"
#include "Lattice/Lattice.h"
#include "Mesh/CutMesh.h"
#include "Stuffing/TetrahedronMesh.h"

namespace isodiamond
{

/** What tetrahedra for simulations are made of. */
struct StuffingInput
{
  const CutMesh& Leaves;
  const std::vector<Vector>& Vertices; ///< positions of the leaves' vertices in the world
  const std::vector<Vector>& Points;   ///< of the interval volume's mesh, in the world
  const GridGeometry& World;
  const Grid& SampleGrid;
  double SurfaceMove = 0.0; ///< see ImprovementOptions
  ///@{
  /** See CoarseningInput; none to neither measure nor coarsen. */
  std::vector<double> Allowances = {};
  std::vector<bool> CanBeFiner = {};
  bool KeepsInside = false;
  ///@}
};

/**
 * An interval volume, as tetrahedra without very small or large dihedral angles.
 *
 * Vertices that are near to a surface move onto it before the leaves are cut (MovedVertices.h);
 * then the few tetrahedra that are still bad are improved one by one (Improvement.h). Points are
 * some of those that the volume's mesh has otherwise; a few inside are moved or added, and fewer
 * still on surfaces move off these, by a quarter of their edge at most. Tetrahedra are positive and
 * conform; surfaces have the topology that they had. What is wanted of the angles, 15 to 165
 * degrees, is no promise: where so much is bad that the search gives up, some are left that are
 * worse.
 *
 * If there are allowances the surfaces are measured; it is for the caller to refine where they are
 * too far away. If they are not, the mesh is made coarser, as far as allowed (Coarsening.h).
 *
 * Angles are those of the world: if steps on the axes differ in length, there is more to improve.
 */
struct StuffedMesh
{
  TetrahedronMesh Mesh;
  /** That have to be finer, see Coarsening.h. If there are any the mesh is not done. */
  std::vector<std::uint32_t> FarLeaves;
};
/** @param parallelFor is given the work in steps, one after the other: it can tell, and abort */
StuffedMesh Stuff(const StuffingInput& input, const ParallelFor& parallelFor);

}

#endif
