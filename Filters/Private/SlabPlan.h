// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_SlabPlan_h
#define vtkIsodiamond_SlabPlan_h

#include "Private/ControllerPeers.h"
#include "Private/Input.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <optional>

class vtkAlgorithm;
class vtkDataObject;
class vtkImageData;
class vtkInformation;

namespace vtkIsodiamond
{

class Slabs;
class Task;

/** Finds the array to process. */
using ArrayFinder = std::function<InputArray(vtkDataSet*)>;

/** How the input of a filter comes: at once, or in slabs, to it alone or to peers of other
 * processes, each of which has its share of them. Decided before it is read; where upstream gives
 * each process another part than it was asked for, as a simulation may, when that is seen. */
class SlabPlan
{
public:
  /**
   * For RequestUpdateExtent: decides, and asks upstream for the whole input, or for one slab.
   *
   * @param blocks how many there should be: 1 if the filter cannot do with slabs; 0 for one, or for
   *        one a process of those that work together, or for as many as keep the input within what
   *        memory is there
   */
  void Request(vtkInformation* input, vtkInformation* output, int blocks);

  /** For ModifyRequest: who gets nothing from upstream is not executed, and tells its peers, who
   *  would wait for it; who gets another part, too. */
  void Note(vtkAlgorithm* filter, vtkInformation* request, int when);

  /**
   * Runs work(task) of RequestData: if it fails for one of the peers it fails for all. Then the
   * output counts as not made, so that the next update executes all of them again, or none: of who
   * got nothing from upstream, or stopped it, VTK executes the filter whatever has changed.
   */
  int Execute(vtkAlgorithm* filter, vtkInformation* output, const std::function<void(Task&)>& work);

  int NumberOfSlabs() const { return this->Count; }

  /** Who makes one hierarchy together, of parts; null for nobody. */
  isodiamond::Peers* Together()
  {
    return this->AreParts || this->IsShared ? &*this->Peers : nullptr;
  }

  /** Whether the input is a part of the whole: a slab, or what a peer has. */
  bool IsAPart() const { return this->Count > 1 || this->AreParts; }

  /** For RequestData.
   *  @param closeBoundary whether the volume is to be padded: where it is at hand by who reads it
   *  @return null if the input is there at once: TakeWhole(); as where cells turn out to be hidden
   *  @throws std::exception if it cannot be had, here or by a peer */
  std::unique_ptr<Slabs> Open(vtkInformation* input, ArrayFinder findArray, bool closeBoundary);

  /** The input that is there at once: as upstream gave it, or put together of what peers have, once
   *  only. */
  vtkSmartPointer<vtkDataObject> TakeWhole(vtkInformation* input);

private:
  std::unique_ptr<Slabs> OpenParts(
    vtkInformation* input, ArrayFinder findArray, bool closeBoundary);

  std::optional<ControllerPeers> Peers; ///< who execute the filter together, on images
  int Blocks = 0;                       ///< how many are asked for
  int Count = 1;
  bool IsShared = false;
  bool IsPeerWithout = false; ///< whether one of the peers has got nothing
  bool AreParts = false;      ///< whether one of them has got another part than it asked for
  vtkSmartPointer<vtkImageData> Gathered;
};

}

#endif
