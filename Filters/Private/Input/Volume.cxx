// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Input/Volume.h"

#include "Private/Common/Arrays.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkPointData.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

namespace vtkIsodiamond
{
namespace
{

/** The type that the core has for one of VTK's, which has several names for integers of one size.
 */
template <typename T>
auto CoreType()
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return T();
  }
  else if constexpr (sizeof(T) == 1)
  {
    return std::conditional_t<std::is_signed_v<T>, std::int8_t, std::uint8_t>();
  }
  else if constexpr (sizeof(T) == 2)
  {
    return std::conditional_t<std::is_signed_v<T>, std::int16_t, std::uint16_t>();
  }
  else if constexpr (sizeof(T) == 4)
  {
    return std::conditional_t<std::is_signed_v<T>, std::int32_t, std::uint32_t>();
  }
  else
  {
    return std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>();
  }
}

template <typename T>
isodiamond::AnySamples SamplesOf(vtkDataArray* array, const std::array<int, 3>& dimensions)
{
  using To = decltype(CoreType<T>());
  static_assert(sizeof(T) == sizeof(To), "one type under two names");
  return isodiamond::SampleView<To>(static_cast<const To*>(array->GetVoidPointer(0)), dimensions);
}

/** A copy with one layer of the minimum on all six sides. @param padded its dimensions */
vtkSmartPointer<vtkDataArray> PaddedCopy(vtkDataArray* array, const std::array<int, 3>& dimensions,
  const std::array<int, 3>& padded, double minimum)
{
  auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  copy->SetNumberOfComponents(1);
  AllocateTuples(copy, vtkIdType{ 1 } * padded[0] * padded[1] * padded[2]);
  copy->Fill(minimum);
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      const vtkIdType from = isodiamond::SampleIndex(dimensions, { 0, y, z });
      const vtkIdType to = isodiamond::SampleIndex(padded, { 1, y + 1, z + 1 });
      copy->InsertTuples(to, dimensions[0], from, array);
    }
  }
  return copy;
}

/** What a grid has instead of an array to contour, for a message. */
std::string OtherArrays(vtkDataSet* grid)
{
  std::string text;
  for (int i = 0; i < grid->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = grid->GetPointData()->GetAbstractArray(i);
    const int components = array->GetNumberOfComponents();
    text += (text.empty() ? " It has \"" : ", \"") +
      std::string(array->GetName() ? array->GetName() : "") + "\"" +
      (components != 1 ? " with " + std::to_string(components) + " components" : "");
  }
  text += text.empty() ? "" : ".";
  return grid->GetCellData()->GetNumberOfArrays() > 0
    ? text + " Cell data have to be converted to point data first."
    : text;
}

void CheckArray(const InputArray& inputArray, vtkDataSet* grid)
{
  vtkDataArray* array = inputArray.Array;
  if (!array)
  {
    throw std::invalid_argument(
      "There is no array to contour: the input has no such point data array." + OtherArrays(grid));
  }
  const std::string name =
    "Array \"" + std::string(array->GetName() ? array->GetName() : "") + "\" ";
  if (inputArray.Association != vtkDataObject::FIELD_ASSOCIATION_POINTS)
  {
    throw std::invalid_argument(name + "is not point data; convert cell data to point data first.");
  }
  if (array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(name + "has " + std::to_string(array->GetNumberOfComponents()) +
      " components; one is needed.");
  }
  if (array->GetNumberOfTuples() != grid->GetNumberOfPoints())
  {
    throw std::invalid_argument(name + "does not have one value for each point.");
  }
}

void CheckDimensions(const std::array<int, 3>& dimensions)
{
  constexpr int most = (1 << isodiamond::Grid::MaximumDepth) - 1; // room for a closed boundary
  for (const int samples : dimensions)
  {
    if (samples < 2 || samples > most)
    {
      throw std::invalid_argument("The grid needs 2 to " + std::to_string(most) +
        " samples on every axis; its dimensions are " + std::to_string(dimensions[0]) + " x " +
        std::to_string(dimensions[1]) + " x " + std::to_string(dimensions[2]) + ".");
    }
  }
}

}

bool ViewSamples(
  vtkDataArray* array, const std::array<int, 3>& dimensions, isodiamond::AnySamples& samples)
{
  switch (array->GetDataType())
  {
    vtkTemplateMacro(samples = SamplesOf<VTK_TT>(array, dimensions); return true);
  }
  return false;
}

InputArray OrScalars(const InputArray& found, vtkInformation* request, vtkDataObject* input)
{
  vtkDataSet* dataSet = vtkDataSet::SafeDownCast(input);
  const char* name = request->Get(vtkDataObject::FIELD_NAME());
  if (found.Array || !dataSet || !name || *name)
  {
    return found;
  }
  return { dataSet->GetPointData()->GetScalars(), vtkDataObject::FIELD_ASSOCIATION_POINTS };
}

std::optional<double> ExtentOfValues(vtkDataArray* array)
{
  if (!array || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() == 0)
  {
    return {};
  }
  double range[2];
  array->GetFiniteRange(range);
  return range[1] > range[0] ? std::optional<double>(range[1] - range[0]) : std::nullopt;
}

double LargestTolerance(
  isodiamond::ErrorMetric metric, vtkDataObject* input, const InputArray& array)
{
  if (metric == isodiamond::ErrorMetric::Field)
  {
    return ExtentOfValues(array.Array).value_or(1.0);
  }
  vtkDataSet* grid = vtkDataSet::SafeDownCast(input);
  const double length = grid && grid->GetNumberOfPoints() > 0 ? DiagonalOf(grid) : 0.0;
  return std::isfinite(length) && length > 0.0 ? DistanceOfInterest * length : 1.0;
}

std::array<int, 3> Volume::SampleDimensions() const
{
  const int both = 2 * this->Padding;
  return { this->Dimensions[0] + both, this->Dimensions[1] + both, this->Dimensions[2] + both };
}

Volume ReadVolume(
  vtkDataSet* grid, const InputArray& inputArray, bool closeBoundary, std::optional<double> minimum)
{
  if (!grid || grid->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument("The input is not a grid or is empty.");
  }
  const std::array<int, 3> dimensions = DimensionsOf(grid);
  CheckArray(inputArray, grid);
  CheckDimensions(dimensions);
  vtkDataArray* array = inputArray.Array;
  Volume volume;
  volume.Grid = grid;
  volume.Dimensions = dimensions;
  volume.Padding = closeBoundary ? 1 : 0;
  volume.Array = InRow(array);
  volume.ArrayName = array->GetName() ? array->GetName() : "";
  if (!ViewSamples(volume.Array, dimensions, volume.Samples))
  {
    throw std::invalid_argument(
      "Arrays of type " + std::string(array->GetDataTypeAsString()) + " are not supported.");
  }
  if (closeBoundary)
  {
    const double lowest = minimum ? *minimum : isodiamond::FiniteRange(volume.Samples).Minimum;
    const std::array<int, 3> padded = volume.SampleDimensions();
    volume.Array = PaddedCopy(volume.Array, dimensions, padded, lowest);
    ViewSamples(volume.Array, padded, volume.Samples);
  }
  volume.Placement = GeometryOf(grid, volume.Padding);
  volume.Hidden = HiddenCellsOf(grid, volume.Padding);
  return volume;
}

}
