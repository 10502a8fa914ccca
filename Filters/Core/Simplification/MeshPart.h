// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshPart_h
#define isodiamond_MeshPart_h

#include "Simplification/AllowedMesh.h"
#include "Simplification/NearLists.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/** A place of the original mesh that is watched: each of its points, and the middle of each of its
 *  triangles. */
struct SurfaceSample
{
  Vector Position;
  double Allowance = 0.0;
  std::uint32_t Home =
    Connectivity::None; ///< the triangle that it lies over; none yet for a point in use
};

/** A part of a mesh that is made simpler on its own, and what it stands for. */
struct MeshPart
{
  AllowedMesh Original;
  std::vector<Triangle> Triangles;    ///< of the simpler mesh, on the points of the original
  std::vector<bool> IsFixed;          ///< by point: stays
  std::vector<SurfaceSample> Samples; ///< the points first
  NearLists Near{ 0 };                ///< by original triangle
};

}

#endif
