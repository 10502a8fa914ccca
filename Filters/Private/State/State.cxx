// SPDX-License-Identifier: BSD-3-Clause
#include "Private/State/State.h"

#include "Mesh/MeshPoints.h"
#include "Private/Common/Threads.h"
#include "Private/State/Format.h"

#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace vtkIsodiamond
{
namespace
{

/** All arrays of a hierarchy, and when each was last modified. */
std::vector<std::pair<vtkSmartPointer<vtkAbstractArray>, vtkMTimeType>> ArraysOf(
  vtkFieldData* fieldData)
{
  std::vector<std::pair<vtkSmartPointer<vtkAbstractArray>, vtkMTimeType>> arrays;
  for (int i = 0; i < fieldData->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = fieldData->GetAbstractArray(i);
    if (format::IsOfHierarchy(array->GetName()))
    {
      array->GetInformation(); // made when an array is first asked for its range: a modification
      arrays.emplace_back(array, array->GetMTime());
    }
  }
  return arrays;
}

/** Reads arrays by name, and checks their types. */
class Reader
{
public:
  Reader(vtkFieldData* fieldData, State& state)
    : FieldData(fieldData)
    , Target(state)
  {
  }

  bool Has(const char* name) const { return this->FieldData->GetAbstractArray(name) != nullptr; }

  vtkDataArray* Array(const char* name)
  {
    vtkDataArray* array = vtkDataArray::SafeDownCast(this->FieldData->GetAbstractArray(name));
    if (!array || array->GetNumberOfComponents() != 1 || !array->HasStandardMemoryLayout())
    {
      throw std::invalid_argument(
        "the field data array \"" + std::string(name) + "\" is missing or malformed");
    }
    return array;
  }

  /** An array of one of the fixed types; names of integer types may differ, sizes may not. */
  template <typename T>
  isodiamond::ArrayView<T> Values(const char* name)
  {
    vtkDataArray* array = this->Array(name);
    const int type = array->GetDataType();
    const bool floating = type == VTK_FLOAT || type == VTK_DOUBLE;
    if (array->GetDataTypeSize() != static_cast<int>(sizeof(T)) ||
      floating != std::is_floating_point_v<T>)
    {
      throw std::invalid_argument(
        "the field data array \"" + std::string(name) + "\" has the wrong type");
    }
    return { static_cast<const T*>(array->GetVoidPointer(0)), array->GetNumberOfTuples() };
  }

  /** An array that counts as part of the encoding. */
  template <typename T>
  isodiamond::ArrayView<T> Stored(const char* name)
  {
    const isodiamond::ArrayView<T> view = this->Values<T>(name);
    this->Target.StorageSize += static_cast<std::int64_t>(sizeof(T)) * view.Size;
    return view;
  }

  isodiamond::AnySamples Samples(const char* name, std::array<int, 3> dimensions)
  {
    vtkDataArray* array = this->Array(name);
    const std::int64_t size = array->GetNumberOfTuples();
    if (dimensions[0] == 0) // a plain row
    {
      if (size > std::numeric_limits<int>::max())
      {
        throw std::invalid_argument("the ranges are too many");
      }
      dimensions = { static_cast<int>(size), 1, 1 };
    }
    isodiamond::AnySamples samples;
    if (std::int64_t{ 1 } * dimensions[0] * dimensions[1] * dimensions[2] != size ||
      !ViewSamples(array, dimensions, samples))
    {
      throw std::invalid_argument("the samples do not match the dimensions");
    }
    this->Target.StorageSize += size * array->GetDataTypeSize();
    return samples;
  }

private:
  vtkFieldData* FieldData;
  State& Target;
};

void ReadIsodiamonds(
  Reader& reader, const isodiamond::EncodingHeader& header, int numberOfThreads, State& state)
{
  isodiamond::EncodingView view;
  view.Header = header;
  view.Arrays.BrickCounts = reader.Stored<std::uint32_t>(format::BrickCounts);
  view.Arrays.BrickIndices = reader.Stored<std::uint32_t>(format::BrickIndices);
  view.Arrays.BrickMasks = reader.Stored<std::uint64_t>(format::BrickMasks);
  view.Arrays.Records = reader.Stored<std::uint16_t>(format::Records);
  view.Arrays.Isovertices = reader.Stored<std::uint8_t>(format::Isovertices);
  if (header.Region.IsVolume())
  {
    view.InsideValues = reader.Samples(format::InsideValues, { 0, 1, 1 });
  }
  if (reader.Has(format::InteriorCodes))
  {
    view.Arrays.InteriorCodes = reader.Stored<std::uint16_t>(format::InteriorCodes);
  }
  if (reader.Has(format::Followers))
  {
    view.Arrays.Followers = reader.Stored<std::uint64_t>(format::Followers);
  }
  RunThreaded(numberOfThreads,
    [&] { state.Isodiamonds = std::make_unique<isodiamond::IsodiamondHierarchy>(view, SMPFor()); });
}

/** The other arrays at stored points, under their own names: copies that share the values. */
void ReadPointArrays(vtkFieldData* fieldData, State& state)
{
  const std::int64_t count = isodiamond::StoredPointCount(*state.Isodiamonds);
  for (int i = 0; i < fieldData->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* found = fieldData->GetAbstractArray(i);
    const std::string name = found->GetName() ? found->GetName() : "";
    if (name.rfind(format::PointDataPrefix, 0) != 0)
    {
      continue;
    }
    vtkDataArray* array = vtkDataArray::SafeDownCast(found);
    if (!array || array->GetDataType() == VTK_BIT || array->GetNumberOfComponents() < 1 ||
      array->GetNumberOfTuples() != count)
    {
      throw std::invalid_argument("the field data array \"" + name + "\" is malformed");
    }
    state.StorageSize += array->GetNumberOfValues() * array->GetDataTypeSize();
    auto own = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
    own->ShallowCopy(array);
    own->SetName(name.substr(std::strlen(format::PointDataPrefix)).c_str());
    state.PointArrays.push_back(own);
  }
}

void ReadScalars(Reader& reader, const isodiamond::EncodingHeader& header, State& state)
{
  const isodiamond::AnySamples samples = reader.Samples(format::Samples, header.Dimensions);
  const isodiamond::ArrayView<std::uint16_t> errors = reader.Stored<std::uint16_t>(format::Errors);
  const isodiamond::AnySamples minima = reader.Samples(format::Minima, { 0, 1, 1 });
  const isodiamond::AnySamples maxima = reader.Samples(format::Maxima, { 0, 1, 1 });
  state.Scalars = std::make_unique<isodiamond::ScalarHierarchy>(
    samples, header.ErrorScale, errors.Data, errors.Size, minima, maxima);
}

int Dimension(std::int64_t value)
{
  if (value < 2 || value > (1 << isodiamond::Grid::MaximumDepth) + 1)
  {
    throw std::invalid_argument("a dimension is out of range");
  }
  return static_cast<int>(value);
}

using Header = std::array<std::int64_t, HeaderAt::Size>;

/** The header, of any version that is read. What an older one lacks is 0, as it was then. */
Header ReadHeader(Reader& reader)
{
  const isodiamond::ArrayView<std::int64_t> stored = reader.Values<std::int64_t>(format::Header);
  const auto isOf = [&](int version, int size)
  { return stored.Size == size && stored[HeaderAt::Version] == version; };
  if (!isOf(format::Version, HeaderAt::Size) && !isOf(2, HeaderAt::SizeOfVersion2))
  {
    throw std::invalid_argument("the hierarchy has an unknown format version");
  }
  Header header{};
  std::copy(stored.Data, stored.Data + stored.Size, header.begin());
  return header;
}

/** @throws std::invalid_argument */
void CheckHeader(const Header& header)
{
  const auto isFlag = [&](int at) { return header[at] == 0 || header[at] == 1; };
  const std::int64_t model = header[HeaderAt::Model];
  const bool isScalars = model == 0;
  const bool isDistance = header[HeaderAt::Metric] == 1;
  if (model < 0 || model > 2 || !isFlag(HeaderAt::Shape) || !isFlag(HeaderAt::Metric) ||
    !isFlag(HeaderAt::ExactIsovertices) || !isFlag(HeaderAt::TwoSided) ||
    !isFlag(HeaderAt::PreservesTopology) || (isScalars && isDistance) ||
    (header[HeaderAt::TwoSided] == 1 && !isDistance))
  {
    throw std::invalid_argument("the hierarchy is of an unknown model, shape or metric");
  }
  // With an HD queries choose, and it holds all samples.
  const bool isWhole = header[HeaderAt::PreservesTopology] == 0 &&
    header[HeaderAt::MinimumPieceSize] == 0 && header[HeaderAt::RemovedPieces] == 0;
  if (header[HeaderAt::MinimumPieceSize] < 0 || header[HeaderAt::RemovedPieces] < 0 ||
    (isScalars && !isWhole))
  {
    throw std::invalid_argument("the hierarchy's topology or removed pieces make no sense");
  }
}

/** Header, parameters, then the arrays of the model. @throws std::invalid_argument */
void ReadArrays(vtkFieldData* fieldData, int numberOfThreads, State& state)
{
  Reader reader(fieldData, state);
  const Header header = ReadHeader(reader);
  CheckHeader(header);
  const isodiamond::ArrayView<double> parameters = reader.Values<double>(format::Parameters);
  if (parameters.Size != ParameterAt::Size ||
    !std::all_of(parameters.Data + ParameterAt::ErrorScale, parameters.Data + parameters.Size,
      [](double value) { return std::isfinite(value); }))
  {
    throw std::invalid_argument("the hierarchy's parameters are malformed");
  }
  vtkStringArray* name =
    vtkStringArray::SafeDownCast(fieldData->GetAbstractArray(format::ArrayName));
  if (name && name->GetNumberOfValues() == 1)
  {
    state.ArrayName = name->GetValue(0);
  }
  state.Model = static_cast<int>(header[HeaderAt::Model]);
  state.Chosen = { static_cast<isodiamond::Shape>(header[HeaderAt::Shape]),
    parameters[ParameterAt::Isovalue],
    { parameters[ParameterAt::Isorange], parameters[ParameterAt::Isorange + 1] } };
  for (int i = 0; i < 12; ++i)
  {
    state.World.Rows[i / 4][i % 4] = parameters[ParameterAt::World + i];
  }
  state.Metric = static_cast<isodiamond::ErrorMetric>(header[HeaderAt::Metric]);
  state.ExactIsovertices = header[HeaderAt::ExactIsovertices] != 0;
  isodiamond::EncodingHeader core;
  core.TheModel = static_cast<isodiamond::Model>(state.Model);
  for (int axis = 0; axis < 3; ++axis)
  {
    core.Dimensions[axis] = Dimension(header[HeaderAt::Dimensions + axis]);
  }
  core.Region = state.Chosen.Region();
  core.Metric = state.Metric;
  core.ErrorScale = parameters[ParameterAt::ErrorScale];
  core.FieldScale = parameters[ParameterAt::FieldScale];
  core.ExactIsovertices = state.ExactIsovertices;
  core.TwoSided = header[HeaderAt::TwoSided] != 0;
  core.PreservesTopology = header[HeaderAt::PreservesTopology] != 0;
  core.MinimumPieceSize = header[HeaderAt::MinimumPieceSize];
  core.RemovedPieces = header[HeaderAt::RemovedPieces];
  core.RelevantCount = header[HeaderAt::RelevantCount];
  if (core.TheModel == isodiamond::Model::HierarchyOfDiamonds)
  {
    ReadScalars(reader, core, state);
  }
  else
  {
    ReadIsodiamonds(reader, core, numberOfThreads, state);
    ReadPointArrays(fieldData, state);
  }
}

/** A scale among a hierarchy's parameters; 1 if there is no hierarchy. */
double Parameter(vtkFieldData* fieldData, int index)
{
  vtkDataArray* parameters = fieldData ? fieldData->GetArray(format::Parameters) : nullptr;
  const bool valid = parameters && parameters->GetNumberOfTuples() == ParameterAt::Size &&
    parameters->GetNumberOfComponents() == 1;
  return isodiamond::ErrorCode(valid ? parameters->GetTuple1(index) : 1.0).Scale();
}

}

bool HasHierarchy(vtkFieldData* fieldData)
{
  return fieldData && fieldData->GetAbstractArray(format::Header) != nullptr;
}

double LargestTolerance(vtkFieldData* fieldData)
{
  vtkDataArray* header = fieldData ? fieldData->GetArray(format::Header) : nullptr;
  const bool isDistance = header && header->GetNumberOfComponents() == 1 &&
    header->GetNumberOfTuples() > HeaderAt::Metric && // of any version
    header->GetTuple1(HeaderAt::Metric) == static_cast<int>(isodiamond::ErrorMetric::Distance);
  return (isDistance ? DistanceOfInterest : 1.0) * Parameter(fieldData, ParameterAt::ErrorScale);
}

double FieldScale(vtkFieldData* fieldData)
{
  return Parameter(fieldData, ParameterAt::FieldScale);
}

std::shared_ptr<const State> ReadState(vtkFieldData* fieldData, int numberOfThreads)
{
  if (!HasHierarchy(fieldData))
  {
    throw std::invalid_argument("The input is not an isodiamond hierarchy: it has no field data "
                                "array \"" +
      std::string(format::Header) + "\".");
  }
  try
  {
    auto state = std::make_shared<State>();
    state->Arrays = ArraysOf(fieldData);
    ReadArrays(fieldData, numberOfThreads, *state);
    return state;
  }
  catch (const std::invalid_argument& problem)
  {
    throw std::invalid_argument(
      "The isodiamond hierarchy is damaged: " + std::string(problem.what()) + ".");
  }
}

bool IsCurrent(const State& state, vtkFieldData* fieldData)
{
  return state.Arrays == ArraysOf(fieldData);
}

}
