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
 * whose ends are on different sides of it: where linear interpolation puts it, or in the middle of
 * the step if one of its ends is not finite. There may be several such crossings. The isovertex is
 * the one nearest to where linear interpolation between the ends of the edge would put it; of two
 * equally near ones, the one nearer to the younger end. Distances that differ by less than 1e-9
 * unit steps count as equal, since otherwise rounding would decide.
 *
 * Coefficients are coded like those of linear isovertices, by Coefficient(): in steps of 1/256 of
 * the edge, counted from the younger end, 1 to 255; 128 if an end of the edge is not finite. On
 * edges of a single unit step both are the same.
 */

/** The signs of the ends must differ. */
int ExactCoefficient(const ScalarField& field, double isovalue, const Isovertex& isovertex);

/**
 * On an edge from below the range to above it, the crossings taken are not those nearest to the
 * linear guesses, but two with nothing but the range between them: on the way from the end below,
 * the first crossing of the upper surface, and the last crossing of the lower surface before it.
 * Such isovertices are kept in order and apart as by Coefficient(). 0 for a lattice vertex.
 */
int ExactCoefficient(const ScalarField& field, const Isorange& range, const IntervalPoint& point);

/** The position in index space that the coefficient stands for. */
std::array<double, 3> ExactPosition(
  const ScalarField& field, double isovalue, const Isovertex& isovertex);
std::array<double, 3> ExactPosition(
  const ScalarField& field, const Isorange& range, const IntervalPoint& point);

}

#endif
