// SPDX-License-Identifier: BSD-3-Clause
#include "Private/SlabPlan.h"

#include "Private/ControllerPeers.h"
#include "Private/Piece.h"
#include "Private/SlabRequest.h"
#include "Private/Slabs.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
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

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** What the image's samples take, if upstream says of what type they are; else as floats. */
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

/** The bytes of memory that nobody uses. */
double FreeMemory()
{
  vtksys::SystemInformation system;
  constexpr double kibibyte = 1024.0;
  return kibibyte * static_cast<double>(system.GetHostMemoryTotal() - system.GetHostMemoryUsed());
}

/** Into how many slabs the input is cut. @param peers how many processes share them, each at least
 *  one */
int CountSlabs(vtkInformation* input, int asked, int peers)
{
  const bool canBeCut = input && vtkImageData::GetData(input) &&
    input->Has(Pipeline::WHOLE_EXTENT()) && MakesParts(input);
  if (!canBeCut || asked == 1)
  {
    return 1;
  }
  // Slabs share slices: there is no point in thinner ones.
  constexpr int thinnest = 8;
  const int most = std::max(WholeDimensionsOf(input)[2] / thinnest, 1);
  if (peers > 1 && peers <= most)
  {
    return std::clamp(asked, peers, most); // free memory is another in each of them
  }
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
  return std::clamp(count, 1, most);
}

}

void SlabPlan::Request(vtkInformation* input, vtkInformation* output, bool canBeCut, int blocks)
{
  const int peers = ControllerPeers::CountOf(output);
  this->Count = canBeCut ? CountSlabs(input, blocks, peers) : 1;
  this->IsShared = peers > 1 && this->Count >= peers;
  if (this->Count == 1)
  {
    RequestWhole(input);
    return;
  }
  const ControllerPeers others;
  RequestSlab(input, SlabAtHand(input, this->Count, this->IsShared ? &others : nullptr));
}

void SlabPlan::Note(vtkAlgorithm* filter, vtkInformation* request, int when)
{
  if (this->IsShared && when == vtkExecutive::AfterForward &&
    request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    this->IsPeerWithout = ControllerPeers().Any(!IsGiven(filter->GetInputInformation(0, 0)));
  }
}

std::unique_ptr<Slabs> SlabPlan::Open(vtkInformation* input, ArrayFinder findArray)
{
  if (this->Count == 1)
  {
    return nullptr;
  }
  std::optional<ControllerPeers> peers;
  if (this->IsShared)
  {
    if (this->IsPeerWithout)
    {
      throw std::runtime_error("Another process has got no part of the volume.");
    }
    peers.emplace();
  }
  isodiamond::Peers* const others = peers ? &*peers : nullptr;
  bool isHidden = false;
  isodiamond::InStep(
    others, [&] { isHidden = HiddenCellsOf(vtkImageData::GetData(input), 0).Any(); });
  if (isodiamond::IsAnywhere(others, isHidden))
  {
    // Which diamonds touch hidden cells is told by all of these, and what is inside by field
    // errors.
    this->Count = 1;
    this->IsShared = false;
    RequestWhole(input);
    vtkExecutive::PRODUCER()->GetExecutive(input)->Update(vtkExecutive::PRODUCER()->GetPort(input));
    return nullptr;
  }
  std::unique_ptr<Slabs> slabs;
  isodiamond::InStep(others,
    [&] { slabs = std::make_unique<Slabs>(input, this->Count, std::move(findArray), peers); });
  return slabs;
}

}
