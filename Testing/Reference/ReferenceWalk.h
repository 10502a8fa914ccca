// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceWalk_h
#define ReferenceWalk_h

#include "ReferenceField.h"

#include <functional>
#include <set>
#include <vector>

namespace reference
{

/** A set of diamonds: for every diamond's index, whether it is in the set. */
using DiamondSet = std::vector<bool>;

std::set<Point> CentersOf(const Hierarchy& hierarchy, const DiamondSet& diamonds);
DiamondSet DiamondsAt(const Hierarchy& hierarchy, const std::set<Point>& centers);

/** Whether the diamond of this index is worth subdividing for its own sake. */
using Criterion = std::function<bool(int)>;

/**
 * The uniform criterion: the error exceeds the tolerance and the isosurface passes through the
 * domain.
 * @param errors the error of every diamond, for instance OwnFieldErrors()
 * @param crossed CrossedDomains(). Both lists must outlive the criterion.
 */
Criterion UniformCriterion(
  const std::vector<double>& errors, const std::vector<bool>& crossed, double tolerance);

/** The outcome of selective refinement. */
struct Refinement
{
  /** Always closed: with a diamond it contains all its parents. */
  DiamondSet Subdivided;
  /** The active front: diamonds that are not subdivided but have a subdivided parent, or the root
   *  alone. */
  DiamondSet Front;
};

/**
 * Selective refinement from the top, the paper's walk. The front, at first the root alone, is
 * searched for diamonds that meet the criterion; such a diamond is subdivided, after those of its
 * parents that are not subdivided yet, and its children join the front.
 */
Refinement Refine(const Hierarchy& hierarchy, const Criterion& criterion);

/**
 * What Refine() must have subdivided, from its definition: the smallest set that
 *  - contains the root if the root meets the criterion,
 *  - contains every diamond that meets the criterion and has a parent in the set,
 *  - contains all parents of its diamonds.
 * The rules are applied to all diamonds in turn until nothing changes.
 */
DiamondSet SmallestClosedSet(const Hierarchy& hierarchy, const Criterion& criterion);

/** The diamonds that are not subdivided but have a subdivided parent, or the root alone. */
DiamondSet FrontOf(const Hierarchy& hierarchy, const DiamondSet& subdivided);

/** Whether all parents of all diamonds in the set are in the set. */
bool IsClosed(const Hierarchy& hierarchy, const DiamondSet& diamonds);

/**
 * The activation threshold of every diamond: the supremum of the tolerances at which the walk with
 * the uniform criterion subdivides it. So the walk at tolerance t subdivides exactly the diamonds
 * with a threshold above t. -Infinity for the diamonds that no tolerance, however negative,
 * subdivides. Found by repeating the walk for every distinct error.
 */
std::vector<double> Thresholds(
  const Hierarchy& hierarchy, const std::vector<double>& errors, const std::vector<bool>& crossed);

}

#endif
