// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_PointData_h
#define vtkIsodiamond_PointData_h

#include "Mesh/MeshPoints.h"
#include "Private/Input.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkPointData;

/**
 * @file PointData.h
 * What a mesh's points have besides a position and the field's value.
 */
namespace vtkIsodiamond
{

/** Writes what it has to say of one point; of several at once from several threads. */
using PointWriter = std::function<void(const isodiamond::MeshPoint& point)>;

/** Makes arrays for a number of points, and returns what fills them. */
using PointDataMaker = std::function<std::vector<PointWriter>(vtkIdType count, vtkPointData*)>;

/** What to take from a volume. */
struct VolumePointData
{
  bool Normals = false;   ///< "Normals", of the full-resolution gradient
  bool Gradients = false; ///< "Gradient", in field units by world units
  bool Others = false;    ///< all other point arrays, interpolated trilinearly
  /** Of the others these only, if there are any. */
  std::vector<std::string> Names = {};

  bool operator==(const VolumePointData& other) const
  {
    return this->Normals == other.Normals && this->Gradients == other.Gradients &&
      this->Others == other.Others && this->Names == other.Names;
  }
};

/**
 * Normals, gradients and other point arrays of a volume at points of its meshes. Points in the
 * padding have the values of the grid's boundary.
 *
 * @param volume must outlive what this makes
 */
PointDataMaker FromVolume(const Volume& volume, const VolumePointData& wanted);

/** The arrays that a hierarchy keeps one value a stored point of, at points of its meshes. @param
 *  arrays must outlive what this makes */
PointDataMaker FromHierarchy(const isodiamond::IsodiamondHierarchy& hierarchy,
  const std::vector<vtkSmartPointer<vtkDataArray>>& arrays);

/** @param contoured the array that meshes have anyway, and which may be among the names
 *  @throws std::invalid_argument if another one that is wanted by name is not there */
void CheckNames(const VolumePointData& wanted, const std::string& contoured,
  const std::vector<vtkSmartPointer<vtkDataArray>>& arrays);

/** Makes such arrays. @throws std::invalid_argument if the volume lacks one that is wanted */
std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Volume& volume,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::ParallelFor& parallelFor);

}

#endif
