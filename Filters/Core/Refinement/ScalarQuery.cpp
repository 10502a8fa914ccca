// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/ScalarQuery.h"

#include "Field/CriticalDiamonds.h"
#include "Field/DiamondSigns.h"
#include "Hierarchy/Encoder.h"

#include <optional>

namespace isodiamond
{
namespace
{

/** The subdivided diamonds of a query to an HD. */
DiamondMask RefineScalars(const ScalarHierarchy& hierarchy, const Isoregion& region,
  const Query& query, const ParallelFor& parallelFor)
{
  const Grid& grid = hierarchy.SampleGrid();
  std::optional<DiamondMask> critical;
  if (query.PreserveTopology)
  {
    const SignLattice signs(grid, hierarchy.Samples(), region, parallelFor);
    critical = CriticalDiamonds(grid, signs, parallelFor);
  }
  const DiamondMask* always = critical ? &*critical : nullptr;
  const ErrorCode& codes = hierarchy.Codes();
  DiamondMask inside = hierarchy
                         .Refine(region, codes.Accepted(query.Tolerance),
                           codes.Accepted(query.InteriorTolerance), always)
                         .Subdivided;
  if (!query.Region)
  {
    return inside;
  }
  constexpr ErrorCode::Type nothingInside = ErrorCode::Always - 1;
  DiamondMask subdivided =
    hierarchy.Refine(region, codes.Accepted(query.OutsideTolerance), nothingInside, always)
      .Subdivided;
  inside.ForEach(
    [&](const Place& place)
    {
      if (!subdivided.Contains(place) && query.Region->Touches(place) &&
        DiamondSigns(region, grid, hierarchy.Samples(), place).KindOfDiamond() != Kind::Relevant)
      {
        subdivided.Insert(place);
      }
    });
  subdivided.CloseOverParents(grid);
  return subdivided;
}

}

Encoded EncodeQuery(const ScalarHierarchy& hierarchy, const Isoregion& region, const Query& query,
  bool exactIsovertices, const ParallelFor& parallelFor)
{
  const Grid& grid = hierarchy.SampleGrid();
  DiamondMask subdivided = RefineScalars(hierarchy, region, query, parallelFor);
  subdivided.Insert(grid.Depth(), 0, CornerBrick());
  const DiamondSet set(grid, subdivided);
  EncodingHeader header;
  header.TheModel = Model::Relevant;
  header.Dimensions = grid.Dimensions();
  header.Region = region;
  header.ErrorScale = hierarchy.Codes().Scale();
  header.ExactIsovertices = exactIsovertices;
  header.PreservesTopology = query.PreserveTopology;
  header.IsAnswer = true;
  header.RelevantCount = set.Size();
  return Encode(header, grid, hierarchy.Samples(), set, ErrorCode::Always, parallelFor);
}

}
