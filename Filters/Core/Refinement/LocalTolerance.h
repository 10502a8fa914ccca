// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_LocalTolerance_h
#define isodiamond_LocalTolerance_h

#include "Refinement/Query.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isodiamond
{

/** What is tolerated somewhere: where a surface is, and inside an interval volume. */
struct Tolerances
{
  double Surface = 0.0;
  double Interior = HUGE_VAL;
};

/** The tolerances of a query that depend on the place: with a region of interest, or from a
 *  viewpoint. */
class LocalTolerance
{
public:
  LocalTolerance(const Query& query, const Grid& grid)
    : TheQuery(query)
    , TheGrid(grid)
  {
  }

  /** Whether they are the same everywhere, so that thresholds alone tell what is refined. */
  bool IsUniform() const
  {
    return !this->TheQuery.Region && !this->TheQuery.View && this->TheQuery.Also.empty();
  }

  const std::vector<Place>& Also() const { return this->TheQuery.Also; }

  /** What is tolerated wherever it is. */
  Tolerances Everywhere() const
  {
    const Tolerances most = this->TheQuery.Region ? this->Outside() : this->Inside();
    return this->Seen(
      most, this->TheQuery.View ? this->TheQuery.View->GreatestIn(this->TheGrid) : 0.0);
  }

  /** At most what is tolerated of any diamond that has its centre in a brick of a scale. */
  Tolerances LeastIn(int scale, const Point& brickOrigin) const
  {
    const bool mayTouch =
      !this->TheQuery.Region || this->TheQuery.Region->MayTouch(scale, brickOrigin);
    Tolerances least = mayTouch ? this->Inside() : this->Outside();
    if (this->TheQuery.Region)
    {
      least.Surface = std::min(least.Surface, this->Outside().Surface); // some may not touch it
    }
    return this->Seen(
      least, this->TheQuery.View ? this->TheQuery.View->LeastIn(scale, brickOrigin) : 0.0);
  }

  /** What is tolerated of a diamond. */
  Tolerances At(const Place& place) const
  {
    const bool touches = !this->TheQuery.Region || this->TheQuery.Region->Touches(place);
    return this->Seen(touches ? this->Inside() : this->Outside(),
      this->TheQuery.View ? this->TheQuery.View->ToleranceOf(place) : 0.0);
  }

private:
  Tolerances Inside() const
  {
    return { this->TheQuery.Tolerance, this->TheQuery.InteriorTolerance };
  }
  Tolerances Outside() const { return { this->TheQuery.OutsideTolerance, HUGE_VAL }; }

  static Tolerances Seen(Tolerances tolerances, double fromViewpoint)
  {
    tolerances.Surface = std::max(tolerances.Surface, fromViewpoint);
    return tolerances;
  }

  const Query& TheQuery;
  const Grid& TheGrid;
};

}

#endif
