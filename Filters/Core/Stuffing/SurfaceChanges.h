// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceChanges_h
#define isodiamond_SurfaceChanges_h

#include "Stuffing/LocalMesh.h"

/**
 * @file SurfaceChanges.h
 * Whether a change of a mesh leaves its surfaces where they are, or near.
 */
namespace isodiamond
{

/** Whether a surface stays near to where it was, and is not folded, when a point on it goes. */
bool StaysNear(const LocalMesh& mesh, std::uint32_t from, std::uint32_t to, double distance);

/** Whether an edge of the boundary can be replaced by the one across, near and on the same. */
bool CanTurn(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring,
  double distance);

/** The end beyond the surface of an edge that it cuts. */
struct CutEdgeEnd
{
  Vector Position{};
  double Half = 0.0; ///< of the edge's length
};

/** Whether a point on a surface can be elsewhere: no triangle of the boundary around it is folded,
 *  and it comes no nearer to the end of its edge than it is, or than half of the edge: another
 * sheet might come as near from beyond. */
bool CanShift(
  const LocalMesh& mesh, std::uint32_t point, const Vector& to, const CutEdgeEnd& beyond);

}

#endif
