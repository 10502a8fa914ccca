// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_HierarchyQuery_h
#define vtkIsodiamond_HierarchyQuery_h

#include "Private/Query/WorldQuery.h"

/**
 * @file HierarchyQuery.h
 * What a hierarchy is asked for if its mesh is made coarser afterwards: it gets a part of each
 * tolerance, and the rest is left for the coarsening.
 */
namespace vtkIsodiamond
{

/** Whether a query's mesh is made coarser after extraction: by simplification, or for
 *  simulations. */
bool GetsCoarser(const WorldQuery& query, isodiamond::ErrorMetric metric);

/** Whether only a trial tells how many cells a mesh has: it is made coarser, or consists of
 *  tetrahedra for simulations. */
inline bool IsCountedByTrial(const WorldQuery& query)
{
  return query.Simplify || query.SimulationQuality;
}

/** The part of a tolerance that the hierarchy gets. The more is left, the fewer cells result, and
 *  the longer it takes. */
double PartForHierarchy(
  const WorldQuery& query, double tolerance, const isodiamond::GridGeometry& world);

/** A tolerance that leaves the hierarchy one at which its mesh is the coarsest.
 *  @param scale of the hierarchy's errors */
double CoarsestTolerance(const WorldQuery& query, isodiamond::ErrorMetric metric, double scale,
  const isodiamond::GridGeometry& world);

/** The query whose mesh is then made coarser; the given one if its mesh is not. */
WorldQuery HierarchyQuery(
  const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world);

}

#endif
