// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondAlgorithm.h"

#include "Private/Common/Arrays.h"
#include "Private/Extraction/Mesh.h"
#include "Private/Extraction/Share.h"
#include "Private/Input/Request.h"
#include "Private/Parallel/InputShares.h"
#include "Private/Query/Target.h"
#include "Private/Query/WorldQuery.h"
#include "Private/State/Format.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

//------------------------------------------------------------------------------
vtkIsodiamondAlgorithm::vtkIsodiamondAlgorithm()
  : Shares(std::make_unique<vtkIsodiamond::InputShares>())
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkIsodiamondAlgorithm::~vtkIsodiamondAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "TargetNumberOfTriangles: " << this->TargetNumberOfTriangles << "\n";
  os << indent << "SimulationQuality: " << (this->SimulationQuality ? "On" : "Off") << "\n";
  os << indent << "SmallestDihedralAngle: " << this->SmallestDihedralAngle << "\n";
  os << indent << "LargestDihedralAngle: " << this->LargestDihedralAngle << "\n";
  os << indent << "ToleranceExcess: " << this->ToleranceExcess << "\n";
  os << indent << "AchievedTolerance: " << this->AchievedTolerance << "\n";
  os << indent << "UseRegionOfInterest: " << (this->UseRegionOfInterest ? "On" : "Off") << "\n";
  os << indent << "RegionOfInterest:";
  for (const double bound : this->RegionOfInterest)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "OutsideErrorTolerance: " << this->OutsideErrorTolerance << "\n";
  os << indent << "ViewDependent: " << (this->ViewDependent ? "On" : "Off") << "\n";
  os << indent << "ViewPosition: " << this->ViewPosition[0] << " " << this->ViewPosition[1] << " "
     << this->ViewPosition[2] << "\n";
  os << indent << "ViewAngle: " << this->ViewAngle << "\n";
  os << indent << "ViewHeight: " << this->ViewHeight << "\n";
  os << indent << "PixelTolerance: " << this->PixelTolerance << "\n";
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
  os << indent << "GenerateGlobalIds: " << (this->GenerateGlobalIds ? "On" : "Off") << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
void vtkIsodiamondAlgorithm::SetRegionOfInterestPosition(double x, double y, double z)
{
  const double position[3] = { x, y, z };
  double region[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* bounds = this->RegionOfInterest + 2 * axis;
    region[2 * axis] = position[axis];
    // The size is kept to the bit where the position stays the same.
    region[2 * axis + 1] =
      bounds[0] == position[axis] ? bounds[1] : position[axis] + (bounds[1] - bounds[0]);
  }
  this->SetRegionOfInterest(region);
}

//------------------------------------------------------------------------------
void vtkIsodiamondAlgorithm::SetRegionOfInterestSize(double x, double y, double z)
{
  const double* region = this->RegionOfInterest;
  this->SetRegionOfInterest(
    region[0], region[0] + x, region[2], region[2] + y, region[4], region[4] + z);
}

//------------------------------------------------------------------------------
vtkDataObject* vtkIsodiamondAlgorithm::GetInput()
{
  return this->GetNumberOfInputConnections(0) > 0 ? this->GetInputDataObject(0, 0) : nullptr;
}

//------------------------------------------------------------------------------
vtkIsodiamond::WorldQuery vtkIsodiamondAlgorithm::GetQuery() const
{
  vtkIsodiamond::WorldQuery query;
  query.ErrorTolerance = this->ErrorTolerance;
  query.HasTarget = this->TargetNumberOfTriangles > 0;
  query.SimulationQuality = this->SimulationQuality;
  query.OutsideErrorTolerance = this->OutsideErrorTolerance;
  if (this->UseRegionOfInterest)
  {
    const double* region = this->RegionOfInterest;
    query.Region =
      isodiamond::Box{ { region[0], region[2], region[4] }, { region[1], region[3], region[5] } };
  }
  if (this->ViewDependent)
  {
    if (!(this->ViewAngle > 0.0 && this->ViewAngle < 180.0 && this->ViewHeight > 0.0))
    {
      throw std::invalid_argument(
        "The view angle must lie between 0 and 180 degrees, and the view height be more than 0.");
    }
    vtkIsodiamond::CheckTolerance(this->PixelTolerance, "pixel");
    const double angle = vtkMath::RadiansFromDegrees(this->ViewAngle);
    query.View =
      vtkIsodiamond::View{ { this->ViewPosition[0], this->ViewPosition[1], this->ViewPosition[2] },
        2.0 * std::tan(0.5 * angle) * this->PixelTolerance / this->ViewHeight };
  }
  return query;
}

//------------------------------------------------------------------------------
vtkIsodiamond::Share vtkIsodiamondAlgorithm::GetShare()
{
  vtkIsodiamond::Share share = this->Shares->Of(this->GetInputDataObject(0, 0));
  if (this->GenerateGlobalIds)
  {
    share.FirstIds = { 0, 0 };
  }
  return share;
}

//------------------------------------------------------------------------------
void vtkIsodiamondAlgorithm::NoteTolerance(
  double tolerance, const vtkIsodiamond::CountedTolerance* aimed, vtkDataObject* output)
{
  this->AchievedTolerance = std::max(this->AchievedTolerance, tolerance); // of all blocks
  if (aimed)
  {
    vtkIsodiamond::WarnIfAbove(this, *aimed, this->TargetNumberOfTriangles);
    vtkIsodiamond::AddNumber<vtkDoubleArray>(
      output->GetFieldData(), vtkIsodiamond::format::AchievedTolerance, tolerance);
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondAlgorithm::ForgetMesh()
{
  this->AchievedTolerance = 0.0;
  this->SmallestDihedralAngle = 0.0;
  this->LargestDihedralAngle = 0.0;
  this->ToleranceExcess = 0.0;
}

//------------------------------------------------------------------------------
void vtkIsodiamondAlgorithm::NoteQuality(const vtkIsodiamond::Mesh& mesh, vtkDataObject* output)
{
  if (!mesh.DihedralAngles)
  {
    return;
  }
  const auto [smallest, largest] = *mesh.DihedralAngles;
  const bool isFirst = this->LargestDihedralAngle == 0.0;
  this->SmallestDihedralAngle =
    isFirst ? smallest : std::min(this->SmallestDihedralAngle, smallest);
  this->LargestDihedralAngle = std::max(this->LargestDihedralAngle, largest);
  vtkIsodiamond::AddNumber<vtkDoubleArray>(
    output->GetFieldData(), vtkIsodiamond::format::SmallestDihedralAngle, smallest);
  vtkIsodiamond::AddNumber<vtkDoubleArray>(
    output->GetFieldData(), vtkIsodiamond::format::LargestDihedralAngle, largest);
  const double excess = mesh.ToleranceExcess.value_or(vtkMath::Nan());
  if (!(excess <= this->ToleranceExcess) && !vtkMath::IsNan(this->ToleranceExcess)) // of all blocks
  {
    this->ToleranceExcess = excess;
  }
  if (!vtkMath::IsNan(excess)) // of which ParaView would show a range from 1e299 to -1e299
  {
    vtkIsodiamond::AddNumber<vtkDoubleArray>(
      output->GetFieldData(), vtkIsodiamond::format::ToleranceExcess, excess);
  }
}

//------------------------------------------------------------------------------
vtkTypeBool vtkIsodiamondAlgorithm::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(request, inputVector, outputVector);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    return this->RequestUpdateExtent(request, inputVector, outputVector);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkIsodiamondAlgorithm::ModifyRequest(vtkInformation* request, int when)
{
  this->Shares->Note(this, request, when);
  if (when == vtkExecutive::BeforeForward && request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    this->ForgetMesh();
  }
  return this->Superclass::ModifyRequest(request, when);
}

//------------------------------------------------------------------------------
int vtkIsodiamondAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkIsodiamond::RequestWhole(inputVector[0]->GetInformationObject(0));
  return 1;
}
