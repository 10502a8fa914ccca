// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Stuff_h
#define vtkIsodiamond_Stuff_h

#include "Mesh/IntervalExtraction.h"
#include "Private/Mesh.h"

/**
 * @file Stuff.h
 * Tetrahedra of good shape instead of those of an interval volume's mesh.
 */
namespace vtkIsodiamond
{

/**
 * Stuffs the volume that an extraction's mesh represents (see Stuffing/Stuffing.h), and hands over
 * points and cells, with their data: those of moved and added points are interpolated linearly in
 * the mesh.
 *
 * @param mesh with all data, nothing left out; afterwards without what is hidden
 */
void StuffMesh(const isodiamond::IntervalExtraction& extraction,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options,
  const isodiamond::ParallelFor& parallelFor, Mesh& mesh);

}

#endif
