// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Stuff_h
#define vtkIsodiamond_Stuff_h

#include "Mesh/IntervalExtraction.h"
#include "Private/Extraction/Mesh.h"
#include "Stuffing/NewLeaves.h"

/**
 * @file Stuff.h
 * Tetrahedra of good shape instead of those of an interval volume's mesh.
 */
namespace vtkIsodiamond
{

/**
 * Stuffs the volume that an extraction's mesh represents (see Stuffing/Stuffing.h), and hands over
 * points and cells, with their data: those of moved and added points are interpolated linearly in
 * the mesh. Known changes are those of this mesh before it was last refined; they are updated, and
 * may be null.
 *
 * @param mesh with all data, nothing left out; afterwards without what is hidden. If diamonds have
 *        to be refined, or vertices pinned, first, it stays as it is, and says which.
 */
void StuffMesh(const isodiamond::IntervalExtraction& extraction,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options,
  const isodiamond::ParallelFor& parallelFor, Mesh& mesh);

/**
 * Looks for the diamonds that have to be refined because stuffed leaves would be too far away, in
 * one refined set after the other; only where these differ. That takes much less time than
 * StuffMesh(), which then finds the few others.
 */
class FarDiamondSearch
{
public:
  std::vector<isodiamond::Place> Find(const isodiamond::RefinedSet& refined,
    const MeshOptions& options, const isodiamond::ParallelFor& parallelFor);

private:
  isodiamond::NewLeaves News;
};

}

#endif
