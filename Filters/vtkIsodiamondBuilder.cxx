// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondBuilder.h"

#include "Build/Builder.h"
#include "Field/SystemMemory.h"
#include "Private/Build/Slabs.h"
#include "Private/Common/Task.h"
#include "Private/Common/Threads.h"
#include "Private/Extraction/Share.h"
#include "Private/Input/PointData.h"
#include "Private/Input/Volume.h"
#include "Private/Parallel/InputShares.h"
#include "Private/State/State.h"

#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"

#include <optional>
#include <stdexcept>

vtkStandardNewMacro(vtkIsodiamondBuilder);

//------------------------------------------------------------------------------
vtkIsodiamondBuilder::vtkIsodiamondBuilder()
  : Shares(std::make_unique<vtkIsodiamond::InputShares>())
  , Plan(std::make_unique<vtkIsodiamond::SlabPlan>())
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkIsodiamondBuilder::~vtkIsodiamondBuilder() = default;

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::GetNumberOfSlabs()
{
  return this->Plan->NumberOfSlabs();
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Model: " << this->Model << "\n";
  os << indent << "Shape: " << this->Shape << "\n";
  os << indent << "Isovalue: " << this->Isovalue << "\n";
  os << indent << "Isorange: " << this->Isorange[0] << " " << this->Isorange[1] << "\n";
  os << indent << "ErrorMetric: " << this->ErrorMetric << "\n";
  os << indent << "ExactIsovertices: " << (this->ExactIsovertices ? "On" : "Off") << "\n";
  os << indent << "PreserveFeatures: " << (this->PreserveFeatures ? "On" : "Off") << "\n";
  os << indent << "PreserveTopology: " << (this->PreserveTopology ? "On" : "Off") << "\n";
  os << indent << "MinimumPieceSize: " << this->MinimumPieceSize << "\n";
  os << indent << "RefineInterior: " << (this->RefineInterior ? "On" : "Off") << "\n";
  os << indent << "CloseBoundary: " << (this->CloseBoundary ? "On" : "Off") << "\n";
  os << indent << "PointArrays:";
  for (const std::string& name : this->PointArrays)
  {
    os << " \"" << name << "\"";
  }
  os << "\n" << indent << "ComputeNormals: " << (this->ComputeNormals ? "On" : "Off") << "\n";
  os << indent << "NumberOfBlocks: " << this->NumberOfBlocks << "\n";
  os << indent << "NumberOfSlabs: " << this->GetNumberOfSlabs() << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::AddPointArray(const char* name)
{
  if (name && *name)
  {
    this->PointArrays.emplace_back(name);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::ClearPointArrays()
{
  if (!this->PointArrays.empty())
  {
    this->PointArrays.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::GetNumberOfPointArrays()
{
  return static_cast<int>(this->PointArrays.size());
}

//------------------------------------------------------------------------------
const char* vtkIsodiamondBuilder::GetPointArray(int i)
{
  return i >= 0 && i < this->GetNumberOfPointArrays() ? this->PointArrays[i].c_str() : nullptr;
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::WarnWithoutPointArrays()
{
  if (!this->PointArrays.empty() || this->ComputeNormals)
  {
    vtkWarningMacro("Other arrays and normals come from an image to a relevant or minimal "
                    "hierarchy only: here they have no effect.");
  }
}

//------------------------------------------------------------------------------
vtkIsodiamondHierarchy* vtkIsodiamondBuilder::GetHierarchy()
{
  return vtkIsodiamondHierarchy::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkIsodiamondBuilder::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    if (!vtkIsodiamondHierarchy::SafeDownCast(info->Get(vtkDataObject::DATA_OBJECT())))
    {
      vtkNew<vtkIsodiamondHierarchy> output;
      info->Set(vtkDataObject::DATA_OBJECT(), output);
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::ModifyRequest(vtkInformation* request, int when)
{
  this->Shares->Note(this, request, when);
  this->Plan->Note(this, request, when, this->Shares->IsSameGrid());
  return this->Superclass::ModifyRequest(request, when);
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Plan->Request(inputVector[0]->GetInformationObject(0),
    outputVector->GetInformationObject(0), this->CanBeCut() ? this->NumberOfBlocks : 1);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkIsodiamondBuilder::ClosesBoundary() const
{
  return this->CloseBoundary && this->Shape == vtkIsodiamondHierarchy::ISOSURFACE;
}

//------------------------------------------------------------------------------
bool vtkIsodiamondBuilder::CanBeCut() const
{
  return this->Model != vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS;
}

//------------------------------------------------------------------------------
int vtkIsodiamondBuilder::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  return this->Plan->Execute(this, outputVector->GetInformationObject(0),
    [&](vtkIsodiamond::Task& task)
    {
      vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
      this->Build(input, task, output);
      if (this->Shares->Of(input).Piece[0] > 0)
      {
        output->SetPoints(vtkNew<vtkPoints>());
        output->SetLines(nullptr);
      }
    });
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::Build(
  vtkDataObject* input, vtkIsodiamond::Task& task, vtkPolyData* output)
{
  vtkInformation* information = this->GetInputInformation(0, 0);
  const std::unique_ptr<vtkIsodiamond::Slabs> slabs = this->Plan->Open(
    information, [this](vtkDataSet* part) { return this->FindInputArray(part); },
    this->ClosesBoundary());
  const vtkSmartPointer<vtkDataObject> whole = this->Plan->TakeWhole(information);
  if (!slabs)
  {
    this->Shares->CheckWhole(whole, information);
  }
  const bool isKnown = this->Built && this->BuiltOf == input &&
    this->BuiltAt > std::max(input->GetMTime(), input->GetUpdateTime()) &&
    this->BuiltAt > this->GetMTime();
  // Peers build together or not at all.
  if (!isodiamond::IsAnywhere(this->Plan->Together(), !isKnown))
  {
    output->ShallowCopy(this->Built);
    return;
  }
  this->Built = nullptr;
  this->CheckModel();
  vtkIsodiamond::RemoveState(output->GetFieldData()); // the input's, if any, which came along
  if (vtkPolyData* hierarchy = vtkPolyData::SafeDownCast(input))
  {
    this->BuildFromHierarchy(hierarchy, task, output);
  }
  else if (slabs)
  {
    this->BuildFromSlabs(*slabs, task, output);
  }
  else
  {
    if (this->NumberOfBlocks > 1)
    {
      vtkWarningMacro("The input comes at once, not in blocks: only images from sources that make "
                      "parts of them do, with a few slices for each block, without blanked cells, "
                      "for relevant and minimal hierarchies.");
    }
    this->BuildFromImage(vtkImageData::SafeDownCast(whole), task, output);
  }
  this->Built = vtkSmartPointer<vtkIsodiamondHierarchy>::New();
  this->Built->ShallowCopy(output);
  this->BuiltOf = input;
  this->BuiltAt.Modified();
}

//------------------------------------------------------------------------------
vtkIsodiamond::InputArray vtkIsodiamondBuilder::FindInputArray(vtkDataObject* input)
{
  vtkIsodiamond::InputArray found;
  if (input)
  {
    found.Array = this->GetInputArrayToProcess(0, input, found.Association);
  }
  return vtkIsodiamond::OrScalars(found, this->GetInputArrayInformation(0), input);
}

//------------------------------------------------------------------------------
vtkIsodiamond::Choice vtkIsodiamondBuilder::GetChoice() const
{
  return { static_cast<isodiamond::Shape>(this->Shape), vtkIsodiamond::AsTyped(this->Isovalue),
    { vtkIsodiamond::AsTyped(this->Isorange[0]), this->Isorange[1] } };
}

//------------------------------------------------------------------------------
isodiamond::BuildOptions vtkIsodiamondBuilder::GetOptions(const isodiamond::AffineMap& world) const
{
  isodiamond::BuildOptions options;
  // An HD does not ask.
  options.Metric = this->ErrorMetric == vtkIsodiamondHierarchy::FIELD
    ? isodiamond::ErrorMetric::Field
    : isodiamond::ErrorMetric::Distance;
  options.ExactIsovertices = this->ExactIsovertices;
  options.PreserveFeatures = this->PreserveFeatures;
  options.PreserveTopology = this->PreserveTopology;
  options.MinimumPieceSize = this->MinimumPieceSize;
  options.RefineInterior = this->RefineInterior;
  options.World = world;
  return options;
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::CheckModel() const
{
  if (this->Model != vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
  {
    return;
  }
  if (this->MinimumPieceSize > 1)
  {
    throw std::invalid_argument("A hierarchy of diamonds (HD) holds all samples: it cannot be "
                                "without small pieces, so MinimumPieceSize must be 0.");
  }
  if (this->ErrorMetric == vtkIsodiamondHierarchy::DISTANCE)
  {
    throw std::invalid_argument("A hierarchy of diamonds (HD) supports the field metric only: the "
                                "distance metric needs an isovalue or isorange.");
  }
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::BuildFromImage(
  vtkImageData* image, vtkIsodiamond::Task& task, vtkPolyData* output)
{
  const vtkIsodiamond::Choice choice = this->GetChoice();
  const isodiamond::Isoregion region = choice.Region();
  const vtkIsodiamond::Volume volume =
    vtkIsodiamond::ReadVolume(image, this->FindInputArray(image), this->ClosesBoundary());
  if (volume.Hidden.Any())
  {
    vtkWarningMacro(
      "Blanked and ghost cells are in the hierarchy like all others: only the filters "
      "that make a mesh from an image in one step leave them out.");
  }
  const isodiamond::AffineMap& world = *volume.Placement.World.Affine(); // as all images'
  if (this->Model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
  {
    this->WarnWithoutPointArrays();
    isodiamond::ScalarEncoding encoding;
    task.Begin("Measuring errors", 0.0, 1.0);
    vtkIsodiamond::RunThreaded(this->NumberOfThreads,
      [&] { encoding = isodiamond::BuildScalarHierarchy(volume.Samples, task.For()); });
    vtkIsodiamond::WriteScalars(encoding, choice, this->ExactIsovertices, volume, output);
    return;
  }
  isodiamond::BuildOptions options = this->GetOptions(world);
  options.Report = task.Report();
  isodiamond::Encoding encoding;
  std::vector<vtkSmartPointer<vtkDataArray>> pointArrays;
  vtkIsodiamond::RunThreaded(this->NumberOfThreads,
    [&]
    {
      encoding = isodiamond::BuildIsodiamonds(
        static_cast<isodiamond::Model>(this->Model), volume.Samples, region, task.For(), options);
      isodiamond::ReturnFreeMemory();
      if (!this->PointArrays.empty() || this->ComputeNormals)
      {
        const isodiamond::IsodiamondHierarchy hierarchy(encoding, task.For());
        pointArrays = vtkIsodiamond::MakeStoredPointData(volume,
          { this->ComputeNormals, false, !this->PointArrays.empty(), this->PointArrays }, hierarchy,
          task.For());
      }
    });
  vtkIsodiamond::WriteIsodiamonds(encoding, choice, world, volume.ArrayName, pointArrays, output);
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::BuildFromSlabs(
  const vtkIsodiamond::Slabs& slabs, vtkIsodiamond::Task& task, vtkPolyData* output)
{
  const vtkIsodiamond::Choice choice = this->GetChoice();
  const vtkIsodiamond::Volume volume = slabs.WholeVolume();
  const isodiamond::AffineMap& world = *volume.Placement.World.Affine(); // as all images'
  isodiamond::BuildOptions options = this->GetOptions(world);
  options.Report = task.Report();
  options.Together = slabs.Together();
  options.InPortions = true;
  isodiamond::Encoding encoding;
  std::vector<vtkSmartPointer<vtkDataArray>> pointArrays;
  vtkIsodiamond::RunThreaded(this->NumberOfThreads,
    [&]
    {
      encoding =
        vtkIsodiamond::BuildInSlabs(slabs, choice.Region(), options, task)
          .Finish(static_cast<isodiamond::Model>(this->Model), volume.Samples, task.For(), options);
      isodiamond::ReturnFreeMemory();
      if (!this->PointArrays.empty() || this->ComputeNormals)
      {
        std::optional<isodiamond::IsodiamondHierarchy> hierarchy;
        isodiamond::InStep(options.Together, [&] { hierarchy.emplace(encoding, task.For()); });
        pointArrays = vtkIsodiamond::MakeStoredPointData(slabs,
          { this->ComputeNormals, false, !this->PointArrays.empty(), this->PointArrays },
          *hierarchy, task);
      }
    });
  vtkIsodiamond::WriteIsodiamonds(encoding, choice, world, volume.ArrayName, pointArrays, output);
}

//------------------------------------------------------------------------------
void vtkIsodiamondBuilder::BuildFromHierarchy(
  vtkPolyData* input, vtkIsodiamond::Task& task, vtkPolyData* output)
{
  const std::shared_ptr<const vtkIsodiamond::State> state =
    vtkIsodiamondHierarchy::ReadState(input, this->NumberOfThreads);
  if (!state->Scalars)
  {
    throw std::invalid_argument(
      "The input hierarchy is relevant or minimal: those are made for "
      "one isovalue or isorange, others come from an HD or from the image.");
  }
  this->WarnWithoutPointArrays();
  const vtkIsodiamond::Choice choice = this->GetChoice();
  if (this->Model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
  {
    output->ShallowCopy(input);
    vtkIsodiamond::WriteDefaultsOfQueries(*state, choice, this->ExactIsovertices, output);
    return;
  }
  isodiamond::BuildOptions options = this->GetOptions(state->World);
  options.Report = task.Report();
  isodiamond::Encoding encoding;
  vtkIsodiamond::RunThreaded(this->NumberOfThreads,
    [&]
    {
      encoding = isodiamond::BuildIsodiamonds(static_cast<isodiamond::Model>(this->Model),
        *state->Scalars, choice.Region(), task.For(), options);
    });
  vtkIsodiamond::WriteIsodiamonds(encoding, choice, state->World, state->ArrayName, {}, output);
}
