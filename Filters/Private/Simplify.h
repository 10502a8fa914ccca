// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Simplify_h
#define vtkIsodiamond_Simplify_h

#include "Private/Mesh.h"
#include "Private/WorldQuery.h"

/**
 * @file Simplify.h
 * Meshes of a tolerance, part of which the hierarchy keeps and the rest a simplification.
 */
namespace vtkIsodiamond
{

/** Makes sure that a query can be simplified. @throws std::invalid_argument saying why not */
void CheckSimplify(isodiamond::ErrorMetric metric, bool isVolume);

/** The query whose mesh is to be simplified: its tolerances are parts of those that are asked for.
 */
WorldQuery BeforeSimplifying(
  const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world);

/**
 * Simplifies the mesh of such a query within what is left of the tolerances. Points stay what they
 * are, with their data; cell data have no meaning any more and go.
 *
 * @param query the one that was asked for
 */
void SimplifyMesh(const WorldQuery& query, const Measure& measure,
  const isodiamond::GridGeometry& world, const isodiamond::ParallelFor& parallelFor, Mesh& mesh);

/** The mesh of a hierarchy that a query asks for, simplified if it is to be. */
Mesh ExtractAsAsked(const isodiamond::IsodiamondHierarchy& hierarchy, const WorldQuery& query,
  const MeshOptions& options, Task& task);

}

#endif
