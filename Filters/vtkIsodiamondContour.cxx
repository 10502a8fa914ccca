// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondContour.h"

#include "Private/Mesh.h"
#include "Private/Threads.h"
#include "Private/WorldQuery.h"

#include "vtkAppendPolyData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdlib>
#include <new>

vtkStandardNewMacro(vtkIsodiamondContour);

namespace
{

/**
 * For vtkAppendPolyData, which allocates its output itself, and would end the program where it
 * cannot. Its cells may have ids of twice the bits that those of the input have.
 *
 * @throws std::bad_alloc if so much is not to be had now
 */
void ExpectMemoryToAppend(std::size_t kibibytes)
{
  void* volatile memory = std::malloc(2 * 1024 * kibibytes); // volatile, or it would be left out
  if (!memory && kibibytes > 0)
  {
    throw std::bad_alloc();
  }
  std::free(memory);
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
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(this->OutputPointsPrecision);
  std::size_t kibibytes = 0;
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    vtkIsodiamond::Task part = task.Part(i / count, (i + 1) / count);
    vtkNew<vtkPolyData> contour;
    const vtkIsodiamond::Mesh mesh = this->ExtractMesh(volume, regions[i], query, options, part);
    mesh.Give(contour);
    if (options.Wanted.FirstIds)
    {
      auto& [firstPoint, firstCell] = *options.Wanted.FirstIds;
      firstPoint += mesh.WholeSize[0];
      firstCell += mesh.WholeSize[1];
    }
    append->AddInputData(contour);
    kibibytes += contour->GetActualMemorySize();
  }
  if (regions.size() == 1)
  {
    output->ShallowCopy(append->GetInput(0));
  }
  else if (regions.size() > 1)
  {
    ExpectMemoryToAppend(kibibytes);
    vtkIsodiamond::RunSerial([&] { append->Update(); });
    output->ShallowCopy(append->GetOutput());
  }
}
