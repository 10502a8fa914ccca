// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Share_h
#define vtkIsodiamond_Share_h

#include "Mesh/ExtractionPasses.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

/**
 * @file Share.h
 * In parallel every process has the whole hierarchy, and gives its share of the mesh. See
 * docs/parallel.md.
 */
namespace vtkIsodiamond
{

struct Ghosts;
struct Mesh;

/** What of a mesh a process is asked for. */
struct Share
{
  std::array<int, 2> Piece = { 0, 1 }; ///< its number, and the number of pieces
  int GhostLevels = 0;                 ///< of cells of other pieces around it, marked as ghosts
  /** The ids of the whole mesh's first point and cell among those of all meshes, if ids are to be
   *  the same in all processes. */
  std::optional<std::array<vtkIdType, 2>> FirstIds;

  bool HasGhosts() const { return this->GhostLevels > 0 && this->Piece[1] > 1; }

  /** For an extraction. A share with ghosts or ids of the whole needs all cells to be counted. */
  isodiamond::MeshShare OfMesh() const;
};

/**
 * Reduces a mesh to a share: of its n cells those from n p / N until n (p + 1) / N for piece p of
 * N, and the points that these use, both in the mesh's order, with all their data; then ghosts. All
 * shares together have each cell once; points between two are in both, identical to the bit.
 *
 * @throws std::bad_alloc if there is no memory for a copy
 */
void KeepShare(const Share& share, Mesh& mesh);

/**
 * Gives a share's points and cells their ids in the whole, and marks what belongs to another share:
 * cells of another one, points that an earlier one has, too. Adds only what the share asks for.
 *
 * @param points ids in the whole mesh, of all points here
 * @param own cells; ghosts follow
 */
void AddOrigins(const Share& share, const std::vector<vtkIdType>& points,
  const std::vector<isodiamond::CellRange>& own, const Ghosts& ghosts, Mesh& mesh);

}

#endif
