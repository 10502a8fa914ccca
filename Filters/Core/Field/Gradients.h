// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Gradients_h
#define isodiamond_Gradients_h

#include "Field/GridGeometry.h"
#include "Field/Samples.h"

#include <array>
#include <optional>

namespace isodiamond
{

/**
 * Gradients in the world of the full-resolution field: central differences at the samples,
 * one-sided on the grid's boundary, interpolated trilinearly. Where the field is not finite they
 * are not either.
 */
class Gradients
{
public:
  /** Both must outlive it. */
  Gradients(const AnySamples& samples, const GridGeometry& geometry);

  /** At a position in index space; the nearest in the grid for one beyond it. */
  Vector operator()(const Vector& index) const;

private:
  const AnySamples& Samples;
  const GridGeometry& Geometry;
  /** In the world, for steps in index space, where these are the same everywhere. */
  std::optional<std::array<Vector, 3>> OfSteps;
};

/** The unit normal toward lower values, as triangles have them; (0, 0, 1) where the gradient
 *  vanishes or is not finite. */
Vector NormalOf(const Vector& gradient);

}

#endif
