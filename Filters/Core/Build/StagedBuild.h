// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_StagedBuild_h
#define isodiamond_StagedBuild_h

#include "Build/Builder.h"

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace isodiamond
{

/**
 * BuildIsodiamonds() in two steps, for showing full resolution first, which needs no errors.
 *
 * Between the steps it keeps what it has found, but not the samples: they have to be passed again
 * to finish, unless they came in slabs: then they are no longer needed.
 */
class StagedBuild
{
public:
  /** @throws std::invalid_argument as BuildIsodiamonds() */
  StagedBuild(const AnySamples& samples, const Isoregion& region, const ParallelFor& parallelFor,
    const BuildOptions& options);
  ~StagedBuild();
  StagedBuild(StagedBuild&&) noexcept;
  StagedBuild& operator=(StagedBuild&&) noexcept;
  StagedBuild(const StagedBuild&) = delete;
  StagedBuild& operator=(const StagedBuild&) = delete;

  /** An RI whose diamonds are subdivided either always or never: at tolerance 0 it gives full
   *  resolution, at any other what RefineTo() was last told; before that, full resolution too.
   *  Valid until the end of Finish(). */
  const IsodiamondHierarchy& OneMesh() const;

  /**
   * Makes OneMesh() a mesh that keeps tolerances, in a fraction of the time of the second step, as
   * most diamonds play no part; that step can still follow. The mesh is as good as those extracted
   * after it, but not the same: errors are compared with tolerances before they are rounded up, and
   * the way back is decided no closer than to 8/9 of a tolerance.
   *
   * @param tolerated the tolerance of a diamond
   * @param samples, options as for Finish(); the distance metric, without refinement inside
   * @throws std::invalid_argument for the field metric, and if the interior is refined
   */
  void RefineTo(const std::function<double(const Place&)>& tolerated, const AnySamples& samples,
    const ParallelFor& parallelFor, const BuildOptions& options);

  /** The second step: returns what BuildIsodiamonds() does, to the bit. Only once; but again after
   *  an exception, such as one thrown to stop it, if CanGoOn() and there were no peers.
   *  @param samples the same, wherever they are now; any if they came in slabs
   *  @param options the same, but Hidden may be elsewhere and Report may differ */
  Encoding Finish(Model model, const AnySamples& samples, const ParallelFor& parallelFor,
    const BuildOptions& options);

  /** False after Finish(), and if that failed at the very end for lack of memory. */
  bool CanGoOn() const;

private:
  friend class StreamedBuild;
  struct State;
  explicit StagedBuild(std::unique_ptr<State> state);

  std::unique_ptr<State> Kept;
};

/**
 * The first step of a staged build from a volume that is larger than memory: it comes twice, in
 * slabs, from the first slice to the last.
 *
 * The first time, signs are found, one bit per sample; they tell which diamonds there are. The
 * second time, isovertices are placed, and field errors measured if they are needed. Distances need
 * no more than these. Not with hidden cells. The result is that of the whole volume, to the bit,
 * however it is cut.
 *
 * Peers (BuildOptions::Together) have some slabs each: they add these, and skip those of others.
 * All of them classify and finish, and have the whole hierarchy in the end. Until then each has, if
 * so requested (BuildOptions::InPortions), only a portion of it (PeerPortion); in that case nothing
 * can be done in between: StagedBuild::Finish() has to follow.
 */
class StreamedBuild
{
public:
  /** @param dimensions of the volume
   *  @throws std::invalid_argument as BuildIsodiamonds(), and for hidden cells */
  StreamedBuild(const std::array<int, 3>& dimensions, const Isoregion& region,
    const ParallelFor& parallelFor, const BuildOptions& options);
  ~StreamedBuild();
  StreamedBuild(StreamedBuild&&) noexcept;
  StreamedBuild& operator=(StreamedBuild&&) noexcept;
  StreamedBuild(const StreamedBuild&) = delete;
  StreamedBuild& operator=(const StreamedBuild&) = delete;

  /** A slab's own slices, End not among them, and the First and Last that it is to hold: on both
   *  sides, where there are more slices, it shares some. */
  struct Slices
  {
    int Begin = 0;
    int End = 0;
    int First = 0;
    int Last = 0;
  };

  /** Cuts a volume into this many slabs, or fewer if it does not have as many slices. */
  static std::vector<Slices> Cut(const std::array<int, 3>& dimensions, int slabs);

  /** The first time. Shared slices are not needed. @param slices of the cut, which the slab is */
  void AddSigns(const SampleSlab& slab, const Slices& slices);

  /** Between the two times: merges what peers have added, and finds which diamonds there are. */
  void Classify();

  /** The second time. @param slices of a cut, which the slab holds; they come in order */
  void AddValues(const SampleSlab& slab, const Slices& slices);

  /** Instead of AddValues(), for slices that a peer adds. */
  void SkipValues(const Slices& slices);

  /** At the end, once only. */
  StagedBuild Finish();

private:
  struct Progress;

  std::unique_ptr<StagedBuild::State> Kept;
  std::unique_ptr<Progress> Current;
};

}

#endif
