// SPDX-License-Identifier: BSD-3-Clause
// The point data of a volume that comes in slabs.
#include "Mesh/MeshPoints.h"
#include "Private/Build/Slabs.h"
#include "Private/Common/Arrays.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

/** The points of a hierarchy whose data a slab has, numbered anew and placed in the volume that was
 *  given. */
struct PointsOfSlab
{
  std::vector<isodiamond::PointGroup> Groups;
  std::vector<vtkIdType> Stored; ///< their numbers in the hierarchy

  PointsOfSlab(const isodiamond::IsodiamondHierarchy& hierarchy, const Slab& slab)
  {
    const bool isLast = slab.Slices.End == slab.Slices.Last + 1;
    isodiamond::ForEachStoredPointGroupNear(hierarchy, slab.Slices.Begin, slab.Slices.End,
      isodiamond::SerialFor,
      [&](const isodiamond::PointGroup& points)
      {
        isodiamond::PointGroup own;
        for (isodiamond::MeshPoint point : points)
        {
          const double slice = point.Index[2];
          if (slice >= slab.Slices.Begin && (slice < slab.Slices.End || isLast))
          {
            this->Stored.push_back(point.Id);
            point.Id = static_cast<std::int64_t>(this->Stored.size()) - 1;
            point.Index[2] -= slab.First;
            own.push_back(point);
          }
        }
        if (!own.empty())
        {
          this->Groups.push_back(std::move(own));
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
  vtkSmartPointer<vtkDataArray> array = NewLike(other, count);
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
    const auto count = static_cast<vtkIdType>(own.Stored.size());
    vtkNew<vtkPointData> data;
    const PointWriter write = Together(FromVolume(slab.Given, wanted)(count, data));
    isodiamond::ForEachIndex(
      task.For(), own.Groups.size(), 4, [&](std::int64_t i) { write(own.Groups[i]); });
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
  isodiamond::Peers* const peers = slabs.Together();
  const bool wantsOthers = isodiamond::IsAnywhere(peers, wanted.Others && slabs.HaveOtherArrays());
  if (wanted.Normals || wanted.Gradients || wantsOthers)
  {
    slabs.FindPadding(task, 0.0, 0.0);
    const Reading reading = wantsOthers ? Reading::AllArrays : Reading::Values;
    isodiamond::InStep(
      peers, [&] { slabs.ForEach(task, "Reading point data", 0.0, 1.0, reading, add); });
  }
  for (vtkDataArray* array : arrays)
  {
    if (peers)
    {
      peers->Or(Bytes(array), CountBytes(array));
    }
  }
  CheckNames(wanted, slabs.WholeVolume().ArrayName, arrays);
  return arrays;
}

}
