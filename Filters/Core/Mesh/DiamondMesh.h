// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondMesh_h
#define isodiamond_DiamondMesh_h

#include "Refinement/RefinedSet.h"

#include <vector>

namespace isodiamond
{

/**
 * The current diamond mesh of a query: the tetrahedra under the front (the paper's figure 14).
 *
 * From an RI or an HD query, these tile the whole grid (but for tetrahedra that stick out of it);
 * from an MI, they are those that carry the surface.
 */
struct DiamondMesh
{
  std::vector<Point> Points;                           ///< lattice points, each once
  std::vector<std::array<std::int64_t, 4>> Tetrahedra; ///< positively oriented in index space
  std::vector<std::int8_t> Levels;  ///< of the diamond that a tetrahedron lies in
  std::vector<std::int8_t> Classes; ///< class of that diamond
};

/** Collects the mesh. Serial: meant for looking at, not for speed. */
DiamondMesh ExtractDiamondMesh(const RefinedSet& refined);

}

#endif
