// SPDX-License-Identifier: BSD-3-Clause
#include "Builder.h"

#include "Activation.h"
#include "Classification.h"
#include "Encoder.h"
#include "FieldError.h"

#include <algorithm>
#include <utility>

namespace isodiamond
{
namespace
{

/** Where the samples, errors and ranges of a build come from. */
struct Source
{
  const Grid& Domain;
  const AnySamples& Samples;
  ErrorCode Code;
  /** The code of a diamond's own error, and the range of its domain. */
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

DiamondCodes Triggers(const Source& source, const Isoregion& region, const DiamondSet& members,
  bool refineInterior, const ParallelFor& parallelFor)
{
  DiamondCodes triggers(members.Size(), refineInterior);
  for (int scale = members.ScaleCount() - 1; scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = members.Level(scale).Bricks;
    parallelFor(static_cast<std::int64_t>(bricks.size()), 1,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          members.ForEachInBrick(scale, bricks[i],
            [&](const Place& place, std::uint32_t rank)
            {
              const auto [code, range] = source.Summary(place);
              if (IsTriggered(region, source.Domain, range, place))
              {
                triggers.Surface[rank] = code;
              }
              if (refineInterior &&
                HasAllVerticesInside(region, source.Domain, source.Samples, place))
              {
                triggers.Interior[rank] = code;
              }
            });
        }
      });
  }
  return triggers;
}

/** Raises the codes of all ancestors: the interior tolerance subdivides whatever exceeds it. */
void SaturateUpward(
  const Grid& grid, const DiamondSet& members, std::vector<ErrorCode::Type>& codes)
{
  for (int scale = 0; scale < grid.Depth(); ++scale)
  {
    for (int diamondClass = 2; diamondClass >= 0; --diamondClass)
    {
      for (const Brick& brick : members.Level(scale).Bricks)
      {
        members.ForEachInBrick(scale, brick,
          [&](const Place& place, std::uint32_t rank)
          {
            const TypeTable& shape = ShapeOf(place.Position);
            for (int i = 0; shape.DiamondClass == diamondClass && i < shape.ParentCount; ++i)
            {
              const Place parent = ParentPlace(shape, place, i);
              if (parent.Scale < grid.Depth() && grid.IsValid(parent.Position, parent.Scale))
              {
                ErrorCode::Type& code = codes[members.Rank(parent)];
                code = std::max(code, codes[rank]);
              }
            }
          });
      }
    }
  }
}

/** The part of the members that a model stores, and their thresholds; the base cube's corners
 *  come first. */
struct Selection
{
  DiamondSet Set;
  DiamondCodes Thresholds;

  Selection(const Grid& grid, Model model, const DiamondSet& members,
    const DiamondCodes& thresholds, const Classification& kinds)
    : Set(grid)
    , Thresholds(0, false)
  {
    this->Set.Append(grid.Depth(), 0, CornerBrick());
    this->Thresholds.Surface.assign(8, ErrorCode::Always);
    this->Thresholds.Interior.assign(thresholds.Interior.empty() ? 0 : 8, ErrorCode::Always);
    for (int scale = grid.Depth() - 1; scale >= 0; --scale)
    {
      for (const Brick& brick : members.Level(scale).Bricks)
      {
        BrickMask mask = brick.Occupancy;
        if (model == Model::Minimal)
        {
          const BrickMask* active = kinds.Active.Find(scale, brick.BoxIndex);
          const BrickMask* creation = kinds.Creation.Find(scale, brick.BoxIndex);
          for (int z = 0; z < 8; ++z)
          {
            mask[z] &=
              (active != nullptr ? (*active)[z] : 0) | (creation != nullptr ? (*creation)[z] : 0);
          }
        }
        this->Add(scale, brick, mask, thresholds);
      }
    }
  }

private:
  void Add(int scale, const Brick& brick, const BrickMask& mask, const DiamondCodes& thresholds)
  {
    this->Set.Append(scale, brick.BoxIndex, mask);
    for (int z = 0; z < 8; ++z)
    {
      ForEachBit(mask[z],
        [&](int bit)
        {
          const std::uint32_t rank = brick.Rank(z, bit);
          this->Thresholds.Surface.push_back(thresholds.Surface[rank]);
          if (!thresholds.Interior.empty())
          {
            this->Thresholds.Interior.push_back(thresholds.Interior[rank]);
          }
        });
    }
  }
};

Encoding Build(Model model, const Source& source, const Isoregion& region, bool refineInterior,
  const ParallelFor& parallelFor)
{
  const Grid& grid = source.Domain;
  refineInterior = refineInterior && region.IsVolume();
  Classification kinds = [&]
  {
    const SignLattice signs(grid, source.Samples, region, parallelFor);
    return Classify(grid, signs, parallelFor, refineInterior);
  }();
  const DiamondSet members(grid, kinds.Members);
  kinds.Members = DiamondMask();
  DiamondCodes codes = Triggers(source, region, members, refineInterior, parallelFor);
  codes.Surface = ActivationThresholds(grid, members, codes.Surface);
  if (refineInterior)
  {
    SaturateUpward(grid, members, codes.Interior);
  }
  const EncodingHeader header{ model, grid.Dimensions(), region, source.Code.Scale(),
    members.Size() - kinds.Active.Size() };
  const Selection selection(grid, model, members, codes, kinds);
  Encoding encoding =
    Encode(header, grid, source.Samples, selection.Set, selection.Thresholds.Surface, parallelFor);
  encoding.Arrays.InteriorCodes = selection.Thresholds.Interior;
  return encoding;
}

}

Encoding BuildIsodiamonds(Model model, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, bool refineInterior)
{
  const ErrorCode code(FieldErrorScale(samples));
  const Grid grid(std::visit([](const auto& view) { return view.Dimensions(); }, samples));
  const auto summary = [&](const Place& place)
  {
    const DomainSummary domain = SummarizeDomain(grid, samples, place);
    return std::make_pair(code.Encode(domain.Error), domain.Range);
  };
  return Build(model, { grid, samples, code, summary }, region, refineInterior, parallelFor);
}

Encoding BuildIsodiamonds(Model model, const ScalarHierarchy& hierarchy, const Isoregion& region,
  const ParallelFor& parallelFor, bool refineInterior)
{
  const auto summary = [&](const Place& place)
  { return std::make_pair(hierarchy.Error(place), hierarchy.Range(place)); };
  return Build(model, { hierarchy.Domain(), hierarchy.Samples(), hierarchy.Codes(), summary },
    region, refineInterior, parallelFor);
}

Encoding EncodeQuery(const ScalarHierarchy& hierarchy, const Isoregion& region, double tolerance,
  const ParallelFor& parallelFor, double interiorTolerance)
{
  const Grid& grid = hierarchy.Domain();
  const ErrorCode& codes = hierarchy.Codes();
  DiamondMask subdivided =
    hierarchy.Refine(region, codes.Accepted(tolerance), codes.Accepted(interiorTolerance))
      .Subdivided;
  subdivided.Insert(grid.Depth(), 0, CornerBrick());
  const DiamondSet set(grid, subdivided);
  const std::vector<ErrorCode::Type> thresholds(set.Size(), ErrorCode::Always);
  const EncodingHeader header{ Model::Relevant, grid.Dimensions(), region, codes.Scale(),
    set.Size() };
  return Encode(header, grid, hierarchy.Samples(), set, thresholds, parallelFor);
}

}
