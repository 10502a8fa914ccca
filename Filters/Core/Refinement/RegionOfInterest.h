// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_RegionOfInterest_h
#define isodiamond_RegionOfInterest_h

#include "Field/AffineMap.h"
#include "Field/GridGeometry.h"
#include "Lattice/DiamondSet.h"

#include <array>

namespace isodiamond
{

/** A closed box along the axes; empty where a minimum is greater than its maximum. */
struct Box
{
  std::array<double, 3> Minimum{};
  std::array<double, 3> Maximum{};

  bool IsEmpty() const
  {
    return !(this->Minimum[0] <= this->Maximum[0] && this->Minimum[1] <= this->Maximum[1] &&
      this->Minimum[2] <= this->Maximum[2]);
  }
};

/** The smallest box in index space around the cells of a grid that may touch a box in the world,
 *  with the padding next to cells at the grid's ends. Not for affine maps. */
Box IndexBoxOf(const Box& box, const GridGeometry& world);

/**
 * The region of interest of a query: a box in the world, whatever the orientation of the grid in
 * it. A diamond counts as inside if its domain, the closed union of those of its tetrahedra that
 * lie in the grid, touches the closed box.
 */
class RegionOfInterest
{
public:
  /** @param world from index space, not singular
   *  @throws std::invalid_argument if a bound is NaN */
  RegionOfInterest(const Box& box, const Grid& grid, const AffineMap& world);

  enum class Relation
  {
    Apart,
    Within, ///< the region holds it
    Unclear
  };

  bool Touches(const Place& place) const;

  /** How the diamonds centred in a brick of a scale lie relative to the region: none touches it,
   *  all do, or some may. */
  Relation OfBrick(int scale, const Point& origin) const;

private:
  /** How a box of lattice points lies relative to the region. */
  Relation Compare(const Point& minimum, const Point& maximum) const;
  bool TouchesTetrahedron(const std::array<Point, 4>& corners) const;

  Grid Domain;
  AffineMap World;
  Box Bounds;
  bool Empty = false;
  double Slack = 0.0; ///< for the rounding of positions in the world
};

}

#endif
