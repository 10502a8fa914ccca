// SPDX-License-Identifier: BSD-3-Clause
#include "Build/OwnErrors.h"

#include "DistanceError/DistanceError.h"
#include "DistanceError/OverturnedTetrahedra.h"
#include "Field/CriticalDiamonds.h"

#include <stdexcept>

namespace isodiamond
{

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

void FieldMetric::SetCodes(const Place& place, std::uint32_t rank, ErrorCode::Type code,
  const ValueRange& range, DiamondCodes& own) const
{
  const bool holdsVolume = this->Signs.AreChanged() &&
    this->SampleGrid.SticksOut(place.Position, place.Scale) &&
    this->Signs.HasAllVerticesInside(place);
  if (holdsVolume || OwnErrorCounts(this->Region, this->SampleGrid, range, place))
  {
    own.Surface[rank] = code;
  }
  if (this->RefineInterior && this->Signs.HasAllVerticesInside(place))
  {
    own.Interior[rank] = code;
  }
}

DiamondCodes OwnFieldCodes(const Source& source, const FieldMetric& metric,
  const DiamondSet& members, const ParallelFor& parallelFor)
{
  DiamondCodes own(members.Size(), metric.RefineInterior);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      const auto [code, range] = source.Summary(place);
      metric.SetCodes(place, rank, code, range, own);
    });
  return own;
}

std::vector<ErrorCode::Type> InteriorCodes(const Source& source, const BuildSigns& signs,
  const DiamondSet& members, const ParallelFor& parallelFor)
{
  std::vector<ErrorCode::Type> codes(members.Size(), 0);
  ForEachMember(members, parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (signs.HasAllVerticesInside(place))
      {
        codes[rank] = source.Summary(place).first;
      }
    });
  return codes;
}

DiamondCodes OwnDistanceCodes(const Source& source, const Finiteness& isFinite,
  const IsodiamondHierarchy& relevant, const BuildSigns& signs, const BuildOptions& options,
  const DiamondPortion* portion, DiamondCodes own, MapBounds& bounds,
  const ParallelFor& parallelFor)
{
  own.Surface = DistanceErrors(relevant, isFinite, options.World, options.PreserveFeatures,
    portion != nullptr ? Loops(parallelFor) : Loops(parallelFor, options.Together),
    std::move(own.Surface), &bounds, portion);
  ForEachMember(relevant.Diamonds(), parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (HoldsVolume(relevant.Region(), source.SampleGrid, signs, place))
      {
        own.Surface[rank] = ErrorCode::Always;
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

void SubdivideOverturned(const IsodiamondHierarchy& relevant, const GridGeometry& world,
  const ParallelFor& parallelFor, std::vector<ErrorCode::Type>& codes)
{
  if (!relevant.Region().IsVolume() || world.Affine() != nullptr)
  {
    return;
  }
  const OverturnedTetrahedra overturned(relevant, world);
  ForEachMember(relevant.Diamonds(), parallelFor,
    [&](const Place& place, std::uint32_t rank)
    {
      if (codes[rank] != ErrorCode::Always && overturned.AreAround(place))
      {
        codes[rank] = ErrorCode::Always;
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
