// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondCache.h"

#include "vtkIsodiamondThreads.h"

namespace vtkIsodiamond
{

namespace
{

/** Whether hierarchies built in one way can stand for those built in another. */
bool AreAlike(const isodiamond::BuildOptions& a, const isodiamond::BuildOptions& b)
{
  bool sameLengths = a.Metric == isodiamond::ErrorMetric::Field;
  if (!sameLengths)
  {
    sameLengths = a.PreserveFeatures == b.PreserveFeatures;
    for (int i = 0; i < 3; ++i)
    {
      sameLengths = sameLengths &&
        std::equal(a.World.Rows[i].begin(), a.World.Rows[i].begin() + 3, b.World.Rows[i].begin());
    }
  }
  return a.Metric == b.Metric && a.ExactIsovertices == b.ExactIsovertices && sameLengths;
}

}

void Cache::Prepare(
  vtkDataArray* array, const Volume& volume, bool closed, const isodiamond::BuildOptions& options)
{
  if (array != this->Array || array->GetMTime() != this->ArrayTime ||
    volume.Dimensions != this->Dimensions || closed != this->Closed ||
    !AreAlike(options, this->Options))
  {
    this->Entries.clear();
    this->Array = array;
    this->ArrayTime = array->GetMTime();
    this->Dimensions = volume.Dimensions;
    this->Closed = closed;
  }
  this->Options = options;
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
  this->Options.RefineInterior = refineInterior;
  entry->Encoding = isodiamond::BuildIsodiamonds(
    isodiamond::Model::Minimal, volume.Samples, region, SMPFor(), this->Options);
  entry->Hierarchy = std::make_unique<isodiamond::IsodiamondHierarchy>(entry->Encoding, SMPFor());
  ++this->NumberOfBuilds;
  this->Entries.push_back(std::move(entry));
  return *this->Entries.back()->Hierarchy;
}

}
