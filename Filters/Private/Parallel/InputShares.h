// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_InputShares_h
#define vtkIsodiamond_InputShares_h

#include "Private/Extraction/Share.h"

#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformation;

namespace vtkIsodiamond
{

/**
 * Which share of a mesh a process makes of each of its inputs.
 *
 * In parallel every process makes its share of the mesh of the whole input. But blocks of a
 * composite input may be distributed, as those of a simulation are, whatever is asked for: then the
 * processes that have a block, mostly one alone, deal its mesh out among themselves.
 */
class InputShares
{
public:
  /**
   * For ModifyRequest: notes what the output is asked for, and which processes have which blocks.
   * RequestData does not know: the pipeline iterates over composite inputs, and for each of their
   * blocks asks for piece 0 of 1.
   */
  void Note(vtkAlgorithm* filter, vtkInformation* request, int when);

  /** The share of the mesh of an input, or of one of its blocks. */
  Share Of(vtkDataObject* input) const;

  /** Whether the filter's input is one grid, and all processes have the same. */
  bool IsSameGrid() const { return this->Same; }

  /**
   * Refuses a part of a volume where several processes are to share its mesh: the meshes of other
   * parts in other processes would not fit. Images of processes that execute together do not come
   * here in parts: see Parts.h.
   *
   * @throws std::invalid_argument
   */
  void CheckWhole(vtkDataObject* volume, vtkInformation* inputInformation) const;

private:
  void Compare(vtkDataObject* input);

  Share Asked;
  std::vector<std::pair<vtkDataObject*, Share>> OfBlocks; ///< only compared, as the input owns them
  bool Same = false;
};

}

#endif
