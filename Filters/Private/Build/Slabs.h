// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Slabs_h
#define vtkIsodiamond_Slabs_h

#include "Build/StagedBuild.h"
#include "Private/Build/SlabPlan.h"
#include "Private/Common/Task.h"
#include "Private/Input/ContentHash.h"
#include "Private/Input/PointData.h"
#include "Private/Input/Request.h"
#include "Private/Input/Volume.h"
#include "Private/Parallel/ControllerPeers.h"
#include "Private/Parallel/Parts.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

class vtkImageData;
class vtkInformation;

/**
 * @file Slabs.h
 * A volume that is larger than memory: upstream gives slab after slab of it, some slices each, as
 * often as it is asked. Sources and readers can do so if they make a part of an image without the
 * rest: the Wavelet source, readers of raw files, .vti and .pvti.
 */
namespace vtkIsodiamond
{

/** Some slices of a volume, padding included if its boundary is closed. */
struct Slab
{
  vtkIsodiamond::Slices Slices;   ///< those that were asked for
  isodiamond::SampleSlab Samples; ///< of these, and no others
  /** What upstream gave, which may be more, and the slice that it begins with. Padding is around
   *  all of it, even where the volume goes on. */
  Volume Given;
  int First = 0;
};

/** What slabs are read for: samples, samples with the slices that are shared with neighbours, or
 * all arrays of these. */
enum class Reading
{
  Signs,
  Values,
  AllArrays
};

/** The slabs of an image, the input of a filter; for use within its RequestData. */
class Slabs
{
public:
  /** @param count of slabs, from a plan whose request has been answered
   *  @param peers that have shares of the slabs, if there are any
   *  @param parts where slabs come from, if not from upstream: peers have parts of another shape
   *  @param closeBoundary whether the volume is padded, as by ReadVolume()
   *  @throws std::exception if a slab cannot be had */
  Slabs(vtkInformation* inputInformation, int count, ArrayFinder findArray, bool closeBoundary,
    const std::optional<ControllerPeers>& peers, std::unique_ptr<Parts> parts = nullptr);

  /** The peers, until everything is built: from then on none waits for another, and slabs cannot be
   *  read. Null if there are none. */
  isodiamond::Peers* Together() const
  {
    return this->Others && !this->HaveDispersed ? &*this->Others : nullptr;
  }
  void Disperse() { this->HaveDispersed = true; }

  /** The whole image, without its arrays. */
  Volume WholeVolume() const;

  /** Whether points have other arrays than the one to process. */
  bool HaveOtherArrays() const { return this->OtherArrays; }

  /** Stands for the content that upstream gives: other content has another stamp. It is made of
   *  upstream's modification times, since the content itself is nowhere at hand. */
  ContentHash Stamp() const { return this->StampOfUpstream; }

  /** To be called before ForEach(), by all peers, any number of times: the first call reads a
   *  volume whose boundary is closed, for the minimum that it is padded with. */
  void FindPadding(Task& task, double begin, double end) const;

  /** Calls body(slab) for all slabs, from the first to the last; with peers, for this one's share.
   *  @param phase in words, a part of the task from begin until end
   *  @param ofOthers called with the slices of other peers' slabs, in their place */
  void ForEach(Task& task, const char* phase, double begin, double end, Reading reading,
    const std::function<void(const Slab&)>& body,
    const std::function<void(const Slices&)>& ofOthers = nullptr) const;

private:
  /** Turns slices of the image into slices of the volume, padding included. */
  Slices InVolume(const Slices& slices) const;
  Slab Get(const Slices& slices) const;
  Slab Read(vtkImageData* image, const Slices& slices) const;

  vtkInformation* Input;
  ArrayFinder FindArray;
  std::unique_ptr<Parts> OfPeers;
  std::array<int, 6> WholeExtent{};
  std::vector<Slices> Cut;
  vtkSmartPointer<vtkImageData> Whole;
  std::string ArrayName;
  bool OtherArrays = false;
  ContentHash StampOfUpstream{};
  int Padding;
  mutable std::optional<double> Minimum;         ///< what to pad with, once it is known
  mutable std::optional<ControllerPeers> Others; ///< an interface to other processes
  bool HaveDispersed = false;
};

/** The first step of a build. */
isodiamond::StagedBuild BuildInSlabs(const Slabs& slabs, const isodiamond::Isoregion& region,
  const isodiamond::BuildOptions& options, Task& task);

/** MakeStoredPointData() for a volume in slabs. */
std::vector<vtkSmartPointer<vtkDataArray>> MakeStoredPointData(const Slabs& slabs,
  const VolumePointData& wanted, const isodiamond::IsodiamondHierarchy& hierarchy, Task& task);

}

#endif
