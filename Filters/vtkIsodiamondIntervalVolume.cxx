// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondIntervalVolume.h"

#include "vtkIsodiamondCache.h"
#include "vtkIsodiamondInput.h"
#include "vtkIsodiamondMesh.h"
#include "vtkIsodiamondQuery.h"
#include "vtkIsodiamondRegion.h"
#include "vtkIsodiamondThreads.h"

#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkIsodiamondIntervalVolume);

//------------------------------------------------------------------------------
vtkIsodiamondIntervalVolume::vtkIsodiamondIntervalVolume()
  : Hierarchies(std::make_unique<vtkIsodiamond::Cache>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsodiamondIntervalVolume::~vtkIsodiamondIntervalVolume() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Isorange: " << this->Isorange[0] << " " << this->Isorange[1] << "\n";
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "ErrorMetric: " << this->ErrorMetric << "\n";
  os << indent << "ExactIsovertices: " << (this->ExactIsovertices ? "On" : "Off") << "\n";
  os << indent << "PreserveFeatures: " << (this->PreserveFeatures ? "On" : "Off") << "\n";
  vtkIsodiamond::PrintRegion(
    os, indent, this->UseRegionOfInterest, this->RegionOfInterest, this->OutsideErrorTolerance);
  os << indent << "InteriorTolerance: " << this->InteriorTolerance << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "NumberOfBuilds: " << this->GetNumberOfBuilds() << "\n";
}

//------------------------------------------------------------------------------
vtkDataObject* vtkIsodiamondIntervalVolume::FindInput()
{
  return this->GetNumberOfInputConnections(0) > 0 ? this->GetInputDataObject(0, 0) : nullptr;
}

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::SetRegionOfInterestPosition(double x, double y, double z)
{
  if (vtkIsodiamond::MoveRegion(this->RegionOfInterest, { x, y, z }))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondIntervalVolume::SetRegionOfInterestSize(double x, double y, double z)
{
  if (vtkIsodiamond::ResizeRegion(this->RegionOfInterest, { x, y, z }))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIsodiamond::Query vtkIsodiamondIntervalVolume::GetQuery() const
{
  vtkIsodiamond::Query query;
  query.ErrorTolerance = this->ErrorTolerance;
  query.InteriorTolerance = this->InteriorTolerance;
  query.OutsideErrorTolerance = this->OutsideErrorTolerance;
  if (this->UseRegionOfInterest)
  {
    query.Region = vtkIsodiamond::RegionBox(this->RegionOfInterest);
  }
  return query;
}

//------------------------------------------------------------------------------
double* vtkIsodiamondIntervalVolume::GetErrorToleranceRange()
{
  this->ErrorToleranceRange[1] =
    vtkIsodiamond::LargestTolerance(static_cast<isodiamond::ErrorMetric>(this->ErrorMetric),
      this->FindInput(), this->FindInputArray(this->FindInput()));
  return this->ErrorToleranceRange;
}

//------------------------------------------------------------------------------
double* vtkIsodiamondIntervalVolume::GetInteriorToleranceRange()
{
  vtkDataArray* array = this->FindInputArray(this->FindInput()).Array;
  this->InteriorToleranceRange[1] = vtkIsodiamond::ExtentOfValues(array).value_or(VTK_DOUBLE_MAX);
  return this->InteriorToleranceRange;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondIntervalVolume::GetNumberOfBuilds()
{
  return this->Hierarchies->GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
int vtkIsodiamondIntervalVolume::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondIntervalVolume::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkIsodiamond::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

//------------------------------------------------------------------------------
vtkIsodiamond::InputArray vtkIsodiamondIntervalVolume::FindInputArray(vtkDataObject* input)
{
  vtkIsodiamond::InputArray found;
  if (input)
  {
    found.Array = this->GetInputArrayToProcess(0, input, found.Association);
  }
  return vtkIsodiamond::OrScalars(found, this->GetInputArrayInformation(0), input);
}

//------------------------------------------------------------------------------
int vtkIsodiamondIntervalVolume::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  if (!vtkIsodiamond::IsFirstPiece(outputVector->GetInformationObject(0)))
  {
    return 1; // the first piece has all of it
  }
  try
  {
    const vtkIsodiamond::Query query = this->GetQuery();
    vtkIsodiamond::CheckTolerances(query);
    const isodiamond::Isoregion region(this->Isorange[0], this->Isorange[1]);
    vtkImageData* image = vtkImageData::GetData(inputVector[0]);
    const vtkIsodiamond::InputArray array = this->FindInputArray(image);
    const vtkIsodiamond::Volume volume = vtkIsodiamond::ReadVolume(image, array, false);
    this->Hierarchies->Prepare(array.Array, volume, false,
      { static_cast<isodiamond::ErrorMetric>(this->ErrorMetric), this->ExactIsovertices,
        this->PreserveFeatures, false, volume.World });
    this->Hierarchies->Retain([&](const isodiamond::Isoregion& kept) { return kept == region; });
    const bool refineInterior =
      this->InteriorTolerance < vtkIsodiamond::ExtentOfValues(array.Array).value_or(0.0);
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&]
      {
        const isodiamond::IsodiamondHierarchy& hierarchy =
          this->Hierarchies->Get(volume, region, refineInterior);
        const isodiamond::RefinedSet refined(hierarchy,
          vtkIsodiamond::CoreQuery(query, hierarchy.Domain(), volume.World),
          vtkIsodiamond::SMPFor());
        vtkIsodiamond::ExtractMesh(refined, volume.World, volume.ArrayName, output);
      });
  }
  catch (const std::exception& problem)
  {
    output->Initialize();
    vtkErrorMacro(<< problem.what());
  }
  return 1;
}
