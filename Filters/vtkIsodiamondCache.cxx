// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondCache.h"

#include "vtkIsodiamondThreads.h"

namespace vtkIsodiamond
{

void Cache::Prepare(vtkDataArray* array, const std::array<int, 3>& dimensions, bool closed)
{
  if (array != this->Array || array->GetMTime() != this->ArrayTime ||
    dimensions != this->Dimensions || closed != this->Closed)
  {
    this->Entries.clear();
    this->Array = array;
    this->ArrayTime = array->GetMTime();
    this->Dimensions = dimensions;
    this->Closed = closed;
  }
}

const isodiamond::IsodiamondHierarchy& Cache::Get(
  const Volume& volume, const isodiamond::Isoregion& region, bool refineInterior)
{
  for (const std::unique_ptr<Entry>& entry : this->Entries)
  {
    // What can be refined inside need not be.
    if (entry->Region == region && (entry->RefineInterior || !refineInterior))
    {
      return *entry->Hierarchy;
    }
  }
  auto entry = std::make_unique<Entry>();
  entry->Region = region;
  entry->RefineInterior = refineInterior;
  entry->Encoding = isodiamond::BuildIsodiamonds(
    isodiamond::Model::Minimal, volume.Samples, region, SMPFor(), refineInterior);
  entry->Hierarchy = std::make_unique<isodiamond::IsodiamondHierarchy>(entry->Encoding, SMPFor());
  ++this->NumberOfBuilds;
  this->Entries.push_back(std::move(entry));
  return *this->Entries.back()->Hierarchy;
}

}
