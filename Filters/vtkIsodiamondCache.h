// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondCache_h
#define vtkIsodiamondCache_h

#include "vtkIsodiamondInput.h"

#include "Builder.h"

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace vtkIsodiamond
{

/**
 * The minimal hierarchies that a one-step filter has built of its current volume, in the way that
 * it is told to. Volumes count as the same when array (object and time), dimensions and padding
 * are; with the distance metric lengths in the world have to be, too. All other geometry is applied
 * on extraction.
 */
class Cache
{
public:
  struct Entry
  {
    isodiamond::Isoregion Region = 0.0;
    bool RefineInterior = false;
    isodiamond::Encoding Encoding;
    std::unique_ptr<isodiamond::IsodiamondHierarchy> Hierarchy;
  };

  /** Forgets what does not belong to the volume and the options. @param array the image's own,
   *  before padding @param options RefineInterior is Get()'s */
  void Prepare(vtkDataArray* array, const Volume& volume, bool closed,
    const isodiamond::BuildOptions& options);

  /** Forgets the hierarchies that keep(region) is false for. */
  template <typename Keep>
  void Retain(Keep&& keep)
  {
    this->Entries.erase(
      std::remove_if(this->Entries.begin(), this->Entries.end(),
        [&](const std::unique_ptr<Entry>& entry) { return !keep(entry->Region); }),
      this->Entries.end());
  }

  /** The hierarchy of a region; built if there is none yet. */
  const isodiamond::IsodiamondHierarchy& Get(
    const Volume& volume, const isodiamond::Isoregion& region, bool refineInterior = false);

  /** How many hierarchies were built so far. */
  vtkIdType GetNumberOfBuilds() const { return this->NumberOfBuilds; }

private:
  std::vector<std::unique_ptr<Entry>> Entries;
  vtkSmartPointer<vtkDataArray> Array; ///< held, so that no other array can get its address
  vtkMTimeType ArrayTime = 0;
  std::array<int, 3> Dimensions{};
  bool Closed = false;
  isodiamond::BuildOptions Options;
  vtkIdType NumberOfBuilds = 0;
};

}

#endif
