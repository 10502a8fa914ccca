// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Target_h
#define vtkIsodiamond_Target_h

#include "Mesh/CellCounts.h"

#include <cstdint>
#include <functional>
#include <vector>

class vtkAlgorithm;
class vtkFieldData;

/**
 * @file Target.h
 * Tolerances by the number of cells that their meshes have.
 */
namespace vtkIsodiamond
{

/** A tolerance, and the number of cells of its mesh. */
struct CountedTolerance
{
  double Tolerance = 0.0;
  std::int64_t Cells = 0;
};

/** The least tolerance with no more cells than a target, summed over hierarchies with errors of one
 *  scale; if there is none, the least one with as many as the coarsest mesh. */
CountedTolerance LeastTolerance(
  const std::vector<const isodiamond::CellCounts*>& counts, std::int64_t target);

/**
 * The same by bisection, for queries with a region of interest or a viewpoint, where cells are
 * hidden and for an HD: every count takes a query. A coarser mesh can have a few more cells; then
 * the result may not be the least.
 */
CountedTolerance LeastTolerance(const isodiamond::ErrorCode& codes, std::int64_t target,
  const std::function<std::int64_t(double tolerance)>& cellsAt);

/**
 * The same for meshes that are simplified, or made for simulations, whose number of cells only
 * trials reveal: to about 2 % of the tolerance. A coarser mesh can have more cells: a tolerance
 * with few enough, between those that are tried, may be missed.
 *
 * @param guess the tolerance that would be found without simplification; most likely more than the
 *        result
 * @param largest tolerance that makes a difference: the result if no tolerance has few enough
 */
CountedTolerance LeastToleranceBelow(double guess, double largest, std::int64_t target,
  const std::function<std::int64_t(double tolerance)>& cellsAt);

/** Of progress: one trial, of what is left. */
constexpr double PartOfTrial = 0.15;

/** Warns if the mesh has more cells than the target. */
void WarnIfAbove(vtkAlgorithm* filter, const CountedTolerance& found, std::int64_t target);

/**
 * Writes how many cells there would be, for users who look at the field data: an array with one
 * value for each of some tolerances that a person would type, and for full resolution.
 *
 * @param cells their name, in capitals
 * @param largest tolerance that is worth trying
 * @param unit what 1 is for the user, in the units of the counts
 */
void WriteCounts(const std::vector<const isodiamond::CellCounts*>& counts, const char* cells,
  double largest, double unit, vtkFieldData* output);

}

#endif
