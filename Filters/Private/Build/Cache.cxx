// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Build/Cache.h"

#include "Field/SystemMemory.h"
#include "Private/Build/Slabs.h"
#include "Private/Query/HierarchyQuery.h"
#include "Refinement/LocalTolerance.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <utility>

namespace vtkIsodiamond
{
namespace
{

constexpr isodiamond::Model ModelKept = isodiamond::Model::Minimal;

/** Null if there are none. */
isodiamond::Peers* PeersOf(const Volume& volume)
{
  return volume.InSlabs ? volume.InSlabs->Together() : nullptr;
}

/** Whether two worlds surely have the same lengths. If not, they still may. Positions of
 * curvilinear ones count as the same: they are compared by their hashes. */
bool HaveSameLengths(const isodiamond::GridGeometry& a, const isodiamond::GridGeometry& b)
{
  const isodiamond::AffineMap* mapA = a.Affine();
  const isodiamond::AffineMap* mapB = b.Affine();
  if (!mapA || !mapB)
  {
    return a.Axes() && b.Axes() ? *a.Axes() == *b.Axes() : a.Positions() && b.Positions();
  }
  return std::equal(mapA->Rows.begin(), mapA->Rows.end(), mapB->Rows.begin(),
    [](const auto& rowA, const auto& rowB)
    { return std::equal(rowA.begin(), rowA.begin() + 3, rowB.begin()); });
}

/** Whether two worlds are the same, except for the grids' padding. */
bool AreSame(const isodiamond::GridGeometry& a, const isodiamond::GridGeometry& b)
{
  const isodiamond::AffineMap* mapA = a.Affine();
  const isodiamond::AffineMap* mapB = b.Affine();
  return mapA && mapB ? mapA->Rows == mapB->Rows : HaveSameLengths(a, b);
}

bool HaveSameRegion(const WorldQuery& a, const WorldQuery& b)
{
  return a.Region.has_value() == b.Region.has_value() &&
    (!a.Region ||
      (a.Region->Minimum == b.Region->Minimum && a.Region->Maximum == b.Region->Maximum &&
        a.OutsideErrorTolerance == b.OutsideErrorTolerance));
}

bool HaveSameView(const WorldQuery& a, const WorldQuery& b)
{
  return a.View.has_value() == b.View.has_value() &&
    (!a.View ||
      (a.View->Position == b.View->Position &&
        a.View->TolerancePerDistance == b.View->TolerancePerDistance));
}

/** Whether hierarchies built in one way can stand for those built in another. */
bool AreAlike(const isodiamond::BuildOptions& a, const isodiamond::BuildOptions& b)
{
  return a.Metric == b.Metric && a.ExactIsovertices == b.ExactIsovertices &&
    a.PreserveTopology == b.PreserveTopology && a.MinimumPieceSize == b.MinimumPieceSize &&
    (a.Metric == isodiamond::ErrorMetric::Field ||
      (a.PreserveFeatures == b.PreserveFeatures && HaveSameLengths(a.World, b.World)));
}

}

bool Cache::Source::operator==(const Source& other) const
{
  return this->Samples == other.Samples && this->HiddenPoints == other.HiddenPoints &&
    this->HiddenCells == other.HiddenCells && this->Positions == other.Positions &&
    this->Dimensions == other.Dimensions && this->Padding == other.Padding &&
    AreAlike(this->Options, other.Options);
}

bool Cache::Refinement::operator==(const Refinement& other) const
{
  const bool isUniform = !this->Query.Region && !this->Query.View;
  return this->Query.ErrorTolerance == other.Query.ErrorTolerance &&
    HaveSameRegion(this->Query, other.Query) && HaveSameView(this->Query, other.Query) &&
    (isUniform || AreSame(this->World, other.World));
}

void Cache::Prepare(
  vtkDataArray* array, const Volume& volume, const isodiamond::BuildOptions& options)
{
  const auto hashOf = [&](vtkDataArray* ofGrid) { return this->Hashes.Of(ofGrid, volume.Grid); };
  this->Current.Samples = volume.InSlabs ? volume.InSlabs->Stamp() : hashOf(array);
  this->Current.HiddenPoints = hashOf(volume.Grid->GetPointGhostArray());
  this->Current.HiddenCells = hashOf(volume.Grid->GetCellGhostArray());
  const bool arePlacesMeasured = options.Metric == isodiamond::ErrorMetric::Distance;
  this->Current.Positions = hashOf(arePlacesMeasured ? volume.Placement.Positions : nullptr);
  this->Current.Dimensions = volume.Dimensions;
  this->Current.Padding = volume.Padding;
  this->Current.Options = options;
}

isodiamond::BuildOptions Cache::OptionsFor(
  const Volume& volume, bool refineInterior, Task& task) const
{
  isodiamond::BuildOptions options = this->Current.Options;
  options.RefineInterior = refineInterior;
  options.Hidden = &volume.Hidden;
  options.Report = task.Report();
  options.Together = PeersOf(volume);
  return options;
}

/** Whether errors are measured as soon as there are isovertices, without making a mesh first. */
bool Cache::MeasuresAtOnce(const Need& need)
{
  return need.AllErrors || need.RefinedInterior;
}

void Cache::Build(
  const Volume& volume, const isodiamond::Isoregion& region, const Need& need, Task& task)
{
  isodiamond::BuildOptions options = this->OptionsFor(volume, need.RefinedInterior, task);
  options.InPortions = MeasuresAtOnce(need);
  std::list<Entry> added(1);
  Entry& entry = added.front();
  entry.From = this->Current;
  entry.Region = region;
  entry.RefineInterior = need.RefinedInterior;
  if (volume.InSlabs)
  {
    entry.Staged.emplace(BuildInSlabs(*volume.InSlabs, region, options, task));
  }
  // Where cells are hidden, the inside of a volume is refined, too, by its errors.
  else if (need.AllErrors || need.RefinedInterior || (region.IsVolume() && volume.Hidden.Any()))
  {
    entry.Encoding =
      isodiamond::BuildIsodiamonds(ModelKept, volume.Samples, region, task.For(), options);
    isodiamond::ReturnFreeMemory();
  }
  else
  {
    entry.Staged.emplace(volume.Samples, region, task.For(), options);
  }
  ++this->NumberOfBuilds;
  this->Entries.splice(this->Entries.begin(), added);
}

template <typename Change>
void Cache::ChangeFirst(isodiamond::Peers* peers, const Change& change)
{
  try
  {
    change(this->Entries.front());
  }
  catch (...)
  {
    if (peers || !this->Entries.front().Staged->CanGoOn())
    {
      this->Entries.pop_front();
    }
    throw;
  }
}

void Cache::MeasureErrors(const Volume& volume, Task& task)
{
  this->ChangeFirst(PeersOf(volume),
    [&](Entry& entry)
    {
      entry.Encoding = entry.Staged->Finish(ModelKept, volume.Samples, task.For(),
        this->OptionsFor(volume, entry.RefineInterior, task));
      entry.Staged.reset();
      entry.RefinedTo.reset();
      isodiamond::ReturnFreeMemory();
    });
}

void Cache::RefineTo(const WorldQuery& only, const Volume& volume, Task& task)
{
  const isodiamond::GridGeometry& world = volume.Placement.World;
  const Entry& first = this->Entries.front();
  const isodiamond::IsodiamondHierarchy& hierarchy = first.Current();
  const Refinement wanted{ HierarchyQuery(only, Measure(hierarchy), world), world };
  if (!isodiamond::IsAnywhere(PeersOf(volume), !(first.RefinedTo == wanted)))
  {
    return;
  }
  this->ChangeFirst(PeersOf(volume),
    [&](Entry& entry)
    {
      entry.RefinedTo.reset();
      const isodiamond::Query inCore = CoreQuery(wanted.Query, hierarchy, world);
      const isodiamond::LocalTolerance tolerance(inCore, hierarchy.SampleGrid());
      entry.Staged->RefineTo([&](const isodiamond::Place& place)
        { return tolerance.At(place).Surface; },
        volume.Samples, task.For(), this->OptionsFor(volume, entry.RefineInterior, task));
      entry.RefinedTo = wanted;
    });
}

std::list<Cache::Entry>::iterator Cache::Find(const isodiamond::Isoregion& region, const Need& need)
{
  const auto find = [&](bool mayBeStaged, bool mayBeDone)
  {
    return std::find_if(this->Entries.begin(), this->Entries.end(),
      [&](const Entry& entry)
      {
        // A hierarchy that can be refined inside mostly need not be.
        const bool fits = entry.RefineInterior == need.RefinedInterior ||
          (entry.RefineInterior && !need.DependsOnInterior);
        return entry.Region == region && fits && (entry.Staged ? mayBeStaged : mayBeDone) &&
          entry.From == this->Current;
      });
  };
  // A lone mesh must not depend on whether other errors are known.
  const auto done = find(false, !need.Only);
  return done != this->Entries.end() ? done : find(true, false);
}

const isodiamond::IsodiamondHierarchy& Cache::Get(
  const Volume& volume, const isodiamond::Isoregion& region, const Need& need, Task& task)
{
  const auto found = this->Find(region, need);
  const bool isKnown = found != this->Entries.end();
  const bool isStaged = isKnown && found->Staged;
  // Peers build together or not at all, and go on from the same stage.
  isodiamond::Peers* const peers = PeersOf(volume);
  const bool isUnknown = isodiamond::IsAnywhere(peers, !isKnown);
  const bool isStagedAnywhere = isodiamond::IsAnywhere(peers, isStaged);
  const bool isDoneAnywhere = isodiamond::IsAnywhere(peers, !isStaged);
  if (isUnknown || (isStagedAnywhere && isDoneAnywhere))
  {
    if (isKnown)
    {
      this->Entries.erase(found);
    }
    this->Build(volume, region, need, task);
  }
  else
  {
    found->IsUsed = true;
    this->Entries.splice(this->Entries.begin(), this->Entries, found);
  }
  // An entry whose inside has a tolerance of its own is built at once, except from slabs.
  if (this->Entries.front().Staged && MeasuresAtOnce(need))
  {
    this->MeasureErrors(volume, task);
  }
  if (need.Only)
  {
    this->RefineTo(*need.Only, volume, task);
  }
  Entry& entry = this->Entries.front();
  isodiamond::InStep(PeersOf(volume),
    [&]
    {
      if (!entry.Staged && !entry.Hierarchy)
      {
        entry.Hierarchy =
          std::make_unique<isodiamond::IsodiamondHierarchy>(entry.Encoding, task.For());
      }
    });
  return entry.Current();
}

const isodiamond::CellCounts& Cache::Count(const Volume& volume,
  const isodiamond::Isoregion& region, const Need& need, double interiorTolerance, Task& task)
{
  const isodiamond::IsodiamondHierarchy& hierarchy = this->Get(volume, region, need, task);
  Entry& entry = this->Entries.front();
  if (!entry.Counts || entry.CountedInside != interiorTolerance)
  {
    task.Begin("Counting cells", 1.0, 1.0);
    entry.Counts.emplace(hierarchy, task.For(), interiorTolerance);
    entry.CountedInside = interiorTolerance;
  }
  return *entry.Counts;
}

const std::vector<vtkSmartPointer<vtkDataArray>>& Cache::StoredPointData(const Volume& volume,
  const isodiamond::Isoregion& region, const Need& need, const VolumePointData& wanted, Task& task)
{
  const isodiamond::IsodiamondHierarchy& hierarchy = this->Get(volume, region, need, task);
  Entry& entry = this->Entries.front();
  const bool isStored = entry.Stored && *entry.Stored == wanted;
  if (isodiamond::IsAnywhere(PeersOf(volume), !isStored))
  {
    entry.Stored.reset();
    entry.StoredArrays = MakeStoredPointData(*volume.InSlabs, wanted, hierarchy, task);
    entry.Stored = wanted;
  }
  return entry.StoredArrays;
}

void Cache::Trim(std::int64_t bytes)
{
  std::int64_t left = bytes;
  for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
  {
    const std::int64_t needed = std::exchange(entry->IsUsed, false) ? 0 : entry->Bytes();
    const bool stays = needed <= left;
    left -= stays ? needed : 0;
    entry = stays ? std::next(entry) : this->Entries.erase(entry);
  }
}

}
