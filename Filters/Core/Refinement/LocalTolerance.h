// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_LocalTolerance_h
#define isodiamond_LocalTolerance_h

#include "Refinement/Query.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isodiamond
{

/** What is tolerated in one place: at a surface, and inside an interval volume. */
struct Tolerances
{
  double Surface = 0.0;
  double Interior = HUGE_VAL;
};

/** The tolerances of a query, which depend on the place if there is a region of interest or a
 *  viewpoint. */
class LocalTolerance
{
public:
  LocalTolerance(const Query& query, const Grid& grid)
    : TheQuery(query)
    , TheGrid(grid)
  {
  }

  /** Whether they are the same everywhere, so that thresholds alone decide what is refined. */
  bool IsUniform() const
  {
    return !this->TheQuery.Region && !this->TheQuery.View && this->TheQuery.Also.empty();
  }

  const std::vector<Place>& Also() const { return this->TheQuery.Also; }

  /** The tolerances above which a diamond is refined wherever it is. */
  Tolerances Everywhere() const
  {
    const Tolerances most = this->TheQuery.Region ? this->Outside() : this->Inside();
    return this->Seen(
      most, this->TheQuery.View ? this->TheQuery.View->GreatestIn(this->TheGrid) : 0.0);
  }

  /** What is tolerated of the diamonds centred in a brick of a scale. */
  struct OfBrick
  {
    Tolerances Least;      ///< at most that of any
    bool AreEqual = false; ///< whether this is that of all
  };
  OfBrick In(int scale, const Point& brickOrigin) const
  {
    using Relation = RegionOfInterest::Relation;
    const Relation relation =
      this->TheQuery.Region ? this->TheQuery.Region->OfBrick(scale, brickOrigin) : Relation::Within;
    Tolerances least = relation == Relation::Apart ? this->Outside() : this->Inside();
    if (relation == Relation::Unclear)
    {
      least.Surface = std::min(least.Surface, this->Outside().Surface); // some may not touch it
    }
    if (this->TheQuery.View)
    {
      return { this->Seen(least, this->TheQuery.View->LeastIn(scale, brickOrigin)), false };
    }
    return { least, relation != Relation::Unclear };
  }

  /** What is tolerated of a diamond. */
  Tolerances At(const Place& place) const
  {
    const bool touches = !this->TheQuery.Region || this->TheQuery.Region->Touches(place);
    return this->Seen(touches ? this->Inside() : this->Outside(),
      this->TheQuery.View ? this->TheQuery.View->ToleranceOf(place) : 0.0);
  }

private:
  /** In the region of interest, or everywhere if there is none: no more than outside. */
  Tolerances Inside() const
  {
    const double most = this->TheQuery.Region ? this->TheQuery.OutsideTolerance : HUGE_VAL;
    return { std::min(this->TheQuery.Tolerance, most), this->TheQuery.InteriorTolerance };
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
