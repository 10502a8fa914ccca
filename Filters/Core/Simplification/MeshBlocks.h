// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshBlocks_h
#define isodiamond_MeshBlocks_h

#include "Field/Vector.h"
#include "Simplification/IdRange.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** The triangles of a mesh in blocks, in an order that depends on their positions, and on their
 *  numbers where positions are the same. */
struct MeshBlocks
{
  std::vector<std::uint32_t> Order; ///< of the triangles
  std::vector<std::size_t> First;   ///< by block, in that order; then the number of all

  std::size_t Count() const { return this->First.size() - 1; }

  /** The triangles of a block, ascending. */
  IdRange operator[](std::size_t block) const
  {
    return { this->Order.data() + this->First[block], this->Order.data() + this->First[block + 1] };
  }
};

/**
 * Cuts triangles repeatedly, where they are spread farthest, until no block has too many.
 *
 * @param middles of the triangles
 * @param most triangles of a block, at least 1
 * @param part of the triangles that lie before a cut; another value puts the cuts elsewhere
 */
MeshBlocks CutIntoBlocks(const std::vector<Vector>& middles, std::size_t most, double part);

}

#endif
