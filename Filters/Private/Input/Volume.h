// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Volume_h
#define vtkIsodiamond_Volume_h

#include "Field/Samples.h"
#include "Hierarchy/IsodiamondHierarchy.h"
#include "Private/Input/Grid.h"

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <optional>
#include <string>

class vtkDataArray;
class vtkDataObject;
class vtkInformation;

namespace vtkIsodiamond
{

class Slabs;

/** The volume that a filter works on: samples in index space, and where they are in the world. */
struct Volume
{
  vtkSmartPointer<vtkDataSet> Grid;
  std::array<int, 3> Dimensions{};     ///< of the grid
  int Padding = 0;                     ///< layers of samples around it, if its boundary is closed
  vtkSmartPointer<vtkDataArray> Array; ///< holds the samples, one component
  isodiamond::AnySamples Samples;
  Geometry Placement; ///< of the samples, padding included
  isodiamond::HiddenCells Hidden;
  std::string ArrayName;
  /** Where the samples come from if they are not at hand: then the members above have neither them
   *  nor other arrays, and their number is 0. */
  const Slabs* InSlabs = nullptr;

  /** Dimensions of the samples, padding included. */
  std::array<int, 3> SampleDimensions() const;
};

/** An array and what it belongs to, a vtkDataObject::FIELD_ASSOCIATION_... */
struct InputArray
{
  vtkDataArray* Array = nullptr;
  int Association = -1;
};

/**
 * The array that a filter is to process: the one it found itself, or the point scalars if the
 * request names none. ParaView makes such a request for an input that has not been updated yet.
 *
 * @param request vtkAlgorithm::GetInputArrayInformation
 */
InputArray OrScalars(const InputArray& found, vtkInformation* request, vtkDataObject* input);

/** The largest finite value minus the smallest; nothing without an array, or if that is 0. */
std::optional<double> ExtentOfValues(vtkDataArray* array);

/** Distance tolerances beyond this part of the grid's diagonal are of little use. */
inline constexpr double DistanceOfInterest = 0.02;

/** The largest error tolerance that is worth trying on a grid's array: with the distance metric a
 * part of the diagonal, with the field metric the extent of the values; 1 while there is no
 * input. */
double LargestTolerance(
  isodiamond::ErrorMetric metric, vtkDataObject* input, const InputArray& array);

/**
 * A grid's array as samples.
 *
 * @param grid an image, rectilinear grid or structured grid
 * @param closeBoundary pad by one layer of the data's minimum on all six sides
 * @param minimum of all the data, if the grid has only some of them
 * @throws std::invalid_argument saying why the grid or the array cannot be used
 */
Volume ReadVolume(vtkDataSet* grid, const InputArray& array, bool closeBoundary,
  std::optional<double> minimum = {});

/** Views an array's samples as a volume of given dimensions. @return false for an unknown type. */
bool ViewSamples(
  vtkDataArray* array, const std::array<int, 3>& dimensions, isodiamond::AnySamples& samples);

}

#endif
