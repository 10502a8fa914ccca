// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Slabs.h"

#include "Mesh/MeshPoints.h"
#include "Private/Arrays.h"
#include "Private/Piece.h"

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
#include <stdexcept>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;
using Slices = isodiamond::StreamedBuild::Slices;

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

/** The slab that upstream has given last, or the first one. */
Slices SlabAtHand(vtkInformation* information, int count)
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
  return isodiamond::StreamedBuild::Cut(DimensionsOf(whole), count).front();
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

}

int CountSlabs(vtkInformation* inputInformation, int asked)
{
  const bool canBeCut = inputInformation && vtkImageData::GetData(inputInformation) &&
    inputInformation->Has(Pipeline::WHOLE_EXTENT()) &&
    inputInformation->Get(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT()) != 0;
  if (!canBeCut || asked == 1)
  {
    return 1;
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
  // Slabs share slices: there is no point in thinner ones.
  constexpr int thinnest = 8;
  const int slices = DimensionsOf(WholeExtentOf(inputInformation))[2];
  return std::clamp(count, 1, std::max(slices / thinnest, 1));
}

void RequestSlab(vtkInformation* inputInformation, int count)
{
  Request(inputInformation, WholeExtentOf(inputInformation), SlabAtHand(inputInformation, count));
}

Slabs::Slabs(vtkInformation* inputInformation, int count, ArrayFinder findArray)
  : Input(inputInformation)
  , FindArray(std::move(findArray))
  , WholeExtent(WholeExtentOf(inputInformation))
  , Cut(isodiamond::StreamedBuild::Cut(DimensionsOf(this->WholeExtent), count))
  , Whole(vtkSmartPointer<vtkImageData>::New())
{
  const Slab atHand = this->Read(SlabAtHand(this->Input, count));
  vtkImageData* image = vtkImageData::SafeDownCast(atHand.Given.Grid);
  this->Whole->SetExtent(this->WholeExtent.data());
  this->Whole->SetOrigin(image->GetOrigin());
  this->Whole->SetSpacing(image->GetSpacing());
  this->Whole->SetDirectionMatrix(image->GetDirectionMatrix());
  this->ArrayName = atHand.Given.ArrayName;

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
      "Blanked cells and ghosts need the whole volume at once: set the number of blocks to 1.");
  }
  return slab;
}

void Slabs::ForEach(Task& task, const char* phase, double begin, double end, bool shared,
  const std::function<void(const Slab&)>& body) const
{
  const auto count = static_cast<double>(this->Cut.size());
  for (std::size_t i = 0; i < this->Cut.size(); ++i)
  {
    const auto at = [&](double part) { return begin + (end - begin) * part / count; };
    task.Begin(phase, at(i), at(i + 1));
    body(this->Get(shared ? this->Cut[i] : Alone(this->Cut[i])));
  }
}

isodiamond::StagedBuild BuildInSlabs(const Slabs& slabs, const isodiamond::Isoregion& region,
  const isodiamond::BuildOptions& options, Task& task)
{
  isodiamond::StreamedBuild build(slabs.WholeVolume().Dimensions, region, task.For(), options);
  slabs.ForEach(task, "Reading signs", 0.0, 0.1, false,
    [&](const Slab& slab) { build.AddSigns(slab.Samples); });
  build.Classify();
  slabs.ForEach(task, "Placing isovertices", 0.2, 0.25, true,
    [&](const Slab& slab) { build.AddValues(slab.Samples, slab.Slices); });
  return build.Finish();
}

std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Slabs& slabs,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy, Task& task)
{
  const vtkIdType count = isodiamond::StoredPointCount(hierarchy);
  std::vector<vtkSmartPointer<vtkDataArray>> arrays;
  slabs.ForEach(task, "Reading point data", 0.0, 1.0, true,
    [&](const Slab& slab)
    {
      // The points of the slab, numbered anew, and where they belong.
      std::vector<isodiamond::MeshPoint> points;
      vtkNew<vtkIdList> ids;
      isodiamond::ForEachStoredPoint(hierarchy, isodiamond::SerialFor,
        [&](isodiamond::MeshPoint point)
        {
          const double slice = point.Index[2];
          const bool isLast = slab.Slices.End == slab.Slices.Last + 1;
          if (slice >= slab.Slices.Begin && (slice < slab.Slices.End || isLast))
          {
            ids->InsertNextId(point.Id);
            point.Id = static_cast<std::int64_t>(points.size());
            point.Index[2] -= slab.First;
            points.push_back(point);
          }
        });
      const auto ownCount = static_cast<vtkIdType>(points.size());
      vtkNew<vtkPointData> own;
      for (const PointWriter& write : FromVolume(slab.Given, wanted)(ownCount, own))
      {
        isodiamond::ForEachIndex(
          task.For(), ownCount, 1024, [&](std::int64_t i) { write(points[i]); });
      }
      for (int i = 0; i < own->GetNumberOfArrays(); ++i)
      {
        vtkDataArray* from = own->GetArray(i);
        if (static_cast<int>(arrays.size()) == i)
        {
          arrays.emplace_back(vtkSmartPointer<vtkDataArray>::Take(from->NewInstance()));
          arrays[i]->SetName(from->GetName());
          arrays[i]->SetNumberOfComponents(from->GetNumberOfComponents());
          AllocateTuples(arrays[i], count);
        }
        for (vtkIdType id = 0; id < ownCount; ++id)
        {
          arrays[i]->SetTuple(ids->GetId(id), id, from);
        }
      }
    });
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
