// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Parts_h
#define vtkIsodiamond_Parts_h

#include "Private/Parallel/ControllerPeers.h"

#include "vtkSmartPointer.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkInformation;
class vtkUnsignedCharArray;

namespace vtkIsodiamond
{

/** Bounds of sample indices, like VTK's extents. */
using Extent = std::array<int, 6>;

/**
 * An image of which each process has a part, whatever it is asked for, as those of a simulation
 * have: together the parts make the whole. They may overlap. Ghost cells around a part do not
 * count: their data come from the process that owns them.
 *
 * All processes call the same functions, each of which waits for the others.
 */
class Parts
{
public:
  /** As the owner of a result: all processes. */
  static constexpr int Everyone = -1;

  /** @param input its image is the part of this process, as long as this object lives
   *  @throws std::exception in all processes if parts do not fit: they must have the same place in
   *          the world and the same point arrays, and leave no sample out */
  Parts(vtkInformation* input, const ControllerPeers& peers);

  /**
   * Some slices of the whole, with the arrays at the points, and what is blanked.
   *
   * @param first, last slice numbers, from 0
   * @param only the one array of this process's part that is wanted; null for all
   * @param owner the process that is to have them, or Everyone
   * @return null in processes that are not
   * @throws std::exception in all processes if there is a problem in one
   */
  vtkSmartPointer<vtkImageData> Gather(int first, int last, vtkDataArray* only, int owner) const;

  /** Whether any cells or points of the whole are blanked. */
  bool HaveBlanks() const { return this->Blanks; }

private:
  /** An array and where its tuples are. */
  struct Located
  {
    vtkSmartPointer<vtkDataArray> Array;
    Extent Of{};
    bool IsOfCells = false;
    bool AreScalars = false; ///< the active ones
  };

  std::vector<Located> ArraysIn(const Extent& extent, vtkDataArray* only) const;
  void Exchange(const Extent& slices, int target, std::vector<Located>& arrays) const;
  vtkSmartPointer<vtkImageData> ImageOf(
    const Extent& slices, const std::vector<Located>& arrays) const;

  mutable ControllerPeers Others; ///< an interface to other processes
  vtkSmartPointer<vtkImageData> Own;
  vtkSmartPointer<vtkUnsignedCharArray> BlankPoints;
  vtkSmartPointer<vtkUnsignedCharArray> BlankCells;
  Extent Whole{};
  std::vector<Extent> Extents; ///< of all processes' parts, without ghosts
  bool Blanks = false;
};

}

#endif
