// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Extraction_h
#define vtkIsodiamond_Extraction_h

#include "Private/Extraction/Mesh.h"
#include "Private/Query/WorldQuery.h"

#include <cstdint>

/**
 * @file Extraction.h
 * Meshes within a tolerance, of which the hierarchy uses a part, and simplification the rest.
 */
namespace vtkIsodiamond
{

/** Makes sure that a query can be simplified. @throws std::invalid_argument saying why not */
void CheckSimplify(const WorldQuery& query, isodiamond::ErrorMetric metric, bool isVolume);

/**
 * The mesh that a query asks for, or the share of it that the options want: for simulations,
 * simplified, or as it is.
 *
 * @param refined set of HierarchyQuery()
 */
Mesh ExtractAsAsked(const isodiamond::RefinedSet& refined, const WorldQuery& query,
  const MeshOptions& options, Task& task);

///@{
/** The same for a hierarchy; and how many cells the mesh has. */
Mesh ExtractAsAsked(const isodiamond::IsodiamondHierarchy& hierarchy, const WorldQuery& query,
  const MeshOptions& options, Task& task);
std::int64_t CountAsAsked(const isodiamond::IsodiamondHierarchy& hierarchy, const WorldQuery& query,
  const MeshOptions& options, Task& task);
///@}

}

#endif
