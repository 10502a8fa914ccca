// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeanNormals_h
#define isodiamond_MeanNormals_h

#include "Simplification/SimplerMesh.h"

namespace isodiamond
{

/**
 * Replaces the normals at the points of a simpler mesh by means over what the points stand for.
 *
 * A large triangle is shaded by the normals of three points of the original surface. These describe
 * only the spot itself, noise and the finest relief included, but show all over the triangle. So
 * all points of the original count, weighted by the area around them: those that are gone, at the
 * three corners of the triangle that they lie over, at each by how near to it they are.
 *
 * @param normals of unit length, or none, by point of the original, three numbers each; those of
 *        points in use are replaced, except where everything that counts cancels out
 */
void TakeMeanNormals(const TriangleMesh& original, const SimplerMesh& simpler, float* normals);

}

#endif
