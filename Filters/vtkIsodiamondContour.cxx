// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondContour.h"

#include "GradientNormals.h"
#include "vtkIsodiamondCache.h"
#include "vtkIsodiamondInput.h"
#include "vtkIsodiamondMesh.h"
#include "vtkIsodiamondQuery.h"
#include "vtkIsodiamondRegion.h"
#include "vtkIsodiamondThreads.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSignedCharArray.h"

#include <algorithm>

vtkStandardNewMacro(vtkIsodiamondContour);

//------------------------------------------------------------------------------
vtkIsodiamondContour::vtkIsodiamondContour()
  : Hierarchies(std::make_unique<vtkIsodiamond::Cache>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsodiamondContour::~vtkIsodiamondContour() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondContour::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "ErrorMetric: " << this->ErrorMetric << "\n";
  os << indent << "ExactIsovertices: " << (this->ExactIsovertices ? "On" : "Off") << "\n";
  os << indent << "PreserveFeatures: " << (this->PreserveFeatures ? "On" : "Off") << "\n";
  vtkIsodiamond::PrintRegion(
    os, indent, this->UseRegionOfInterest, this->RegionOfInterest, this->OutsideErrorTolerance);
  os << indent << "ComputeNormals: " << (this->ComputeNormals ? "On" : "Off") << "\n";
  os << indent << "ComputeScalars: " << (this->ComputeScalars ? "On" : "Off") << "\n";
  os << indent << "CloseBoundary: " << (this->CloseBoundary ? "On" : "Off") << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "NumberOfBuilds: " << this->GetNumberOfBuilds() << "\n";
  os << indent << "ContourValues:\n";
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsodiamondContour::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

//------------------------------------------------------------------------------
void vtkIsodiamondContour::SetRegionOfInterestPosition(double x, double y, double z)
{
  if (vtkIsodiamond::MoveRegion(this->RegionOfInterest, { x, y, z }))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondContour::SetRegionOfInterestSize(double x, double y, double z)
{
  if (vtkIsodiamond::ResizeRegion(this->RegionOfInterest, { x, y, z }))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIsodiamond::Query vtkIsodiamondContour::GetQuery() const
{
  vtkIsodiamond::Query query;
  query.ErrorTolerance = this->ErrorTolerance;
  query.OutsideErrorTolerance = this->OutsideErrorTolerance;
  if (this->UseRegionOfInterest)
  {
    query.Region = vtkIsodiamond::RegionBox(this->RegionOfInterest);
  }
  return query;
}

//------------------------------------------------------------------------------
double* vtkIsodiamondContour::GetErrorToleranceRange()
{
  vtkDataObject* input =
    this->GetNumberOfInputConnections(0) > 0 ? this->GetInputDataObject(0, 0) : nullptr;
  this->ErrorToleranceRange[1] = vtkIsodiamond::LargestTolerance(
    static_cast<isodiamond::ErrorMetric>(this->ErrorMetric), input, this->FindInputArray(input));
  return this->ErrorToleranceRange;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondContour::GetNumberOfBuilds()
{
  return this->Hierarchies->GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  vtkIsodiamond::RequestWholeExtent(inputVector[0]->GetInformationObject(0));
  return 1;
}

namespace
{

//------------------------------------------------------------------------------
vtkSmartPointer<vtkFloatArray> Normals(const vtkIsodiamond::Volume& volume, vtkPoints* points)
{
  vtkSmartPointer<vtkFloatArray> normals = vtkSmartPointer<vtkFloatArray>::New();
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points->GetNumberOfPoints());
  isodiamond::WriteGradientNormals(volume.Samples, volume.World,
    vtkFloatArray::SafeDownCast(points->GetData())->GetPointer(0), points->GetNumberOfPoints(),
    normals->GetPointer(0), vtkIsodiamond::SMPFor());
  return normals;
}

}

//------------------------------------------------------------------------------
int vtkIsodiamondContour::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!vtkIsodiamond::IsFirstPiece(outputVector->GetInformationObject(0)))
  {
    return 1; // the first piece has all of it
  }
  try
  {
    const vtkIsodiamond::Query query = this->GetQuery();
    vtkIsodiamond::CheckTolerances(query);
    vtkImageData* image = vtkImageData::GetData(inputVector[0]);
    const vtkIsodiamond::InputArray array = this->FindInputArray(image);
    const vtkIsodiamond::Volume volume =
      vtkIsodiamond::ReadVolume(image, array, this->CloseBoundary);
    const double* values = this->ContourValues->GetValues();
    const double* end = values + this->ContourValues->GetNumberOfContours();
    this->Hierarchies->Prepare(array.Array, volume, this->CloseBoundary,
      { static_cast<isodiamond::ErrorMetric>(this->ErrorMetric), this->ExactIsovertices,
        this->PreserveFeatures, false, volume.World });
    this->Hierarchies->Retain([&](const isodiamond::Isoregion& region)
      { return std::find(values, end, region.Isovalue()) != end; });
    vtkNew<vtkAppendPolyData> append;
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&]
      {
        for (int i = 0; i < this->ContourValues->GetNumberOfContours(); ++i)
        {
          append->AddInputData(
            this->ExtractContour(volume, query, this->ContourValues->GetValue(i)));
        }
      });
    if (append->GetNumberOfInputConnections(0) == 1)
    {
      output->ShallowCopy(append->GetInput(0));
    }
    else if (append->GetNumberOfInputConnections(0) > 1)
    {
      append->Update();
      output->ShallowCopy(append->GetOutput());
    }
  }
  catch (const std::exception& problem)
  {
    output->Initialize();
    vtkErrorMacro(<< problem.what());
  }
  return 1;
}

//------------------------------------------------------------------------------
vtkIsodiamond::InputArray vtkIsodiamondContour::FindInputArray(vtkDataObject* input)
{
  vtkIsodiamond::InputArray found;
  if (input)
  {
    found.Array = this->GetInputArrayToProcess(0, input, found.Association);
  }
  return vtkIsodiamond::OrScalars(found, this->GetInputArrayInformation(0), input);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> vtkIsodiamondContour::ExtractContour(
  const vtkIsodiamond::Volume& volume, const vtkIsodiamond::Query& query, double isovalue)
{
  vtkIsodiamond::Choice choice;
  choice.Isovalue = isovalue;
  const isodiamond::IsodiamondHierarchy& hierarchy =
    this->Hierarchies->Get(volume, choice.Region());
  const isodiamond::RefinedSet refined(hierarchy,
    vtkIsodiamond::CoreQuery(query, hierarchy.Domain(), volume.World), vtkIsodiamond::SMPFor());
  const vtkIsodiamond::Surface surface = vtkIsodiamond::ExtractSurface(refined, volume.World);
  vtkSmartPointer<vtkPolyData> contour = vtkSmartPointer<vtkPolyData>::New();
  contour->SetPoints(surface.Points);
  contour->SetPolys(surface.Triangles);
  contour->GetCellData()->AddArray(surface.Levels);
  if (this->ComputeScalars)
  {
    contour->GetPointData()->SetScalars(vtkIsodiamond::ConstantScalars(
      volume.ArrayName, surface.Points->GetNumberOfPoints(), isovalue));
  }
  if (this->ComputeNormals)
  {
    contour->GetPointData()->SetNormals(Normals(volume, surface.Points));
  }
  return contour;
}
