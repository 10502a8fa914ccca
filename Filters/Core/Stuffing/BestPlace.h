// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestPlace_h
#define isodiamond_BestPlace_h

#include "Patches/IntervalPatches.h"
#include "Stuffing/TetrahedronMesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace isodiamond
{

/** The faces opposite to a point in its tetrahedra. */
class PointStar
{
public:
  /** Adds a tetrahedron that has the point in the place of one of its corners. */
  void Add(const TetrahedronMesh& mesh, const Corners& corners, std::uint32_t point)
  {
    const auto own = std::find(corners.begin(), corners.end(), point) - corners.begin();
    // The point, and the face opposite to it from outside: an even permutation.
    const std::array<int, 3>& face = FacesOfTetrahedron[own];
    this->Faces.push_back({ mesh.Positions[corners[face[0]]], mesh.Positions[corners[face[1]]],
      mesh.Positions[corners[face[2]]] });
  }

  /** The smallest sine of the tetrahedra with the point at a place; any that is small enough, if
   *  it is not more than what is of interest. */
  double WorstAt(const Vector& place, double interesting)
  {
    double worst = 1.0;
    for (std::array<Vector, 3>& face : this->Faces)
    {
      worst = std::min(worst, SmallestSine(place, face[0], face[1], face[2]));
      if (worst <= interesting)
      {
        std::swap(face, this->Faces.front()); // the next place most likely fails there, too
        return worst;
      }
    }
    return worst;
  }

  /** Calls visit(sine) of each tetrahedron with the point at a place. */
  template <typename Visit>
  void ForEachSine(const Vector& place, Visit&& visit) const
  {
    for (const std::array<Vector, 3>& face : this->Faces)
    {
      visit(SmallestSine(place, face[0], face[1], face[2]));
    }
  }

  Vector Mean() const
  {
    Vector sum{};
    for (const std::array<Vector, 3>& face : this->Faces)
    {
      sum = sum + face[0] + face[1] + face[2];
    }
    return (1.0 / (3.0 * static_cast<double>(this->Faces.size()))) * sum;
  }

  /** The distance of the nearest corner. */
  double Radius(const Vector& place) const
  {
    double squared = HUGE_VAL;
    for (const std::array<Vector, 3>& face : this->Faces)
    {
      for (const Vector& corner : face)
      {
        squared = std::min(squared, Dot(corner - place, corner - place));
      }
    }
    return std::sqrt(squared);
  }

private:
  std::vector<std::array<Vector, 3>> Faces;
};

/** A place for a point, and the smallest sine around it there. */
struct PlacedPoint
{
  Vector Place{};
  double Sine = 0.0;
};

/** Where a place may be. */
struct Reach
{
  double FirstStep = 0.0; ///< 0: by the distance to the nearest point
  std::function<bool(const Vector& place)> Allows = nullptr; ///< null for all
};

/** Looks for a better place for a point, until all around it is as wanted: first in the middle of
 *  its star, then in steps that get smaller.
 *  @param walls that it stays on */
PlacedPoint BestPlace(PointStar& star, const Vector& from, Walls::Type walls,
  const std::array<Vector, 3>& axes, double wanted, const Reach& reach = {});

}

#endif
