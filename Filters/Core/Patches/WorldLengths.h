// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_WorldLengths_h
#define isodiamond_WorldLengths_h

#include "Field/Bounds.h"
#include "Field/GridGeometry.h"
#include "Field/Vector.h"
#include "Patches/CurvedLengths.h"
#include "Patches/ExactPlane.h"

#include <array>
#include <string>
#include <variant>

/**
 * @file WorldLengths.h
 * World lengths: maps from fine positions to spaces in which distances are the world's but
 * orientation and origin do not matter. What is flat in the world is flat there.
 *
 * There is one for affine worlds, one for coordinates along the axes, and one for curvilinear grids
 * (CurvedLengths.h). Code that measures a lot is a template of these, so that the first one, by far
 * the most common, pays nothing for the others.
 */
namespace isodiamond
{

///@{
/** The eighth power of a length must neither vanish nor be infinite. */
inline constexpr double ShortestStep = 1e-35;
inline constexpr double LongestStep = 1e35;
///@}

/** The lengths of an affine world, by the upper triangular factor of its map. */
class AffineLengths
{
public:
  /** Whether lattice steps are the same everywhere, so that Factor() says all. */
  static constexpr bool IsLinear = true;

  explicit AffineLengths(const AffineMap& world);

  /** Whether the world has lengths along all axes. */
  bool IsValid() const;

  /** Where a position is. */
  Vector operator()(const FinePosition& p) const
  {
    constexpr double unit = 1.0 / FineUnits;
    return this->Mapped(unit * p[0], unit * p[1], unit * p[2]);
  }

  /** The offset from one lattice point to another. */
  Vector Between(const Point& from, const Point& to) const
  {
    const Point between = to + -1 * from;
    return this->Mapped(between[0], between[1], between[2]);
  }

  /** The squared radius of the ball, around the middle of a box, that holds the box. */
  double SquaredRadius(const FineBox& box, const FinePosition& middle) const;

  /** A box in index space that holds all that is within a radius of a point. */
  Bounds IndexBox(const Vector& point, double radius) const;

  /** A box in index space that holds all that is between some points. If it lies within the grid,
   *  so does what is between them. */
  Bounds IndexBoxAround(const Vector* corners, int count) const;

  /** About how far it is from a cell to the next one. */
  double StepIn(const Point& /*cell*/) const { return this->TypicalStep(); }

  /** What no distance in the grid exceeds. @param last the lattice's last point */
  double LongestDistance(const Point& last) const;

  /** From index space; upper triangular. */
  const std::array<std::array<double, 3>, 3>& Factor() const { return this->Triangular; }

  /** The length of a lattice step, along the axis where it is longest. */
  double TypicalStep() const;

  /** The rounding error between two positions that is not in proportion to their distance. */
  static constexpr double Rounding() { return 0.0; }

private:
  Vector Mapped(double x, double y, double z) const
  {
    const auto& f = this->Triangular;
    return { f[0][0] * x + f[0][1] * y + f[0][2] * z, f[1][1] * y + f[1][2] * z, f[2][2] * z };
  }

  std::array<std::array<double, 3>, 3> Triangular{};
  std::array<std::array<double, 3>, 3> Inverse{};
};

/** The lengths of a world of coordinates along the axes; the members are as above. */
class AxesLengths
{
public:
  static constexpr bool IsLinear = false;

  /** @param padding index of the grid's first sample */
  AxesLengths(AxisCoordinates coordinates, int padding);

  /** Whether the coordinates are finite and, along each axis, rise, or fall, at every sample. */
  bool IsValid() const;

  Vector operator()(const FinePosition& p) const
  {
    return { this->Along(0, p[0]), this->Along(1, p[1]), this->Along(2, p[2]) };
  }
  Vector Between(const Point& from, const Point& to) const
  {
    return (*this)(FineUnits * to) - (*this)(FineUnits * from);
  }
  double SquaredRadius(const FineBox& box, const FinePosition& middle) const;
  Bounds IndexBox(const Vector& point, double radius) const;
  Bounds IndexBoxAround(const Vector* corners, int count) const;
  double StepIn(const Point& cell) const;
  double LongestDistance(const Point& last) const;

  /** The mean of the steps, on the axis where it is longest. */
  double TypicalStep() const;

  /** Positions that are close together, but far from the first sample, have lost digits. */
  double Rounding() const { return this->AbsoluteError; }

private:
  /** Interpolated between samples, and continued beyond the ends by the outermost steps. */
  double Along(int axis, std::int32_t position) const;
  /** The index of a place on an axis. */
  double IndexAlong(int axis, double place) const;

  AxisCoordinates Coordinates; ///< from the first sample on
  int Padding = 0;
  double AbsoluteError = 0.0;
};

using WorldLengths = std::variant<AffineLengths, AxesLengths, CurvedLengths>;

/** Why a world has no lengths, in words; empty if it has. */
std::string FaultOfLengths(const GridGeometry& world);

/** The lengths of a world. @throws std::invalid_argument if it has none */
WorldLengths WorldLengthsOf(const GridGeometry& world);

}

#endif
