// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondIntervalVolume.h"

#include "Private/Extraction/Mesh.h"
#include "Private/Query/WorldQuery.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

vtkStandardNewMacro(vtkIsodiamondIntervalVolume);

//------------------------------------------------------------------------------
vtkIsodiamondIntervalVolume::vtkIsodiamondIntervalVolume() = default;

//------------------------------------------------------------------------------
vtkIsodiamondIntervalVolume::~vtkIsodiamondIntervalVolume() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Isorange: " << this->Isorange[0] << " " << this->Isorange[1] << "\n";
  os << indent << "InteriorTolerance: " << this->InteriorTolerance << "\n";
  os << indent << "UseInteriorTolerance: " << (this->UseInteriorTolerance ? "On" : "Off") << "\n";
  os << indent << "ComputeGradients: " << (this->ComputeGradients ? "On" : "Off") << "\n";
}

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::SetInteriorTolerance(double tolerance)
{
  this->StoreInteriorTolerance(tolerance);
  this->UseInteriorToleranceOn();
}

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::StoreInteriorTolerance(double tolerance)
{
  if (this->InteriorTolerance != tolerance)
  {
    this->InteriorTolerance = tolerance;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkIsodiamondIntervalVolume::GetOutput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
double* vtkIsodiamondIntervalVolume::GetInteriorToleranceRange()
{
  double largest = 0.0;
  for (vtkDataSet* grid : vtkIsodiamond::LeavesOf(this->GetInput()))
  {
    largest = std::max(
      largest, vtkIsodiamond::ExtentOfValues(this->FindInputArray(grid).Array).value_or(0.0));
  }
  this->InteriorToleranceRange[1] = largest > 0.0 ? largest : VTK_DOUBLE_MAX;
  return this->InteriorToleranceRange;
}

//------------------------------------------------------------------------------
int vtkIsodiamondIntervalVolume::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkUnstructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
vtkIsodiamond::WorldQuery vtkIsodiamondIntervalVolume::GetQuery() const
{
  vtkIsodiamond::WorldQuery query = this->Superclass::GetQuery();
  if (this->UseInteriorTolerance)
  {
    query.InteriorTolerance = this->InteriorTolerance;
  }
  return query;
}

//------------------------------------------------------------------------------
std::vector<isodiamond::Isoregion> vtkIsodiamondIntervalVolume::GetRegions() const
{
  return { { this->Isorange[0], this->Isorange[1] } };
}

//------------------------------------------------------------------------------
vtkIsodiamond::VolumePointData vtkIsodiamondIntervalVolume::GetPointDataWanted() const
{
  return { false, this->ComputeGradients != 0, this->InterpolateAttributes != 0 };
}

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::Extract(const vtkIsodiamond::Volume& volume,
  const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task, vtkDataObject* output)
{
  vtkIsodiamond::MeshOptions options{ volume.Placement.World, volume.ArrayName };
  options.PointsPrecision = this->OutputPointsPrecision;
  options.Hidden = &volume.Hidden;
  options.Wanted = this->GetShare();
  const vtkIsodiamond::Mesh mesh =
    this->ExtractMesh(volume, this->GetRegions().front(), query, options, task);
  mesh.Give(vtkUnstructuredGrid::SafeDownCast(output), true);
  this->NoteQuality(mesh, output);
}
