// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SurfaceChanges_h
#define isodiamond_SurfaceChanges_h

#include "Stuffing/LocalMesh.h"

#include <cmath>

/**
 * @file SurfaceChanges.h
 * Whether a change of a mesh leaves its surfaces where they are, or near there.
 */
namespace isodiamond
{

/** Whether a surface stays near where it was, unfolded, if a point on it goes into another one. */
bool StaysNear(const LocalMesh& mesh, std::uint32_t from, std::uint32_t to, double distance);

/** Whether an edge of the boundary can be replaced by the one across it, near and on the same
 *  surface or wall. */
bool CanTurn(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b, const LocalMesh::Ring& ring,
  double distance);

/** An edge that a surface cuts, in index space. On a curvilinear grid, in the world. */
struct CutSide
{
  Vector Inside{}; ///< the end on the volume's side
  Vector Beyond{};
  double Length = 0.0;        ///< in the world
  double MostMove = HUGE_VAL; ///< how far the surface may move there, in one change
};

/** Whether an isovertex may be at a place beside its edge: in a spindle around the edge, which
 *  meets those of the lattice's other edges, and the grid's boundary, at its ends only, so that
 *  sheets stay apart; and no nearer to the end beyond than it is now, or than the edge's middle.
 *  That is so in index space: on a curvilinear grid spindles may overlap. */
bool IsBeside(const CutSide& edge, const Vector& from, const Vector& to);

/** Whether a point on a surface can move to a place: this folds no boundary triangle around it. */
bool CanShift(const LocalMesh& mesh, std::uint32_t point, const Vector& to);

}

#endif
