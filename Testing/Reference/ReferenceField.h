// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferenceField_h
#define ReferenceField_h

#include "ReferenceLattice.h"

#include <vector>

namespace reference
{

/** Samples at the integer points of a grid, x fastest. */
struct ScalarField
{
  Point Dims;
  std::vector<double> Samples;

  /** The sample at a point, which must have one. */
  double At(const Point& point) const;
};

/** The side of the isosurface a value lies on: 1 above the isovalue, else 0, also for NaN. */
int SignOf(double value, double isovalue);

/**
 * What a diamond means to an isosurface (the paper's kinds of isodiamonds). Vertices without a
 * sample are ignored throughout.
 */
enum class Kind
{
  /** The vertices lie on both sides: the diamond has a patch. */
  Active,
  /** The vertices lie on one side, the central vertex on the other: subdivision creates a patch. */
  Creation,
  /** Neither, but a descendant is active or a creation diamond. */
  Relevant,
  Inactive
};

/** The kind of every diamond. */
std::vector<Kind> Classify(const Hierarchy& hierarchy, const ScalarField& field, double isovalue);

/** The numbers that the paper's Table 2 lists. */
struct Counts
{
  /** m_a. */
  int Active = 0;
  /** m_c. */
  int Creation = 0;
  /** m_r: relevant diamonds, including the creation diamonds. */
  int Relevant = 0;
  /** v_i: subdivision edges of diamonds with two sampled ends of different sign. */
  int Isovertices = 0;
  /** The same on the base cube's own edges, which belong to no diamond; not part of v_i. */
  int BaseIsovertices = 0;
};

Counts Count(const Hierarchy& hierarchy, const ScalarField& field, double isovalue,
  const std::vector<Kind>& kinds);

/**
 * The lattice points with a sample in the closed domain of a diamond, the union of its tetrahedra.
 * A point on a common face is listed once for each tetrahedron.
 */
std::vector<Point> DomainPoints(const Hierarchy& hierarchy, int diamond);

/**
 * The field error of a diamond by itself, whatever its descendants' errors (the paper's error): the
 * largest difference, at any lattice point of the closed domain, between the field and its linear
 * interpolation from the vertices of the tetrahedron that holds the point. Infinite where this has
 * no meaning: for diamonds that stick out of the grid and for domains with a sample that is not
 * finite.
 */
double OwnFieldError(const Hierarchy& hierarchy, const ScalarField& field, int diamond);
std::vector<double> OwnFieldErrors(const Hierarchy& hierarchy, const ScalarField& field);

/** The smallest and the largest sample in the closed domain; NaN does not count. */
struct ValueRange
{
  double Minimum;
  double Maximum;
};

ValueRange DomainRange(const Hierarchy& hierarchy, const ScalarField& field, int diamond);

/** Whether the samples in the closed domain lie on both sides of the isosurface. */
bool IsCrossed(const Hierarchy& hierarchy, const ScalarField& field, double isovalue, int diamond);
std::vector<bool> CrossedDomains(
  const Hierarchy& hierarchy, const ScalarField& field, double isovalue);

}

#endif
