// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeanNormals_h
#define isodiamond_MeanNormals_h

#include "Simplification/SimplerMesh.h"

namespace isodiamond
{

/**
 * Replaces the normals of the points of a simpler mesh by means over what these stand for.
 *
 * A large triangle is shaded by the normals of three points of the original surface. These tell of
 * what is right there, noise and the finest relief included, but are seen all over the triangle. So
 * all points of the original have a say, by the area around them: those that are gone at the three
 * corners of the triangle that they lie over, at each as much as they are near to it.
 *
 * @param normals of unit length, or none, by point of the original, three numbers each; those of
 *        points in use are replaced, but where all that counts cancels out
 */
void TakeMeanNormals(const TriangleMesh& original, const SimplerMesh& simpler, float* normals);

}

#endif
