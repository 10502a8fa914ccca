// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Builder.h"

#include "Build/ActivationThresholds.h"
#include "Build/Classification.h"
#include "DistanceError/DistanceError.h"
#include "FieldError/FieldError.h"
#include "Hierarchy/Encoder.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace isodiamond
{
namespace
{

/** Where the samples, field errors and ranges of a build come from. */
struct Source
{
  const Grid& Domain;
  const AnySamples& Samples;
  double FieldScale = 1.0;
  /** The code of a diamond's own field error, and the range of its domain. */
  std::function<std::pair<ErrorCode::Type, ValueRange>(const Place&)> Summary;
};

/** Codes by rank: of own errors where they count, else 0, or thresholds made of these. For the
 *  tolerance, and for the interior tolerance. */
struct DiamondCodes
{
  std::vector<ErrorCode::Type> Surface;
  std::vector<ErrorCode::Type> Interior; ///< empty without refinement of the interior

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
    parallelFor(8 * static_cast<std::int64_t>(bricks.size()), 1,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          members.ForEachInWord(scale, bricks[i / 8], static_cast<int>(i % 8), body);
        }
      });
  }
}

/** The field metric. */
DiamondCodes OwnFieldCodes(const Source& source, const Isoregion& region, const DiamondSet& members,
  bool refineInterior, const ParallelFor& parallelFor)
{
  DiamondCodes triggers(members.Size(), refineInterior);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      const auto [code, range] = source.Summary(place);
      if (OwnErrorCounts(region, source.Domain, range, place))
      {
        triggers.Surface[rank] = code;
      }
      if (refineInterior && HasAllVerticesInside(region, source.Domain, source.Samples, place))
      {
        triggers.Interior[rank] = code;
      }
    });
  return triggers;
}

/** The distance metric; inside of an interval volume the field's. */
DiamondCodes OwnDistanceCodes(const Source& source, const IsodiamondHierarchy& relevant,
  const BuildOptions& options, bool refineInterior, const ParallelFor& parallelFor)
{
  const DiamondSet& members = relevant.Diamonds();
  DiamondCodes triggers(members.Size(), refineInterior);
  triggers.Surface =
    DistanceErrors(relevant, source.Samples, options.World, options.PreserveFeatures, parallelFor);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (!relevant.Region().IsVolume() ||
        !HasAllVerticesInside(relevant.Region(), source.Domain, source.Samples, place))
      {
        return;
      }
      if (source.Domain.SticksOut(place.Position, place.Scale))
      {
        triggers.Surface[rank] = ErrorCode::Always; // it holds volume
      }
      if (refineInterior)
      {
        triggers.Interior[rank] = source.Summary(place).first;
      }
    });
  return triggers;
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

/** Own errors become thresholds; an interior tolerance subdivides whatever exceeds it, with the
 *  ancestors. */
void RaiseToThresholds(
  const Grid& grid, const DiamondSet& members, const ParallelFor& parallelFor, DiamondCodes& codes)
{
  codes.Surface = ActivationThresholds(grid, members, std::move(codes.Surface), parallelFor);
  std::fill_n(codes.Surface.begin(), 8, ErrorCode::Always);
  if (!codes.Interior.empty())
  {
    codes.Interior = SaturateUpward(grid, members, std::move(codes.Interior), parallelFor);
    std::fill_n(codes.Interior.begin(), 8, ErrorCode::Always);
  }
}

void SetCodes(Encoding& encoding, DiamondCodes codes)
{
  std::vector<std::uint16_t>& records = encoding.Arrays.Records;
  for (std::size_t rank = 0; rank < records.size(); ++rank)
  {
    records[rank] = Record::Pack(codes.Surface[rank], Record::Sign(records[rank]));
  }
  encoding.Arrays.InteriorCodes = std::move(codes.Interior);
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

Encoding Build(Model model, const Source& source, const Isoregion& region,
  const BuildOptions& options, const ParallelFor& parallelFor)
{
  const Grid& grid = source.Domain;
  const auto report = [&](const char* phase, double begin, double end)
  {
    if (options.Report)
    {
      options.Report(phase, begin, end);
    }
  };
  // First of all: it throws if there are no distances.
  const double errorScale = options.Metric == ErrorMetric::Field
    ? source.FieldScale
    : DistanceErrorScale(grid, options.World);
  const bool hides = options.Hidden != nullptr && options.Hidden->Any();
  // What lies in hidden cells can be left out at full resolution only, deep inside too.
  const bool refineInterior = (options.RefineInterior || hides) && region.IsVolume();
  report("Classifying diamonds", 0.0, 0.2);
  Classification kinds = [&]
  {
    const SignLattice signs(grid, source.Samples, region, parallelFor);
    return Classify(grid, signs, parallelFor, refineInterior);
  }();
  kinds.Members.Insert(grid.Depth(), 0, CornerBrick());
  const DiamondSet members(grid, kinds.Members);
  kinds.Members = DiamondMask();

  EncodingHeader header;
  header.Dimensions = grid.Dimensions();
  header.Region = region;
  header.Metric = options.Metric;
  header.FieldScale = source.FieldScale;
  header.ErrorScale = errorScale;
  header.ExactIsovertices = options.ExactIsovertices;
  header.ActiveCount = kinds.Active.Size();
  header.CreationCount = kinds.Creation.Size();
  header.RelevantCount = members.Size() - 8 - header.ActiveCount;
  header.Kind = Model::Relevant;
  const auto encode = [&]
  { return Encode(header, grid, source.Samples, members, ErrorCode::Always, parallelFor); };

  // Distances are measured on the encoding; otherwise it waits: less memory at once.
  const bool isFirst = options.Metric == ErrorMetric::Distance;
  Encoding encoding;
  if (isFirst)
  {
    report("Placing isovertices", 0.2, 0.25);
    encoding = encode();
  }
  report("Measuring errors", 0.25, 0.8);
  DiamondCodes codes = isFirst
    ? OwnDistanceCodes(
        source, IsodiamondHierarchy(encoding, parallelFor), options, refineInterior, parallelFor)
    : OwnFieldCodes(source, region, members, refineInterior, parallelFor);
  if (hides)
  {
    RefineAtHiddenCells(*options.Hidden, kinds.Active, members, parallelFor, codes);
  }
  report("Finding thresholds", 0.8, 0.9);
  RaiseToThresholds(grid, members, parallelFor, codes);
  if (!isFirst)
  {
    report("Placing isovertices", 0.9, 1.0);
    encoding = encode();
  }
  SetCodes(encoding, std::move(codes));
  encoding.Header.Kind = model;
  if (model == Model::Minimal)
  {
    KeepMinimal(encoding, members, kinds);
  }
  return encoding;
}

}

Encoding BuildIsodiamonds(Model model, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  const ErrorCode code(FieldErrorScale(samples));
  const Grid grid(std::visit([](const auto& view) { return view.Dimensions(); }, samples));
  const FieldErrors errors(grid, samples, parallelFor);
  const auto summary = [&](const Place& place)
  {
    const DomainSummary domain = errors.Summarize(place);
    return std::make_pair(code.Encode(domain.Error), domain.Range);
  };
  return Build(model, { grid, samples, code.Scale(), summary }, region, options, parallelFor);
}

Encoding BuildIsodiamonds(Model model, const ScalarHierarchy& hierarchy, const Isoregion& region,
  const ParallelFor& parallelFor, const BuildOptions& options)
{
  const auto summary = [&](const Place& place)
  { return std::make_pair(hierarchy.Error(place), hierarchy.Range(place)); };
  return Build(model,
    { hierarchy.Domain(), hierarchy.Samples(), hierarchy.Codes().Scale(), summary }, region,
    options, parallelFor);
}

}
