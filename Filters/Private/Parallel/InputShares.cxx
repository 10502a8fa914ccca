// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Parallel/InputShares.h"

#include "Private/Input/Grid.h"
#include "Private/Parallel/ControllerPeers.h"

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** Of arrays with more values only the number of values is compared. */
constexpr vtkIdType FewValues = 64;

/** What tells a hierarchy from another one: its points are in one process only. */
void WriteFieldData(vtkFieldData* data, std::ostream& text)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* const array = data->GetAbstractArray(i);
    text << (array->GetName() ? array->GetName() : "") << ' ' << array->GetNumberOfValues() << ' ';
    for (vtkIdType k = 0; array->GetNumberOfValues() <= FewValues && k < array->GetNumberOfValues();
         ++k)
    {
      text << array->GetVariantValue(k).ToString() << ' ';
    }
  }
}

/** Tells a block from others by its kind and its place. */
std::uint64_t KeyOf(vtkDataSet* block)
{
  std::ostringstream text;
  text.precision(17);
  text << block->GetClassName() << ' ';
  if (vtkPolyData::SafeDownCast(block))
  {
    WriteFieldData(block->GetFieldData(), text);
  }
  else
  {
    const std::array<int, 3> samples = DimensionsOf(block);
    const double* const bounds = block->GetBounds();
    const auto write = [&](auto value) { text << value << ' '; };
    std::for_each(samples.begin(), samples.end(), write);
    std::for_each(bounds, bounds + 6, write);
  }
  return std::hash<std::string>()(text.str());
}

}

void InputShares::Note(vtkAlgorithm* filter, vtkInformation* request, int when)
{
  if (when != vtkExecutive::AfterForward || !request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return;
  }
  vtkInformation* const output = filter->GetOutputInformation(0);
  const int count = output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  const int ghosts = output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS());
  this->Asked = { { output->Get(Pipeline::UPDATE_PIECE_NUMBER()), std::max(count, 1) }, // 0 if none
    std::max(ghosts, 0), {} };
  this->OfBlocks.clear();
  this->Same = false;
  // Hierarchies that are no blocks are the same everywhere.
  vtkDataObject* const input =
    filter->GetNumberOfInputConnections(0) > 0 ? filter->GetInputDataObject(0, 0) : nullptr;
  if (ControllerPeers::CountOf(output) > 1 && !vtkPolyData::SafeDownCast(input))
  {
    this->Compare(input);
  }
}

void InputShares::Compare(vtkDataObject* input)
{
  ControllerPeers peers;
  const auto rank = static_cast<std::uint64_t>(peers.Rank());
  const std::vector<vtkDataSet*> blocks = LeavesOf(input);
  std::vector<std::uint64_t> own; // keys, each followed by the process
  for (vtkDataSet* block : blocks)
  {
    own.insert(own.end(), { KeyOf(block), rank });
  }
  const std::vector<std::uint64_t> all = peers.Gather(own);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    Share share = this->Asked;
    share.Piece = { 0, 0 };
    std::uint64_t last = ~std::uint64_t{ 0 }; // each process once
    for (std::size_t k = 0; k < all.size(); k += 2)
    {
      if (all[k] == own[2 * i] && all[k + 1] != last)
      {
        last = all[k + 1];
        share.Piece[0] += last < rank ? 1 : 0;
        ++share.Piece[1];
      }
    }
    this->OfBlocks.emplace_back(blocks[i], share);
  }
  if (!vtkCompositeDataSet::SafeDownCast(input))
  {
    this->Same = blocks.size() == 1 && this->OfBlocks.front().second.Piece[1] == peers.Count();
    this->OfBlocks.clear(); // parts of one grid are put together
  }
}

Share InputShares::Of(vtkDataObject* input) const
{
  const auto found = std::find_if(this->OfBlocks.begin(), this->OfBlocks.end(),
    [&](const auto& block) { return block.first == input; });
  return found != this->OfBlocks.end() ? found->second : this->Asked;
}

void InputShares::CheckWhole(vtkDataObject* volume, vtkInformation* inputInformation) const
{
  vtkInformation* data = volume ? volume->GetInformation() : nullptr;
  if (this->Of(volume).Piece[1] == 1 || this->Same || !data ||
    !data->Has(vtkDataObject::DATA_EXTENT()) || !inputInformation->Has(Pipeline::WHOLE_EXTENT()))
  {
    return;
  }
  int whole[6];
  int extent[6];
  inputInformation->Get(Pipeline::WHOLE_EXTENT(), whole);
  data->Get(vtkDataObject::DATA_EXTENT(), extent);
  for (int axis = 0; axis < 3; ++axis)
  {
    const bool isKnown = whole[2 * axis] <= whole[2 * axis + 1];
    if (!isKnown || extent[2 * axis] > whole[2 * axis] ||
      extent[2 * axis + 1] < whole[2 * axis + 1])
    {
      throw std::invalid_argument("The input is a part of the volume, though all of it was asked "
                                  "for: in parallel every process needs the whole volume.");
    }
  }
}

}
