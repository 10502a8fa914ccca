// SPDX-License-Identifier: BSD-3-Clause
#include "Build/StagedBuild.h"

#include "Build/BuildSteps.h"
#include "Build/Dealing.h"
#include "Build/StreamedFieldCodes.h"
#include "DistanceError/DistanceError.h"
#include "Hierarchy/StreamedEncoder.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace isodiamond
{

/** Owns what the steps refer to. */
struct StagedBuild::State
{
  State(const Grid& grid, const AnySamples& samples, double fieldScale,
    const ParallelFor& parallelFor, const BuildOptions& options)
    : Samples(samples)
    , For(parallelFor)
    , Options(options)
    , TheGrid(grid)
    , From{ this->TheGrid, this->Samples, fieldScale, [this](const Place& place) {
             return SummaryOf(*this->Errors, this->From.FieldScale, place);
           } }
  {
  }

  double ErrorScale() const
  {
    return this->Options.Metric == ErrorMetric::Distance
      ? DistanceErrorScale(this->TheGrid, this->Options.World)
      : this->From.FieldScale;
  }

  void SetRelevant(Encoded relevant)
  {
    this->Relevant = std::move(relevant.Encoding);
    this->Hierarchy.emplace(
      this->Relevant, std::move(relevant.Diamonds), std::move(relevant.Edges));
  }

  /** Resumes with the samples, wherever they are now. */
  void Resume(
    const AnySamples& samples, const ParallelFor& parallelFor, const BuildOptions& options)
  {
    this->Samples = samples;
    this->For = parallelFor;
    this->Options = options;
    if (options.Metric == ErrorMetric::Distance && !this->IsFinite)
    {
      this->IsFinite.emplace(this->Samples);
    }
  }

  AnySamples Samples;
  ParallelFor For;
  BuildOptions Options;
  Grid TheGrid;
  bool CameInSlabs = false;
  std::optional<FieldErrors> Errors;
  Source From;
  std::optional<BuildSteps> Done;
  std::optional<Finiteness> IsFinite; ///< once distances are measured, or if samples came in slabs
  Encoding Relevant;
  std::optional<IsodiamondHierarchy> Hierarchy;
};

StagedBuild::StagedBuild(const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckOptions(options);
  this->Kept = std::make_unique<State>(GridOf(samples), samples,
    ErrorCode(FieldErrorScale(samples, parallelFor)).Scale(), parallelFor, options);
  State& kept = *this->Kept;
  kept.Done.emplace(kept.From, region, kept.Options, kept.ErrorScale(), kept.For);
  kept.SetRelevant(kept.Done->PlaceIsovertices(0.2, 0.9));
}

StagedBuild::StagedBuild(std::unique_ptr<State> state)
  : Kept(std::move(state))
{
}

StagedBuild::~StagedBuild() = default;
StagedBuild::StagedBuild(StagedBuild&&) noexcept = default;
StagedBuild& StagedBuild::operator=(StagedBuild&&) noexcept = default;

bool StagedBuild::CanGoOn() const
{
  return this->Kept->Hierarchy.has_value();
}

const IsodiamondHierarchy& StagedBuild::OneMesh() const
{
  return *this->Kept->Hierarchy;
}

void StagedBuild::RefineTo(const std::function<double(const Place&)>& tolerated,
  const AnySamples& samples, const ParallelFor& parallelFor, const BuildOptions& options)
{
  State& kept = *this->Kept;
  if (NeedsFieldErrors(kept.Relevant.Header.Region, options))
  {
    throw std::invalid_argument(
      "By the field metric, and where what is inside is refined, all errors are measured at once.");
  }
  kept.Resume(samples, parallelFor, options);
  const ErrorCode code(kept.Relevant.Header.ErrorScale);
  // The hierarchy reads them there; which ones are the highest stays true enough.
  BuildSteps::SetThresholds(kept.Done->RefineTo(*kept.Hierarchy, *kept.IsFinite,
                              [&](const Place& place) { return code.Accepted(tolerated(place)); }),
    kept.Relevant);
}

Encoding StagedBuild::Finish(Model model, const AnySamples& samples, const ParallelFor& parallelFor,
  const BuildOptions& options)
{
  State& kept = *this->Kept;
  kept.Resume(samples, parallelFor, options);
  if (!kept.CameInSlabs && NeedsFieldErrors(kept.Relevant.Header.Region, options))
  {
    kept.Errors.emplace(
      kept.TheGrid, kept.Samples, kept.For, WantedRange(kept.Relevant.Header.Region));
  }
  DiamondCodes codes = options.Metric == ErrorMetric::Field
    ? kept.Done->MeasureField()
    : kept.Done->MeasureDistances(*kept.Hierarchy, *kept.IsFinite);
  kept.Done->FindThresholds(codes);
  if (kept.Done->PortionOfPeers() != nullptr)
  {
    const IsodiamondHierarchy hierarchy = *std::exchange(kept.Hierarchy, {});
    return kept.Done->CompleteOfPortions(
      model, std::move(kept.Relevant), hierarchy, std::move(codes));
  }
  Encoding finished;
  InStep(options.Together,
    [&]
    {
      kept.Hierarchy.reset();
      finished = kept.Done->Complete(model, std::move(kept.Relevant), std::move(codes));
    });
  return finished;
}

namespace
{

/** The slices of the centres of a slab's diamonds: diamonds with their centre behind the last slice
 *  belong to that slice. */
SliceRange OfCentres(const Grid& grid, const StreamedBuild::Slices& slices)
{
  const bool isLast = slices.End == grid.Dimensions()[2];
  return { slices.Begin, isLast ? EncodingPasses::AllSlices.End : slices.End };
}

}

/** What is known from the slabs so far. */
struct StreamedBuild::Progress
{
  Progress(const Grid& grid, const Isoregion& region)
    : Region(region)
    , Signs(std::in_place, grid, region)
  {
  }

  Isoregion Region;
  std::optional<SignLattice> Signs; ///< until diamonds are classified: these have them from then on
  FiniteRangeOfSlabs Range;
  std::vector<SliceRange> Own;            ///< slices of the slabs that are added here
  std::optional<GatheredSamples> Coarse;  ///< if field errors are needed, until then
  std::optional<Dealing> ToPortions;      ///< if peers have portions, from then on
  std::optional<StreamedEncoder> Encoder; ///< from then on
  std::optional<StreamedFieldCodes> FieldCodes;
};

StreamedBuild::StreamedBuild(const std::array<int, 3>& dimensions, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  CheckOptions(options);
  if (HasHiddenCells(options))
  {
    throw std::invalid_argument("Hidden cells need the whole volume at once.");
  }
  const Grid grid(dimensions);
  this->Kept = std::make_unique<StagedBuild::State>(
    grid, SampleView<std::uint8_t>(nullptr, dimensions), 1.0, parallelFor, options);
  this->Kept->CameInSlabs = true;
  this->Kept->ErrorScale(); // throws if there are no distances
  this->Kept->IsFinite.emplace(dimensions);
  this->Current = std::make_unique<Progress>(grid, region);
  if (NeedsFieldErrors(region, options))
  {
    this->Current->Coarse = StreamedFieldCodes::CoarseSamples(grid);
  }
}

StreamedBuild::~StreamedBuild() = default;
StreamedBuild::StreamedBuild(StreamedBuild&&) noexcept = default;
StreamedBuild& StreamedBuild::operator=(StreamedBuild&&) noexcept = default;

std::vector<StreamedBuild::Slices> StreamedBuild::Cut(
  const std::array<int, 3>& dimensions, int slabs)
{
  const int slices = dimensions[2];
  const int count = std::clamp(slabs, 1, slices);
  std::vector<Slices> cut(count);
  for (int i = 0; i < count; ++i)
  {
    const auto at = [&](int slab)
    { return static_cast<int>(std::int64_t{ 1 } * slices * slab / count); };
    cut[i].Begin = at(i);
    cut[i].End = at(i + 1);
    cut[i].First = std::max(cut[i].Begin - StreamedEncoder::Overlap, 0);
    cut[i].Last = std::min(cut[i].End - 1 + StreamedEncoder::Overlap, slices - 1);
  }
  return cut;
}

void StreamedBuild::AddSigns(const SampleSlab& slab, const Slices& slices)
{
  this->Current->Own.push_back(OfCentres(this->Kept->TheGrid, slices));
  this->Current->Signs->Add(slab, this->Kept->For);
  this->Current->Range.Add(slab.Samples, this->Kept->For);
  this->Kept->IsFinite->Add(slab);
  if (this->Current->Coarse)
  {
    this->Current->Coarse->Add(slab);
  }
}

void StreamedBuild::Classify()
{
  StagedBuild::State& kept = *this->Kept;
  Progress& current = *this->Current;
  Peers* const peers = kept.Options.Together;
  if (peers != nullptr)
  {
    current.Signs->Merge(*peers);
    current.Range.Merge(*peers);
    kept.IsFinite->Merge(*peers);
    if (current.Coarse)
    {
      current.Coarse->Merge(*peers);
    }
  }
  InStep(peers,
    [&]
    {
      Tell(kept.Options, "Classifying diamonds", 0.1, 0.2);
      current.Signs->Complete(kept.For, kept.Options.MinimumPieceSize);
      const ValueRange range = current.Range.Range();
      kept.From.FieldScale = ErrorCode(range.Maximum - range.Minimum).Scale();
      kept.Done.emplace(kept.From, std::move(*current.Signs), current.Region, kept.Options,
        kept.ErrorScale(), kept.For);
      current.Signs.reset();
      if (const PeerPortion* const portion = kept.Done->PortionOfPeers())
      {
        current.ToPortions.emplace(kept.TheGrid, *portion, kept.Done->Relevant(), current.Own);
      }
      const DiamondSet& told =
        current.ToPortions ? current.ToPortions->OfSlabs() : kept.Done->Relevant();
      current.Encoder.emplace(kept.Done->RelevantHeader(), kept.TheGrid, told, ErrorCode::Always,
        *kept.Done->SignsIfKept(), kept.For);
      if (current.Coarse)
      {
        current.FieldCodes.emplace(kept.TheGrid, told, kept.Done->ByField(),
          ErrorCode(kept.From.FieldScale), std::move(*current.Coarse), kept.For);
        current.Coarse.reset();
      }
    });
}

void StreamedBuild::AddValues(const SampleSlab& slab, const Slices& slices)
{
  const SliceRange centres = OfCentres(this->Kept->TheGrid, slices);
  this->Current->Encoder->Add(slab, centres);
  if (this->Current->FieldCodes)
  {
    this->Current->FieldCodes->Add(slab, { slices.Begin, slices.End }, centres);
  }
}

void StreamedBuild::SkipValues(const Slices& slices)
{
  this->Current->Encoder->Skip(OfCentres(this->Kept->TheGrid, slices));
}

StagedBuild StreamedBuild::Finish()
{
  Progress& current = *this->Current;
  Peers* const peers = this->Kept->Options.Together;
  if (peers != nullptr)
  {
    current.Encoder->Merge(*peers, current.ToPortions.has_value());
    if (current.FieldCodes)
    {
      current.FieldCodes->Merge(*peers, current.ToPortions.has_value());
    }
  }
  Encoded relevant;
  DiamondCodes codes;
  InStep(peers,
    [&]
    {
      relevant = current.Encoder->Finish();
      current.Encoder.reset();
      if (current.FieldCodes)
      {
        codes = current.FieldCodes->Finish();
      }
    });
  if (current.ToPortions)
  {
    relevant = current.ToPortions->Deal(std::move(relevant));
    codes.Surface = current.ToPortions->Deal(codes.Surface);
    codes.Interior = current.ToPortions->Deal(codes.Interior);
  }
  InStep(peers,
    [&]
    {
      if (current.FieldCodes)
      {
        this->Kept->Done->SetFieldCodes(std::move(codes));
      }
      this->Current.reset();
      this->Kept->Done->DropSigns();
      this->Kept->SetRelevant(std::move(relevant));
    });
  return StagedBuild(std::move(this->Kept));
}

}
