// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Viewpoint_h
#define isodiamond_Viewpoint_h

#include "Field/Bounds.h"
#include "Field/GridGeometry.h"
#include "Field/Vector.h"
#include "Lattice/DiamondSet.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isodiamond
{

/**
 * The viewpoint of a query: the tolerance grows with the distance from it, as the size of a pixel
 * does in the world. A diamond has the tolerance at the nearest point of a ball around it or, where
 * lattice steps differ in length, of a box around it: so everywhere in it the error in pixels is
 * at most the tolerated one; around the viewpoint the mesh has full resolution.
 */
class Viewpoint
{
public:
  /** @param tolerancePerDistance what is tolerated at distance 1, at least 0
   *  @throws std::invalid_argument if something is not a finite number */
  Viewpoint(const Vector& position, double tolerancePerDistance, const GridGeometry& world)
    : Position(position)
    , TolerancePerDistance(tolerancePerDistance)
    , World(world)
  {
    if (!std::isfinite(position[0] + position[1] + position[2] + tolerancePerDistance))
    {
      throw std::invalid_argument("The viewpoint or its tolerance is not a finite number.");
    }
    if (world.Affine() == nullptr)
    {
      return;
    }
    const Vector origin = world({ 0.0, 0.0, 0.0 });
    for (const double y : { -1.0, 1.0 })
    {
      for (const double z : { -1.0, 1.0 })
      {
        this->CornerLength = std::max(this->CornerLength, LengthOf(world({ 1.0, y, z }) - origin));
      }
    }
  }

  /** The tolerance of a diamond. */
  double ToleranceOf(const Place& place) const
  {
    const Point centre = Centre(place);
    return this->NearestIn({ 1.0 * centre[0], 1.0 * centre[1], 1.0 * centre[2] }, 1 << place.Scale);
  }

  /** At most the tolerance of any diamond centred in a brick of a scale. */
  double LeastIn(int scale, const Point& brickOrigin) const
  {
    const double h = 1 << scale;
    return this->NearestIn(
      { h * (brickOrigin[0] + 3.5), h * (brickOrigin[1] + 3.5), h * (brickOrigin[2] + 3.5) },
      4.5 * h);
  }

  /** At least the tolerance of any diamond in the base cube of a grid. */
  double GreatestIn(const Grid& grid) const
  {
    if (this->World.Positions() != nullptr)
    {
      return this->TolerancePerDistance * this->FarthestOf(this->World.CellsInWorld().OfAll());
    }
    double greatest = 0.0;
    const double last = 1 << grid.Depth();
    for (int corner = 0; corner < 8; ++corner)
    {
      greatest = std::max(greatest,
        this->DistanceOf(
          { (corner & 1) * last, ((corner >> 1) & 1) * last, (corner >> 2) * last }));
    }
    return greatest * this->TolerancePerDistance;
  }

private:
  static double LengthOf(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }

  double DistanceOf(const Vector& index) const
  {
    return LengthOf(this->World(index) - this->Position);
  }

  /** The tolerance at the nearest point of a cube of a half width, or of the ball around it. */
  double NearestIn(const Vector& centre, double half) const
  {
    const double distance = this->World.Affine() == nullptr
      ? this->DistanceOfBox(this->BoxAround(centre, half))
      : std::max(0.0, this->DistanceOf(centre) - half * this->CornerLength);
    return this->TolerancePerDistance * distance;
  }

  /** A box in the world around a cube, or around what a curvilinear grid has of it. */
  Bounds BoxAround(const Vector& centre, double half) const
  {
    const Vector halves = { half, half, half };
    const Vector low = centre - halves;
    const Vector high = centre + halves;
    if (this->World.Positions() != nullptr)
    {
      const auto down = [](double index) { return static_cast<int>(std::floor(index)); };
      const auto up = [](double index) { return static_cast<int>(std::ceil(index)); };
      return this->World.CellsInWorld().Of(
        { down(low[0]), down(low[1]), down(low[2]) }, { up(high[0]), up(high[1]), up(high[2]) });
    }
    Bounds box;
    box.Add(this->World(low));
    box.Add(this->World(high));
    return box;
  }

  double DistanceOfBox(const Bounds& box) const
  {
    Vector apart{};
    for (int axis = 0; axis < 3; ++axis)
    {
      apart[axis] = std::max(
        { 0.0, box.Low[axis] - this->Position[axis], this->Position[axis] - box.High[axis] });
    }
    return LengthOf(apart);
  }

  /** The distance of a box's farthest point. */
  double FarthestOf(const Bounds& box) const
  {
    Vector apart{};
    for (int axis = 0; axis < 3; ++axis)
    {
      apart[axis] =
        std::max(this->Position[axis] - box.Low[axis], box.High[axis] - this->Position[axis]);
    }
    return LengthOf(apart);
  }

  Vector Position;
  double TolerancePerDistance;
  GridGeometry World;
  double CornerLength = 0.0; ///< in an affine world, the longest of (+-1, +-1, +-1)
};

}

#endif
