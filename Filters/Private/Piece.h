// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Piece_h
#define vtkIsodiamond_Piece_h

#include "vtkType.h"

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

/**
 * @file Piece.h
 * In parallel every process makes the whole mesh, from the whole input, and keeps its share of it.
 * See docs/parallel.md.
 */
namespace vtkIsodiamond
{

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

/**
 * Leaves a piece of a mesh: its cells from cells * piece / pieces until the same of the next piece,
 * and the points that these use, both in the mesh's order, with all their data. All pieces together
 * have each cell once; points between two pieces are in both, the same to the bit. More pieces than
 * cells leave some without a cell, but with all arrays.
 *
 * @param mesh a vtkPolyData or vtkUnstructuredGrid, whose cells are of one kind
 * @param piece its number, and number of pieces
 * @throws std::bad_alloc if there is no memory for a copy
 */
void KeepPiece(vtkDataObject* mesh, const int piece[2]);

}

#endif
