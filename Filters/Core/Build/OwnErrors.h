// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_OwnErrors_h
#define isodiamond_OwnErrors_h

#include "Build/Builder.h"
#include "DistanceError/MapBounds.h"
#include "Field/DiamondSigns.h"
#include "Field/SignLattice.h"
#include "FieldError/FieldError.h"

#include <functional>
#include <utility>
#include <vector>

/**
 * @file OwnErrors.h
 * The diamonds' own errors by either metric, and what is subdivided whatever its error: from these,
 * thresholds are made.
 */
namespace isodiamond
{

/** Where the samples, field errors and ranges of a build come from. A volume that comes in slabs
 * offers only signs, kept by the steps, and a view without samples. */
struct Source
{
  const Grid& SampleGrid;
  const AnySamples& Samples;
  double FieldScale = 1.0;
  /** The code of a diamond's own field error, and the range of its domain. */
  std::function<std::pair<ErrorCode::Type, ValueRange>(const Place&)> Summary;
};

/** @throws std::invalid_argument if the minimum size of pieces is negative */
void CheckOptions(const BuildOptions& options);

Grid GridOf(const AnySamples& samples);

/** Whether a build needs field errors; they take a pass over the samples. */
bool NeedsFieldErrors(const Isoregion& region, const BuildOptions& options);

/** The summary that a source gives, from field errors. @param scale of their codes */
std::pair<ErrorCode::Type, ValueRange> SummaryOf(
  const FieldErrors& errors, double scale, const Place& place);

/** The signs that a build goes by: the samples', or, where small pieces were removed or the samples
 *  are not at hand, those of a lattice. */
class BuildSigns
{
public:
  /** All arguments must outlive it. @param lattice null if the samples say the same */
  BuildSigns(const Isoregion& region, const Source& source, const SignLattice* lattice)
    : Region(region)
    , Origin(source)
    , Lattice(lattice)
  {
  }

  /** Whether these differ from the samples'. */
  bool AreChanged() const { return this->Lattice != nullptr && this->Lattice->RemovedPieces() > 0; }

  bool HasAllVerticesInside(const Place& place) const
  {
    return isodiamond::HasAllVerticesInside(this->Region, this->Origin.SampleGrid, place,
      [this](const Point& vertex)
      {
        return this->Lattice != nullptr
          ? this->Lattice->Sign(0, vertex)
          : this->Region.SignOf(SampleAt(this->Origin.Samples, vertex));
      });
  }

private:
  const Isoregion& Region;
  const Source& Origin;
  const SignLattice* Lattice;
};

/** Codes by rank, for the tolerance and for the interior tolerance: of own errors where they count,
 *  else 0; or of thresholds made from these. */
struct DiamondCodes
{
  std::vector<ErrorCode::Type> Surface;
  std::vector<ErrorCode::Type> Interior; ///< empty without refinement of the interior
  std::vector<std::uint32_t> Followers;  ///< ranks, once there are thresholds

  DiamondCodes() = default;
  DiamondCodes(std::int64_t size, bool refineInterior)
    : Surface(size, 0)
    , Interior(refineInterior ? size : 0, 0)
  {
  }
};

/**
 * What the field metric makes of the summaries of domains.
 *
 * Ranges are the samples', even where small pieces were removed. So what these crossed is
 * subdivided without need, but never too little is: where signs differ, values do. Only a domain
 * that has come to lie entirely inside can have all of its samples outside on one side.
 */
struct FieldMetric
{
  const Isoregion& Region;
  const Grid& SampleGrid;
  BuildSigns Signs;
  bool RefineInterior = false;

  /** @param code, range from a diamond's summary @param own where its codes are set */
  void SetCodes(const Place& place, std::uint32_t rank, ErrorCode::Type code,
    const ValueRange& range, DiamondCodes& own) const;
};

/** Calls body(place, rank) for all diamonds but the corners of the base cube. Goes word by word: a
 *  whole brick of coarse diamonds would be much work for one step. */
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

/** Own errors by the field metric. */
DiamondCodes OwnFieldCodes(const Source& source, const FieldMetric& metric,
  const DiamondSet& members, const ParallelFor& parallelFor);

/** Own errors by the field metric inside an interval volume. */
std::vector<ErrorCode::Type> InteriorCodes(const Source& source, const BuildSigns& signs,
  const DiamondSet& members, const ParallelFor& parallelFor);

/** Own errors by the distance metric.
 *  @param own already has what is always subdivided; its interior codes stay as they are
 *  @param portion that the diamonds make up; null for all of them */
DiamondCodes OwnDistanceCodes(const Source& source, const Finiteness& isFinite,
  const IsodiamondHierarchy& relevant, const BuildSigns& signs, const BuildOptions& options,
  const DiamondPortion* portion, DiamondCodes own, MapBounds& bounds,
  const ParallelFor& parallelFor);

/** Whether a diamond of an interval volume has to be subdivided because it holds volume in the grid
 *  and sticks out of the grid. */
bool HoldsVolume(
  const Isoregion& region, const Grid& grid, const BuildSigns& signs, const Place& place);

bool HasHiddenCells(const BuildOptions& options);

/** Whether an interval volume is refined inside: what lies in hidden cells can only be left out at
 *  full resolution, even deep inside. */
bool RefinesInterior(const Isoregion& region, const BuildOptions& options);

/** Active diamonds that touch a hidden cell are always subdivided. */
void RefineAtHiddenCells(const HiddenCells& hidden, const DiamondMask& active,
  const DiamondSet& members, const ParallelFor& parallelFor, DiamondCodes& codes);

/** Diamonds that would have tetrahedra turn over in the world (OverturnedTetrahedra.h) are always
 *  subdivided. @param relevant an RI, of which there are none if it is of an isosurface */
void SubdivideOverturned(const IsodiamondHierarchy& relevant, const GridGeometry& world,
  const ParallelFor& parallelFor, std::vector<ErrorCode::Type>& codes);

/** What is always subdivided, with all ancestors, so that every mesh has the topology of full
 * resolution: critical diamonds, and what carries a surface to where hidden cells are cut out. */
DiamondMask RefinedForTopology(const Grid& grid, const SignLattice& signs,
  const DiamondMask& active, const BuildOptions& options, const ParallelFor& parallelFor);

}

#endif
