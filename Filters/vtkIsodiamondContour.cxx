// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondContour.h"

#include "Private/Common/Threads.h"
#include "Private/Extraction/Mesh.h"
#include "Private/Query/WorldQuery.h"

#include "vtkAppendPolyData.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

vtkStandardNewMacro(vtkIsodiamondContour);

namespace
{

/**
 * For vtkAppendPolyData, which allocates its output itself, and would end the program where it
 * cannot. The ids of its cells may have twice as many bits as the input's.
 *
 * @throws std::bad_alloc if that much memory is not available now
 */
void ExpectMemoryToAppend(const std::vector<vtkSmartPointer<vtkPolyData>>& meshes)
{
  std::size_t kibibytes = 0;
  for (const vtkSmartPointer<vtkPolyData>& mesh : meshes)
  {
    kibibytes += mesh->GetActualMemorySize();
  }
  void* volatile memory = std::malloc(2 * 1024 * kibibytes); // volatile, or it would be elided
  if (!memory && kibibytes > 0)
  {
    throw std::bad_alloc();
  }
  std::free(memory);
}

/** Gives appended data the order and the roles of the arrays that it was appended from, which
 *  vtkAppendPolyData does not keep. */
void OrderAs(vtkDataSetAttributes* model, vtkDataSetAttributes* data)
{
  vtkNew<vtkDataSetAttributes> appended;
  appended->ShallowCopy(data);
  data->ShallowCopy(model);
  for (int i = 0; i < appended->GetNumberOfArrays(); ++i)
  {
    data->AddArray(appended->GetAbstractArray(i));
  }
}

/** Meshes, one after the other, as one. @throws std::bad_alloc */
vtkSmartPointer<vtkPolyData> Appended(
  const std::vector<vtkSmartPointer<vtkPolyData>>& meshes, int precision)
{
  if (meshes.size() == 1)
  {
    return meshes.front();
  }
  ExpectMemoryToAppend(meshes);
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(precision);
  for (const vtkSmartPointer<vtkPolyData>& mesh : meshes)
  {
    append->AddInputData(mesh);
  }
  vtkIsodiamond::RunSerial([&] { append->Update(); });
  vtkSmartPointer<vtkPolyData> all = append->GetOutput();
  if (all->GetNumberOfPoints() == 0)
  {
    return meshes.front(); // appending nothing yields no arrays
  }
  OrderAs(meshes.front()->GetPointData(), all->GetPointData());
  OrderAs(meshes.front()->GetCellData(), all->GetCellData());
  return all;
}

}

//------------------------------------------------------------------------------
vtkIsodiamondContour::vtkIsodiamondContour() = default;

//------------------------------------------------------------------------------
vtkIsodiamondContour::~vtkIsodiamondContour() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondContour::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ComputeNormals: " << (this->ComputeNormals ? "On" : "Off") << "\n";
  os << indent << "ComputeGradients: " << (this->ComputeGradients ? "On" : "Off") << "\n";
  os << indent << "ComputeScalars: " << (this->ComputeScalars ? "On" : "Off") << "\n";
  os << indent << "Simplify: " << (this->Simplify ? "On" : "Off") << "\n";
  os << indent << "CloseBoundary: " << (this->CloseBoundary ? "On" : "Off") << "\n";
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsodiamondContour::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

//------------------------------------------------------------------------------
vtkPolyData* vtkIsodiamondContour::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
vtkIsodiamond::WorldQuery vtkIsodiamondContour::GetQuery() const
{
  vtkIsodiamond::WorldQuery query = this->Superclass::GetQuery();
  query.Simplify = this->Simplify && !query.IsFull();
  query.TurnToTriangles();
  return query;
}

//------------------------------------------------------------------------------
std::vector<isodiamond::Isoregion> vtkIsodiamondContour::GetRegions() const
{
  std::vector<isodiamond::Isoregion> regions;
  for (int i = 0; i < this->ContourValues->GetNumberOfContours(); ++i)
  {
    vtkIsodiamond::Choice choice;
    choice.Isovalue = this->ContourValues->GetValue(i);
    regions.push_back(choice.Region());
  }
  return regions;
}

//------------------------------------------------------------------------------
vtkIsodiamond::VolumePointData vtkIsodiamondContour::GetPointDataWanted() const
{
  return { this->ComputeNormals != 0, this->ComputeGradients != 0,
    this->InterpolateAttributes != 0 };
}

//------------------------------------------------------------------------------
void vtkIsodiamondContour::Extract(const vtkIsodiamond::Volume& volume,
  const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task, vtkDataObject* output)
{
  vtkIsodiamond::MeshOptions options{ volume.Placement.World, volume.ArrayName };
  options.WithValues = this->ComputeScalars != 0;
  options.PointsPrecision = this->OutputPointsPrecision;
  options.Hidden = &volume.Hidden;
  options.Wanted = this->GetShare();
  const std::vector<isodiamond::Isoregion> regions = this->GetRegions();
  const auto count = static_cast<double>(regions.size());
  if (regions.empty())
  {
    vtkWarningMacro("There are no isovalues, so there is no surface.");
  }
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    vtkIsodiamond::Task part = task.Part(i / count, (i + 1) / count);
    const vtkIsodiamond::Mesh mesh = this->ExtractMesh(volume, regions[i], query, options, part);
    meshes.push_back(vtkSmartPointer<vtkPolyData>::New());
    mesh.Give(meshes.back());
    if (options.Wanted.FirstIds)
    {
      auto& [firstPoint, firstCell] = *options.Wanted.FirstIds;
      firstPoint += mesh.CountedSize[0];
      firstCell += mesh.CountedSize[1];
    }
  }
  if (!meshes.empty())
  {
    // Field data of the input have been passed on.
    const vtkSmartPointer<vtkPolyData> all = Appended(meshes, this->OutputPointsPrecision);
    vtkPolyData* surface = vtkPolyData::SafeDownCast(output);
    surface->CopyStructure(all);
    surface->GetPointData()->ShallowCopy(all->GetPointData());
    surface->GetCellData()->ShallowCopy(all->GetCellData());
  }
}
