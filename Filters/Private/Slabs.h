// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Slabs_h
#define vtkIsodiamond_Slabs_h

#include "Build/StagedBuild.h"
#include "Private/ContentHash.h"
#include "Private/Input.h"
#include "Private/PointData.h"
#include "Private/Task.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

class vtkImageData;
class vtkInformation;

/**
 * @file Slabs.h
 * A volume that is larger than memory: upstream gives slab after slab of it, some slices each, as
 * often as it is asked. Sources and readers can that make a part of an image without the rest: the
 * Wavelet source, readers of raw files, .vti and .pvti.
 */
namespace vtkIsodiamond
{

/** Into how many slabs a filter should cut its input, before it is read.
 *
 * @param asked so many; 0 for one, or for as many as keep the input within what memory is there
 * @return 1 if the input comes at once: it fits, or its source makes no parts of an image
 */
int CountSlabs(vtkInformation* inputInformation, int asked);

/** Asks upstream for one of some slabs: that which it has, or else the first. */
void RequestSlab(vtkInformation* inputInformation, int count);

/** Some slices of an image. */
struct Slab
{
  isodiamond::StreamedBuild::Slices Slices; ///< those that were asked for
  isodiamond::SampleSlab Samples;           ///< of these, and no others
  /** What upstream gave, which may be more, and the slice that it begins with. */
  Volume Given;
  int First = 0;
};

/** The slabs of an image. Within a filter's RequestData, whose input it is. */
class Slabs
{
public:
  using ArrayFinder = std::function<InputArray(vtkDataSet*)>;

  /** @param count of them, as for RequestSlab(), which has been answered
   *  @param findArray finds the array to process
   *  @throws std::exception if a slab cannot be had */
  Slabs(vtkInformation* inputInformation, int count, ArrayFinder findArray);

  /** The whole image, without its arrays. */
  Volume WholeVolume() const;

  /** Stands for the content that upstream gives: others have another one. It is told by upstream's
   *  modification times, since the content itself is nowhere. */
  ContentHash Stamp() const { return this->StampOfUpstream; }

  /** Calls body(slab) for all of them, from the first to the last.
   *  @param phase in words, a part of the task from begin until end
   *  @param shared whether a slab is to have the slices, too, that it shares with its neighbours */
  void ForEach(Task& task, const char* phase, double begin, double end, bool shared,
    const std::function<void(const Slab&)>& body) const;

private:
  Slab Get(const isodiamond::StreamedBuild::Slices& slices) const;
  Slab Read(const isodiamond::StreamedBuild::Slices& slices) const;

  vtkInformation* Input;
  ArrayFinder FindArray;
  std::array<int, 6> WholeExtent{};
  std::vector<isodiamond::StreamedBuild::Slices> Cut;
  vtkSmartPointer<vtkImageData> Whole;
  std::string ArrayName;
  ContentHash StampOfUpstream{};
};

/** The first step of a build. */
isodiamond::StagedBuild BuildInSlabs(const Slabs& slabs, const isodiamond::Isoregion& region,
  const isodiamond::BuildOptions& options, Task& task);

/** MakeStoredPointData() of a volume in slabs. */
std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Slabs& slabs,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy, Task& task);

}

#endif
