// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Query_h
#define isodiamond_Query_h

#include "Refinement/RegionOfInterest.h"
#include "Refinement/Viewpoint.h"

#include <cmath>
#include <optional>
#include <vector>

namespace isodiamond
{

/** What is asked of a hierarchy. */
struct Query
{
  /** The tolerated error, in the units of the hierarchy's metric; 0 gives full resolution, infinity
   *  leaves only what must always be subdivided; negative values and NaN count as 0. */
  double Tolerance = 0.0;
  /** The tolerated field error inside an interval volume; has no effect if the hierarchy has no
   *  thresholds for it. */
  double InteriorTolerance = HUGE_VAL;
  /** Where these tolerances hold; everywhere if there is none. */
  std::optional<RegionOfInterest> Region = std::nullopt;
  /** The tolerance outside the region. */
  double OutsideTolerance = HUGE_VAL;
  /** Diamonds to be subdivided, with all ancestors, whatever is tolerated. */
  std::vector<Place> Also = {};
  /** Where the mesh is seen from: a diamond's tolerance is at least that which follows from its
   *  distance from there. For errors that are distances. */
  std::optional<Viewpoint> View = std::nullopt;
  /** For an HD: whether the mesh is to be homeomorphic to that of full resolution. For RI and MI
   *  this is decided when they are built. */
  bool PreserveTopology = false;
};

}

#endif
