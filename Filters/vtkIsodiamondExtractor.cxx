// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondExtractor.h"

#include "Private/Extraction/Extraction.h"
#include "Private/Extraction/Mesh.h"
#include "Private/Input/Volume.h"
#include "Private/Query/HierarchyQuery.h"
#include "Private/Query/Target.h"
#include "Private/Query/WorldQuery.h"

#include "vtkCellArray.h"
#include "vtkDataObjectTypes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
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

  /** Repeats the query the first time, only to count. @return 0 after an error */
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
  os << indent << "OutputType: " << this->OutputType << "\n";
  os << indent << "InteriorTolerance: " << this->InteriorTolerance << "\n";
  os << indent << "UseInteriorTolerance: " << (this->UseInteriorTolerance ? "On" : "Off") << "\n";
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Isorange: " << this->Isorange[0] << " " << this->Isorange[1] << "\n";
  os << indent << "UseIsorange: " << (this->UseIsorange ? "On" : "Off") << "\n";
  os << indent << "Isovalue: " << this->Isovalue << "\n";
  os << indent << "UseIsovalue: " << (this->UseIsovalue ? "On" : "Off") << "\n";
  os << indent << "Simplify: " << (this->Simplify ? "On" : "Off") << "\n";
  os << indent << "PreserveTopology: " << (this->PreserveTopology ? "On" : "Off") << "\n";
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::SetInteriorTolerance(double tolerance)
{
  this->StoreInteriorTolerance(tolerance);
  this->UseInteriorToleranceOn();
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreInteriorTolerance(double tolerance)
{
  if (this->InteriorTolerance != tolerance)
  {
    this->InteriorTolerance = tolerance;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::SetIsovalue(double isovalue)
{
  this->StoreWantedIsovalue(isovalue);
  this->UseIsovalueOn();
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreIsovalue(double isovalue)
{
  isovalue = vtkIsodiamond::AsTyped(isovalue);
  this->FirstIsovalue = this->FirstIsovalue.value_or(isovalue);
  this->StoreWantedIsovalue(isovalue);
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreWantedIsovalue(double isovalue)
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
  this->StoreWantedIsorange(lower, upper);
  this->UseIsorangeOn();
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreIsorange(double lower, double upper)
{
  lower = vtkIsodiamond::AsTyped(lower);
  this->FirstIsorange = this->FirstIsorange.value_or(std::array<double, 2>{ lower, upper });
  this->StoreWantedIsorange(lower, upper);
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::StoreWantedIsorange(double lower, double upper)
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
  if (this->UseInteriorTolerance)
  {
    query.InteriorTolerance = this->InteriorTolerance;
  }
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
  query.Simplify = this->Simplify && !query.IsFull();
  return query;
}

//------------------------------------------------------------------------------
vtkUnstructuredGrid* vtkIsodiamondExtractor::GetOutput()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkIsodiamondExtractor::GetPolyDataOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
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
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPointSet");
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkIsodiamondExtractor::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
    const int type = this->GivesPolyData() ? VTK_POLY_DATA : VTK_UNSTRUCTURED_GRID;
    if (!output || output->GetDataObjectType() != type)
    {
      info->Set(vtkDataObject::DATA_OBJECT(),
        vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type)));
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkIsodiamondExtractor::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  this->Last.reset();
  const int success = vtkIsodiamond::Execute(this, output,
    [&](vtkIsodiamond::Task& task)
    {
      vtkIsodiamond::RemoveState(output->GetFieldData());
      auto execution = std::make_unique<Execution>();
      vtkIsodiamond::WorldQuery query = this->GetQuery();
      task.Begin("Reading the hierarchy", 0.0, 0.2);
      execution->State = vtkIsodiamond::ReadForQuery(
        this, vtkPolyData::GetData(inputVector[0]), this->NumberOfThreads, query);
      this->WarnOfUnusedValues(*execution->State);
      if (!vtkIsodiamond::IsForVolume(query, *execution->State))
      {
        query.TurnToTriangles();
      }
      else if (vtkPolyData::SafeDownCast(output))
      {
        throw std::invalid_argument("Tetrahedra of an interval volume need an unstructured grid: "
                                    "poly data are for isosurfaces.");
      }
      std::optional<vtkIsodiamond::CountedTolerance> aimed;
      double refiningBegins = 0.2;
      if (this->TargetNumberOfTriangles > 0)
      {
        refiningBegins = vtkIsodiamond::IsCountedByTrial(query) ? 0.8 : 0.3;
        vtkIsodiamond::Task aiming = task.Part(0.2, refiningBegins);
        aiming.Begin("Finding the tolerance", 0.0, 1.0);
        aimed = this->Aim(*execution->State, query, aiming);
        query.SetFound(aimed->Tolerance);
      }
      const double writingBegins = refiningBegins + 0.3 * (1.0 - refiningBegins);
      task.Begin("Refining", refiningBegins, writingBegins);
      vtkIsodiamond::Task writing = task.Part(writingBegins, 1.0);
      execution->Query = this->GetExtracted(*execution->State, query);
      vtkIsodiamond::RefineState(*execution->State, execution->Query, this->NumberOfThreads,
        task.For(),
        [&](const isodiamond::RefinedSet& refined)
        { this->WriteMesh(*execution->State, query, refined, writing, output); });
      this->NoteTolerance(query.ErrorTolerance, aimed ? &*aimed : nullptr, output);
      this->Last = std::move(execution);
    });
  if (!this->Last)
  {
    this->ForgetMesh();
  }
  return success;
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::WarnOfUnusedValues(const vtkIsodiamond::State& state)
{
  // Values that a user set but did not turn on; those that a panel starts with do not count.
  const vtkIsodiamond::Choice& own = state.Chosen;
  const bool isVolume = vtkIsodiamond::IsForVolume(this->GetQuery(), state);
  if (!isVolume && !this->UseIsovalue && this->Isovalue != this->FirstIsovalue.value_or(0.0) &&
    this->Isovalue != own.Isovalue)
  {
    vtkWarningMacro("Isovalue is " << this->Isovalue
                                   << ", but UseIsovalue is off: the mesh has the "
                                   << "hierarchy's, " << own.Isovalue << ".");
  }
  const std::array<double, 2> isorange = { this->Isorange[0], this->Isorange[1] };
  const std::array<double, 2> first =
    this->FirstIsorange.value_or(std::array<double, 2>{ 0.0, 1.0 });
  if (isVolume && !this->UseIsorange && isorange != first && isorange != own.Isorange)
  {
    vtkWarningMacro("Isorange is set, but UseIsorange is off: the mesh has the hierarchy's, "
      << own.Isorange[0] << " to " << own.Isorange[1] << ".");
  }
}

//------------------------------------------------------------------------------
vtkIsodiamond::CountedTolerance vtkIsodiamondExtractor::Aim(const vtkIsodiamond::State& state,
  const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task)
{
  const isodiamond::ParallelFor parallelFor = task.For();
  vtkIsodiamond::CountedTolerance found;
  const bool isUniform = !query.Region && !query.View;
  const bool isByTrial = vtkIsodiamond::IsCountedByTrial(query);
  if (state.Isodiamonds && isUniform)
  {
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&]
      {
        const isodiamond::CellCounts counts(
          *state.Isodiamonds, parallelFor, query.InteriorTolerance);
        found = vtkIsodiamond::LeastTolerance({ &counts }, this->TargetNumberOfTriangles);
      });
  }
  if (state.Isodiamonds && isUniform && !isByTrial)
  {
    return found;
  }
  const isodiamond::ErrorCode& codes =
    state.Isodiamonds ? state.Isodiamonds->Codes() : state.Scalars->Codes();
  vtkIsodiamond::WorldQuery tried = query;
  vtkIsodiamond::Rounds rounds(task, 0.0, vtkIsodiamond::PartOfTrial);
  const auto cellsAt = [&](double tolerance)
  {
    vtkIsodiamond::Task counting = rounds.Next();
    tried.SetFound(tolerance);
    std::int64_t cells = 0;
    vtkIsodiamond::RefineState(state, this->GetExtracted(state, tried), this->NumberOfThreads,
      parallelFor,
      [&](const isodiamond::RefinedSet& refined)
      {
        cells = isByTrial
          ? this->MakeMesh(state, tried, refined, {}, counting).Cells->GetNumberOfCells()
          : isodiamond::CountCells(refined, parallelFor);
      });
    return cells;
  };
  if (!isByTrial)
  {
    return vtkIsodiamond::LeastTolerance(codes, this->TargetNumberOfTriangles, cellsAt);
  }
  const double guess = isUniform ? found.Tolerance : 0.01 * codes.Scale();
  return vtkIsodiamond::LeastToleranceBelow(guess,
    vtkIsodiamond::CoarsestTolerance(query, state.Metric, codes.Scale(), state.World),
    this->TargetNumberOfTriangles, cellsAt);
}

//------------------------------------------------------------------------------
vtkIsodiamond::WorldQuery vtkIsodiamondExtractor::GetExtracted(
  const vtkIsodiamond::State& state, const vtkIsodiamond::WorldQuery& query) const
{
  if (query.Simplify)
  {
    vtkIsodiamond::CheckSimplify(query, state.Metric, vtkIsodiamond::IsForVolume(query, state));
  }
  return state.Isodiamonds
    ? vtkIsodiamond::HierarchyQuery(query, vtkIsodiamond::Measure(*state.Isodiamonds), state.World)
    : query;
}

//------------------------------------------------------------------------------
vtkIsodiamond::Mesh vtkIsodiamondExtractor::MakeMesh(const vtkIsodiamond::State& state,
  const vtkIsodiamond::WorldQuery& query, const isodiamond::RefinedSet& refined,
  const vtkIsodiamond::Share& share, vtkIsodiamond::Task& task) const
{
  const isodiamond::GridGeometry world = state.World;
  vtkIsodiamond::MeshOptions options{ world, state.ArrayName };
  // Nobody wants to see a surface in the colour of its isovalue.
  options.ValuesAreScalars = refined.Hierarchy().Region().IsVolume();
  options.PointsPrecision = this->OutputPointsPrecision;
  if (state.Isodiamonds && !state.PointArrays.empty())
  {
    options.MorePointData = vtkIsodiamond::FromHierarchy(*state.Isodiamonds, state.PointArrays);
  }
  options.Wanted = share;
  return vtkIsodiamond::ExtractAsAsked(refined, query, options, task);
}

//------------------------------------------------------------------------------
void vtkIsodiamondExtractor::WriteMesh(const vtkIsodiamond::State& state,
  const vtkIsodiamond::WorldQuery& query, const isodiamond::RefinedSet& refined,
  vtkIsodiamond::Task& task, vtkDataObject* output)
{
  const vtkIsodiamond::Mesh mesh = this->MakeMesh(state, query, refined, this->GetShare(), task);
  this->NoteQuality(mesh, output);
  if (vtkPolyData* surface = vtkPolyData::SafeDownCast(output))
  {
    mesh.Give(surface);
  }
  else
  {
    mesh.Give(vtkUnstructuredGrid::SafeDownCast(output), refined.Hierarchy().Region().IsVolume());
  }
}
