// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_BestChange_h
#define isodiamond_BestChange_h

#include "Stuffing/Change.h"
#include "Stuffing/Improvement.h"

#include <random>

namespace isodiamond
{

/**
 * Finds what would be best for a bad tetrahedron: what leaves least to be wished for of all the
 * tetrahedra that it touches, and makes the worst of these no worse. See Improvement.h for what is
 * tried.
 *
 * It only reads the mesh, and of that the tetrahedra at the tetrahedron's points, and at points
 * that have an edge to one of these.
 *
 * @return a change of no kind if there is none
 */
Change BestChange(
  const LocalMesh& mesh, const ImprovementOptions& options, std::uint32_t tetrahedron);

/** One of the changes that BestChange() looks at, by chance: it may make things worse, but leaves
 *  no tetrahedron of nearly no height. @return a change of no kind if there is none */
Change AnyChange(const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron, std::minstd_rand& random);

}

#endif
