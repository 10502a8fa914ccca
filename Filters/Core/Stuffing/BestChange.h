// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestChange_h
#define isodiamond_BestChange_h

#include "Stuffing/Change.h"
#include "Stuffing/Improvement.h"

#include <random>

namespace isodiamond
{

/**
 * Finds the best change for a bad tetrahedron: the one that leaves the smallest shortfall in all
 * the tetrahedra that it touches, and makes the worst of these no worse. See Improvement.h for what
 * is tried.
 *
 * It only reads the mesh, and only the tetrahedra at the tetrahedron's points, and at points that
 * share an edge with one of these.
 *
 * @return a change of kind None if there is none
 */
Change BestChange(
  const LocalMesh& mesh, const ImprovementOptions& options, std::uint32_t tetrahedron);

/** Whether a change makes things better by enough to be made for a tetrahedron, and can be made.
 *  @param change found by BestChange(), perhaps in a similar mesh; all its points and tetrahedra
 *         must be in this one, and its points on the same surfaces and walls */
bool Helps(const Change& change, const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron);

/** A random one of the changes that BestChange() looks at: it may make things worse, but leaves no
 *  tetrahedron nearly flat. @return a change of kind None if there is none */
Change AnyChange(const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron, std::minstd_rand& random);

}

#endif
