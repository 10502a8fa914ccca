// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Slabs.h"

#include "Mesh/MeshPoints.h"
#include "Private/Arrays.h"
#include "Private/Piece.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
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
using Slices = isodiamond::StreamedBuild::Slices;
using isodiamond::Peers;

std::array<int, 6> WholeExtentOf(vtkInformation* information)
{
  std::array<int, 6> extent{};
  information->Get(Pipeline::WHOLE_EXTENT(), extent.data());
  return extent;
}

std::array<int, 3> DimensionsOf(const std::array<int, 6>& extent)
{
  return { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1, extent[5] - extent[4] + 1 };
}

void Request(vtkInformation* information, const std::array<int, 6>& whole, const Slices& slices)
{
  RequestWhole(information);
  std::array<int, 6> extent = whole;
  extent[4] = whole[4] + slices.First;
  extent[5] = whole[4] + slices.Last;
  information->Set(Pipeline::UPDATE_EXTENT(), extent.data(), 6);
}

/** Without the slices that it shares with others. */
Slices Alone(Slices slices)
{
  slices.First = slices.Begin;
  slices.Last = slices.End - 1;
  return slices;
}

/** Who of the peers has a slab, and which of them is the first that a peer has. */
int OwnerOf(int slab, int count, const Peers& peers)
{
  return static_cast<int>(std::int64_t{ 1 } * slab * peers.Count() / count);
}
int FirstOwn(int count, const Peers& peers)
{
  int slab = 0;
  while (OwnerOf(slab, count, peers) < peers.Rank())
  {
    ++slab;
  }
  return slab;
}

/** The slab that upstream has given last, or the first one of a peer. */
Slices SlabAtHand(vtkInformation* information, int count, const Peers* peers)
{
  const std::array<int, 6> whole = WholeExtentOf(information);
  const int* extent = vtkImageData::GetData(information)->GetExtent();
  for (const Slices& slices : isodiamond::StreamedBuild::Cut(DimensionsOf(whole), count))
  {
    for (const Slices& given : { slices, Alone(slices) })
    {
      if (whole[4] + given.First == extent[4] && whole[4] + given.Last == extent[5])
      {
        return given;
      }
    }
  }
  const int own = peers ? FirstOwn(count, *peers) : 0;
  return isodiamond::StreamedBuild::Cut(DimensionsOf(whole), count)[own];
}

/** What the image's samples take, if upstream says of what type they are; else as floats. */
double BytesOf(vtkInformation* information)
{
  vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
    information, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const int type = scalars && scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE())
    ? scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE())
    : VTK_FLOAT;
  const std::array<int, 3> dimensions = DimensionsOf(WholeExtentOf(information));
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

/** Whether upstream can make a part of its whole extent. ParaView puts a filter behind every source
 *  that passes requests on, but does not tell. */
bool MakesParts(vtkInformation* information)
{
  if (information->Get(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT()) != 0)
  {
    return true;
  }
  vtkExecutive* upstream = vtkExecutive::PRODUCER()->GetExecutive(information);
  vtkAlgorithm* algorithm = upstream ? upstream->GetAlgorithm() : nullptr;
  return algorithm && algorithm->IsA("vtkPVPostFilter") &&
    algorithm->GetNumberOfInputConnections(0) == 1 &&
    MakesParts(algorithm->GetInputInformation(0, 0));
}

/** Into how many slabs the input is cut. @param peers how many processes share them, each at least
 *  one */
int CountSlabs(vtkInformation* inputInformation, int asked, int peers)
{
  const bool canBeCut = inputInformation && vtkImageData::GetData(inputInformation) &&
    inputInformation->Has(Pipeline::WHOLE_EXTENT()) && MakesParts(inputInformation);
  if (!canBeCut || asked == 1)
  {
    return 1;
  }
  // Slabs share slices: there is no point in thinner ones.
  constexpr int thinnest = 8;
  const int most = std::max(DimensionsOf(WholeExtentOf(inputInformation))[2] / thinnest, 1);
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
    const double bytes = BytesOf(inputInformation);
    const double memory = FreeMemory();
    count = bytes <= partForVolume * memory
      ? 1
      : static_cast<int>(std::min(bytes / (partForSlab * std::max(memory, 1.0)), 1e6)) + 1;
  }
  return std::clamp(count, 1, most);
}

/** Whether upstream has given what it was asked for. */
bool IsGiven(vtkInformation* inputInformation)
{
  vtkImageData* image = vtkImageData::GetData(inputInformation);
  int asked[6];
  inputInformation->Get(Pipeline::UPDATE_EXTENT(), asked);
  const int* given = image->GetExtent();
  bool all = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    all = all && given[2 * axis] <= asked[2 * axis] && given[2 * axis + 1] >= asked[2 * axis + 1];
  }
  return all;
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
  vtkIsodiamond::Request(input, WholeExtentOf(input),
    SlabAtHand(input, this->Count, this->IsShared ? &others : nullptr));
}

void SlabPlan::Note(vtkAlgorithm* filter, vtkInformation* request, int when)
{
  if (this->IsShared && when == vtkExecutive::AfterForward &&
    request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    this->IsPeerWithout = ControllerPeers().Any(!IsGiven(filter->GetInputInformation(0, 0)));
  }
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
  const bool isHidden = HiddenCellsOf(vtkImageData::GetData(input), 0).Any();
  if (peers ? peers->Any(isHidden) : isHidden)
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
  isodiamond::InStep(peers ? &*peers : nullptr,
    [&] { slabs = std::make_unique<Slabs>(input, this->Count, std::move(findArray), peers); });
  return slabs;
}

Slabs::Slabs(vtkInformation* inputInformation, int count, ArrayFinder findArray,
  const std::optional<ControllerPeers>& peers)
  : Input(inputInformation)
  , FindArray(std::move(findArray))
  , WholeExtent(WholeExtentOf(inputInformation))
  , Cut(isodiamond::StreamedBuild::Cut(DimensionsOf(this->WholeExtent), count))
  , Whole(WholeImage(inputInformation))
  , Others(peers)
{
  const Slab atHand = this->Read(SlabAtHand(this->Input, count, this->Together()));
  this->ArrayName = atHand.Given.ArrayName;
  this->OtherArrays = atHand.Given.Grid->GetPointData()->GetNumberOfArrays() > 1;

  auto* upstream =
    vtkDemandDrivenPipeline::SafeDownCast(vtkExecutive::PRODUCER()->GetExecutive(this->Input));
  const double time = this->Input->Has(Pipeline::UPDATE_TIME_STEP())
    ? this->Input->Get(Pipeline::UPDATE_TIME_STEP())
    : 0.0;
  const std::size_t content = std::hash<double>()(time) ^ std::hash<std::string>()(this->ArrayName);
  this->StampOfUpstream = { static_cast<std::uint64_t>(upstream->GetPipelineMTime()),
    static_cast<std::uint64_t>(content ^ std::hash<const void*>()(upstream)) };
}

Volume Slabs::WholeVolume() const
{
  Volume volume;
  volume.Grid = this->Whole;
  volume.Dimensions = DimensionsOf(this->WholeExtent);
  volume.Placement = GeometryOf(this->Whole, 0);
  volume.ArrayName = this->ArrayName;
  volume.InSlabs = this;
  return volume;
}

Slab Slabs::Get(const Slices& slices) const
{
  Request(this->Input, this->WholeExtent, slices);
  vtkExecutive* upstream = vtkExecutive::PRODUCER()->GetExecutive(this->Input);
  if (!upstream->Update(vtkExecutive::PRODUCER()->GetPort(this->Input)))
  {
    throw std::runtime_error("A part of the volume cannot be had from upstream.");
  }
  return this->Read(slices);
}

Slab Slabs::Read(const Slices& slices) const
{
  vtkImageData* image = vtkImageData::GetData(this->Input);
  const int* extent = image->GetExtent();
  const std::array<int, 6>& whole = this->WholeExtent;
  if (!std::equal(extent, extent + 4, whole.begin()) || extent[4] > whole[4] + slices.First ||
    extent[5] < whole[4] + slices.Last)
  {
    throw std::runtime_error("Upstream gave another part of the volume than it was asked for.");
  }
  Slab slab;
  slab.Slices = slices;
  slab.Given = ReadVolume(image, this->FindArray(image), false);
  slab.First = extent[4] - whole[4];
  slab.Samples = { SlicesOf(
                     slab.Given.Samples, slices.First - slab.First, slices.Last + 1 - slices.First),
    slices.First };
  if (slab.Given.Hidden.Any())
  {
    throw std::runtime_error(
      "Blanked cells, of which the first block has none, need the number of blocks 1.");
  }
  return slab;
}

void Slabs::ForEach(Task& task, const char* phase, double begin, double end, bool shared,
  const std::function<void(const Slab&)>& body,
  const std::function<void(const Slices&)>& ofOthers) const
{
  if (this->HaveDispersed)
  {
    throw std::logic_error("A volume in slabs is read after its readers have dispersed.");
  }
  const auto count = static_cast<double>(this->Cut.size());
  for (std::size_t i = 0; i < this->Cut.size(); ++i)
  {
    const Peers* peers = this->Together();
    if (peers &&
      OwnerOf(static_cast<int>(i), static_cast<int>(this->Cut.size()), *peers) != peers->Rank())
    {
      if (ofOthers)
      {
        ofOthers(this->Cut[i]);
      }
      continue;
    }
    const auto at = [&](double part) { return begin + (end - begin) * part / count; };
    task.Begin(phase, at(i), at(i + 1));
    body(this->Get(shared ? this->Cut[i] : Alone(this->Cut[i])));
  }
}

isodiamond::StagedBuild BuildInSlabs(const Slabs& slabs, const isodiamond::Isoregion& region,
  const isodiamond::BuildOptions& options, Task& task)
{
  std::optional<isodiamond::StreamedBuild> build;
  Peers* const peers = options.Together;
  isodiamond::InStep(peers,
    [&]
    {
      build.emplace(slabs.WholeVolume().Dimensions, region, task.For(), options);
      slabs.ForEach(task, "Reading signs", 0.0, 0.1, false,
        [&](const Slab& slab) { build->AddSigns(slab.Samples); });
    });
  build->Classify();
  isodiamond::InStep(peers,
    [&]
    {
      slabs.ForEach(
        task, "Placing isovertices", 0.2, 0.25, true,
        [&](const Slab& slab) { build->AddValues(slab.Samples, slab.Slices); },
        [&](const Slices& slices) { build->SkipValues(slices); });
    });
  return build->Finish();
}

namespace
{

/** The points of a hierarchy whose data a slab has, numbered anew and placed in what was given. */
struct PointsOfSlab
{
  std::vector<isodiamond::MeshPoint> Points;
  std::vector<vtkIdType> Stored; ///< their numbers in the hierarchy

  PointsOfSlab(const isodiamond::IsodiamondHierarchy& hierarchy, const Slab& slab)
  {
    const bool isLast = slab.Slices.End == slab.Slices.Last + 1;
    isodiamond::ForEachStoredPoint(hierarchy, isodiamond::SerialFor,
      [&](isodiamond::MeshPoint point)
      {
        const double slice = point.Index[2];
        if (slice >= slab.Slices.Begin && (slice < slab.Slices.End || isLast))
        {
          this->Stored.push_back(point.Id);
          point.Id = static_cast<std::int64_t>(this->Points.size());
          point.Index[2] -= slab.First;
          this->Points.push_back(point);
        }
      });
  }
};

/** Bytes of an array. */
std::uint8_t* Bytes(vtkDataArray* array)
{
  return static_cast<std::uint8_t*>(array->GetVoidPointer(0));
}
std::int64_t CountBytes(vtkDataArray* array)
{
  return std::int64_t{ array->GetNumberOfValues() } * array->GetDataTypeSize();
}

/** An array like another, all 0. */
vtkSmartPointer<vtkDataArray> ZerosLike(vtkDataArray* other, vtkIdType count)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(other->NewInstance());
  array->SetName(other->GetName());
  array->SetNumberOfComponents(other->GetNumberOfComponents());
  AllocateTuples(array, count);
  std::fill_n(Bytes(array), CountBytes(array), std::uint8_t{ 0 });
  return array;
}

}

std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Slabs& slabs,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy, Task& task)
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  const auto add = [&](const Slab& slab)
  {
    const PointsOfSlab own(hierarchy, slab);
    const auto count = static_cast<vtkIdType>(own.Points.size());
    vtkNew<vtkPointData> data;
    for (const PointWriter& write : FromVolume(slab.Given, wanted)(count, data))
    {
      isodiamond::ForEachIndex(
        task.For(), count, 1024, [&](std::int64_t i) { write(own.Points[i]); });
    }
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      if (static_cast<int>(arrays.size()) == i)
      {
        arrays.push_back(ZerosLike(data->GetArray(i), isodiamond::StoredPointCount(hierarchy)));
      }
      for (vtkIdType id = 0; id < count; ++id)
      {
        arrays[i]->SetTuple(own.Stored[id], id, data->GetArray(i));
      }
    }
  };
  Peers* const peers = slabs.Together();
  if (wanted.Normals || wanted.Gradients || (wanted.Others && slabs.HaveOtherArrays()))
  {
    isodiamond::InStep(
      peers, [&] { slabs.ForEach(task, "Reading point data", 0.0, 1.0, true, add); });
  }
  for (vtkDataArray* array : arrays)
  {
    if (peers)
    {
      peers->Or(Bytes(array), CountBytes(array));
    }
  }
  for (const std::string& name : wanted.Names)
  {
    if (std::none_of(arrays.begin(), arrays.end(),
          [&](vtkDataArray* array) { return name == array->GetName(); }))
    {
      throw std::invalid_argument("The input has no other point array \"" + name + "\".");
    }
  }
  return arrays;
}

}
