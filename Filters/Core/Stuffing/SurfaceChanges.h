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

/** An edge that a surface cuts. */
struct CutSide
{
  Vector Inside{}; ///< the end on the volume's side
  Vector Beyond{};
};

/** Where an isovertex may be beside its place on an edge: in a spindle around that, which meets
 *  those of the lattice's other edges, and the grid's boundary, at its ends only, so that sheets
 *  keep apart; and no nearer to the end beyond than it is, or than the middle. Where spacings
 *  differ spindles may overlap. */
bool IsBeside(const CutSide& edge, const Vector& from, const Vector& to);

/** Whether a point on a surface can be elsewhere: no triangle of the boundary around it is folded.
 */
bool CanShift(const LocalMesh& mesh, std::uint32_t point, const Vector& to);

}

#endif
