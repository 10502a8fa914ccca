// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceRegion_h
#define ReferenceRegion_h

#include "ReferenceWalk.h"

#include <array>
#include <vector>

namespace reference
{

/** A closed box in index space. Empty if a minimum is above its maximum. */
struct Box
{
  std::array<double, 3> Minimum;
  std::array<double, 3> Maximum;
};

/**
 * Whether the domain of a diamond, the closed union of its tetrahedra, has at least one point in
 * common with a box. The domain may extend beyond the sampled box, and the common point may lie
 * there. Nothing is rounded if the corners of the box are multiples of 1/8.
 */
bool Touches(const Hierarchy& hierarchy, int diamond, const Box& box);

/** The smallest closed superset: all parents are added until nothing changes. */
DiamondSet CloseOverParents(const Hierarchy& hierarchy, DiamondSet diamonds);

/**
 * What is subdivided for a region of interest: the smallest closed set that contains all of one
 * set, and those active and creation diamonds of another that touch the region.
 * @param outside what is subdivided everywhere, for the tolerance outside the region; closed
 * @param inside what would be subdivided if the tolerance in the region held everywhere
 */
DiamondSet RefineRegion(const Hierarchy& hierarchy, const DiamondSet& outside,
  const DiamondSet& inside, const std::vector<Kind>& kinds, const Box& region);

}

#endif
