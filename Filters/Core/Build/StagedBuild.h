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
 * BuildIsodiamonds() in two steps, for who shows full resolution first: that needs no errors.
 *
 * Between the steps it keeps what it has found, but not the samples: who finishes it brings them
 * again, unless they came in slabs: then nothing more is asked of them.
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

  /** An RI whose diamonds are always subdivided, or never: at tolerance 0 full resolution, at any
   *  other what RefineTo() was told last; before, full resolution too. Valid until the end of
   *  Finish(). */
  const IsodiamondHierarchy& OneMesh() const;

  /**
   * Makes OneMesh() one that keeps tolerances, in a fraction of the time of the second step, which
   * can still follow: most diamonds have no part in it. As good as what is extracted after that,
   * but not the same: errors are compared with tolerances before they are rounded up, and the way
   * back is decided no closer than to 8/9 of a tolerance.
   *
   * @param tolerated the tolerance of a diamond
   * @param samples, options as of Finish(); the distance metric, without refinement inside
   * @throws std::invalid_argument for the field metric, and if what is inside is refined
   */
  void RefineTo(const std::function<double(const Place&)>& tolerated, const AnySamples& samples,
    const ParallelFor& parallelFor, const BuildOptions& options);

  /** The second step: what BuildIsodiamonds() returns, to the bit. Once only; after an exception,
   *  as of who stops it, again if it CanGoOn() and there were no peers.
   *  @param samples the same, wherever they are now; any if they came in slabs
   *  @param options the same, but Hidden may be elsewhere and Report another */
  Encoding Finish(Model model, const AnySamples& samples, const ParallelFor& parallelFor,
    const BuildOptions& options);

  /** Not after Finish(), nor if that failed in the very end, for lack of memory. */
  bool CanGoOn() const;

private:
  friend class StreamedBuild;
  struct State;
  explicit StagedBuild(std::unique_ptr<State> state);

  std::unique_ptr<State> Kept;
};

/**
 * The first step of a staged build from a volume that is larger than memory: it comes in slabs,
 * slices from the first to the last, twice.
 *
 * The first time signs are found, a bit for a sample; they tell which diamonds there are. The
 * second time isovertices are placed, and field errors measured, if they are asked for. Distances
 * need no more than these. Not with hidden cells. The result is that of the whole volume, to the
 * bit, however it is cut.
 *
 * Peers (BuildOptions::Together) have some slabs each: they add these, and skip those of others.
 * All of them classify and finish, and have the whole hierarchy in the end; until then, if they ask
 * for that (BuildOptions::InPortions), a portion of it (PeerPortion). Then nothing can be done in
 * between: StagedBuild::Finish() has to follow.
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

  /** The slices of a slab that are its own, the end not among them, and those that it is to have:
   *  on both sides some that it shares, where there are more. */
  struct Slices
  {
    int Begin = 0;
    int End = 0;
    int First = 0;
    int Last = 0;
  };

  /** Cuts a volume into so many slabs, or fewer if it has not as many slices. */
  static std::vector<Slices> Cut(const std::array<int, 3>& dimensions, int slabs);

  /** The first time. What slabs share is not needed. @param slices of the cut that the slab is */
  void AddSigns(const SampleSlab& slab, const Slices& slices);

  /** Between the times: what peers have added, and which diamonds there are. */
  void Classify();

  /** The second time. @param slices a cut that the slab holds; they come one after the other */
  void AddValues(const SampleSlab& slab, const Slices& slices);

  /** In its place slices that a peer adds. */
  void SkipValues(const Slices& slices);

  /** In the end, once only. */
  StagedBuild Finish();

private:
  struct Progress;

  std::unique_ptr<StagedBuild::State> Kept;
  std::unique_ptr<Progress> Current;
};

}

#endif
