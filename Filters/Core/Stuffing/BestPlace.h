// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestPlace_h
#define isodiamond_BestPlace_h

#include "Patches/IntervalPatches.h"
#include "Stuffing/LocalMesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace isodiamond
{

/** The face opposite to a point, and all of its tetrahedron that does not depend on the point. */
class OppositeFace
{
public:
  /** Corners as seen from outside: with the point they form a positive tetrahedron. */
  explicit OppositeFace(const std::array<Vector, 3>& corners)
    : Corners(corners)
    , Across(Cross(corners[1] - corners[0], corners[2] - corners[0]))
    , SquaredAcross(Dot(this->Across, this->Across))
  {
    for (int i = 0; i < 3; ++i)
    {
      const Vector side = corners[(i + 2) % 3] - corners[(i + 1) % 3];
      this->SquaredSides[i] = Dot(side, side);
    }
  }

  const std::array<Vector, 3>& Points() const { return this->Corners; }

  double SmallestSine(const Vector& place) const
  {
    return isodiamond::SmallestSine(place, this->Corners[0], this->Corners[1], this->Corners[2]);
  }

  /** The smallest sine with the point at a place, where only more than a given sine is of interest:
   *  if that is not negative, 0 for a tetrahedron that is not positive. */
  double SmallestSine(const Vector& place, double interesting) const
  {
    const Vector b = this->Corners[0] - place;
    const Vector c = this->Corners[1] - place;
    const Vector d = this->Corners[2] - place;
    const double sixVolumes = Dot(this->Across, b);
    if (!(sixVolumes > 0.0))
    {
      return interesting < 0.0 ? this->SmallestSine(place) : 0.0;
    }
    const Vector toB = Cross(c, d); // normals of the other faces
    const Vector toC = Cross(d, b);
    const Vector toD = Cross(b, c);
    const auto& [cd, bd, bc] = this->SquaredSides;
    return isodiamond::SmallestSine(sixVolumes, { Dot(b, b), Dot(c, c), Dot(d, d), bc, bd, cd },
      { this->SquaredAcross, Dot(toB, toB), Dot(toC, toC), Dot(toD, toD) });
  }

private:
  std::array<Vector, 3> Corners;
  Vector Across;
  double SquaredAcross;
  std::array<double, 3> SquaredSides{}; ///< by the corner opposite to them
};

/** The faces opposite to a point in its tetrahedra. */
class PointStar
{
public:
  /** Adds a tetrahedron that has the point as one of its corners. */
  void Add(const TetrahedronMesh& mesh, const Corners& corners, std::uint32_t point)
  {
    const auto own = std::find(corners.begin(), corners.end(), point) - corners.begin();
    // The point, and the face opposite to it from outside: an even permutation.
    const std::array<int, 3>& face = FacesOfTetrahedron[own];
    this->Faces.emplace_back(std::array<Vector, 3>{ mesh.Positions[corners[face[0]]],
      mesh.Positions[corners[face[1]]], mesh.Positions[corners[face[2]]] });
    this->Looks.push_back({ this->Looks.size() });
  }

  /** The smallest sine of the tetrahedra with the point at a place; if that is not more than what
   *  is of interest, any sine that is not. */
  double WorstAt(const Vector& place, double interesting)
  {
    double worst = 1.0;
    for (Look& look : this->Looks)
    {
      look.Sine = this->Faces[look.Face].SmallestSine(place, interesting);
      worst = std::min(worst, look.Sine);
      if (worst <= interesting)
      {
        std::swap(look, this->Looks.front()); // the next place most likely fails there, too
        return worst;
      }
    }
    // Places around this one will be tried next, and fail where this one is worst.
    std::sort(this->Looks.begin(), this->Looks.end(),
      [](const Look& a, const Look& b) { return a.Sine < b.Sine; });
    return worst;
  }

  /** Calls visit(sine) for each tetrahedron with the point at a place. */
  template <typename Visit>
  void ForEachSine(const Vector& place, Visit&& visit) const
  {
    for (const OppositeFace& face : this->Faces)
    {
      visit(face.SmallestSine(place));
    }
  }

  Vector Mean() const
  {
    Vector sum{};
    for (const OppositeFace& face : this->Faces)
    {
      const auto& [a, b, c] = face.Points();
      sum = sum + a + b + c;
    }
    return (1.0 / (3.0 * static_cast<double>(this->Faces.size()))) * sum;
  }

  /** The distance to the nearest corner. */
  double Radius(const Vector& place) const
  {
    double squared = HUGE_VAL;
    for (const OppositeFace& face : this->Faces)
    {
      for (const Vector& corner : face.Points())
      {
        squared = std::min(squared, Dot(corner - place, corner - place));
      }
    }
    return std::sqrt(squared);
  }

private:
  std::vector<OppositeFace> Faces;
  /** A face to look at, and what was found there the last time. */
  struct Look
  {
    std::size_t Face = 0;
    double Sine = 0.0;
  };
  std::vector<Look> Looks; ///< in the order in which they are done
};

/** The faces opposite to a point of a mesh. */
PointStar FacesAround(const LocalMesh& mesh, std::uint32_t point);

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

/** Looks for a better place for a point until everything around it is as wanted: first in the
 *  middle of its star, then in ever smaller steps.
 *  @param walls that it stays on */
PlacedPoint BestPlace(PointStar& star, const Vector& from, Walls::Type walls,
  const std::array<Vector, 3>& axes, double wanted, const Reach& reach = {});

}

#endif
