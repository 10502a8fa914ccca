// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Gradients_h
#define isodiamond_Gradients_h

#include "Field/GridGeometry.h"
#include "Field/Samples.h"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace isodiamond
{

/**
 * World-space gradients of the full-resolution field: central differences at the samples, one-sided
 * on the grid's boundary and beside samples that are not finite, interpolated trilinearly. Not
 * finite where a sample is not and, on some axis, neither is one next to it.
 */
class Gradients
{
public:
  /** Both must outlive it. */
  Gradients(const AnySamples& samples, const GridGeometry& geometry);

  /** The gradient at a position in index space; for one beyond the grid, at the nearest in it. */
  Vector operator()(const Vector& index) const;

  /** The same for many positions, all finite; faster where these are near each other.
   *  @param gradients one for each is written */
  void Find(const std::vector<Vector>& positions, Vector* gradients) const;

  /** The unit normal toward lower values, as of triangles. Where the field is not finite: toward
   *  what counts as below any value (NaN, too), and away from what counts as above.
   *  @param gradient the gradient there */
  Vector NormalAt(const Vector& index, const Vector& gradient) const;

private:
  /** From each corner of the cell: minds samples that are not finite, and how cells differ. */
  template <typename ValueOf>
  Vector FromCorners(const Vector& index, const ValueOf& valueOf) const;
  Vector OfGaps(const Vector& index) const;

  const AnySamples& Samples;
  const GridGeometry& Geometry;
  /** In the world, for steps in index space, if these are the same everywhere. */
  std::optional<std::array<Vector, 3>> OfSteps;
};

/** NormalOf() a gradient that is too short or too long to be squared, or not a number. */
Vector NormalOfExtreme(const Vector& gradient);

/** The unit normal of a gradient, toward lower values; (0, 0, 1) where it vanishes or is not
 * finite. */
inline Vector NormalOf(const Vector& gradient)
{
  const double squared = Dot(gradient, gradient);
  const bool isOrdinary = squared > 1e-200 && squared < 1e200;
  return isOrdinary ? (-1.0 / std::sqrt(squared)) * gradient : NormalOfExtreme(gradient);
}

}

#endif
