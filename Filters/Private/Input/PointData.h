// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_PointData_h
#define vtkIsodiamond_PointData_h

#include "Mesh/MeshPoints.h"
#include "Private/Input/Volume.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkPointData;

/**
 * @file PointData.h
 * What a mesh's points have besides a position and the field's value.
 */
namespace vtkIsodiamond
{

/** Writes its data for some points; several threads may write for several groups at once. */
using PointWriter = std::function<void(const isodiamond::PointGroup& points)>;

/** A writer of each point for itself. @param write (point) */
template <typename Write>
PointWriter OneByOne(Write write)
{
  return [write](const isodiamond::PointGroup& points)
  {
    for (const isodiamond::MeshPoint& point : points)
    {
      write(point);
    }
  };
}

/** A writer that writes what several do, in one pass over the points. */
inline PointWriter Together(std::vector<PointWriter> writers)
{
  return [writers = std::move(writers)](const isodiamond::PointGroup& points)
  {
    for (const PointWriter& write : writers)
    {
      write(points);
    }
  };
}

/** Makes arrays for a number of points, and returns the writers that fill them. */
using PointDataMaker = std::function<std::vector<PointWriter>(vtkIdType count, vtkPointData*)>;

/** What to take from a volume. */
struct VolumePointData
{
  bool Normals = false;   ///< "Normals", of the full-resolution gradient
  bool Gradients = false; ///< "Gradient", in field units per world unit
  bool Others = false;    ///< all other point arrays, interpolated trilinearly
  /** Only these of the others, if any are named. */
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

/** The arrays of which a hierarchy keeps one value per stored point, at points of its meshes.
 *  @param arrays must outlive what this makes */
PointDataMaker FromHierarchy(const isodiamond::IsodiamondHierarchy& hierarchy,
  const std::vector<vtkSmartPointer<vtkDataArray>>& arrays);

/** @param contoured the array that meshes have anyway; it may be among the names
 *  @throws std::invalid_argument if another one that is wanted by name is missing */
void CheckNames(const VolumePointData& wanted, const std::string& contoured,
  const std::vector<vtkSmartPointer<vtkDataArray>>& arrays);

/** Makes such arrays. @throws std::invalid_argument if the volume lacks one that is wanted */
std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Volume& volume,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::ParallelFor& parallelFor);

}

#endif
