// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Input/PointData.h"

#include "Field/Gradients.h"
#include "Field/Trilinear.h"
#include "Private/Common/Arrays.h"

#include "vtkArrayListTemplate.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>

namespace vtkIsodiamond
{
namespace
{

constexpr const char* NormalsName = "Normals";

/** @param normals,gradients may be null */
PointWriter WriteGradients(const Volume& volume, vtkFloatArray* normals, vtkFloatArray* gradients)
{
  const auto write = [](float* tuple, const isodiamond::Vector& vector)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      tuple[axis] = static_cast<float>(vector[axis]);
    }
  };
  const auto valuesOf = [](vtkFloatArray* array) { return array ? array->GetPointer(0) : nullptr; };
  return [write, gradientsOf = isodiamond::Gradients(volume.Samples, volume.Placement.World),
           ofNormals = valuesOf(normals),
           ofGradients = valuesOf(gradients)](const isodiamond::PointGroup& points)
  {
    std::vector<isodiamond::Vector> positions;
    positions.reserve(points.size());
    for (const isodiamond::MeshPoint& point : points)
    {
      positions.push_back(point.Index);
    }
    std::vector<isodiamond::Vector> found(points.size());
    gradientsOf.Find(positions, found.data());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (ofNormals)
      {
        write(ofNormals + 3 * points[i].Id, gradientsOf.NormalAt(positions[i], found[i]));
      }
      if (ofGradients)
      {
        write(ofGradients + 3 * points[i].Id, found[i]);
      }
    }
  };
}

/** Whether values between an array's own make sense. */
/** @param points of the grid */
bool CanBeInterpolated(vtkDataArray* array, int attribute, vtkIdType points)
{
  return array && array->GetName() && array->GetDataType() != VTK_BIT &&
    array->GetNumberOfTuples() >= points &&
    std::string(array->GetName()) != vtkDataSetAttributes::GhostArrayName() &&
    attribute != vtkDataSetAttributes::GLOBALIDS && attribute != vtkDataSetAttributes::PEDIGREEIDS;
}

/** Arrays to read, their values in a row, and for each an array to write. */
struct ArrayPairs
{
  ArrayList Values;
  std::vector<vtkSmartPointer<vtkDataArray>> Read; ///< the list does not keep them alive
};

/** Like ArrayList::AddArrayPair, which would allocate in its own way. @return the array that the
 * list writes, under the same name */
vtkSmartPointer<vtkDataArray> AddPair(
  ArrayPairs& pairs, vtkDataArray* from, vtkIdType count, bool integersAsFloats)
{
  const int type = from->GetDataType();
  const bool isFloating = type == VTK_FLOAT || type == VTK_DOUBLE;
  const bool converts = integersAsFloats && !isFloating;
  auto to =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(converts ? VTK_FLOAT : type));
  const int components = from->GetNumberOfComponents();
  to->SetName(from->GetName());
  to->SetNumberOfComponents(components);
  AllocateTuples(to, count);
  pairs.Read.push_back(InRow(from));
  ArrayList* list = &pairs.Values;
  void* read = pairs.Read.back()->GetVoidPointer(0);
  void* written = to->GetVoidPointer(0);
  if (converts)
  {
    switch (type)
    {
      vtkTemplateMacro(CreateRealArrayPair(list, static_cast<VTK_TT*>(read),
        static_cast<float*>(written), count, components, to, 0.0F));
    }
    return to;
  }
  switch (type)
  {
    vtkTemplateMacro(CreateArrayPair(list, static_cast<VTK_TT*>(read),
      static_cast<VTK_TT*>(written), count, components, to, VTK_TT()));
  }
  return to;
}

/** The wanted arrays of the grid, except those that the output already has by name; integers as
 *  floats. */
PointWriter WriteOthers(const Volume& volume, const std::vector<std::string>& names,
  vtkIdType count, vtkPointData* output)
{
  vtkPointData* input = volume.Grid->GetPointData();
  const auto arrays = std::make_shared<ArrayPairs>();
  for (int i = 0; i < input->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = input->GetArray(i);
    const int attribute = input->IsArrayAnAttribute(i);
    if (!CanBeInterpolated(array, attribute, volume.Grid->GetNumberOfPoints()) ||
      array->GetName() == volume.ArrayName || output->HasArray(array->GetName()) ||
      (!names.empty() && std::find(names.begin(), names.end(), array->GetName()) == names.end()))
    {
      continue;
    }
    const auto made = AddPair(*arrays, array, count, true);
    output->AddArray(made);
    if (attribute >= 0 && !output->GetAbstractAttribute(attribute))
    {
      output->SetActiveAttribute(made->GetName(), attribute);
    }
  }
  return OneByOne(
    [&volume, arrays](const isodiamond::MeshPoint& point)
    {
      const std::array<int, 3>& dimensions = volume.Dimensions;
      isodiamond::Vector index = point.Index;
      for (double& coordinate : index)
      {
        coordinate -= volume.Padding;
      }
      std::array<vtkIdType, 8> ids{};
      std::array<double, 8> weights{};
      int corners = 0;
      isodiamond::CellPosition(index, dimensions)
        .Clamped()
        .ForEachCorner(
          [&](const isodiamond::Point& sample, double weight)
          {
            ids[corners] = isodiamond::SampleIndex(dimensions, sample);
            weights[corners++] = weight;
          });
      arrays->Values.Interpolate(corners, ids.data(), weights.data(), vtkIdType{ point.Id });
    });
}

}

PointDataMaker FromVolume(const Volume& volume, const VolumePointData& wanted)
{
  return [&volume, wanted](vtkIdType count, vtkPointData* output)
  {
    std::vector<PointWriter> writers;
    const auto normals = wanted.Normals ? NewArray<vtkFloatArray>(NormalsName, count, 3) : nullptr;
    const auto gradients =
      wanted.Gradients ? NewArray<vtkFloatArray>("Gradient", count, 3) : nullptr;
    if (normals)
    {
      output->SetNormals(normals);
    }
    if (gradients)
    {
      output->AddArray(gradients);
    }
    if (normals || gradients)
    {
      writers.push_back(WriteGradients(volume, normals, gradients));
    }
    if (wanted.Others && volume.Grid->GetPointData()->GetNumberOfArrays() > 1)
    {
      writers.push_back(WriteOthers(volume, wanted.Names, count, output));
    }
    return writers;
  };
}

PointDataMaker FromHierarchy(const isodiamond::IsodiamondHierarchy& hierarchy,
  const std::vector<vtkSmartPointer<vtkDataArray>>& stored)
{
  return [&hierarchy, &stored](vtkIdType count, vtkPointData* output) -> std::vector<PointWriter>
  {
    const auto arrays = std::make_shared<ArrayPairs>();
    for (vtkDataArray* array : stored)
    {
      if (!output->HasArray(array->GetName())) // the mesh's own come first
      {
        output->AddArray(AddPair(*arrays, array, count, false));
      }
    }
    if (output->HasArray(NormalsName))
    {
      output->SetActiveNormals(NormalsName);
    }
    return { OneByOne(
      [&hierarchy, arrays](const isodiamond::MeshPoint& point)
      {
        arrays->Values.Copy(
          vtkIdType{ isodiamond::StoredNumber(hierarchy, point) }, vtkIdType{ point.Id });
      }) };
  };
}

void CheckNames(const VolumePointData& wanted, const std::string& contoured,
  const std::vector<vtkSmartPointer<vtkDataArray>>& arrays)
{
  for (const std::string& name : wanted.Names)
  {
    // Meshes have the contoured values anyway: users who ask for all arrays mean the others.
    if (name != contoured &&
      std::none_of(arrays.begin(), arrays.end(),
        [&](vtkDataArray* array) { return name == array->GetName(); }))
    {
      throw std::invalid_argument("The input has no other point array \"" + name + "\".");
    }
  }
}

std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Volume& volume,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy,
  const isodiamond::ParallelFor& parallelFor)
{
  vtkNew<vtkPointData> made;
  const std::vector<PointWriter> writers =
    FromVolume(volume, wanted)(isodiamond::StoredPointCount(hierarchy), made);
  std::vector<vtkSmartPointer<vtkDataArray>> arrays(made->GetNumberOfArrays());
  for (int i = 0; i < made->GetNumberOfArrays(); ++i)
  {
    arrays[i] = made->GetArray(i);
  }
  CheckNames(wanted, volume.ArrayName, arrays);
  if (!writers.empty())
  {
    isodiamond::ForEachStoredPointGroup(hierarchy, parallelFor, Together(writers));
  }
  return arrays;
}

}
