// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Cache_h
#define vtkIsodiamond_Cache_h

#include "Build/StagedBuild.h"
#include "Mesh/CellCounts.h"
#include "Private/Common/Task.h"
#include "Private/Input/ContentHash.h"
#include "Private/Input/PointData.h"
#include "Private/Input/Volume.h"
#include "Private/Query/WorldQuery.h"

#include "vtkDataArray.h"
#include "vtkType.h"

#include <cstdint>
#include <list>
#include <memory>
#include <optional>

namespace vtkIsodiamond
{

/**
 * The minimal hierarchies that a one-step filter has built: for the blocks of its input, for time
 * steps shown before, for isovalues.
 *
 * Volumes count as the same when the values of their arrays, their dimensions, padding and hidden
 * cells are the same; with the distance metric their lengths in the world must be, too. All other
 * geometry is applied on extraction. The most recently used that fit are kept.
 */
class Cache
{
public:
  /** Sets the volume and the build options for the calls that follow. @param array the grid's own,
   *  before padding @param options RefineInterior is set by Get() */
  void Prepare(vtkDataArray* array, const Volume& volume, const isodiamond::BuildOptions& options);

  /** What a query needs of a hierarchy. */
  struct Need
  {
    bool AllErrors = true; ///< else the query is for full resolution, or for one mesh only
    bool RefinedInterior = false;
    /** Whether one that is refined inside gives another mesh, even where nothing asks for that: so
     *  do tetrahedra for simulations, which are refined where that is possible. */
    bool DependsOnInterior = false;
    /** With the distance metric, without all errors: the query for that one mesh. Not for an
     *  interval volume with hidden cells, which is refined inside. */
    std::optional<WorldQuery> Only = std::nullopt;
  };

  /** The hierarchy of a region; built if there is none yet, and its errors measured when a query
   *  first needs them. */
  const isodiamond::IsodiamondHierarchy& Get(
    const Volume& volume, const isodiamond::Isoregion& region, const Need& need, Task& task);

  /** The numbers of cells at all tolerances, of the same hierarchy. Kept until a query has another
   *  interior tolerance, or the hierarchy is forgotten. @pre need.AllErrors */
  const isodiamond::CellCounts& Count(const Volume& volume, const isodiamond::Isoregion& region,
    const Need& need, double interiorTolerance, Task& task);

  /** The point data of its meshes, for a volume in slabs: one value per stored point. Kept until
   *  other data are wanted, or the hierarchy is forgotten. */
  const std::vector<vtkSmartPointer<vtkDataArray>>& StoredPointData(const Volume& volume,
    const isodiamond::Isoregion& region, const Need& need, const VolumePointData& wanted,
    Task& task);

  /** Forgets all but the entries used since the last call, and as many more as fit. */
  void Trim(std::int64_t bytes);

  /** How many hierarchies have been built so far, and how many are kept. */
  vtkIdType GetNumberOfBuilds() const { return this->NumberOfBuilds; }
  vtkIdType GetSize() const { return static_cast<vtkIdType>(this->Entries.size()); }

private:
  /** What of a volume has to be the same. */
  struct Source
  {
    ContentHash Samples{};
    ContentHash HiddenPoints{};
    ContentHash HiddenCells{};
    ContentHash Positions{}; ///< of a structured grid, if distances are measured
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
    bool IsUsed = true;                            ///< since the cache was last trimmed
    std::optional<isodiamond::StagedBuild> Staged; ///< until a query needs all errors
    std::optional<Refinement> RefinedTo;           ///< what it was last refined for
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
    /** 0 if an abort left nothing to show yet. */
    std::int64_t Bytes() const
    {
      std::int64_t bytes = 0;
      if (this->Staged || this->Hierarchy)
      {
        bytes = this->Current().StorageSize() + this->Current().DerivedSize();
      }
      bytes += this->Counts ? this->Counts->Bytes() : 0;
      for (vtkDataArray* array : this->StoredArrays)
      {
        bytes += array->GetNumberOfValues() * array->GetDataTypeSize();
      }
      return bytes;
    }
  };

  isodiamond::BuildOptions OptionsFor(const Volume& volume, bool refineInterior, Task& task) const;
  static bool MeasuresAtOnce(const Need& need);
  /** Adds an entry, in front. */
  void Build(
    const Volume& volume, const isodiamond::Isoregion& region, const Need& need, Task& task);
  /** The kept entry that serves a need; the end if none does. */
  std::list<Entry>::iterator Find(const isodiamond::Isoregion& region, const Need& need);
  /** Finishes the front entry. */
  void MeasureErrors(const Volume& volume, Task& task);
  /** Makes the front entry show one mesh, unless it already does. */
  void RefineTo(const WorldQuery& only, const Volume& volume, Task& task);
  /** Applies a change to the front entry. If that fails, the entry is forgotten if it cannot go on,
   *  and always among peers: others may have come farther, so all begin anew. */
  template <typename Change>
  void ChangeFirst(isodiamond::Peers* peers, const Change& change);

  ContentHashes Hashes;
  Source Current;
  std::list<Entry> Entries; ///< the most recently used comes first
  vtkIdType NumberOfBuilds = 0;
};

/** Trims a cache at the end of a scope, however it is left. */
struct CacheTrimmer
{
  Cache& Target;
  std::int64_t Bytes;
  ~CacheTrimmer() { this->Target.Trim(this->Bytes); }
};

}

#endif
