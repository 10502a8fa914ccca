// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Cache_h
#define vtkIsodiamond_Cache_h

#include "Build/StagedBuild.h"
#include "Mesh/CellCounts.h"
#include "Private/ContentHash.h"
#include "Private/Input.h"
#include "Private/PointData.h"
#include "Private/Task.h"
#include "Private/WorldQuery.h"

#include "vtkType.h"

#include <cstdint>
#include <list>
#include <memory>
#include <optional>

namespace vtkIsodiamond
{

/**
 * The minimal hierarchies that a one-step filter has built: of the blocks of its input, of time
 * steps that were shown before, of isovalues.
 *
 * Volumes count as the same when the values of their arrays, their dimensions, padding and hidden
 * cells are; with the distance metric their lengths in the world have to be, too. All other
 * geometry is applied on extraction. What was used longest ago is forgotten first.
 */
class Cache
{
public:
  /** The volume and the way to build that what follows is about. @param array the grid's own,
   *  before padding @param options RefineInterior is Get()'s */
  void Prepare(vtkDataArray* array, const Volume& volume, const isodiamond::BuildOptions& options);

  /** What of a hierarchy a query needs. */
  struct Need
  {
    bool AllErrors = true; ///< else it asks for full resolution, or for one mesh only
    bool RefinedInterior = false;
    /** By the distance metric, without all errors: what that mesh is asked for with. Not of an
     *  interval volume with hidden cells, which is refined inside. */
    std::optional<WorldQuery> Only = std::nullopt;
  };

  /** The hierarchy of a region; built if there is none yet, and its errors measured when a query
   *  first needs them. */
  const isodiamond::IsodiamondHierarchy& Get(
    const Volume& volume, const isodiamond::Isoregion& region, const Need& need, Task& task);

  /** How many cells there are at every tolerance, of the same hierarchy. Kept until a query has
   *  another interior tolerance, or the hierarchy is forgotten. @pre need.AllErrors */
  const isodiamond::CellCounts& Count(const Volume& volume, const isodiamond::Isoregion& region,
    const Need& need, double interiorTolerance, Task& task);

  /** What points of its meshes have, of a volume in slabs: one value a stored point. Kept until
   *  something else is wanted, or the hierarchy is forgotten. */
  const std::vector<vtkSmartPointer<vtkDataArray>>& StoredPointData(const Volume& volume,
    const isodiamond::Isoregion& region, const Need& need, const VolumePointData& wanted,
    Task& task);

  /** Forgets all but what was used since the last time, and as much more as fits. */
  void Trim(std::int64_t bytes);

  /** How many hierarchies were built so far, and are kept. */
  vtkIdType GetNumberOfBuilds() const { return this->NumberOfBuilds; }
  vtkIdType GetSize() const { return static_cast<vtkIdType>(this->Entries.size()); }

private:
  /** What has to be the same of a volume. */
  struct Source
  {
    ContentHash Samples{};
    ContentHash HiddenPoints{};
    ContentHash HiddenCells{};
    std::array<int, 3> Dimensions{};
    int Padding = 0;
    isodiamond::BuildOptions Options;

    bool operator==(const Source& other) const;
  };

  /** What a mesh was refined for: tolerances, and where in the world they hold. */
  struct Refinement
  {
    WorldQuery Query;
    isodiamond::GridGeometry World;

    bool operator==(const Refinement& other) const;
  };

  struct Entry
  {
    Source From;
    isodiamond::Isoregion Region = 0.0;
    bool RefineInterior = false;
    bool IsUsed = true;                            ///< since the last time of trimming
    std::optional<isodiamond::StagedBuild> Staged; ///< as long as nobody needs all errors
    std::optional<Refinement> RefinedTo;           ///< what it was told last
    isodiamond::Encoding Encoding;
    std::unique_ptr<isodiamond::IsodiamondHierarchy> Hierarchy; ///< of the encoding
    std::optional<isodiamond::CellCounts> Counts;
    double CountedInside = 0.0; ///< the interior tolerance of the counts
    std::optional<VolumePointData> Stored;
    std::vector<vtkSmartPointer<vtkDataArray>> StoredArrays;

    const isodiamond::IsodiamondHierarchy& Current() const
    {
      return this->Staged ? this->Staged->OneMesh() : *this->Hierarchy;
    }
    /** 0 if an abortion left nothing to be seen yet. */
    std::int64_t Bytes() const
    {
      return this->Staged || this->Hierarchy
        ? this->Current().StorageSize() + this->Current().DerivedSize()
        : 0;
    }
  };

  isodiamond::BuildOptions OptionsFor(const Volume& volume, bool refineInterior, Task& task) const;
  static bool MeasuresAtOnce(const Need& need);
  /** Adds an entry, in front. */
  void Build(
    const Volume& volume, const isodiamond::Isoregion& region, const Need& need, Task& task);
  /** What is kept that serves a need; the end if nothing does. */
  std::list<Entry>::iterator Find(const isodiamond::Isoregion& region, const Need& need);
  /** Finishes the one in front. */
  void MeasureErrors(const Volume& volume, Task& task);
  /** Makes the one in front show one mesh, unless it does. */
  void RefineTo(const WorldQuery& only, const Volume& volume, Task& task);
  /** Does something with the one in front. Where that fails it is forgotten if it cannot go on, and
   *  among peers: others may have come farther, so all begin anew. */
  template <typename Change>
  void ChangeFirst(isodiamond::Peers* peers, const Change& change);

  ContentHashes Hashes;
  Source Current;
  std::list<Entry> Entries; ///< what was used last comes first
  vtkIdType NumberOfBuilds = 0;
};

/** Trims a cache at the end of a scope, however that is left. */
struct CacheTrimmer
{
  Cache& Target;
  std::int64_t Bytes;
  ~CacheTrimmer() { this->Target.Trim(this->Bytes); }
};

}

#endif
