// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceInterval_h
#define ReferenceInterval_h

#include "ReferenceWalk.h"

#include <vector>

namespace reference
{

/** The values from Lower to Upper, both included; Lower < Upper, and either may be infinite. */
struct Isorange
{
  double Lower;
  double Upper;
};

/** Where a value lies: -1 below the range, also for NaN, 0 inside, 1 above. */
int SignOf(double value, const Isorange& range);

/**
 * Whether a diamond has sampled vertices and they are all inside the range. It is then full of the
 * interval volume, unless a descendant says otherwise.
 */
bool HasVerticesInside(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range, int diamond);
DiamondSet DiamondsInside(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range);

/**
 * The kind of every diamond for an interval volume. Vertices without a sample are ignored.
 *
 * A diamond is one of the seeds if
 *  - its vertices are not all of one sign: it is active;
 *  - they are all outside on one side, and the central vertex has another sign: it is a creation
 *    diamond;
 *  - they are all inside, and the central vertex is outside: it is active;
 *  - they are all inside, and the diamond sticks out of the grid: it is active, because it holds
 *    some of the volume and has tetrahedra that cannot be drawn.
 *
 * The seeds and all their ancestors make up the hierarchy. An ancestor that is no seed is active if
 * its vertices are all inside, else it is relevant. All other diamonds are inactive.
 *
 * @param refineInterior whether all diamonds with all vertices inside are seeds, and active
 */
std::vector<Kind> Classify(const Hierarchy& hierarchy, const ScalarField& field,
  const Isorange& range, bool refineInterior = false);

/**
 * The numbers that the paper's Table 2 lists. An edge has as many isovertices as the signs of its
 * ends differ by: two if it leads from below the range to above.
 */
Counts Count(const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range,
  const std::vector<Kind>& kinds);

/**
 * Whether a domain carries a piece of a surface, or of the volume where it cannot be drawn: its
 * sampled lattice points are not all of one sign, or they are all inside and the diamond sticks out
 * of the grid.
 */
bool IsCarrying(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range, int diamond);
DiamondSet CarryingDomains(
  const Hierarchy& hierarchy, const ScalarField& field, const Isorange& range);

/**
 * What makes a diamond worth subdividing: its domain carries something and its error exceeds the
 * tolerance. An infinite error exceeds every tolerance, even an infinite one.
 * @param errors the error of every diamond, for instance OwnFieldErrors()
 * @param carrying CarryingDomains(). Both lists must outlive the criterion.
 */
Criterion IntervalCriterion(
  const std::vector<double>& errors, const DiamondSet& carrying, double tolerance);

/**
 * The smallest superset of a closed set that is closed and contains all diamonds with all vertices
 * inside and an error above the tolerance. Nothing is above the infinite tolerance.
 * @param inside DiamondsInside()
 */
DiamondSet RefineInterior(const Hierarchy& hierarchy, const DiamondSet& subdivided,
  const std::vector<double>& errors, const DiamondSet& inside, double interiorTolerance);

}

#endif
