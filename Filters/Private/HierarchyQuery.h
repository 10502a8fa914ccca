// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_HierarchyQuery_h
#define vtkIsodiamond_HierarchyQuery_h

#include "Private/WorldQuery.h"

/**
 * @file HierarchyQuery.h
 * What a hierarchy is asked for, of meshes that are made coarser afterwards: it gets a part of each
 * tolerance, and the rest is left for that.
 */
namespace vtkIsodiamond
{

/** Whether a query's mesh is made coarser after it was extracted: simplified, or for simulations.
 */
bool GetsCoarser(const WorldQuery& query, isodiamond::ErrorMetric metric);

/** The part of a tolerance for the hierarchy. The more is left, the fewer cells come out, and the
 *  longer it takes. */
double PartForHierarchy(
  const WorldQuery& query, double tolerance, const isodiamond::GridGeometry& world);

/** The query whose mesh is made coarser; the same where it is not. */
WorldQuery HierarchyQuery(
  const WorldQuery& query, const Measure& measure, const isodiamond::GridGeometry& world);

}

#endif
