// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondExtractor.h"

#include "vtkIsodiamondInput.h"
#include "vtkIsodiamondQuery.h"
#include "vtkIsodiamondSurface.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSignedCharArray.h"
#include "vtkUnstructuredGrid.h"

vtkStandardNewMacro(vtkIsodiamondExtractor);

//------------------------------------------------------------------------------
vtkIsodiamondExtractor::vtkIsodiamondExtractor() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorTolerance: " << this->ErrorTolerance << "\n";
  os << indent << "Isovalue: " << this->Isovalue << "\n";
  os << indent << "UseIsovalue: " << (this->UseIsovalue ? "On" : "Off") << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::SetIsovalue(double isovalue)
{
  if (!this->UseIsovalue || this->Isovalue != isovalue)
  {
    this->Isovalue = isovalue;
    this->UseIsovalue = true;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double* vtkIsodiamondExtractor::GetErrorToleranceRange()
{
  vtkPolyData* input = this->GetNumberOfInputConnections(0) > 0
    ? vtkPolyData::SafeDownCast(this->GetInputDataObject(0, 0))
    : nullptr;
  this->ErrorToleranceRange[1] = input ? vtkIsodiamond::ErrorScale(input->GetFieldData()) : 1.0;
  return this->ErrorToleranceRange;
}

//------------------------------------------------------------------------------
int vtkIsodiamondExtractor::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondExtractor::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  if (!vtkIsodiamond::IsFirstPiece(outputVector->GetInformationObject(0)))
  {
    return 1; // the first piece has all of it
  }
  try
  {
    const vtkIsodiamond::Query query{ this->ErrorTolerance, this->UseIsovalue, this->Isovalue };
    vtkIsodiamond::RunQuery(this, vtkPolyData::GetData(inputVector[0]), query,
      this->NumberOfThreads,
      [&](const vtkIsodiamond::State& state, const isodiamond::IsodiamondHierarchy& hierarchy)
      {
        const vtkIsodiamond::Surface surface =
          vtkIsodiamond::ExtractSurface(hierarchy, state.World, this->ErrorTolerance);
        output->SetPoints(surface.Points);
        output->SetCells(VTK_TRIANGLE, surface.Triangles);
        output->GetCellData()->AddArray(surface.Levels);
        output->GetPointData()->SetScalars(vtkIsodiamond::ConstantScalars(
          state.ArrayName, surface.Points->GetNumberOfPoints(), hierarchy.Header().Isovalue));
      });
  }
  catch (const std::exception& problem)
  {
    output->Initialize();
    vtkErrorMacro(<< problem.what());
  }
  return 1;
}
