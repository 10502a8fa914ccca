// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_NewLeaves_h
#define isodiamond_NewLeaves_h

#include "Mesh/CutMesh.h"

#include <vector>

namespace isodiamond
{

/**
 * What is new in a mesh that is refined again and again: where leaves are the same as in the last
 * mesh, what was found out about them still holds.
 *
 * A leaf is known by its middle: that of a larger one that it is a part of lies on the plane that
 * bisects the larger one, so no two have the same.
 */
class NewLeaves
{
public:
  /** The leaves that the last mesh did not have, and three rings of leaves around them; all leaves
   *  of the first mesh. The result has all of the mesh's vertices; those that leaves outside it
   *  share are fixed, too. */
  CutMesh Find(const CutMesh& mesh);

private:
  std::vector<Point> Seen; ///< four times the middles of the last mesh's leaves, sorted
};

}

#endif
