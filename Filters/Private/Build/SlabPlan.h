// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_SlabPlan_h
#define vtkIsodiamond_SlabPlan_h

#include "Private/Input/Volume.h"
#include "Private/Parallel/ControllerPeers.h"

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

/** How a filter's input arrives: at once or in slabs, in one process alone or in peers, each of
 * which has its share of the slabs. Decided before it is read or, where upstream gives each process
 * a part other than it was asked for, as a simulation may, when that is seen. */
class SlabPlan
{
public:
  /**
   * For RequestUpdateExtent: decides, and asks upstream for the whole input, or for one slab.
   *
   * @param blocks how many slabs there should be: 1 if the filter cannot work on slabs; 0 for one,
   *        or for one per process of those that work together, or for as many as keep the input
   *        within free memory
   */
  void Request(vtkInformation* input, vtkInformation* output, int blocks);

  /** For ModifyRequest: a process that gets nothing from upstream does not execute, and tells its
   *  peers, which would wait for it; one that gets another part tells them, too.
   *  @param isSame whether all processes have got the same image */
  void Note(vtkAlgorithm* filter, vtkInformation* request, int when, bool isSame);

  /**
   * Runs work(task) of RequestData: if it fails in one of the peers, it fails in all. Then the
   * output counts as not made, so that the next update executes all of them again, or none: in a
   * process that got nothing from upstream, or stopped it, VTK executes the filter whatever has
   * changed.
   */
  int Execute(vtkAlgorithm* filter, vtkInformation* output, const std::function<void(Task&)>& work);

  int NumberOfSlabs() const { return this->Count; }

  /** The peers that make one hierarchy together, from parts; null if there are none. */
  isodiamond::Peers* Together()
  {
    return this->AreParts || this->IsShared ? &*this->Peers : nullptr;
  }

  /** Whether the input is a part of the whole: a slab, or what a peer has. */
  bool IsAPart() const { return this->Count > 1 || this->AreParts; }

  /** For RequestData.
   *  @param closeBoundary whether the volume is to be padded: if it is there at once, by whoever
   *         reads it
   *  @return null if the input is there at once, see TakeWhole(); also if cells turn out to be
   *          hidden
   *  @throws std::exception if the input cannot be had, here or by a peer */
  std::unique_ptr<Slabs> Open(vtkInformation* input, ArrayFinder findArray, bool closeBoundary);

  /** The input that is there at once: as upstream gave it, or put together from what the peers
   *  have, only once. */
  vtkSmartPointer<vtkDataObject> TakeWhole(vtkInformation* input);

private:
  std::unique_ptr<Slabs> OpenParts(
    vtkInformation* input, ArrayFinder findArray, bool closeBoundary);
  void GetAtOnce(vtkInformation* input);

  std::optional<ControllerPeers> Peers; ///< those that execute the filter together, on images
  int Blocks = 0;                       ///< how many are asked for
  int Count = 1;
  bool IsShared = false;
  bool IsPeerWithout = false; ///< whether one of the peers got nothing
  bool AreParts = false;      ///< whether each has a part, and not a slab that it asked for
  bool AskedForParts = false; ///< whether each asked for one
  vtkSmartPointer<vtkImageData> Gathered;
};

}

#endif
