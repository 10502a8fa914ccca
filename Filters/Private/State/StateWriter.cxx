// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Common/Arrays.h"
#include "Private/State/Format.h"
#include "Private/State/State.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkTypeUInt16Array.h"
#include "vtkTypeUInt32Array.h"
#include "vtkTypeUInt64Array.h"
#include "vtkTypeUInt8Array.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

template <typename Array, typename T>
void AddArray(vtkFieldData* fieldData, const char* name, const std::vector<T>& values)
{
  const auto array = NewArray<Array>(name, static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  fieldData->AddArray(array);
}

/** Samples of a VTK type. */
void AddSamples(
  vtkFieldData* fieldData, const char* name, int type, const void* values, std::int64_t count)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name);
  AllocateTuples(array, count);
  const char* bytes = static_cast<const char*>(values);
  std::copy(
    bytes, bytes + count * array->GetDataTypeSize(), static_cast<char*>(array->GetVoidPointer(0)));
  fieldData->AddArray(array);
}

void AddSamples(vtkFieldData* fieldData, const char* name, const isodiamond::AnyValues& values)
{
  // In the order of the alternatives.
  constexpr std::array<int, 10> types = { VTK_FLOAT, VTK_DOUBLE, VTK_TYPE_INT8, VTK_TYPE_UINT8,
    VTK_TYPE_INT16, VTK_TYPE_UINT16, VTK_TYPE_INT32, VTK_TYPE_UINT32, VTK_TYPE_INT64,
    VTK_TYPE_UINT64 };
  static_assert(types.size() == std::variant_size_v<isodiamond::AnyValues>);
  std::visit(
    [&](const auto& array)
    {
      AddSamples(fieldData, name, types[values.index()], array.data(),
        static_cast<std::int64_t>(array.size()));
    },
    values);
}

/** The outline box of the grid: 8 corners and 12 edges. */
void WriteOutline(
  const std::array<int, 3>& dimensions, const isodiamond::AffineMap& world, vtkPolyData* output)
{
  const isodiamond::Point last = { dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 };
  vtkNew<vtkPoints> points;
  points->SetDataType(isodiamond::GridGeometry(world).FitsFloats(last) ? VTK_FLOAT : VTK_DOUBLE);
  vtkNew<vtkCellArray> lines;
  for (int corner = 0; corner < 8; ++corner)
  {
    const std::array<double, 3> point = world((corner & 1) != 0 ? last[0] : 0,
      (corner & 2) != 0 ? last[1] : 0, (corner & 4) != 0 ? last[2] : 0);
    points->InsertNextPoint(point.data());
    for (int axis = 1; axis < 8; axis *= 2)
    {
      if ((corner & axis) == 0)
      {
        const vtkIdType ends[2] = { corner, corner + axis };
        lines->InsertNextCell(2, ends);
      }
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
}

void WriteHeader(const isodiamond::EncodingHeader& header, const Choice& choice,
  const isodiamond::AffineMap& world, const std::string& arrayName, vtkFieldData* fieldData)
{
  std::vector<std::int64_t> values(HeaderAt::Size);
  values[HeaderAt::Version] = format::Version;
  values[HeaderAt::Model] = static_cast<int>(header.TheModel);
  values[HeaderAt::Shape] = static_cast<int>(choice.Shape);
  std::copy(
    header.Dimensions.begin(), header.Dimensions.end(), values.begin() + HeaderAt::Dimensions);
  values[HeaderAt::RelevantCount] = header.RelevantCount;
  values[HeaderAt::Metric] = static_cast<int>(header.Metric);
  values[HeaderAt::ExactIsovertices] = header.ExactIsovertices ? 1 : 0;
  values[HeaderAt::TwoSided] = header.TwoSided ? 1 : 0;
  values[HeaderAt::PreservesTopology] = header.PreservesTopology ? 1 : 0;
  values[HeaderAt::MinimumPieceSize] = header.MinimumPieceSize;
  values[HeaderAt::RemovedPieces] = header.RemovedPieces;
  AddArray<vtkTypeInt64Array>(fieldData, format::Header, values);
  std::vector<double> parameters(ParameterAt::Size);
  parameters[ParameterAt::Isovalue] = choice.Isovalue;
  std::copy(
    choice.Isorange.begin(), choice.Isorange.end(), parameters.begin() + ParameterAt::Isorange);
  parameters[ParameterAt::ErrorScale] = header.ErrorScale;
  parameters[ParameterAt::FieldScale] = header.FieldScale;
  for (int i = 0; i < 12; ++i)
  {
    parameters[ParameterAt::World + i] = world.Rows[i / 4][i % 4];
  }
  AddArray<vtkDoubleArray>(fieldData, format::Parameters, parameters);
  vtkNew<vtkStringArray> name;
  name->SetName(format::ArrayName);
  name->InsertNextValue(arrayName.c_str());
  fieldData->AddArray(name);
}

/** The header of an HD. */
void WriteScalarsHeader(const std::array<int, 3>& dimensions, double errorScale,
  const Choice& choice, bool exactIsovertices, const isodiamond::AffineMap& world,
  const std::string& arrayName, vtkFieldData* fieldData)
{
  isodiamond::EncodingHeader header;
  header.TheModel = isodiamond::Model::HierarchyOfDiamonds;
  header.Dimensions = dimensions;
  header.Region = choice.Region();
  header.ErrorScale = errorScale;
  header.FieldScale = errorScale;
  header.ExactIsovertices = exactIsovertices;
  WriteHeader(header, choice, world, arrayName, fieldData);
}

/** Numbers for users who look at the field data, in ParaView's Information for instance. */
void WriteNumbers(const isodiamond::Encoding& encoding, vtkFieldData* fieldData)
{
  const isodiamond::EncodingHeader& header = encoding.Header;
  const std::array<std::pair<const char*, std::int64_t>, 6> numbers = { {
    { format::NumberOfActiveIsodiamonds, header.ActiveCount },
    { format::NumberOfRelevantIsodiamonds, header.RelevantCount },
    { format::NumberOfCreationIsodiamonds, header.CreationCount },
    { format::NumberOfIsovertices, static_cast<std::int64_t>(encoding.Arrays.Isovertices.size()) },
    { format::NumberOfRemovedPieces, header.RemovedPieces },
    { format::StorageSize, isodiamond::EncodingView(encoding).StorageSize() },
  } };
  for (const auto& [name, number] : numbers)
  {
    AddArray<vtkTypeInt64Array>(fieldData, name, std::vector<std::int64_t>{ number });
  }
}

/** The same for ParaView's panels: the extractor's slider, and the values that it begins with. */
void WriteDefaults(const Choice& choice, vtkFieldData* fieldData)
{
  AddArray<vtkDoubleArray>(
    fieldData, format::LargestErrorTolerance, std::vector<double>{ LargestTolerance(fieldData) });
  AddArray<vtkDoubleArray>(fieldData, format::Isovalue, std::vector<double>{ choice.Isovalue });
  AddArray<vtkDoubleArray>(fieldData, format::Isorange,
    std::vector<double>(choice.Isorange.begin(), choice.Isorange.end()));
}

}

void RemoveState(vtkFieldData* fieldData)
{
  const std::set<std::string> numbers = { format::LargestErrorTolerance, format::Isovalue,
    format::Isorange, format::NumberOfActiveIsodiamonds, format::NumberOfRelevantIsodiamonds,
    format::NumberOfCreationIsodiamonds, format::NumberOfIsovertices, format::NumberOfRemovedPieces,
    format::StorageSize };
  for (int i = fieldData->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    const char* name = fieldData->GetAbstractArray(i)->GetName();
    if (format::IsOfHierarchy(name) || (name && numbers.count(name) > 0))
    {
      fieldData->RemoveArray(i);
    }
  }
}

void WriteIsodiamonds(const isodiamond::Encoding& encoding, const Choice& choice,
  const isodiamond::AffineMap& world, const std::string& arrayName,
  const std::vector<vtkSmartPointer<vtkDataArray>>& pointArrays, vtkPolyData* output)
{
  WriteOutline(encoding.Header.Dimensions, world, output);
  vtkFieldData* fieldData = output->GetFieldData();
  WriteHeader(encoding.Header, choice, world, arrayName, fieldData);
  AddArray<vtkTypeUInt32Array>(fieldData, format::BrickCounts, encoding.Arrays.BrickCounts);
  AddArray<vtkTypeUInt32Array>(fieldData, format::BrickIndices, encoding.Arrays.BrickIndices);
  AddArray<vtkTypeUInt64Array>(fieldData, format::BrickMasks, encoding.Arrays.BrickMasks);
  AddArray<vtkTypeUInt16Array>(fieldData, format::Records, encoding.Arrays.Records);
  AddArray<vtkTypeUInt8Array>(fieldData, format::Isovertices, encoding.Arrays.Isovertices);
  if (encoding.Header.Region.IsVolume())
  {
    AddSamples(fieldData, format::InsideValues, encoding.InsideValues);
  }
  if (!encoding.Arrays.InteriorCodes.empty())
  {
    AddArray<vtkTypeUInt16Array>(fieldData, format::InteriorCodes, encoding.Arrays.InteriorCodes);
  }
  if (!encoding.Arrays.Followers.empty())
  {
    AddArray<vtkTypeUInt64Array>(fieldData, format::Followers, encoding.Arrays.Followers);
  }
  WriteNumbers(encoding, fieldData);
  WriteDefaults(choice, fieldData);
  for (vtkDataArray* array : pointArrays)
  {
    array->SetName((std::string(format::PointDataPrefix) + array->GetName()).c_str());
    fieldData->AddArray(array);
  }
}

void WriteDefaultsOfQueries(
  const State& state, const Choice& choice, bool exactIsovertices, vtkPolyData* output)
{
  const isodiamond::ScalarHierarchy& scalars = *state.Scalars;
  vtkFieldData* fieldData = output->GetFieldData();
  WriteScalarsHeader(scalars.SampleGrid().Dimensions(), scalars.Codes().Scale(), choice,
    exactIsovertices, state.World, state.ArrayName, fieldData);
  WriteDefaults(choice, fieldData);
}

void WriteScalars(const isodiamond::ScalarEncoding& encoding, const Choice& choice,
  bool exactIsovertices, const Volume& volume, vtkPolyData* output)
{
  const std::array<int, 3> dimensions =
    std::visit([](const auto& view) { return view.Dimensions(); }, volume.Samples);
  const isodiamond::AffineMap& world = *volume.Placement.World.Affine();
  WriteOutline(dimensions, world, output);
  vtkFieldData* fieldData = output->GetFieldData();
  WriteScalarsHeader(
    dimensions, encoding.ErrorScale, choice, exactIsovertices, world, volume.ArrayName, fieldData);
  // A copy: the input's own array, if shared, would be renamed for the input, too.
  AddSamples(fieldData, format::Samples, volume.Array->GetDataType(),
    volume.Array->GetVoidPointer(0), volume.Array->GetNumberOfTuples());
  AddArray<vtkTypeUInt16Array>(fieldData, format::Errors, encoding.Codes);
  AddSamples(fieldData, format::Minima, encoding.Minima);
  AddSamples(fieldData, format::Maxima, encoding.Maxima);
  WriteDefaults(choice, fieldData);
}

}
