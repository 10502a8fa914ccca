// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceLinearVolume_h
#define ReferenceLinearVolume_h

#include "ReferenceInterval.h"

#include <array>

namespace reference
{

/**
 * The six tetrahedra of full resolution in a voxel, which is named by its lowest corner. They
 * surround the voxel's diagonal from the corner with even coordinates to the one with odd
 * coordinates, so neighbouring voxels mirror each other.
 */
std::array<Tetrahedron, 6> VoxelTetrahedra(const Point& voxel);

/**
 * The fraction of a tetrahedron, from 0 to 1, where the linear interpolation of four finite values
 * at its vertices is inside the range.
 */
double FractionInside(const std::array<double, 4>& values, const Isorange& range);

/**
 * The volume in index space of what is inside the range, if the field is linear in every
 * tetrahedron of full resolution. No hierarchy, no coefficients: the truth that the mesh
 * approximates. All samples must be finite.
 */
double LinearVolume(const ScalarField& field, const Isorange& range);

}

#endif
