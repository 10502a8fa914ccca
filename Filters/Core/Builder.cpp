// SPDX-License-Identifier: BSD-3-Clause
#include "Builder.h"

#include "Activation.h"
#include "Classification.h"
#include "Encoder.h"
#include "FieldError.h"

namespace isodiamond
{
namespace
{

/** The code of a diamond's own error, 0 if the surface does not cross its domain. */
using TriggerFunction = std::function<ErrorCode::Type(const Place&)>;

std::vector<ErrorCode::Type> Triggers(
  const DiamondSet& members, const TriggerFunction& trigger, const ParallelFor& parallelFor)
{
  std::vector<ErrorCode::Type> triggers(members.Size(), 0);
  for (int scale = members.ScaleCount() - 1; scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = members.Level(scale).Bricks;
    parallelFor(static_cast<std::int64_t>(bricks.size()), 1,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          members.ForEachInBrick(scale, bricks[i],
            [&](const Place& place, std::uint32_t rank) { triggers[rank] = trigger(place); });
        }
      });
  }
  return triggers;
}

/** The part of the members that a model stores, and their thresholds; the base cube's corners
 *  come first. */
struct Selection
{
  DiamondSet Set;
  std::vector<ErrorCode::Type> Thresholds;

  Selection(const Grid& grid, Model model, const DiamondSet& members,
    const std::vector<ErrorCode::Type>& thresholds, const Classification& kinds)
    : Set(grid)
    , Thresholds(8, ErrorCode::Always)
  {
    this->Set.Append(grid.Depth(), 0, CornerBrick());
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
  void Add(int scale, const Brick& brick, const BrickMask& mask,
    const std::vector<ErrorCode::Type>& thresholds)
  {
    this->Set.Append(scale, brick.BoxIndex, mask);
    for (int z = 0; z < 8; ++z)
    {
      ForEachBit(
        mask[z], [&](int bit) { this->Thresholds.push_back(thresholds[brick.Rank(z, bit)]); });
    }
  }
};

Encoding Build(EncodingHeader header, const AnySamples& samples, const TriggerFunction& trigger,
  const ParallelFor& parallelFor)
{
  const Grid grid(header.Dimensions);
  Classification kinds = [&]
  {
    const SignLattice signs(grid, samples, header.Isovalue, parallelFor);
    return Classify(grid, signs, parallelFor);
  }();
  const DiamondSet members(grid, kinds.Members);
  kinds.Members = DiamondMask();
  const std::vector<ErrorCode::Type> thresholds =
    ActivationThresholds(grid, members, Triggers(members, trigger, parallelFor));
  header.RelevantCount = members.Size() - kinds.Active.Size();
  const Selection selection(grid, header.Kind, members, thresholds, kinds);
  return Encode(header, grid, samples, selection.Set, selection.Thresholds, parallelFor);
}

}

Encoding BuildIsodiamonds(
  Model model, const AnySamples& samples, double isovalue, const ParallelFor& parallelFor)
{
  const ErrorCode code(FieldErrorScale(samples));
  const std::array<int, 3> dimensions =
    std::visit([](const auto& view) { return view.Dimensions(); }, samples);
  const Grid grid(dimensions);
  const TriggerFunction trigger = [&](const Place& place)
  {
    const DomainSummary summary = SummarizeDomain(grid, samples, place);
    return summary.Range.Crosses(isovalue) ? code.Encode(summary.Error) : ErrorCode::Type{ 0 };
  };
  return Build({ model, dimensions, isovalue, code.Scale(), 0 }, samples, trigger, parallelFor);
}

Encoding BuildIsodiamonds(
  Model model, const ScalarHierarchy& hierarchy, double isovalue, const ParallelFor& parallelFor)
{
  const TriggerFunction trigger = [&](const Place& place)
  {
    return hierarchy.Range(place).Crosses(isovalue) ? hierarchy.Error(place) : ErrorCode::Type{ 0 };
  };
  return Build({ model, hierarchy.Domain().Dimensions(), isovalue, hierarchy.Codes().Scale(), 0 },
    hierarchy.Samples(), trigger, parallelFor);
}

Encoding EncodeQuery(const ScalarHierarchy& hierarchy, double isovalue, double tolerance,
  const ParallelFor& parallelFor)
{
  const Grid& grid = hierarchy.Domain();
  DiamondMask subdivided =
    hierarchy.Refine(isovalue, hierarchy.Codes().Accepted(tolerance)).Subdivided;
  subdivided.Insert(grid.Depth(), 0, CornerBrick());
  const DiamondSet set(grid, subdivided);
  const std::vector<ErrorCode::Type> thresholds(set.Size(), ErrorCode::Always);
  const EncodingHeader header{ Model::Relevant, grid.Dimensions(), isovalue,
    hierarchy.Codes().Scale(), set.Size() };
  return Encode(header, grid, hierarchy.Samples(), set, thresholds, parallelFor);
}

}
