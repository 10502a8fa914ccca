// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondExtractor.h"

#include "Private/Input.h"
#include "Private/Mesh.h"
#include "Private/Piece.h"
#include "Private/WorldQuery.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkUnstructuredGrid.h"

#include <optional>

vtkStandardNewMacro(vtkIsodiamondExtractor);

//------------------------------------------------------------------------------
struct vtkIsodiamondExtractor::Execution
{
  std::shared_ptr<const vtkIsodiamond::State> State;
  vtkIsodiamond::WorldQuery Query;
  std::optional<vtkIdType> Subdivided;
  std::optional<vtkIdType> Front;

  /** Asks again the first time, and only counts. @return 0 after an error */
  vtkIdType CountOnce(std::optional<vtkIdType>& counted,
    std::int64_t (isodiamond::RefinedSet::*count)() const, vtkIsodiamondExtractor* filter) const
  {
    try
    {
      if (!counted)
      {
        vtkIsodiamond::RefineState(*this->State, this->Query, filter->GetNumberOfThreads(),
          vtkIsodiamond::SMPFor(),
          [&](const isodiamond::RefinedSet& refined) { counted = (refined.*count)(); });
      }
    }
    catch (...)
    {
      vtkIsodiamond::ReportException(filter);
    }
    return counted.value_or(0);
  }
};

//------------------------------------------------------------------------------
vtkIsodiamondExtractor::vtkIsodiamondExtractor() = default;

//------------------------------------------------------------------------------
vtkIsodiamondExtractor::~vtkIsodiamondExtractor() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "InteriorTolerance: " << this->InteriorTolerance << "\n";
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Isorange: " << this->Isorange[0] << " " << this->Isorange[1] << "\n";
  os << indent << "UseIsorange: " << (this->UseIsorange ? "On" : "Off") << "\n";
  os << indent << "Isovalue: " << this->Isovalue << "\n";
  os << indent << "UseIsovalue: " << (this->UseIsovalue ? "On" : "Off") << "\n";
  os << indent << "PreserveTopology: " << (this->PreserveTopology ? "On" : "Off") << "\n";
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::SetIsovalue(double isovalue)
{
  this->StoreIsovalue(isovalue);
  this->UseIsovalueOn();
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreIsovalue(double isovalue)
{
  if (this->Isovalue != isovalue)
  {
    this->Isovalue = isovalue;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::SetIsorange(double lower, double upper)
{
  this->StoreIsorange(lower, upper);
  this->UseIsorangeOn();
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreIsorange(double lower, double upper)
{
  if (this->Isorange[0] != lower || this->Isorange[1] != upper)
  {
    this->Isorange[0] = lower;
    this->Isorange[1] = upper;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondExtractor::GetNumberOfSubdividedDiamonds()
{
  return this->Last
    ? this->Last->CountOnce(this->Last->Subdivided, &isodiamond::RefinedSet::Count, this)
    : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondExtractor::GetNumberOfFrontDiamonds()
{
  return this->Last
    ? this->Last->CountOnce(this->Last->Front, &isodiamond::RefinedSet::CountFront, this)
    : 0;
}

//------------------------------------------------------------------------------
vtkIsodiamond::WorldQuery vtkIsodiamondExtractor::GetQuery() const
{
  vtkIsodiamond::WorldQuery query = this->Superclass::GetQuery();
  query.InteriorTolerance = this->InteriorTolerance;
  if (this->Shape >= 0)
  {
    query.Shape = static_cast<isodiamond::Shape>(this->Shape);
  }
  if (this->UseIsovalue)
  {
    query.Isovalue = this->Isovalue;
  }
  if (this->UseIsorange)
  {
    query.Isorange = { this->Isorange[0], this->Isorange[1] };
  }
  query.PreserveTopology = this->PreserveTopology;
  return query;
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkIsodiamondExtractor::GetOutput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkFieldData* vtkIsodiamondExtractor::FindHierarchy()
{
  vtkPolyData* input = vtkPolyData::SafeDownCast(this->GetInput());
  return input && vtkIsodiamond::HasHierarchy(input->GetFieldData()) ? input->GetFieldData()
                                                                     : nullptr;
}

//------------------------------------------------------------------------------
double* vtkIsodiamondExtractor::GetErrorToleranceRange()
{
  vtkFieldData* hierarchy = this->FindHierarchy();
  this->ErrorToleranceRange[1] = hierarchy ? vtkIsodiamond::LargestTolerance(hierarchy) : 1.0;
  return this->ErrorToleranceRange;
}

//------------------------------------------------------------------------------
double* vtkIsodiamondExtractor::GetInteriorToleranceRange()
{
  vtkFieldData* hierarchy = this->FindHierarchy();
  this->InteriorToleranceRange[1] =
    hierarchy ? vtkIsodiamond::FieldScale(hierarchy) : VTK_DOUBLE_MAX;
  return this->InteriorToleranceRange;
}

//------------------------------------------------------------------------------
int vtkIsodiamondExtractor::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondExtractor::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkUnstructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondExtractor::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector);
  this->Last.reset();
  return vtkIsodiamond::Execute(this, output,
    [&](vtkIsodiamond::Task& task)
    {
      vtkIsodiamond::RemoveState(output->GetFieldData());
      auto execution = std::make_unique<Execution>();
      execution->Query = this->GetQuery();
      task.Begin("Reading the hierarchy", 0.0, 0.2);
      execution->State =
        vtkIsodiamond::ReadForQuery(this, vtkPolyData::GetData(inputVector[0]), execution->Query);
      task.Begin("Refining", 0.2, 0.5);
      vtkIsodiamond::Task writing = task.Part(0.5, 1.0);
      vtkIsodiamond::RefineState(*execution->State, execution->Query, this->NumberOfThreads,
        task.For(),
        [&](const isodiamond::RefinedSet& refined)
        { this->WriteMesh(*execution->State, refined, writing, output); });
      vtkIsodiamond::KeepPiece(output, this->Piece);
      this->Last = std::move(execution);
    });
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::WriteMesh(const vtkIsodiamond::State& state,
  const isodiamond::RefinedSet& refined, vtkIsodiamond::Task& task, vtkUnstructuredGrid* output)
{
  const isodiamond::GridGeometry world = state.World;
  vtkIsodiamond::MeshOptions options{ world, state.ArrayName };
  options.PointsPrecision = this->OutputPointsPrecision;
  if (state.Isodiamonds && !state.PointArrays.empty())
  {
    options.MorePointData = vtkIsodiamond::FromHierarchy(*state.Isodiamonds, state.PointArrays);
  }
  vtkIsodiamond::ExtractMesh(refined, options, task)
    .Give(output, refined.Hierarchy().Region().IsVolume());
}
