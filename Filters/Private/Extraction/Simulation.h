// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Simulation_h
#define vtkIsodiamond_Simulation_h

#include "Private/Extraction/Mesh.h"
#include "Private/Query/WorldQuery.h"

/**
 * @file Simulation.h
 * Tetrahedra for simulations, as a query asks for them.
 */
namespace vtkIsodiamond
{

/**
 * Extracts a refined set's interval volume, stuffed. Where its surfaces are farther from those of
 * the volume's mesh than the diamonds' errors leave of the tolerance, it refines and begins again;
 * or, where cells are at full resolution, it pins their vertices.
 *
 * @param query whose refined set it is
 */
Mesh ExtractForSimulation(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task);

}

#endif
