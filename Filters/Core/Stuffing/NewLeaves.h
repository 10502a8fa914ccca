// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_NewLeaves_h
#define isodiamond_NewLeaves_h

#include "Mesh/CutMesh.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * What is new in a mesh that is refined again and again: where leaves are the same as in the last
 * mesh, what was found out about them still holds.
 *
 * A leaf comes from subdividing the diamond whose centre is its youngest vertex. If that was
 * already subdivided in the last mesh, the leaf was there, too: nothing that is a leaf now was
 * subdivided before.
 */
class NewLeaves
{
public:
  /** The leaves that the last mesh did not have, and three rings of leaves around them; all leaves
   *  of the first mesh. The result has all of the mesh's vertices; those that leaves outside it
   *  share are fixed, too.
   *  @param mesh the last one, or a refined one */
  CutMesh Find(const CutMesh& mesh);

private:
  std::vector<std::uint64_t> Seen; ///< the youngest vertices of the last mesh's leaves, sorted
};

}

#endif
