// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Piece_h
#define vtkIsodiamond_Piece_h

#include "Mesh/ExtractionPasses.h"

#include <cstdint>

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

struct Mesh;

/** Asks for the whole input: a hierarchy of a part of a volume is another hierarchy, and of a part
 *  of a hierarchy there is no mesh. */
void RequestWhole(vtkInformation* inputInformation);

/**
 * Notes the piece and the number of pieces that a filter's output is asked for. For ModifyRequest,
 * which has both: composite inputs are iterated over by the pipeline, and for every block of theirs
 * RequestData is asked for piece 0 of 1.
 *
 * @param piece its number, and number of pieces
 */
void NotePiece(vtkAlgorithm* filter, vtkInformation* request, int when, int piece[2]);

/**
 * Refuses a part of a volume where several processes are to share its mesh: of other parts in other
 * processes the meshes would not fit. A simulation may have a part in each process, for instance,
 * and ignore what it is asked for.
 *
 * @throws std::invalid_argument
 */
void CheckWhole(vtkDataObject* volume, vtkInformation* inputInformation, const int piece[2]);

/** The cells of a share: those from cells * piece / pieces until the same of the next piece. Shares
 *  differ by at most one cell; where there are more of them than cells, some have none.
 *  @param cells their number in the whole mesh @param piece its number, and number of pieces */
isodiamond::CellRange ShareOf(std::int64_t cells, const int piece[2]);

/**
 * Leaves a share of a mesh: its cells, and the points that these use, both in the mesh's order,
 * with all their data. All shares together have each cell once; points between two are in both, the
 * same to the bit.
 *
 * @throws std::bad_alloc if there is no memory for a copy
 */
void KeepShare(const int piece[2], Mesh& mesh);

}

#endif
