// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondVolumeAlgorithm.h"

#include "Mesh/CellCounts.h"
#include "Patches/WorldLengths.h"
#include "Private/Build/Cache.h"
#include "Private/Build/Slabs.h"
#include "Private/Common/Arrays.h"
#include "Private/Common/Task.h"
#include "Private/Common/Threads.h"
#include "Private/Extraction/Extraction.h"
#include "Private/Extraction/Mesh.h"
#include "Private/Extraction/Share.h"
#include "Private/Input/PointData.h"
#include "Private/Input/Volume.h"
#include "Private/Parallel/InputShares.h"
#include "Private/Query/HierarchyQuery.h"
#include "Private/Query/Target.h"
#include "Private/Query/WorldQuery.h"
#include "Private/State/Format.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace
{

bool AreVolumes(const std::vector<isodiamond::Isoregion>& regions)
{
  return !regions.empty() && regions.front().IsVolume();
}

/** Which hierarchy a query needs. */
vtkIsodiamond::Cache::Need NeedOf(const vtkIsodiamond::WorldQuery& query)
{
  vtkIsodiamond::Cache::Need need{ !query.IsFull(), query.RefinesInterior,
    query.SimulationQuality };
  // Tetrahedra for simulations are refined once more where they are too far away.
  if (need.AllErrors && query.OneTolerance && !query.HasTarget && !query.SimulationQuality &&
    !query.RefinesInterior)
  {
    need.AllErrors = false;
    need.Only = query;
  }
  return need;
}

}

//------------------------------------------------------------------------------
vtkIsodiamondVolumeAlgorithm::vtkIsodiamondVolumeAlgorithm()
  : Hierarchies(std::make_unique<vtkIsodiamond::Cache>())
  , Plan(std::make_unique<vtkIsodiamond::SlabPlan>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsodiamondVolumeAlgorithm::~vtkIsodiamondVolumeAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkIsodiamondVolumeAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ErrorMetric: " << this->ErrorMetric << "\n";
  os << indent << "ToleranceUnit: " << this->ToleranceUnit << "\n";
  os << indent << "OneTolerance: " << (this->OneTolerance ? "On" : "Off") << "\n";
  os << indent << "ExactIsovertices: " << (this->ExactIsovertices ? "On" : "Off") << "\n";
  os << indent << "PreserveFeatures: " << (this->PreserveFeatures ? "On" : "Off") << "\n";
  os << indent << "PreserveTopology: " << (this->PreserveTopology ? "On" : "Off") << "\n";
  os << indent << "MinimumPieceSize: " << this->MinimumPieceSize << "\n";
  os << indent << "InterpolateAttributes: " << (this->InterpolateAttributes ? "On" : "Off") << "\n";
  os << indent << "CacheSize: " << this->CacheSize << "\n";
  os << indent << "NumberOfBlocks: " << this->NumberOfBlocks << "\n";
  os << indent << "NumberOfSlabs: " << this->GetNumberOfSlabs() << "\n";
  os << indent << "NumberOfBuilds: " << this->GetNumberOfBuilds() << "\n";
  os << indent << "NumberOfCachedHierarchies: " << this->GetNumberOfCachedHierarchies() << "\n";
  os << indent << "NumberOfRemovedPieces: " << this->NumberOfRemovedPieces << "\n";
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondVolumeAlgorithm::GetNumberOfBuilds()
{
  return this->Hierarchies->GetNumberOfBuilds();
}

//------------------------------------------------------------------------------
vtkIdType vtkIsodiamondVolumeAlgorithm::GetNumberOfCachedHierarchies()
{
  return this->Hierarchies->GetSize();
}

//------------------------------------------------------------------------------
int vtkIsodiamondVolumeAlgorithm::GetNumberOfSlabs()
{
  return this->Plan->NumberOfSlabs();
}

//------------------------------------------------------------------------------
double* vtkIsodiamondVolumeAlgorithm::GetErrorToleranceRange()
{
  double largest = 0.0;
  vtkSmartPointer<vtkDataObject> input = this->GetInput();
  vtkInformation* information =
    this->GetNumberOfInputConnections(0) > 0 ? this->GetInputInformation(0, 0) : nullptr;
  // The plan may have been made for another input.
  if (this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE && this->Plan->IsAPart() &&
    vtkIsodiamond::HasWholeImage(information))
  {
    input = vtkIsodiamond::WholeImage(information);
  }
  for (vtkDataSet* grid : vtkIsodiamond::LeavesOf(input))
  {
    if (grid->GetNumberOfPoints() == 0)
    {
      continue;
    }
    const double inUnits = vtkIsodiamond::LargestTolerance(
      static_cast<isodiamond::ErrorMetric>(this->ErrorMetric), grid, this->FindInputArray(grid));
    largest = std::max(largest, inUnits / this->GetUnit(vtkIsodiamond::VoxelOf(grid)));
  }
  this->ErrorToleranceRange[1] = largest > 0.0 ? largest : 1.0;
  return this->ErrorToleranceRange;
}

//------------------------------------------------------------------------------
int vtkIsodiamondVolumeAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkRectilinearGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsodiamondVolumeAlgorithm::ModifyRequest(vtkInformation* request, int when)
{
  const bool isForData = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA());
  if (isForData && when == vtkExecutive::BeforeForward)
  {
    this->NumberOfRemovedPieces = 0;
    this->HasFailed = false;
  }
  if (isForData && when == vtkExecutive::AfterForward)
  {
    const std::vector<vtkDataSet*> blocks = vtkIsodiamond::LeavesOf(this->GetInput());
    this->HaveBlocksTheArray = blocks.size() > 1 &&
      std::any_of(blocks.begin(), blocks.end(),
        [this](vtkDataSet* block) { return this->FindInputArray(block).Array != nullptr; });
  }
  const int success = this->Superclass::ModifyRequest(request, when);
  this->Plan->Note(this, request, when, this->Shares->IsSameGrid());
  return success;
}

//------------------------------------------------------------------------------
vtkIsodiamond::InputArray vtkIsodiamondVolumeAlgorithm::FindInputArray(vtkDataSet* input)
{
  vtkIsodiamond::InputArray found;
  if (input)
  {
    found.Array = this->GetInputArrayToProcess(0, input, found.Association);
  }
  return vtkIsodiamond::OrScalars(found, this->GetInputArrayInformation(0), input);
}

//------------------------------------------------------------------------------
int vtkIsodiamondVolumeAlgorithm::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Plan->Request(inputVector[0]->GetInformationObject(0),
    outputVector->GetInformationObject(0), this->NumberOfBlocks);
  return 1;
}

//------------------------------------------------------------------------------
/** The volume of one execution, which refers to the rest. */
struct vtkIsodiamondVolumeAlgorithm::OneInput
{
  std::unique_ptr<vtkIsodiamond::Slabs> Slabs;
  vtkSmartPointer<vtkDataObject> Whole; // if it is there at once
  vtkIsodiamond::InputArray Array;      // likewise
  vtkIsodiamond::Volume Volume;
};

//------------------------------------------------------------------------------
int vtkIsodiamondVolumeAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  bool isDone = false;
  const int success = this->Plan->Execute(this, outputVector->GetInformationObject(0),
    [&](vtkIsodiamond::Task& task)
    {
      vtkIsodiamond::WorldQuery query = this->GetQuery();
      vtkIsodiamond::CheckTolerances(query);
      vtkIsodiamond::WarnOfEmptyRegion(this, query);
      OneInput input;
      if (this->Open(inputVector[0]->GetInformationObject(0), input))
      {
        this->ExtractFrom(input, query, task, vtkDataObject::GetData(outputVector));
      }
      isDone = true;
    });
  this->HasFailed = this->HasFailed || !isDone;
  if (this->HasFailed) // this block, or one before
  {
    this->ForgetMesh();
    this->NumberOfRemovedPieces = 0;
  }
  return success;
}

//------------------------------------------------------------------------------
bool vtkIsodiamondVolumeAlgorithm::Open(vtkInformation* information, OneInput& input)
{
  input.Slabs = this->Plan->Open(
    information, [this](vtkDataSet* part) { return this->FindInputArray(part); },
    this->ClosesBoundary());
  if (input.Slabs)
  {
    input.Volume = input.Slabs->WholeVolume();
    return true;
  }
  if (this->NumberOfBlocks > 1)
  {
    vtkWarningMacro("The input comes at once, not in blocks: only images from sources that make "
                    "parts of them do, with a few slices for each block, without blanked cells.");
  }
  input.Whole = this->Plan->TakeWhole(information);
  vtkDataSet* grid = vtkDataSet::SafeDownCast(input.Whole);
  this->Shares->CheckWhole(grid, information);
  input.Array = this->FindInputArray(grid);
  if (!input.Array.Array && this->HaveBlocksTheArray)
  {
    return false;
  }
  input.Volume = vtkIsodiamond::ReadVolume(grid, input.Array, this->ClosesBoundary());
  return true;
}

//------------------------------------------------------------------------------
void vtkIsodiamondVolumeAlgorithm::ExtractFrom(const OneInput& input,
  vtkIsodiamond::WorldQuery query, vtkIsodiamond::Task& task, vtkDataObject* output)
{
  const vtkIsodiamond::Volume& volume = input.Volume;
  const double unit = this->GetUnit(volume.Placement.World.SmallestStep());
  query.ErrorTolerance *= unit;
  query.OutsideErrorTolerance *= unit;
  query.RefinesInterior = this->RefinesInterior(query, volume, input.Array.Array);
  // Where cells are hidden, an interval volume is refined inside, by all errors.
  query.OneTolerance = this->OneTolerance &&
    this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE &&
    !(volume.Hidden.Any() && AreVolumes(this->GetRegions()));
  const isodiamond::BuildOptions options = this->GetOptions(volume.Placement.World, query);
  this->RemovedFromBlock = 0;
  vtkIsodiamond::RunThreaded(this->NumberOfThreads,
    [&]
    {
      // Trimmed after an abort or an error, too, or a series of these would fill the memory.
      const vtkIsodiamond::CacheTrimmer trimmer{ *this->Hierarchies,
        std::int64_t{ this->CacheSize } << 20 };
      const bool isTogether = input.Slabs && input.Slabs->Together();
      isodiamond::InStep(isTogether ? input.Slabs->Together() : nullptr,
        [&] { this->Hierarchies->Prepare(input.Array.Array, volume, options); });
      const double built = isTogether ? 0.8 : 0.0;
      if (isTogether)
      {
        vtkIsodiamond::Task building = task.Part(0.0, built);
        this->BuildTogether(volume, query, building);
        input.Slabs->Disperse();
      }
      vtkIsodiamond::Task extracting = task.Part(built, 1.0);
      this->ExtractAtTolerance(volume, query, unit, extracting, output);
    });
  this->NumberOfRemovedPieces += this->RemovedFromBlock;
  if (this->MinimumPieceSize > 0)
  {
    vtkIsodiamond::AddNumber<vtkTypeInt64Array>(
      output->GetFieldData(), vtkIsodiamond::format::NumberOfRemovedPieces, this->RemovedFromBlock);
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondVolumeAlgorithm::BuildTogether(const vtkIsodiamond::Volume& volume,
  const vtkIsodiamond::WorldQuery& query, vtkIsodiamond::Task& task)
{
  const vtkIsodiamond::Cache::Need need = NeedOf(query);
  for (const isodiamond::Isoregion& region : this->GetRegions())
  {
    this->Hierarchies->StoredPointData(volume, region, need, this->GetPointDataWanted(), task);
  }
}

//------------------------------------------------------------------------------
bool vtkIsodiamondVolumeAlgorithm::RefinesInterior(const vtkIsodiamond::WorldQuery& query,
  const vtkIsodiamond::Volume& volume, vtkDataArray* samples)
{
  if (!(query.InteriorTolerance < VTK_DOUBLE_MAX))
  {
    return false;
  }
  // A tolerance of the values' extent or more refines nothing, if all are finite; with slabs that
  // is not known.
  double extent = VTK_DOUBLE_MAX;
  if (samples)
  {
    vtkIsodiamond::RunSerial( // once: the array keeps it
      [&] { extent = vtkIsodiamond::ExtentOfValues(samples).value_or(0.0); });
  }
  return query.InteriorTolerance < extent || !isodiamond::Finiteness(volume.Samples).All();
}

//------------------------------------------------------------------------------
double vtkIsodiamondVolumeAlgorithm::GetUnit(double voxel) const
{
  const bool isVoxel = this->ToleranceUnit == VOXELS &&
    this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE && voxel > 0.0;
  return isVoxel ? voxel : 1.0;
}

//------------------------------------------------------------------------------
vtkIsodiamond::CountedTolerance vtkIsodiamondVolumeAlgorithm::Aim(
  const vtkIsodiamond::Volume& volume, const vtkIsodiamond::WorldQuery& query,
  vtkIsodiamond::Task& task)
{
  const std::vector<isodiamond::Isoregion> regions = this->GetRegions();
  const vtkIsodiamond::Cache::Need need = NeedOf(query);
  std::vector<const isodiamond::IsodiamondHierarchy*> hierarchies;
  std::vector<const isodiamond::CellCounts*> counts;
  const bool isByTrial = vtkIsodiamond::IsCountedByTrial(query);
  const double buildPart = isByTrial ? 0.4 : 1.0;
  for (std::size_t i = 0; i < regions.size(); ++i)
  {
    const double share = buildPart / static_cast<double>(regions.size());
    vtkIsodiamond::Task part = task.Part(i * share, (i + 1) * share);
    hierarchies.push_back(&this->Hierarchies->Get(volume, regions[i], need, part));
    counts.push_back(
      &this->Hierarchies->Count(volume, regions[i], need, query.InteriorTolerance, part));
  }
  // Counts are those of uniform meshes of the whole grid.
  const bool isCounted = !query.Region && !query.View && !volume.Hidden.Any();
  if (hierarchies.empty() || (isCounted && !isByTrial))
  {
    return vtkIsodiamond::LeastTolerance(counts, this->TargetNumberOfTriangles);
  }
  vtkIsodiamond::MeshOptions options{ volume.Placement.World, volume.ArrayName };
  options.WithValues = false;
  options.PointsPrecision = this->OutputPointsPrecision;
  options.Hidden = &volume.Hidden;
  vtkIsodiamond::WorldQuery tried = query;
  vtkIsodiamond::Rounds rounds(task, buildPart, vtkIsodiamond::PartOfTrial);
  const auto cellsAt = [&](double tolerance)
  {
    vtkIsodiamond::Task counting = rounds.Next();
    tried.SetFound(tolerance);
    std::int64_t cells = 0;
    for (const isodiamond::IsodiamondHierarchy* hierarchy : hierarchies)
    {
      cells += vtkIsodiamond::CountAsAsked(*hierarchy, tried, options, counting);
    }
    return cells;
  };
  const isodiamond::ErrorCode& codes = hierarchies.front()->Codes();
  return isByTrial
    ? vtkIsodiamond::LeastToleranceBelow(
        vtkIsodiamond::LeastTolerance(counts, this->TargetNumberOfTriangles).Tolerance,
        vtkIsodiamond::CoarsestTolerance(
          query, hierarchies.front()->Header().Metric, codes.Scale(), volume.Placement.World),
        this->TargetNumberOfTriangles, cellsAt)
    : vtkIsodiamond::LeastTolerance(codes, this->TargetNumberOfTriangles, cellsAt);
}

//------------------------------------------------------------------------------
void vtkIsodiamondVolumeAlgorithm::ExtractAtTolerance(const vtkIsodiamond::Volume& volume,
  const vtkIsodiamond::WorldQuery& query, double unit, vtkIsodiamond::Task& task,
  vtkDataObject* output)
{
  constexpr double aimPart = 0.8;
  vtkIsodiamond::WorldQuery aimed = query;
  std::optional<vtkIsodiamond::CountedTolerance> found;
  if (this->TargetNumberOfTriangles > 0)
  {
    vtkIsodiamond::Task aiming = task.Part(0.0, aimPart);
    found = this->Aim(volume, query, aiming);
    aimed.SetFound(found->Tolerance);
  }
  vtkIsodiamond::Task extracting = task.Part(found ? aimPart : 0.0, 1.0);
  this->Extract(volume, aimed, extracting, output);
  this->WriteTable(volume, query, unit, extracting, output);
  // AchievedTolerance, set as ErrorTolerance, has to give this mesh.
  double achieved = found ? aimed.ErrorTolerance / unit : this->ErrorTolerance;
  while (achieved * unit < aimed.ErrorTolerance)
  {
    achieved = std::nextafter(achieved, HUGE_VAL);
  }
  this->NoteTolerance(achieved, found ? &*found : nullptr, output);
}

//------------------------------------------------------------------------------
void vtkIsodiamondVolumeAlgorithm::WriteTable(const vtkIsodiamond::Volume& volume,
  const vtkIsodiamond::WorldQuery& query, double unit, vtkIsodiamond::Task& task,
  vtkDataObject* output)
{
  const vtkIsodiamond::Cache::Need need = NeedOf(query);
  // Without all errors: as if they were not known, even if they are, since the mesh is that of a
  // new filter. Where cells are hidden, counts are too high.
  if (!need.AllErrors || volume.Hidden.Any())
  {
    return;
  }
  std::vector<const isodiamond::CellCounts*> counts;
  for (const isodiamond::Isoregion& region : this->GetRegions())
  {
    counts.push_back(
      &this->Hierarchies->Count(volume, region, need, query.InteriorTolerance, task));
  }
  if (!counts.empty())
  {
    // VTK would look for the values' extent, which the codes have, in threads of its own.
    const double largest = this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE
      ? vtkIsodiamond::LargestTolerance(isodiamond::ErrorMetric::Distance, volume.Grid, {})
      : counts.front()->Codes().Scale();
    vtkIsodiamond::WriteCounts(
      counts, this->GetNameOfCells(), largest, unit, output->GetFieldData());
  }
}

//------------------------------------------------------------------------------
isodiamond::BuildOptions vtkIsodiamondVolumeAlgorithm::GetOptions(
  const isodiamond::GridGeometry& world, const vtkIsodiamond::WorldQuery& query) const
{
  isodiamond::BuildOptions options;
  options.ExactIsovertices = this->ExactIsovertices;
  options.PreserveFeatures = this->PreserveFeatures;
  options.PreserveTopology = this->PreserveTopology;
  options.MinimumPieceSize = this->MinimumPieceSize;
  if (query.View && this->ErrorMetric != vtkIsodiamondHierarchy::DISTANCE)
  {
    throw std::invalid_argument("A view-dependent mesh needs the distance metric.");
  }
  // Full resolution is the same by either metric: grids without distances have it, too.
  if (this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE &&
    (world.Affine() || !query.IsFull() || isodiamond::FaultOfLengths(world).empty()))
  {
    options.Metric = isodiamond::ErrorMetric::Distance;
    options.World = world;
  }
  return options;
}

//------------------------------------------------------------------------------
vtkIsodiamond::Mesh vtkIsodiamondVolumeAlgorithm::ExtractMesh(const vtkIsodiamond::Volume& volume,
  const isodiamond::Isoregion& region, const vtkIsodiamond::WorldQuery& query,
  vtkIsodiamond::MeshOptions options, vtkIsodiamond::Task& task)
{
  constexpr double buildPart = 0.8;
  vtkIsodiamond::Task building = task.Part(0.0, buildPart);
  const vtkIsodiamond::Cache::Need need = NeedOf(query);
  const isodiamond::IsodiamondHierarchy& hierarchy =
    this->Hierarchies->Get(volume, region, need, building);
  const vtkIsodiamond::VolumePointData wanted = this->GetPointDataWanted();
  options.MorePointData = volume.InSlabs
    ? vtkIsodiamond::FromHierarchy(
        hierarchy, this->Hierarchies->StoredPointData(volume, region, need, wanted, building))
    : vtkIsodiamond::FromVolume(volume, wanted);
  this->RemovedFromBlock += hierarchy.Header().RemovedPieces;
  options.AreErrorsKnown = need.AllErrors;
  vtkIsodiamond::Task extracting = task.Part(buildPart, 1.0);
  return vtkIsodiamond::ExtractAsAsked(hierarchy, query, options, extracting);
}
