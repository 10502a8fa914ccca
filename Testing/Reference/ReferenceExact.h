// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceExact_h
#define ReferenceExact_h

#include "ReferenceIntervalMesh.h"

#include <array>

namespace reference
{

/**
 * Exact isovertices. An edge of the hierarchy leads over h unit steps from its younger to its older
 * end, by lattice points that all have a sample if the ends do. At full resolution the field is
 * linear between neighbouring lattice points, so a surface crosses the edge on every unit step
 * whose ends are on either side of it, where linear interpolation puts it, or in the middle of the
 * unit step if an end of that is not finite. There may be several such crossings, and an isovertex
 * is one of them: the one nearest to where linear interpolation of the ends of the edge puts it, of
 * two equally near ones the one nearer to the younger end. Distances that differ by less than 1e-9
 * unit steps count as equal, since rounding would else decide.
 *
 * The coefficients are coded as those of linear isovertices are, by Coefficient(): in steps of
 * 1/256 of the edge, counted from the younger end, 1 to 255; 128 if an end of the edge is not
 * finite. On edges of a single unit step they are the same.
 */

/** The signs of the ends must differ. */
int ExactCoefficient(const ScalarField& field, double isovalue, const Isovertex& isovertex);

/**
 * For an edge that leads from below the range to above it, not the crossings nearest to the linear
 * guesses are taken, but two that have nothing but the range between them: on the way from the end
 * below, the first crossing of the upper surface, and the last crossing of the lower surface before
 * it. Such isovertices are kept in order and apart in the way of Coefficient(). 0 for a lattice
 * vertex.
 */
int ExactCoefficient(const ScalarField& field, const Isorange& range, const IntervalPoint& point);

/** The position in index space that the coefficient stands for. */
std::array<double, 3> ExactPosition(
  const ScalarField& field, double isovalue, const Isovertex& isovertex);
std::array<double, 3> ExactPosition(
  const ScalarField& field, const Isorange& range, const IntervalPoint& point);

}

#endif
