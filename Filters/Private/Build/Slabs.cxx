// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Build/Slabs.h"

#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** The samples of some slices of a slab that has more. */
isodiamond::AnySamples SlicesOf(const isodiamond::AnySamples& samples, int first, int count)
{
  return std::visit(
    [&](const auto& view) -> isodiamond::AnySamples
    {
      using View = std::decay_t<decltype(view)>;
      const auto [x, y, z] = view.Dimensions();
      return View(view.Pointer() + view.Index({ 0, 0, first }), { x, y, count });
    },
    samples);
}

}

Slabs::Slabs(vtkInformation* inputInformation, int count, ArrayFinder findArray, bool closeBoundary,
  const std::optional<ControllerPeers>& peers, std::unique_ptr<Parts> parts)
  : Input(inputInformation)
  , FindArray(std::move(findArray))
  , OfPeers(std::move(parts))
  , WholeExtent(WholeExtentOf(inputInformation))
  , Cut(isodiamond::StreamedBuild::Cut(WholeDimensionsOf(this->Input), count))
  , Whole(WholeImage(inputInformation))
  , Padding(closeBoundary ? 1 : 0)
  , Others(peers)
{
  vtkImageData* image = vtkImageData::GetData(this->Input);
  if (!this->OfPeers)
  {
    // Throws if it cannot be read.
    this->Read(image, SlabAtHand(this->Input, count, this->Together()));
  }
  vtkDataArray* array = this->FindArray(image).Array;
  this->ArrayName = array && array->GetName() ? array->GetName() : "";
  this->OtherArrays = image->GetPointData()->GetNumberOfArrays() > 1;

  auto* upstream =
    vtkDemandDrivenPipeline::SafeDownCast(vtkExecutive::PRODUCER()->GetExecutive(this->Input));
  const double time = this->Input->Has(Pipeline::UPDATE_TIME_STEP())
    ? this->Input->Get(Pipeline::UPDATE_TIME_STEP())
    : 0.0;
  const std::string port = std::to_string(vtkExecutive::PRODUCER()->GetPort(this->Input));
  const std::size_t content =
    std::hash<double>()(time) ^ std::hash<std::string>()(port + ' ' + this->ArrayName);
  this->StampOfUpstream = { static_cast<std::uint64_t>(upstream->GetPipelineMTime()),
    static_cast<std::uint64_t>(content ^ std::hash<const void*>()(upstream)) };
}

Volume Slabs::WholeVolume() const
{
  Volume volume;
  volume.Grid = this->Whole;
  volume.Dimensions = WholeDimensionsOf(this->Input);
  volume.Padding = this->Padding;
  volume.Placement = GeometryOf(this->Whole, this->Padding);
  volume.ArrayName = this->ArrayName;
  volume.InSlabs = this;
  return volume;
}

Slices Slabs::InVolume(const Slices& slices) const
{
  // Padding at an end belongs to the slab there.
  const int last = WholeDimensionsOf(this->Input)[2] - 1;
  const auto begin = [&](int slice) { return slice == 0 ? 0 : slice + this->Padding; };
  const auto end = [&](int slice) { return slice + (slice == last ? 2 : 1) * this->Padding; };
  return { begin(slices.Begin), end(slices.End - 1) + 1, begin(slices.First), end(slices.Last) };
}

Slab Slabs::Get(const Slices& slices) const
{
  RequestSlab(this->Input, slices);
  vtkExecutive* upstream = vtkExecutive::PRODUCER()->GetExecutive(this->Input);
  if (!upstream->Update(vtkExecutive::PRODUCER()->GetPort(this->Input)))
  {
    throw std::runtime_error("A part of the volume cannot be had from upstream.");
  }
  return this->Read(vtkImageData::GetData(this->Input), slices);
}

Slab Slabs::Read(vtkImageData* image, const Slices& slices) const
{
  const int* extent = image->GetExtent();
  const std::array<int, 6>& whole = this->WholeExtent;
  if (!std::equal(extent, extent + 4, whole.begin()) || extent[4] > whole[4] + slices.First ||
    extent[5] < whole[4] + slices.Last)
  {
    throw std::runtime_error("Upstream gave another part of the volume than it was asked for.");
  }
  Slab slab;
  // Until the minimum is known, slices stay as given.
  const bool isPadded = this->Minimum.has_value();
  const Slices wanted = isPadded ? this->InVolume(slices) : slices;
  slab.Slices = wanted;
  slab.Given = ReadVolume(image, this->FindArray(image), isPadded, this->Minimum);
  slab.First = extent[4] - whole[4];
  slab.Samples = { SlicesOf(
                     slab.Given.Samples, wanted.First - slab.First, wanted.Last + 1 - wanted.First),
    wanted.First };
  if (slab.Given.Hidden.Any())
  {
    throw std::runtime_error(
      "Blanked cells, of which the first block has none, need the number of blocks 1.");
  }
  return slab;
}

void Slabs::FindPadding(Task& task, double begin, double end) const
{
  if (this->Padding == 0 || this->Minimum)
  {
    return;
  }
  isodiamond::FiniteRangeOfSlabs range;
  isodiamond::Peers* const peers = this->Together();
  isodiamond::InStep(peers,
    [&]
    {
      this->ForEach(task, "Reading the range", begin, end, Reading::Signs,
        [&](const Slab& slab) { range.Add(slab.Samples.Samples); });
    });
  if (peers)
  {
    range.Merge(*peers);
  }
  this->Minimum = range.Range().Minimum;
}

void Slabs::ForEach(Task& task, const char* phase, double begin, double end, Reading reading,
  const std::function<void(const Slab&)>& body,
  const std::function<void(const Slices&)>& ofOthers) const
{
  if (this->HaveDispersed)
  {
    throw std::logic_error("A volume in slabs is read after its readers have dispersed.");
  }
  isodiamond::Peers* const peers = this->Together();
  const auto count = static_cast<double>(this->Cut.size());
  vtkDataArray* const only = reading == Reading::AllArrays
    ? nullptr
    : this->FindArray(vtkImageData::GetData(this->Input)).Array;
  for (std::size_t i = 0; i < this->Cut.size(); ++i)
  {
    const Slices slices = reading == Reading::Signs ? Alone(this->Cut[i]) : this->Cut[i];
    const int owner =
      peers ? OwnerOf(static_cast<int>(i), static_cast<int>(this->Cut.size()), *peers) : 0;
    const auto visit = [&](const std::function<Slab()>& read)
    {
      if (!peers || owner == peers->Rank())
      {
        const auto at = [&](double part) { return begin + (end - begin) * part / count; };
        task.Begin(phase, at(i), at(i + 1));
        body(read());
      }
      else if (ofOthers)
      {
        ofOthers(this->InVolume(this->Cut[i]));
      }
    };
    if (this->OfPeers)
    {
      const vtkSmartPointer<vtkImageData> image =
        this->OfPeers->Gather(slices.First, slices.Last, only, owner);
      // A peer that fails here must not leave the others with the next slab.
      isodiamond::InStep(peers, [&] { visit([&] { return this->Read(image, slices); }); });
    }
    else
    {
      visit([&] { return this->Get(slices); });
    }
  }
}

isodiamond::StagedBuild BuildInSlabs(const Slabs& slabs, const isodiamond::Isoregion& region,
  const isodiamond::BuildOptions& options, Task& task)
{
  std::optional<isodiamond::StreamedBuild> build;
  isodiamond::Peers* const peers = options.Together;
  isodiamond::InStep(peers,
    [&] { build.emplace(slabs.WholeVolume().SampleDimensions(), region, task.For(), options); });
  slabs.FindPadding(task, 0.0, 0.05);
  isodiamond::InStep(peers,
    [&]
    {
      slabs.ForEach(task, "Reading signs", 0.05, 0.1, Reading::Signs,
        [&](const Slab& slab) { build->AddSigns(slab.Samples, slab.Slices); });
    });
  build->Classify();
  isodiamond::InStep(peers,
    [&]
    {
      slabs.ForEach(
        task, "Placing isovertices", 0.2, 0.25, Reading::Values,
        [&](const Slab& slab) { build->AddValues(slab.Samples, slab.Slices); },
        [&](const Slices& slices) { build->SkipValues(slices); });
    });
  return build->Finish();
}

}
