// SPDX-License-Identifier: BSD-3-Clause
#include "Private/SlabRequest.h"

#include "Private/Piece.h"

#include "vtkAlgorithm.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cstdint>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

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

// Behind every source ParaView puts a filter that passes requests on, but does not say so.
bool MakesParts(vtkInformation* input)
{
  if (input->Get(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT()) != 0)
  {
    return true;
  }
  vtkExecutive* upstream = vtkExecutive::PRODUCER()->GetExecutive(input);
  vtkAlgorithm* algorithm = upstream ? upstream->GetAlgorithm() : nullptr;
  return algorithm && algorithm->IsA("vtkPVPostFilter") &&
    algorithm->GetNumberOfInputConnections(0) == 1 &&
    MakesParts(algorithm->GetInputInformation(0, 0));
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
  return input != nullptr && vtkImageData::GetData(input) != nullptr &&
    input->Has(Pipeline::WHOLE_EXTENT());
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

void RequestSlab(vtkInformation* input, const Slices& slices)
{
  RequestWhole(input);
  std::array<int, 6> extent = WholeExtentOf(input);
  extent[5] = extent[4] + slices.Last;
  extent[4] += slices.First;
  input->Set(Pipeline::UPDATE_EXTENT(), extent.data(), 6);
}

bool IsGiven(vtkInformation* input)
{
  vtkImageData* image = vtkImageData::GetData(input);
  int asked[6];
  input->Get(Pipeline::UPDATE_EXTENT(), asked);
  const int* given = image->GetExtent();
  bool all = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    all = all && given[2 * axis] <= asked[2 * axis] && given[2 * axis + 1] >= asked[2 * axis + 1];
  }
  return all;
}

}
