// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Build/SlabPlan.h"

#include "Private/Build/Slabs.h"
#include "Private/Common/Task.h"
#include "Private/Extraction/Share.h"
#include "Private/Input/Request.h"
#include "Private/Parallel/ControllerPeers.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <vtksys/SystemInformation.hxx>

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

/** The bytes that the image's samples take, of the type that upstream states, else as floats. */
double BytesOf(vtkInformation* input)
{
  vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
    input, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const int type = scalars && scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE())
    ? scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE())
    : VTK_FLOAT;
  const std::array<int, 3> dimensions = WholeDimensionsOf(input);
  return std::accumulate(dimensions.begin(), dimensions.end(),
    double{ 1.0 * vtkDataArray::GetDataTypeSize(type) }, std::multiplies<>());
}

/** The bytes of memory that are not in use. */
double FreeMemory()
{
  vtksys::SystemInformation system;
  constexpr double kibibyte = 1024.0;
  return kibibyte * static_cast<double>(system.GetHostMemoryTotal() - system.GetHostMemoryUsed());
}

/** Slabs share slices: there is no point in thinner ones. */
int MostSlabs(vtkInformation* input)
{
  constexpr int thinnest = 8;
  return std::max(WholeDimensionsOf(input)[2] / thinnest, 1);
}

/** Into how many slabs the input of peers is cut: at least one for each, or none at all. */
int CountShared(vtkInformation* input, int asked, int peers)
{
  const int most = MostSlabs(input);
  // Free memory differs between them.
  return asked != 1 && peers <= most ? std::clamp(asked, peers, most) : 1;
}

/** Into how many slabs the input of one process is cut. */
int CountAlone(vtkInformation* input, int asked)
{
  int count = asked;
  if (asked == 0)
  {
    // What is built takes memory, too.
    constexpr double partForVolume = 0.5;
    constexpr double partForSlab = 1.0 / 16;
    const double bytes = BytesOf(input);
    const double memory = FreeMemory();
    count = bytes <= partForVolume * memory
      ? 1
      : static_cast<int>(std::min(bytes / (partForSlab * std::max(memory, 1.0)), 1e6)) + 1;
  }
  return std::clamp(count, 1, MostSlabs(input));
}

/** Whether upstream has not made what it should have: its output is empty, or the previous one. */
bool HasFailed(vtkInformation* input)
{
  vtkImageData* image = vtkImageData::GetData(input);
  auto* upstream =
    vtkDemandDrivenPipeline::SafeDownCast(vtkExecutive::PRODUCER()->GetExecutive(input));
  // A trivial producer does not make what it gives.
  const bool makes = upstream && !upstream->GetAlgorithm()->IsA("vtkTrivialProducer");
  return image->GetNumberOfPoints() == 0 ||
    (makes && image->GetUpdateTime() < upstream->GetPipelineMTime());
}

void Update(vtkInformation* input)
{
  vtkExecutive::PRODUCER()->GetExecutive(input)->Update(vtkExecutive::PRODUCER()->GetPort(input));
}

/** Whether upstream gives the slabs of the whole that it is asked for. Time steps may have extents
 *  other than it says: then it gives all of a step, whatever it is asked for. */
bool GivesSlabs(vtkInformation* input, int count)
{
  if (!IsGiven(input) || IsBeyondWhole(input))
  {
    return false;
  }
  const std::array<int, 6> whole = WholeExtentOf(input);
  std::array<int, 6> asked{};
  input->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), asked.data());
  std::array<int, 6> given{};
  vtkImageData::GetData(input)->GetExtent(given.data());
  if (given == asked || given == whole)
  {
    return true;
  }
  // It may just give more, or still have that; if so, both ends can be had, the first one last.
  const std::vector<Slices> cut = isodiamond::StreamedBuild::Cut(WholeDimensionsOf(input), count);
  const std::array<Slices, 2> ends = { cut.back(), cut.front() };
  return std::all_of(ends.begin(), ends.end(),
    [&](const Slices& end)
    {
      RequestSlab(input, end);
      Update(input);
      return IsGiven(input);
    });
}

}

void SlabPlan::Request(vtkInformation* input, vtkInformation* output, int blocks)
{
  const bool isImage = HasWholeImage(input);
  const int peers = isImage ? ControllerPeers::CountOf(output) : 1;
  this->Peers.reset();
  if (peers > 1)
  {
    this->Peers.emplace();
  }
  this->Blocks = blocks;
  this->IsPeerWithout = false;
  this->AreParts = false;
  this->AskedForParts = false;
  this->Gathered = nullptr;
  this->Count = 1;
  if (peers > 1 && blocks != 1 && ReadsTogether(input) && RequestPart(input, *this->Peers))
  {
    // Slabs are read by one process or another, but here all of them have to read together.
    this->AskedForParts = true;
    this->IsShared = false;
    return;
  }
  if (isImage && MakesParts(input) && !(peers > 1 && ReadsTogether(input)))
  {
    this->Count = CountShared(input, blocks, peers);
    if (this->Count == 1)
    {
      this->Count = CountAlone(input, blocks);
    }
  }
  this->IsShared = peers > 1 && this->Count >= peers;
  if (this->Count == 1)
  {
    RequestWhole(input);
    return;
  }
  RequestSlab(input, SlabAtHand(input, this->Count, this->IsShared ? &*this->Peers : nullptr));
}

void SlabPlan::Note(vtkAlgorithm* filter, vtkInformation* request, int when, bool isSame)
{
  if (this->Peers && when == vtkExecutive::AfterForward &&
    request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    vtkInformation* input = filter->GetInputInformation(0, 0);
    this->IsPeerWithout = this->Peers->Any(HasFailed(input));
    const bool isOther = this->Peers->Any(!IsGiven(input) || IsBeyondWhole(input));
    this->AreParts = !isSame && (isOther || this->AskedForParts);
    if (isSame && isOther)
    {
      // All that there is at this time, though upstream says otherwise.
      this->Count = 1;
      this->IsShared = false;
    }
  }
}

int SlabPlan::Execute(
  vtkAlgorithm* filter, vtkInformation* output, const std::function<void(Task&)>& work)
{
  vtkDataObject* data = vtkDataObject::GetData(output);
  const bool isDone = Succeeds(filter, data,
    [&](Task& task)
    {
      if (this->IsPeerWithout)
      {
        throw std::runtime_error("Another process has got no part of the volume.");
      }
      isodiamond::InStep(this->Peers ? &*this->Peers : nullptr, [&] { work(task); });
    });
  if (this->Peers && !isDone)
  {
    data->ReleaseData();
    output->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
  return 1;
}

vtkSmartPointer<vtkDataObject> SlabPlan::TakeWhole(vtkInformation* input)
{
  vtkSmartPointer<vtkDataObject> whole = std::move(this->Gathered);
  return whole ? whole : vtkSmartPointer<vtkDataObject>(vtkDataObject::GetData(input));
}

std::unique_ptr<Slabs> SlabPlan::Open(
  vtkInformation* input, ArrayFinder findArray, bool closeBoundary)
{
  if (this->AreParts)
  {
    return this->OpenParts(input, std::move(findArray), closeBoundary);
  }
  if (this->Count == 1)
  {
    return nullptr;
  }
  isodiamond::Peers* const others = this->IsShared ? &*this->Peers : nullptr;
  // Which diamonds touch hidden cells depends on all such cells, and what is inside on field
  // errors.
  bool isWhole = false;
  isodiamond::InStep(others,
    [&]
    {
      isWhole = HiddenCellsOf(vtkImageData::GetData(input), 0).Any() || ConvertsCells(input) ||
        (!others && !GivesSlabs(input, this->Count));
    });
  if (isodiamond::IsAnywhere(others, isWhole))
  {
    this->GetAtOnce(input);
    return nullptr;
  }
  std::unique_ptr<Slabs> slabs;
  isodiamond::InStep(others,
    [&]
    {
      slabs = std::make_unique<Slabs>(input, this->Count, std::move(findArray), closeBoundary,
        this->IsShared ? this->Peers : std::nullopt);
    });
  return slabs;
}

/** Gets the whole input in each process, if that is possible. */
void SlabPlan::GetAtOnce(vtkInformation* input)
{
  this->Count = 1;
  this->IsShared = false;
  this->AreParts = false;
  RequestWhole(input);
  Update(input);
}

std::unique_ptr<Slabs> SlabPlan::OpenParts(
  vtkInformation* input, ArrayFinder findArray, bool closeBoundary)
{
  if (this->AskedForParts && this->Peers->Any(ConvertsCells(input)))
  {
    this->GetAtOnce(input);
    return nullptr;
  }
  auto parts = std::make_unique<Parts>(input, *this->Peers);
  this->Count = parts->HaveBlanks() ? 1 : CountShared(input, this->Blocks, this->Peers->Count());
  this->IsShared = this->Count > 1;
  if (!this->IsShared)
  {
    const int slices = WholeDimensionsOf(input)[2];
    this->Gathered = parts->Gather(0, slices - 1, nullptr, Parts::Everyone);
    return nullptr;
  }
  std::unique_ptr<Slabs> slabs;
  isodiamond::InStep(&*this->Peers,
    [&]
    {
      slabs = std::make_unique<Slabs>(
        input, this->Count, std::move(findArray), closeBoundary, this->Peers, std::move(parts));
    });
  return slabs;
}

}
