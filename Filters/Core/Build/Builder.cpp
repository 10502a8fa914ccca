// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Builder.h"

#include "Build/ActivationThresholds.h"
#include "Build/Classification.h"
#include "DistanceError/DistanceError.h"
#include "Field/CriticalDiamonds.h"
#include "Field/DiamondSigns.h"
#include "FieldError/FieldError.h"
#include "Hierarchy/Encoder.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

namespace isodiamond
{
namespace
{

/** Where the samples, field errors and ranges of a build come from. */
struct Source
{
  const Grid& SampleGrid;
  const AnySamples& Samples;
  double FieldScale = 1.0;
  /** The code of a diamond's own field error, and the range of its domain. */
  std::function<std::pair<ErrorCode::Type, ValueRange>(const Place&)> Summary;
};

/** The signs that a build goes by: the samples', or, where small pieces were removed, those of what
 *  is left. */
class BuildSigns
{
public:
  /** All must outlive it. @param remaining null where nothing was removed */
  BuildSigns(const Isoregion& region, const Source& source, const SignLattice* remaining)
    : Region(region)
    , Origin(source)
    , Remaining(remaining)
  {
  }

  /** Whether these are others than the samples'. */
  bool AreChanged() const { return this->Remaining != nullptr; }

  bool HasAllVerticesInside(const Place& place) const
  {
    return isodiamond::HasAllVerticesInside(this->Region, this->Origin.SampleGrid, place,
      [this](const Point& vertex)
      {
        return this->Remaining != nullptr
          ? this->Remaining->Sign(0, vertex)
          : this->Region.SignOf(SampleAt(this->Origin.Samples, vertex));
      });
  }

private:
  const Isoregion& Region;
  const Source& Origin;
  const SignLattice* Remaining;
};

/** Codes by rank: of own errors where they count, else 0, or thresholds made of these. For the
 *  tolerance, and for the interior tolerance. */
struct DiamondCodes
{
  std::vector<ErrorCode::Type> Surface;
  std::vector<ErrorCode::Type> Interior; ///< empty without refinement of the interior
  std::vector<std::uint32_t> Followers;  ///< ranks, once there are thresholds

  explicit DiamondCodes(std::int64_t size, bool refineInterior)
    : Surface(size, 0)
    , Interior(refineInterior ? size : 0, 0)
  {
  }
};

/** Calls body(place, rank) for all diamonds but the corners of the base cube. Goes by words: the
 *  work of a whole brick of coarse diamonds is long for one step. */
template <typename Body>
void ForEachMember(const DiamondSet& members, const ParallelFor& parallelFor, const Body& body)
{
  for (int scale = members.ScaleCount() - 2; scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = members.Level(scale).Bricks;
    ForEachIndex(parallelFor, 8 * static_cast<std::int64_t>(bricks.size()), 1,
      [&](std::int64_t i)
      { members.ForEachInWord(scale, bricks[i / 8], static_cast<int>(i % 8), body); });
  }
}

/**
 * The field metric.
 *
 * Ranges are the samples', also where small pieces were removed. That subdivides what these
 * crossed, which is not needed, but never too little: where signs differ, values do. Only a domain
 * that has come to lie inside altogether can have all of its samples on one side outside.
 */
DiamondCodes OwnFieldCodes(const Source& source, const Isoregion& region, const BuildSigns& signs,
  const DiamondSet& members, bool refineInterior, const ParallelFor& parallelFor)
{
  DiamondCodes own(members.Size(), refineInterior);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      const auto [code, range] = source.Summary(place);
      const bool holdsVolume = signs.AreChanged() &&
        source.SampleGrid.SticksOut(place.Position, place.Scale) &&
        signs.HasAllVerticesInside(place);
      if (holdsVolume || OwnErrorCounts(region, source.SampleGrid, range, place))
      {
        own.Surface[rank] = code;
      }
      if (refineInterior && signs.HasAllVerticesInside(place))
      {
        own.Interior[rank] = code;
      }
    });
  return own;
}

/** The distance metric; inside of an interval volume the field's.
 *  @param own what is always subdivided already */
DiamondCodes OwnDistanceCodes(const Source& source, const IsodiamondHierarchy& relevant,
  const BuildSigns& signs, const BuildOptions& options, DiamondCodes own, MapBounds& bounds,
  const ParallelFor& parallelFor)
{
  const DiamondSet& members = relevant.Diamonds();
  const bool refineInterior = !own.Interior.empty();
  own.Surface = DistanceErrors(relevant, source.Samples, options.World, options.PreserveFeatures,
    parallelFor, std::move(own.Surface), &bounds);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (!relevant.Region().IsVolume() || !signs.HasAllVerticesInside(place))
      {
        return;
      }
      if (source.SampleGrid.SticksOut(place.Position, place.Scale))
      {
        own.Surface[rank] = ErrorCode::Always; // it holds volume
      }
      if (refineInterior)
      {
        own.Interior[rank] = source.Summary(place).first;
      }
    });
  return own;
}

bool HasHiddenCells(const BuildOptions& options)
{
  return options.Hidden != nullptr && options.Hidden->Any();
}

/** Active diamonds that touch a hidden cell are always subdivided. */
void RefineAtHiddenCells(const HiddenCells& hidden, const DiamondMask& active,
  const DiamondSet& members, const ParallelFor& parallelFor, DiamondCodes& codes)
{
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (active.Contains(place) && hidden.Touch(place))
      {
        codes.Surface[rank] = ErrorCode::Always;
      }
    });
}

/** What is always subdivided, with all ancestors, so that every mesh has full resolution's
 * topology: critical diamonds, and what carries a surface to where hidden cells are cut out. */
DiamondMask RefinedForTopology(const Grid& grid, const SignLattice& signs,
  const DiamondMask& active, const BuildOptions& options, const ParallelFor& parallelFor)
{
  DiamondMask refined = CriticalDiamonds(grid, signs, parallelFor);
  if (HasHiddenCells(options))
  {
    active.ForEach(
      [&](const Place& place)
      {
        if (options.Hidden->Touch(place))
        {
          refined.Insert(place);
        }
      });
  }
  refined.CloseOverParents(grid);
  return refined;
}

/**
 * Own errors become thresholds; an interior tolerance subdivides whatever exceeds it, with the
 * ancestors, and what follows these.
 * @param haveFollowers without, what something else than a threshold leads to may have any error
 */
void RaiseToThresholds(const Grid& grid, const DiamondSet& members, bool haveFollowers,
  const ParallelFor& parallelFor, DiamondCodes& codes)
{
  const std::vector<ErrorCode::Type> own =
    haveFollowers ? codes.Surface : std::vector<ErrorCode::Type>();
  codes.Surface = ActivationThresholds(grid, members, std::move(codes.Surface), parallelFor);
  codes.Followers = FindFollowers(own, codes.Surface);
  std::fill_n(codes.Surface.begin(), 8, ErrorCode::Always);
  if (!codes.Interior.empty())
  {
    codes.Interior = SaturateUpward(grid, members, codes.Interior, codes.Followers, parallelFor);
    std::fill_n(codes.Interior.begin(), 8, ErrorCode::Always);
  }
}

void SetCodes(Encoding& encoding, const DiamondSet& members, DiamondCodes codes)
{
  std::vector<std::uint16_t>& records = encoding.Arrays.Records;
  for (std::size_t rank = 0; rank < records.size(); ++rank)
  {
    records[rank] = Record::Pack(codes.Surface[rank], Record::Sign(records[rank]));
  }
  encoding.Arrays.InteriorCodes = std::move(codes.Interior);
  std::vector<std::uint64_t>& followers = encoding.Arrays.Followers;
  auto next = codes.Followers.cbegin();
  members.ForEach(
    [&](const Place& place, std::uint32_t rank)
    {
      if (next != codes.Followers.cend() && *next == rank)
      {
        followers.push_back(CentreCode(place));
        ++next;
      }
    });
  std::sort(followers.begin(), followers.end());
}

/** Removes the relevant diamonds from an encoding. They have no isovertices and no values inside,
 *  so these arrays stay as they are. */
void KeepMinimal(Encoding& encoding, const DiamondSet& members, const Classification& kinds)
{
  EncodingArrays<OwnedArray>& arrays = encoding.Arrays;
  arrays.BrickCounts.assign(1, 1); // the corners of the base cube
  std::size_t bricks = 1;
  std::size_t diamonds = 8;
  for (int scale = members.ScaleCount() - 2; scale >= 0; --scale)
  {
    const std::size_t before = bricks;
    for (const Brick& brick : members.Level(scale).Bricks)
    {
      const BrickMask* active = kinds.Active.Find(scale, brick.BoxIndex);
      const BrickMask* creation = kinds.Creation.Find(scale, brick.BoxIndex);
      if (active == nullptr && creation == nullptr)
      {
        continue;
      }
      for (int z = 0; z < 8; ++z)
      {
        const std::uint64_t kept =
          (active != nullptr ? (*active)[z] : 0) | (creation != nullptr ? (*creation)[z] : 0);
        ForEachBit(kept & brick.Occupancy[z],
          [&](int bit)
          {
            const std::uint32_t rank = brick.Rank(z, bit);
            arrays.Records[diamonds] = arrays.Records[rank];
            if (!arrays.InteriorCodes.empty())
            {
              arrays.InteriorCodes[diamonds] = arrays.InteriorCodes[rank];
            }
            ++diamonds;
          });
        arrays.BrickMasks[8 * bricks + z] = kept & brick.Occupancy[z];
      }
      arrays.BrickIndices[bricks++] = brick.BoxIndex;
    }
    arrays.BrickCounts.push_back(static_cast<std::uint32_t>(bricks - before));
  }
  const auto shorten = [](auto& array, std::size_t size)
  {
    array.resize(size);
    array.shrink_to_fit();
  };
  shorten(arrays.BrickIndices, bricks);
  shorten(arrays.BrickMasks, 8 * bricks);
  shorten(arrays.Records, diamonds);
  shorten(arrays.InteriorCodes, arrays.InteriorCodes.empty() ? 0 : diamonds);
}

/** Whether an interval volume is refined inside: what lies in hidden cells can be left out at full
 *  resolution only, deep inside too. */
bool RefinesInterior(const Isoregion& region, const BuildOptions& options)
{
  return region.IsVolume() && (options.RefineInterior || HasHiddenCells(options));
}

/** The steps of a build. Each metric has them in an order of its own. */
class Steps
{
public:
  Steps(const Source& source, const Isoregion& region, const BuildOptions& options,
    double errorScale, const ParallelFor& parallelFor)
    : Origin(source)
    , Options(options)
    , For(parallelFor)
    , Interior(RefinesInterior(region, options))
  {
    this->Report("Classifying diamonds", 0.0, 0.2);
    const Grid& grid = source.SampleGrid;
    this->Signs.emplace(grid, source.Samples, region, parallelFor, options.MinimumPieceSize);
    this->Kinds = Classify(grid, *this->Signs, parallelFor, this->Interior);
    if (options.PreserveTopology)
    {
      this->ForTopology =
        RefinedForTopology(grid, *this->Signs, this->Kinds.Active, options, parallelFor);
    }
    this->Header.MinimumPieceSize = options.MinimumPieceSize;
    this->Header.RemovedPieces = this->Signs->RemovedPieces();
    if (this->Header.RemovedPieces == 0)
    {
      this->Signs.reset(); // the samples say the same
    }
    this->Kinds.Members.Insert(grid.Depth(), 0, CornerBrick());
    this->Members = DiamondSet(grid, this->Kinds.Members);
    this->Kinds.Members = DiamondMask();

    this->Header.TheModel = Model::Relevant;
    this->Header.Dimensions = grid.Dimensions();
    this->Header.Region = region;
    this->Header.Metric = options.Metric;
    this->Header.FieldScale = source.FieldScale;
    this->Header.ErrorScale = errorScale;
    this->Header.ExactIsovertices = options.ExactIsovertices;
    this->Header.TwoSided = options.Metric == ErrorMetric::Distance;
    this->Header.PreservesTopology = options.PreserveTopology;
    this->Header.ActiveCount = this->Kinds.Active.Size();
    this->Header.CreationCount = this->Kinds.Creation.Size();
    this->Header.RelevantCount = this->Members.Size() - 8 - this->Header.ActiveCount;
  }

  /** An RI without errors. */
  Encoding PlaceIsovertices(double begin, double end) const
  {
    this->Report("Placing isovertices", begin, end);
    return Encode(this->Header, this->Origin.SampleGrid, this->Origin.Samples, this->Members,
      ErrorCode::Always, this->For, this->RemainingSigns());
  }

  DiamondCodes MeasureField() const
  {
    this->Report("Measuring errors", 0.25, 0.8);
    DiamondCodes own = OwnFieldCodes(this->Origin, this->Header.Region, this->SignsToGoBy(),
      this->Members, this->Interior, this->For);
    this->SubdivideAlways(own);
    return own;
  }

  DiamondCodes MeasureDistances(const IsodiamondHierarchy& relevant) const
  {
    this->Report("Measuring errors", 0.25, 0.5);
    MapBounds bounds(this->Members.Size(), this->Header.Region.SurfaceCount());
    DiamondCodes own(this->Members.Size(), this->Interior);
    this->SubdivideAlways(own);
    own = OwnDistanceCodes(this->Origin, relevant, this->SignsToGoBy(), this->Options,
      std::move(own), bounds, this->For);
    this->Report("Measuring errors", 0.5, 0.8);
    const BeforeWayBack known{ this->Options.Hidden, &bounds,
      ActivationThresholds(this->Origin.SampleGrid, this->Members, own.Surface, this->For) };
    RaiseByWayBack(relevant, this->Options.World, known, own.Surface, this->For);
    return own;
  }

  /** Own errors become thresholds. Of the field metric nothing follows: an HD, which is to give the
   *  same mesh, has no thresholds to tell. */
  void FindThresholds(DiamondCodes& codes) const
  {
    this->Report("Finding thresholds", 0.8, 0.9);
    RaiseToThresholds(this->Origin.SampleGrid, this->Members,
      this->Header.Metric == ErrorMetric::Distance, this->For, codes);
  }

  Encoding Complete(Model model, Encoding relevant, DiamondCodes thresholds) const
  {
    SetCodes(relevant, this->Members, std::move(thresholds));
    relevant.Header.TheModel = model;
    if (model == Model::Minimal)
    {
      KeepMinimal(relevant, this->Members, this->Kinds);
    }
    return relevant;
  }

private:
  void Report(const char* phase, double begin, double end) const
  {
    if (this->Options.Report)
    {
      this->Options.Report(phase, begin, end);
    }
  }

  /** What is always subdivided, whatever its error. */
  void SubdivideAlways(DiamondCodes& codes) const
  {
    if (HasHiddenCells(this->Options))
    {
      RefineAtHiddenCells(
        *this->Options.Hidden, this->Kinds.Active, this->Members, this->For, codes);
    }
    this->ForTopology.ForEach(
      [&](const Place& place) { codes.Surface[this->Members.Rank(place)] = ErrorCode::Always; });
  }

  const SignLattice* RemainingSigns() const { return this->Signs ? &*this->Signs : nullptr; }

  BuildSigns SignsToGoBy() const
  {
    return { this->Header.Region, this->Origin, this->RemainingSigns() };
  }

  const Source& Origin;
  const BuildOptions& Options;
  const ParallelFor& For;
  bool Interior;                    ///< whether it is refined
  std::optional<SignLattice> Signs; ///< kept where they are others than the samples'
  Classification Kinds;
  DiamondMask ForTopology; ///< empty if topology need not be preserved
  DiamondSet Members;
  EncodingHeader Header;
};

Encoding BuildByField(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  const Steps steps(source, region, options, source.FieldScale, parallelFor);
  DiamondCodes codes = steps.MeasureField();
  steps.FindThresholds(codes);
  // Last: less memory at once.
  return steps.Complete(model, steps.PlaceIsovertices(0.9, 1.0), std::move(codes));
}

Encoding BuildByDistance(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  // First of all: it throws if there are no distances.
  const double errorScale = DistanceErrorScale(source.SampleGrid, options.World);
  const Steps steps(source, region, options, errorScale, parallelFor);
  // Distances are measured on it.
  Encoding relevant = steps.PlaceIsovertices(0.2, 0.25);
  DiamondCodes codes = steps.MeasureDistances(IsodiamondHierarchy(relevant, parallelFor));
  steps.FindThresholds(codes);
  return steps.Complete(model, std::move(relevant), std::move(codes));
}

void CheckMinimumPieceSize(const BuildOptions& options)
{
  if (options.MinimumPieceSize < 0)
  {
    throw std::invalid_argument("The minimum size of pieces must not be negative.");
  }
}

bool NeedsFieldErrors(const Isoregion& region, const BuildOptions& options)
{
  return options.Metric == ErrorMetric::Field || RefinesInterior(region, options);
}

Grid GridOf(const AnySamples& samples)
{
  return Grid(std::visit([](const auto& view) { return view.Dimensions(); }, samples));
}

std::pair<ErrorCode::Type, ValueRange> SummaryOf(
  const FieldErrors& errors, double scale, const Place& place)
{
  const DomainSummary domain = errors.Summarize(place);
  return { ErrorCode(scale).Encode(domain.Error), domain.Range };
}

Encoding Build(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  return options.Metric == ErrorMetric::Field
    ? BuildByField(model, source, region, options, parallelFor)
    : BuildByDistance(model, source, region, options, parallelFor);
}

}

/** Owns what the steps refer to. */
struct StagedBuild::State
{
  State(const AnySamples& samples, const Isoregion& region, const ParallelFor& parallelFor,
    const BuildOptions& options)
    : Samples(samples)
    , For(parallelFor)
    , Options(options)
    , TheGrid(GridOf(samples))
    , From{ this->TheGrid, this->Samples, ErrorCode(FieldErrorScale(samples)).Scale(),
      [this](const Place& place)
      { return SummaryOf(*this->Errors, this->From.FieldScale, place); } }
    , Done(this->From, region, this->Options,
        options.Metric == ErrorMetric::Distance ? DistanceErrorScale(this->TheGrid, options.World)
                                                : this->From.FieldScale,
        this->For)
    , Relevant(this->Done.PlaceIsovertices(0.2, 0.9))
  {
    this->Hierarchy.emplace(this->Relevant, this->For);
  }

  AnySamples Samples;
  ParallelFor For;
  BuildOptions Options;
  Grid TheGrid;
  std::optional<FieldErrors> Errors;
  Source From;
  Steps Done;
  Encoding Relevant;
  std::optional<IsodiamondHierarchy> Hierarchy;
};

StagedBuild::StagedBuild(const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckMinimumPieceSize(options);
  this->Kept = std::make_unique<State>(samples, region, parallelFor, options);
}

StagedBuild::~StagedBuild() = default;
StagedBuild::StagedBuild(StagedBuild&&) noexcept = default;
StagedBuild& StagedBuild::operator=(StagedBuild&&) noexcept = default;

const IsodiamondHierarchy& StagedBuild::FullResolution() const
{
  return *this->Kept->Hierarchy;
}

Encoding StagedBuild::Finish(Model model, const AnySamples& samples, const ParallelFor& parallelFor,
  const BuildOptions& options)
{
  State& kept = *this->Kept;
  kept.Samples = samples;
  kept.For = parallelFor;
  kept.Options = options;
  if (NeedsFieldErrors(kept.Relevant.Header.Region, options))
  {
    kept.Errors.emplace(kept.TheGrid, kept.Samples, kept.For);
  }
  DiamondCodes codes = options.Metric == ErrorMetric::Field
    ? kept.Done.MeasureField()
    : kept.Done.MeasureDistances(*kept.Hierarchy);
  kept.Done.FindThresholds(codes);
  kept.Hierarchy.reset();
  return kept.Done.Complete(model, std::move(kept.Relevant), std::move(codes));
}

Encoding BuildIsodiamonds(Model model, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckMinimumPieceSize(options);
  const ErrorCode code(FieldErrorScale(samples));
  const Grid grid = GridOf(samples);
  std::optional<FieldErrors> errors; // takes a pass over the samples, and is not always asked
  if (NeedsFieldErrors(region, options))
  {
    errors.emplace(grid, samples, parallelFor);
  }
  const auto summary = [&](const Place& place) { return SummaryOf(*errors, code.Scale(), place); };
  return Build(model, { grid, samples, code.Scale(), summary }, region, options, parallelFor);
}

Encoding BuildIsodiamonds(Model model, const ScalarHierarchy& hierarchy, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckMinimumPieceSize(options);
  if (options.MinimumPieceSize > 1)
  {
    throw std::invalid_argument("Small pieces cannot be removed from a hierarchy of diamonds: its "
                                "errors are those of all samples.");
  }
  const auto summary = [&](const Place& place)
  { return std::make_pair(hierarchy.Error(place), hierarchy.Range(place)); };
  return Build(model,
    { hierarchy.SampleGrid(), hierarchy.Samples(), hierarchy.Codes().Scale(), summary }, region,
    options, parallelFor);
}

}
