// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Input/Request.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cstdint>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** The algorithm that an input comes from; null if there is none. */
vtkAlgorithm* ProducerOf(vtkInformation* input)
{
  vtkExecutive* upstream = vtkExecutive::PRODUCER()->GetExecutive(input);
  return upstream ? upstream->GetAlgorithm() : nullptr;
}

/** Behind every source ParaView puts a filter that passes requests on, but does not say so.
 *  @return its input, if an input comes from one; or null */
vtkInformation* BeforeParaView(vtkInformation* input)
{
  vtkAlgorithm* algorithm = ProducerOf(input);
  return algorithm && algorithm->IsA("vtkPVPostFilter") &&
      algorithm->GetNumberOfInputConnections(0) == 1
    ? algorithm->GetInputInformation(0, 0)
    : nullptr;
}

/** Whether one extent is within another one. */
bool IsWithin(const int* inner, const int* outer)
{
  return inner[0] >= outer[0] && inner[1] <= outer[1] && inner[2] >= outer[2] &&
    inner[3] <= outer[3] && inner[4] >= outer[4] && inner[5] <= outer[5];
}

/** The first of some slabs that a peer has. */
int FirstOwn(int count, const isodiamond::Peers& peers)
{
  int slab = 0;
  while (OwnerOf(slab, count, peers) < peers.Rank())
  {
    ++slab;
  }
  return slab;
}

}

bool MakesParts(vtkInformation* input)
{
  vtkInformation* before = BeforeParaView(input);
  return input->Get(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT()) != 0 || (before && MakesParts(before));
}

// Raw files are read by a reader within one that ParaView has for series of image files.
bool ReadsTogether(vtkInformation* input)
{
  vtkInformation* before = BeforeParaView(input);
  if (before)
  {
    return ReadsTogether(before);
  }
  vtkAlgorithm* algorithm = ProducerOf(input);
  return algorithm &&
    (algorithm->IsA("vtkMPIImageReader") || algorithm->IsA("vtkPNrrdReader") ||
      algorithm->IsA("vtkImageFileSeriesReader"));
}

bool ConvertsCells(vtkInformation* input)
{
  vtkInformation* beforeInput = BeforeParaView(input);
  vtkDataSet* before = beforeInput ? vtkDataSet::GetData(beforeInput) : nullptr;
  vtkDataSet* after = vtkDataSet::GetData(input);
  return before && after && before->GetCellData()->GetNumberOfArrays() > 0 &&
    after->GetPointData()->GetNumberOfArrays() > before->GetPointData()->GetNumberOfArrays();
}

std::array<int, 6> WholeExtentOf(vtkInformation* input)
{
  std::array<int, 6> extent{};
  input->Get(Pipeline::WHOLE_EXTENT(), extent.data());
  return extent;
}

std::array<int, 3> WholeDimensionsOf(vtkInformation* input)
{
  const std::array<int, 6> extent = WholeExtentOf(input);
  return { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1, extent[5] - extent[4] + 1 };
}

bool HasWholeImage(vtkInformation* input)
{
  if (!input || !vtkImageData::GetData(input) || !input->Has(Pipeline::WHOLE_EXTENT()))
  {
    return false;
  }
  const std::array<int, 3> samples = WholeDimensionsOf(input); // none if the source does not say
  return samples[0] > 0 && samples[1] > 0 && samples[2] > 0;
}

vtkSmartPointer<vtkImageData> WholeImage(vtkInformation* input)
{
  vtkImageData* slab = vtkImageData::GetData(input);
  auto whole = vtkSmartPointer<vtkImageData>::New();
  whole->SetExtent(WholeExtentOf(input).data());
  whole->SetOrigin(slab->GetOrigin());
  whole->SetSpacing(slab->GetSpacing());
  whole->SetDirectionMatrix(slab->GetDirectionMatrix());
  return whole;
}

Slices Alone(Slices slices)
{
  slices.First = slices.Begin;
  slices.Last = slices.End - 1;
  return slices;
}

int OwnerOf(int slab, int count, const isodiamond::Peers& peers)
{
  return static_cast<int>(std::int64_t{ 1 } * slab * peers.Count() / count);
}

Slices SlabAtHand(vtkInformation* input, int count, const isodiamond::Peers* peers)
{
  const std::array<int, 6> whole = WholeExtentOf(input);
  const int* extent = vtkImageData::GetData(input)->GetExtent();
  const std::vector<Slices> cut = isodiamond::StreamedBuild::Cut(WholeDimensionsOf(input), count);
  for (const Slices& slices : cut)
  {
    for (const Slices& given : { slices, Alone(slices) })
    {
      if (whole[4] + given.First == extent[4] && whole[4] + given.Last == extent[5])
      {
        return given;
      }
    }
  }
  return cut[peers ? FirstOwn(count, *peers) : 0];
}

void RequestWhole(vtkInformation* inputInformation)
{
  if (!inputInformation)
  {
    return;
  }
  if (inputInformation->Has(Pipeline::WHOLE_EXTENT()))
  {
    int extent[6];
    inputInformation->Get(Pipeline::WHOLE_EXTENT(), extent);
    inputInformation->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
  }
  inputInformation->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  inputInformation->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  inputInformation->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

void RequestSlab(vtkInformation* input, const Slices& slices)
{
  RequestWhole(input);
  std::array<int, 6> extent = WholeExtentOf(input);
  extent[5] = extent[4] + slices.Last;
  extent[4] += slices.First;
  input->Set(Pipeline::UPDATE_EXTENT(), extent.data(), 6);
}

bool RequestPart(vtkInformation* input, const isodiamond::Peers& peers)
{
  std::array<int, 6> whole = WholeExtentOf(input);
  vtkNew<vtkExtentTranslator> translator;
  std::array<int, 6> own{};
  bool isThere = true;
  for (int rank = 0; rank < peers.Count(); ++rank)
  {
    std::array<int, 6> part{};
    translator->PieceToExtentThreadSafe(
      rank, peers.Count(), 0, whole.data(), part.data(), vtkExtentTranslator::BLOCK_MODE, 0);
    isThere = isThere && part[0] <= part[1] && part[2] <= part[3] && part[4] <= part[5];
    own = rank == peers.Rank() ? part : own;
  }
  if (isThere)
  {
    RequestWhole(input); // as piece 0 of 1: otherwise upstream would cut the part once more
    input->Set(Pipeline::UPDATE_EXTENT(), own.data(), 6);
  }
  return isThere;
}

bool IsGiven(vtkInformation* input)
{
  int asked[6];
  input->Get(Pipeline::UPDATE_EXTENT(), asked);
  return IsWithin(asked, vtkImageData::GetData(input)->GetExtent());
}

bool IsBeyondWhole(vtkInformation* input)
{
  return !IsWithin(vtkImageData::GetData(input)->GetExtent(), WholeExtentOf(input).data());
}

}
