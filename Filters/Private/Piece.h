// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Piece_h
#define vtkIsodiamond_Piece_h

#include "Mesh/ExtractionPasses.h"

#include "vtkType.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

/**
 * @file Piece.h
 * In parallel every process has the whole hierarchy, and gives its share of the mesh. See
 * docs/parallel.md.
 */
namespace vtkIsodiamond
{

struct Ghosts;
struct Mesh;

/** What a process is asked for of a mesh. */
struct Share
{
  std::array<int, 2> Piece = { 0, 1 }; ///< its number, and number of pieces
  int GhostLevels = 0; ///< of cells of the other pieces around it, that are marked as such
  /** The ids of the whole mesh's first point and cell among all meshes', if points and cells are to
   *  have ids that are the same in all processes. */
  std::optional<std::array<vtkIdType, 2>> FirstIds;

  bool HasGhosts() const { return this->GhostLevels > 0 && this->Piece[1] > 1; }

  /** For an extraction. What has ghosts or ids of all needs all cells to be counted. */
  isodiamond::MeshShare OfMesh() const;
};

/** Asks for the whole input: a hierarchy of a part of a volume is another hierarchy, and of a part
 *  of a hierarchy there is no mesh. */
void RequestWhole(vtkInformation* inputInformation);

/**
 * Notes the piece and the number of pieces that a filter's output is asked for. For ModifyRequest,
 * which has both: composite inputs are iterated over by the pipeline, and for every block of theirs
 * RequestData is asked for piece 0 of 1.
 *
 * @param piece its number, number of pieces, and number of ghost levels
 */
void NotePiece(vtkAlgorithm* filter, vtkInformation* request, int when, int piece[3]);

/**
 * Refuses a part of a volume where several processes are to share its mesh: of other parts in other
 * processes the meshes would not fit. Images of processes that execute together do not come here in
 * parts: see Parts.h.
 *
 * @throws std::invalid_argument
 */
void CheckWhole(vtkDataObject* volume, vtkInformation* inputInformation, const int piece[2]);

/**
 * Leaves a share of a mesh: of its n cells those from n p / N until n (p + 1) / N for piece p of N,
 * and the points that these use, both in the mesh's order, with all their data; then ghosts. All
 * shares together have each cell once; points between two are in both, the same to the bit.
 *
 * @throws std::bad_alloc if there is no memory for a copy
 */
void KeepShare(const Share& share, Mesh& mesh);

/**
 * Gives a share's points and cells ids of the whole, and marks what is another share's: a cell of
 * another one, a point that a share before has, too. Nothing that the share does not ask for.
 *
 * @param points ids in the whole mesh, of all that there are
 * @param own cells; ghosts follow
 */
void AddOrigins(const Share& share, const std::vector<vtkIdType>& points,
  const std::vector<isodiamond::CellRange>& own, const Ghosts& ghosts, Mesh& mesh);

}

#endif
