// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_CurvedLengths_h
#define isodiamond_CurvedLengths_h

#include "Field/Bounds.h"
#include "Field/GridGeometry.h"
#include "Field/Vector.h"
#include "Patches/ExactPlane.h"

namespace isodiamond
{

/**
 * The lengths of a curvilinear grid; the members are those of AffineLengths (WorldLengths.h).
 *
 * Positions between samples are trilinear, those that a mesh's points get. Samples may coincide, as
 * on the axis of a cylinder. There is no way from the world to index space: what is near to a place
 * is found by boxes around cells (CellBounds), so it is all there, and more.
 */
class CurvedLengths
{
public:
  static constexpr bool IsLinear = false;

  /** @pre CanBeMeasured() */
  explicit CurvedLengths(const GridGeometry& world);

  /** Whether all positions are finite and, all together, neither too near nor too far apart. */
  static bool CanBeMeasured(const GridGeometry& world);

  Vector operator()(const FinePosition& p) const
  {
    constexpr double unit = 1.0 / FineUnits;
    return this->World({ unit * p[0], unit * p[1], unit * p[2] }) - this->Origin;
  }
  Vector Between(const Point& from, const Point& to) const
  {
    return this->World.PaddedAt(to) - this->World.PaddedAt(from);
  }
  double SquaredRadius(const FineBox& box, const FinePosition& middle) const;
  Bounds IndexBox(const Vector& point, double radius) const;
  Bounds IndexBoxAround(const Vector* corners, int count) const;
  double StepIn(const Point& cell) const;
  double LongestDistance(const Point& last) const;
  double TypicalStep() const { return this->Step; }
  double Rounding() const { return this->AbsoluteError; }

private:
  Bounds Near(const Bounds& box) const;

  GridGeometry World;
  Point Last{}; ///< the lattice's last point
  Vector Origin{};
  double Step = 0.0;
  double AbsoluteError = 0.0;
};

}

#endif
