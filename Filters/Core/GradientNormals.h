// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_GradientNormals_h
#define isodiamond_GradientNormals_h

#include "AffineMap.h"
#include "Parallel.h"
#include "Samples.h"

namespace isodiamond
{

/**
 * Unit normals of surface points from the gradient of the full-resolution field: central
 * differences at the samples (one-sided on the grid's boundary), interpolated trilinearly. They
 * point to lower values, as the triangles' normals do; (0, 0, 1) where the gradient vanishes or is
 * not finite.
 *
 * @param points world positions, 3 a point  @param normals receives 3 components a point
 */
void WriteGradientNormals(const AnySamples& samples, const AffineMap& world, const float* points,
  std::int64_t count, float* normals, const ParallelFor& parallelFor);

}

#endif
