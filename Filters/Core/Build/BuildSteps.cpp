// SPDX-License-Identifier: BSD-3-Clause
#include "Build/BuildSteps.h"

#include "Build/ActivationThresholds.h"
#include "Build/Assembly.h"
#include "Build/ToleratedSet.h"
#include "DistanceError/DistanceError.h"
#include "Hierarchy/Encoder.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{

void Tell(const BuildOptions& options, const char* phase, double begin, double end)
{
  if (options.Report)
  {
    options.Report(phase, begin, end);
  }
}

namespace
{

/**
 * Turns own errors into thresholds; an interior tolerance subdivides whatever exceeds it, with all
 * ancestors, and the followers of these.
 * @param portion that the members make up; null for all
 * @param haveFollowers if not, diamonds reached other than by a threshold may have any error
 */
void TurnIntoThresholds(const Grid& grid, const DiamondSet& members, const PeerPortion* portion,
  bool haveFollowers, const ParallelFor& parallelFor, DiamondCodes& codes)
{
  Peers* const others = portion != nullptr ? &portion->Others() : nullptr;
  std::vector<ErrorCode::Type> own;
  InStep(others, [&] { own = haveFollowers ? codes.Surface : own; });
  codes.Surface =
    ActivationThresholds(grid, members, std::move(codes.Surface), parallelFor, portion);
  InStep(others, [&] { codes.Followers = FindFollowers(own, codes.Surface); });
  std::fill_n(codes.Surface.begin(), 8, ErrorCode::Always);
  if (!codes.Interior.empty())
  {
    codes.Interior =
      SaturateUpward(grid, members, codes.Interior, codes.Followers, parallelFor, portion);
    std::fill_n(codes.Interior.begin(), 8, ErrorCode::Always);
  }
}

void SetCodes(Encoding& encoding, const DiamondSet& members, DiamondCodes codes)
{
  BuildSteps::SetThresholds(codes.Surface, encoding);
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

SignLattice SignsOf(const Source& source, const Isoregion& region, const BuildOptions& options,
  const ParallelFor& parallelFor)
{
  Tell(options, "Classifying diamonds", 0.0, 0.2);
  return { source.SampleGrid, source.Samples, region, parallelFor, options.MinimumPieceSize };
}

}

BuildSteps::BuildSteps(const Source& source, const Isoregion& region, const BuildOptions& options,
  double errorScale, const ParallelFor& parallelFor)
  : BuildSteps(source, SignsOf(source, region, options, parallelFor), region, options, errorScale,
      parallelFor)
{
  if (this->Header.RemovedPieces == 0)
  {
    this->Signs.reset(); // the samples say the same
  }
}

BuildSteps::BuildSteps(const Source& source, SignLattice signs, const Isoregion& region,
  const BuildOptions& options, double errorScale, const ParallelFor& parallelFor)
  : Origin(source)
  , Options(options)
  , For(parallelFor)
  , Interior(RefinesInterior(region, options))
  , Signs(std::move(signs))
{
  const Grid& grid = source.SampleGrid;
  this->Kinds = Classify(grid, *this->Signs, parallelFor, this->Interior);
  if (options.PreserveTopology)
  {
    this->ForTopology =
      RefinedForTopology(grid, *this->Signs, this->Kinds.Active, options, parallelFor);
  }
  const std::int64_t relevantCount = this->Kinds.Members.Size();
  this->Kinds.Members.Insert(grid.Depth(), 0, CornerBrick());
  if (options.InPortions && options.Together != nullptr)
  {
    this->Portion.emplace(grid, std::move(this->Kinds.Members), *options.Together);
    this->Members = this->Portion->TakeMembers();
  }
  else
  {
    this->Members = DiamondSet(grid, this->Kinds.Members);
  }
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
  this->Header.MinimumPieceSize = options.MinimumPieceSize;
  this->Header.RemovedPieces = this->Signs->RemovedPieces();
  this->Header.ActiveCount = this->Kinds.Active.Size();
  this->Header.CreationCount = this->Kinds.Creation.Size();
  this->Header.RelevantCount = relevantCount - this->Header.ActiveCount;
}

Encoded BuildSteps::PlaceIsovertices(double begin, double end, bool withEdges) const
{
  Tell(this->Options, "Placing isovertices", begin, end);
  return Encode(this->Header, this->Origin.SampleGrid, this->Origin.Samples, this->Members,
    ErrorCode::Always, this->For, this->SignsIfKept(), withEdges);
}

FieldMetric BuildSteps::ByField() const
{
  return { this->Header.Region, this->Origin.SampleGrid, this->SignsToGoBy(), this->Interior };
}

DiamondCodes BuildSteps::MeasureField() const
{
  DiamondCodes own;
  InStep(this->Options.Together,
    [&]
    {
      Tell(this->Options, "Measuring errors", 0.25, 0.8);
      own = this->FieldCodes
        ? *this->FieldCodes
        : OwnFieldCodes(this->Origin, this->ByField(), this->Members, this->For);
      this->SubdivideAlways(own);
    });
  return own;
}

DiamondCodes BuildSteps::MeasureDistances(
  const IsodiamondHierarchy& relevant, const Finiteness& isFinite) const
{
  Peers* const peers = this->Options.Together;
  MapBounds bounds;
  DiamondCodes own;
  InStep(peers,
    [&]
    {
      Tell(this->Options, "Measuring errors", 0.25, 0.5);
      bounds = MapBounds(this->Members, this->Header.Region.SurfaceCount());
      own = DiamondCodes(this->Members.Size(), false);
      this->SubdivideAlways(own);
      SubdivideOverturned(relevant, this->Options.World, this->For, own.Surface);
      if (this->Interior)
      {
        own.Interior = this->FieldCodes
          ? this->FieldCodes->Interior
          : InteriorCodes(this->Origin, this->SignsToGoBy(), this->Members, this->For);
      }
      own = OwnDistanceCodes(this->Origin, isFinite, relevant, this->SignsToGoBy(), this->Options,
        this->Portion ? &this->Portion->Diamonds() : nullptr, std::move(own), bounds, this->For);
    });
  this->Merge(own.Surface);
  if (this->Portion)
  {
    bounds.Merge(*this->Portion);
  }
  else if (peers != nullptr)
  {
    bounds.Merge(*peers);
  }
  this->Do("Measuring errors", 0.5, 0.8,
    [&]
    {
      RaiseToThresholds(
        this->Origin.SampleGrid, this->Members, own.Surface, this->For, this->PortionOfPeers());
      RaiseByWayBack(relevant, this->Options.World,
        { this->Options.Hidden, &bounds, this->PortionOfPeers() }, own.Surface,
        Loops(this->For, peers));
    });
  this->Merge(own.Surface);
  return own;
}

/** Merges the errors that peers have found. */
void BuildSteps::Merge(std::vector<ErrorCode::Type>& codes) const
{
  if (this->Portion)
  {
    this->Portion->Max(codes);
  }
  else if (this->Options.Together != nullptr)
  {
    this->Options.Together->Max(codes.data(), static_cast<std::int64_t>(codes.size()));
  }
}

std::vector<ErrorCode::Type> BuildSteps::RefineTo(const IsodiamondHierarchy& relevant,
  const Finiteness& isFinite, const std::function<ErrorCode::Type(const Place&)>& accepted) const
{
  Peers* const peers = this->Options.Together;
  DiamondCodes own;
  std::optional<DistanceTests> tests;
  InStep(peers,
    [&]
    {
      Tell(this->Options, "Measuring errors", 0.25, 0.9);
      own = DiamondCodes(this->Members.Size(), false);
      this->SubdivideAlways(own);
      SubdivideOverturned(relevant, this->Options.World, this->For, own.Surface);
      tests.emplace(TestedHierarchy{ relevant, isFinite, ErrorCode(this->Header.ErrorScale),
                      this->Options.PreserveFeatures, this->Options.Hidden },
        this->Options.World, this->For);
    });
  const BuildSigns signs = this->SignsToGoBy();
  const auto isAlways = [&](const Place& place, std::uint32_t rank)
  {
    return own.Surface[rank] == ErrorCode::Always ||
      HoldsVolume(relevant.Region(), this->Origin.SampleGrid, signs, place);
  };
  return ToleratedSet(relevant, *tests, { accepted, isAlways }, Loops(this->For, peers), peers);
}

void BuildSteps::SetThresholds(const std::vector<ErrorCode::Type>& thresholds, Encoding& relevant)
{
  std::vector<std::uint16_t>& records = relevant.Arrays.Records;
  for (std::size_t rank = 0; rank < records.size(); ++rank)
  {
    records[rank] = Record::Pack(thresholds[rank], Record::Sign(records[rank]));
  }
}

void BuildSteps::FindThresholds(DiamondCodes& codes) const
{
  this->Do("Finding thresholds", 0.8, 0.9,
    [&]
    {
      TurnIntoThresholds(this->Origin.SampleGrid, this->Members, this->PortionOfPeers(),
        this->Header.Metric == ErrorMetric::Distance, this->For, codes);
    });
}

Encoding BuildSteps::Complete(Model model, Encoding relevant, DiamondCodes thresholds) const
{
  SetCodes(relevant, this->Members, std::move(thresholds));
  relevant.Header.TheModel = model;
  if (model == Model::Minimal)
  {
    KeepMinimal(relevant, this->Members, this->Kinds);
  }
  return relevant;
}

/** The diamonds of a whole hierarchy. */
DiamondSet BuildSteps::KeptOf(Model model) const
{
  const Grid& grid = this->Origin.SampleGrid;
  if (model == Model::Relevant)
  {
    return { grid, this->Portion->All() };
  }
  DiamondMask kept = this->Kinds.Active;
  this->Kinds.Creation.ForEachBrick(
    [&](int scale, std::int64_t index, const BrickMask& mask) { kept.Insert(scale, index, mask); });
  kept.Insert(grid.Depth(), 0, CornerBrick());
  return { grid, kept };
}

Encoding BuildSteps::CompleteOfPortions(Model model, Encoding relevant,
  const IsodiamondHierarchy& hierarchy, DiamondCodes thresholds) const
{
  DiamondSet kept;
  this->Options.Together->Together(
    [&]
    {
      SetCodes(relevant, this->Members, std::move(thresholds));
      relevant.Header.TheModel = model;
      kept = this->KeptOf(model);
    });
  return Assemble(*this->Portion, std::move(relevant), hierarchy, kept);
}

/** Does work after reporting it, which may stop it. If peers have portions, work calls them. */
template <typename Work>
void BuildSteps::Do(const char* phase, double begin, double end, const Work& work) const
{
  InStep(this->Options.Together,
    [&]
    {
      Tell(this->Options, phase, begin, end);
      if (!this->Portion)
      {
        work();
      }
    });
  if (this->Portion)
  {
    work();
  }
}

/** What is always subdivided, whatever its error. */
void BuildSteps::SubdivideAlways(DiamondCodes& codes) const
{
  if (HasHiddenCells(this->Options))
  {
    RefineAtHiddenCells(*this->Options.Hidden, this->Kinds.Active, this->Members, this->For, codes);
  }
  this->ForTopology.ForEach(
    [&](const Place& place)
    {
      if (const std::int64_t rank = this->Members.Rank(place); rank != DiamondSet::None)
      {
        codes.Surface[rank] = ErrorCode::Always; // other portions have the rest
      }
    });
}

void BuildSteps::DropSigns()
{
  if (!this->Header.Region.IsVolume())
  {
    this->Signs.reset();
  }
}

BuildSigns BuildSteps::SignsToGoBy() const
{
  return { this->Header.Region, this->Origin, this->SignsIfKept() };
}

}
