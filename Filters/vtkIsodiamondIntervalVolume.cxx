// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondIntervalVolume.h"

#include "Private/Mesh.h"
#include "Private/WorldQuery.h"

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
void vtkIsodiamondIntervalVolume::Extract(const vtkIsodiamond::Volume& volume,
  const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task, vtkDataObject* output)
{
  vtkIsodiamond::WorldQuery withInterior = query;
  withInterior.InteriorTolerance = this->InteriorTolerance;
  vtkIsodiamond::CheckTolerances(withInterior);
  const auto extent = [&]
  {
    const isodiamond::ValueRange range = isodiamond::FiniteRange(volume.Samples);
    return range.Maximum - range.Minimum;
  };
  const bool refineInterior =
    this->InteriorTolerance < VTK_DOUBLE_MAX && this->InteriorTolerance < extent();
  vtkIsodiamond::MeshOptions options{ volume.Placement.World, volume.ArrayName };
  options.PointsPrecision = this->OutputPointsPrecision;
  options.Hidden = &volume.Hidden;
  options.MorePointData =
    vtkIsodiamond::FromVolume(volume, { false, false, this->InterpolateAttributes != 0 });
  this
    ->ExtractMesh(
      volume, { this->Isorange[0], this->Isorange[1] }, refineInterior, withInterior, options, task)
    .Give(vtkUnstructuredGrid::SafeDownCast(output), true);
}
