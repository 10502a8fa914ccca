// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshBlocks_h
#define isodiamond_MeshBlocks_h

#include "Simplification/Simplification.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/** The triangles of a mesh in blocks, in an order that depends on their positions alone. */
struct MeshBlocks
{
  std::vector<std::uint32_t> Order; ///< of the triangles
  std::vector<std::size_t> First;   ///< in that order; and the number of all

  std::size_t Count() const { return this->First.size() - 1; }
};

/** Cubes that have triangles. @param shift of their corners, in their size */
MeshBlocks CutIntoBlocks(const TriangleMesh& mesh, double size, double shift);

/** Two halves along the axis that a mesh is longest on. */
MeshBlocks CutInTwo(const TriangleMesh& mesh);

/** A block with points of its own. @param points is given their ids in the mesh */
AllowedMesh TakeBlock(const AllowedMesh& mesh, const MeshBlocks& blocks, std::size_t number,
  std::vector<std::uint32_t>& points);

}

#endif
