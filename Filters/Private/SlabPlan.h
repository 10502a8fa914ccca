// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_SlabPlan_h
#define vtkIsodiamond_SlabPlan_h

#include "Private/Input.h"

#include <functional>
#include <memory>

class vtkAlgorithm;
class vtkInformation;

namespace vtkIsodiamond
{

class Slabs;

/** Finds the array to process. */
using ArrayFinder = std::function<InputArray(vtkDataSet*)>;

/** How the input of a filter comes: at once, or in slabs, to it alone or to peers of other
 * processes, each of which has its share of them. Decided before it is read. */
class SlabPlan
{
public:
  /**
   * For RequestUpdateExtent: decides, and asks upstream for the whole input, or for one slab.
   *
   * @param canBeCut whether the filter can do with slabs
   * @param blocks how many there should be; 0 for one, or for one a process of those that work
   *        together, or for as many as keep the input within what memory is there
   */
  void Request(vtkInformation* input, vtkInformation* output, bool canBeCut, int blocks);

  /** For ModifyRequest: who gets nothing from upstream is not executed, and tells its peers, who
   *  would wait for it. */
  void Note(vtkAlgorithm* filter, vtkInformation* request, int when);

  int NumberOfSlabs() const { return this->Count; }

  /** For RequestData.
   *  @return null if the input is there at once; as it is where cells turn out to be hidden
   *  @throws std::exception if it cannot be had, here or by a peer */
  std::unique_ptr<Slabs> Open(vtkInformation* input, ArrayFinder findArray);

private:
  int Count = 1;
  bool IsShared = false;
  bool IsPeerWithout = false; ///< whether one of the peers has not got what it asked for
};

}

#endif
