// SPDX-License-Identifier: BSD-3-Clause
#include "Build/OwnErrors.h"

#include "DistanceError/DistanceError.h"
#include "Field/CriticalDiamonds.h"

#include <stdexcept>

namespace isodiamond
{
namespace
{

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

}

void CheckOptions(const BuildOptions& options)
{
  if (options.MinimumPieceSize < 0)
  {
    throw std::invalid_argument("The minimum size of pieces must not be negative.");
  }
}

Grid GridOf(const AnySamples& samples)
{
  return Grid(std::visit([](const auto& view) { return view.Dimensions(); }, samples));
}

bool NeedsFieldErrors(const Isoregion& region, const BuildOptions& options)
{
  return options.Metric == ErrorMetric::Field || RefinesInterior(region, options);
}

std::pair<ErrorCode::Type, ValueRange> SummaryOf(
  const FieldErrors& errors, double scale, const Place& place)
{
  const DomainSummary domain = errors.Summarize(place);
  return { ErrorCode(scale).Encode(domain.Error), domain.Range };
}

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

DiamondCodes OwnDistanceCodes(const Source& source, const Finiteness& isFinite,
  const IsodiamondHierarchy& relevant, const BuildSigns& signs, const BuildOptions& options,
  DiamondCodes own, MapBounds& bounds, const ParallelFor& parallelFor)
{
  const DiamondSet& members = relevant.Diamonds();
  const bool refineInterior = !own.Interior.empty();
  own.Surface = DistanceErrors(relevant, isFinite, options.World, options.PreserveFeatures,
    Loops(parallelFor, options.Together), std::move(own.Surface), &bounds);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (HoldsVolume(relevant.Region(), source.SampleGrid, signs, place))
      {
        own.Surface[rank] = ErrorCode::Always;
      }
      if (refineInterior && signs.HasAllVerticesInside(place))
      {
        own.Interior[rank] = source.Summary(place).first;
      }
    });
  return own;
}

bool HoldsVolume(
  const Isoregion& region, const Grid& grid, const BuildSigns& signs, const Place& place)
{
  return region.IsVolume() && grid.SticksOut(place.Position, place.Scale) &&
    signs.HasAllVerticesInside(place);
}

bool HasHiddenCells(const BuildOptions& options)
{
  return options.Hidden != nullptr && options.Hidden->Any();
}

bool RefinesInterior(const Isoregion& region, const BuildOptions& options)
{
  return region.IsVolume() && (options.RefineInterior || HasHiddenCells(options));
}

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

}
