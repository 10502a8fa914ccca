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
  /** The error that is tolerated, in the units of the hierarchy's metric; 0 is full resolution,
   *  infinity leaves only what must always be subdivided; negative and NaN count as 0. */
  double Tolerance = 0.0;
  /** The same, of the field, inside an interval volume; without effect if the hierarchy has no
   *  thresholds for it. */
  double InteriorTolerance = HUGE_VAL;
  /** Where these tolerances hold; everywhere if there is none. */
  std::optional<RegionOfInterest> Region = std::nullopt;
  /** The tolerance outside of the region. */
  double OutsideTolerance = HUGE_VAL;
  /** Diamonds that are to be subdivided whatever is tolerated, with all ancestors. */
  std::vector<Place> Also = {};
  /** From where the mesh is seen: a diamond's tolerance is at least what the distance from there
   *  makes of it. For errors that are distances. */
  std::optional<Viewpoint> View = std::nullopt;
  /** Of an HD: whether the mesh is to be homeomorphic to that of full resolution. RI and MI are
   *  built so, or not. */
  bool PreserveTopology = false;
};

}

#endif
