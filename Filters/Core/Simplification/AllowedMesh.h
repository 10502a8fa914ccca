// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_AllowedMesh_h
#define isodiamond_AllowedMesh_h

#include "Field/Walls.h"
#include "Simplification/TriangleMesh.h"

#include <vector>

namespace isodiamond
{

/** A mesh, and how far from each of its triangles a mesh made of it may be. */
struct AllowedMesh
{
  TriangleMesh Mesh;
  std::vector<double> Allowances;     ///< by triangle; at least 0
  std::vector<Walls::Type> OnWalls{}; ///< by point; none if nothing is known of walls
  /** In degrees, below 60: no new triangle has a smaller angle, unless one that it replaces has. */
  double LeastAngle = 0.0;
};

}

#endif
