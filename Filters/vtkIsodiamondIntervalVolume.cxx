// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondIntervalVolume.h"

#include "vtkIsodiamondCache.h"
#include "vtkIsodiamondInput.h"
#include "vtkIsodiamondMesh.h"
#include "vtkIsodiamondQuery.h"
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
double* vtkIsodiamondIntervalVolume::GetErrorToleranceRange()
{
  vtkDataArray* array = this->FindInputArray(this->FindInput()).Array;
  this->ErrorToleranceRange[1] = vtkIsodiamond::ExtentOfValues(array).value_or(1.0);
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
    vtkIsodiamond::CheckTolerance(this->ErrorTolerance);
    vtkIsodiamond::CheckTolerance(this->InteriorTolerance, "interior");
    const isodiamond::Isoregion region(this->Isorange[0], this->Isorange[1]);
    vtkImageData* image = vtkImageData::GetData(inputVector[0]);
    const vtkIsodiamond::InputArray array = this->FindInputArray(image);
    const vtkIsodiamond::Volume volume = vtkIsodiamond::ReadVolume(image, array, false);
    this->Hierarchies->Prepare(array.Array, volume.Dimensions, false);
    this->Hierarchies->Retain([&](const isodiamond::Isoregion& kept) { return kept == region; });
    const bool refineInterior =
      this->InteriorTolerance < vtkIsodiamond::ExtentOfValues(array.Array).value_or(0.0);
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&]
      {
        const isodiamond::RefinedSet refined(this->Hierarchies->Get(volume, region, refineInterior),
          this->ErrorTolerance, vtkIsodiamond::SMPFor(), this->InteriorTolerance);
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
