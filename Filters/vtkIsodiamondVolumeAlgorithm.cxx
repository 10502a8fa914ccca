// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondVolumeAlgorithm.h"

#include "Patches/WorldLengths.h"
#include "Private/Cache.h"
#include "Private/Format.h"
#include "Private/Input.h"
#include "Private/Mesh.h"
#include "Private/Piece.h"
#include "Private/Task.h"
#include "Private/Threads.h"
#include "Private/WorldQuery.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"

#include <algorithm>

//------------------------------------------------------------------------------
vtkIsodiamondVolumeAlgorithm::vtkIsodiamondVolumeAlgorithm()
  : Hierarchies(std::make_unique<vtkIsodiamond::Cache>())
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
  os << indent << "ExactIsovertices: " << (this->ExactIsovertices ? "On" : "Off") << "\n";
  os << indent << "PreserveFeatures: " << (this->PreserveFeatures ? "On" : "Off") << "\n";
  os << indent << "PreserveTopology: " << (this->PreserveTopology ? "On" : "Off") << "\n";
  os << indent << "MinimumPieceSize: " << this->MinimumPieceSize << "\n";
  os << indent << "InterpolateAttributes: " << (this->InterpolateAttributes ? "On" : "Off") << "\n";
  os << indent << "CacheSize: " << this->CacheSize << "\n";
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
double* vtkIsodiamondVolumeAlgorithm::GetErrorToleranceRange()
{
  double largest = 0.0;
  for (vtkDataSet* grid : vtkIsodiamond::LeavesOf(this->GetInput()))
  {
    largest = std::max(largest,
      vtkIsodiamond::LargestTolerance(
        static_cast<isodiamond::ErrorMetric>(this->ErrorMetric), grid, this->FindInputArray(grid)));
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
  if (when == vtkExecutive::BeforeForward && request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    this->NumberOfRemovedPieces = 0;
  }
  return this->Superclass::ModifyRequest(request, when);
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
int vtkIsodiamondVolumeAlgorithm::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  return vtkIsodiamond::Execute(this, output,
    [&](vtkIsodiamond::Task& task)
    {
      const vtkIsodiamond::WorldQuery query = this->GetQuery();
      vtkIsodiamond::CheckTolerances(query);
      vtkDataSet* grid = vtkDataSet::GetData(inputVector[0]);
      vtkIsodiamond::CheckWhole(grid, inputVector[0]->GetInformationObject(0), this->Piece);
      const vtkIsodiamond::InputArray array = this->FindInputArray(grid);
      const vtkIsodiamond::Volume volume =
        vtkIsodiamond::ReadVolume(grid, array, this->ClosesBoundary());
      const isodiamond::BuildOptions options = this->GetOptions(volume.Placement.World, query);
      this->RemovedFromBlock = 0;
      vtkIsodiamond::RunThreaded(this->NumberOfThreads,
        [&]
        {
          // Trimmed after an abortion or an error, too, or runs of these would fill the memory.
          const vtkIsodiamond::CacheTrimmer trimmer{ *this->Hierarchies,
            std::int64_t{ this->CacheSize } << 20 };
          this->Hierarchies->Prepare(array.Array, volume, options);
          this->Extract(volume, query, task, output);
        });
      vtkIsodiamond::KeepPiece(output, this->Piece);
      this->NumberOfRemovedPieces += this->RemovedFromBlock;
      if (this->MinimumPieceSize > 0)
      {
        vtkNew<vtkIdTypeArray> removed;
        removed->SetName(vtkIsodiamond::format::NumberOfRemovedPieces);
        removed->InsertNextValue(this->RemovedFromBlock);
        output->GetFieldData()->AddArray(removed);
      }
    });
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
  const isodiamond::Isoregion& region, bool refineInterior, const vtkIsodiamond::WorldQuery& query,
  const vtkIsodiamond::MeshOptions& options, vtkIsodiamond::Task& task)
{
  constexpr double buildPart = 0.8;
  vtkIsodiamond::Task building = task.Part(0.0, buildPart);
  const isodiamond::IsodiamondHierarchy& hierarchy =
    this->Hierarchies->Get(volume, region, { !query.IsFull(), refineInterior }, building);
  this->RemovedFromBlock += hierarchy.Header().RemovedPieces;
  vtkIsodiamond::Task extracting = task.Part(buildPart, 1.0);
  extracting.Begin("Refining", 0.0, 0.3);
  const isodiamond::RefinedSet refined(hierarchy,
    vtkIsodiamond::CoreQuery(query, hierarchy.SampleGrid(), volume.Placement.World),
    extracting.For());
  return vtkIsodiamond::ExtractMesh(refined, options, extracting);
}
