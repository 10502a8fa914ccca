// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshPart_h
#define isodiamond_MeshPart_h

#include "Field/Walls.h"
#include "Simplification/NearLists.h"
#include "Simplification/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/** A watched place of the original mesh: one of its points, or the middle of one of its triangles.
 */
struct SurfaceSample
{
  Vector Position;
  double Allowance = 0.0;
  std::uint32_t Home = None; ///< the triangle that it lies over; None for a point in use
};

/** A part of a mesh that is simplified on its own, and what it stands for. */
struct MeshPart
{
  std::vector<Vector> Positions;
  LinkedTriangles Original;
  std::vector<double> Allowances;     ///< by triangle of the original
  LinkedTriangles Simple;             ///< on some of the points
  std::vector<bool> IsFixed;          ///< by point: stays
  std::vector<bool> IsSettled;        ///< by point: has been tried, and nothing has changed since
  std::vector<Walls::Type> OnWalls;   ///< by point
  std::vector<SurfaceSample> Samples; ///< first the points, then the original's middles
  NearLists Near{ 0 };                ///< by triangle of the original
  double LeastSine = 0.0;             ///< of the angles of new triangles
  std::vector<Triangle> Others{};     ///< of other parts, that new ones might meet
};

}

#endif
