// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/ScalarQuery.h"

#include "Hierarchy/Encoder.h"

namespace isodiamond
{
namespace
{

/** Whether a diamond has a patch or makes one: it is an active or creation diamond if it leads to
 *  the surface at all. */
bool IsActiveOrCreation(
  const Isoregion& region, const Grid& grid, const AnySamples& samples, const Place& place)
{
  std::uint32_t signs = 0;
  const auto addSign = [&](const Point& point)
  {
    if (grid.IsSampled(point))
    {
      signs |= 1U << region.SignOf(SampleAt(samples, point));
    }
  };
  const ParityTable& shape = tables::Parities[Parity(place.Position)];
  addSign(Centre(place));
  for (int i = 0; i < shape.VertexCount; ++i)
  {
    addSign(VertexAt(place, shape.Offsets[i]));
  }
  const bool oneSign = (signs & (signs - 1)) == 0;
  return !oneSign || (region.IsVolume() && signs == 1U << InsideSign);
}

/** The subdivided diamonds of a query to an HD. */
DiamondMask RefineScalars(
  const ScalarHierarchy& hierarchy, const Isoregion& region, const Query& query)
{
  const ErrorCode& codes = hierarchy.Codes();
  DiamondMask inside =
    hierarchy
      .Refine(region, codes.Accepted(query.Tolerance), codes.Accepted(query.InteriorTolerance))
      .Subdivided;
  if (!query.Region)
  {
    return inside;
  }
  const Grid& grid = hierarchy.Domain();
  DiamondMask subdivided =
    hierarchy.Refine(region, codes.Accepted(query.OutsideTolerance)).Subdivided;
  inside.ForEach(
    [&](const Place& place)
    {
      if (!subdivided.Contains(place) && query.Region->Touches(place) &&
        IsActiveOrCreation(region, grid, hierarchy.Samples(), place))
      {
        subdivided.Insert(place);
      }
    });
  subdivided.CloseOverParents(grid);
  return subdivided;
}

}

Encoding EncodeQuery(const ScalarHierarchy& hierarchy, const Isoregion& region, const Query& query,
  bool exactIsovertices, const ParallelFor& parallelFor)
{
  const Grid& grid = hierarchy.Domain();
  DiamondMask subdivided = RefineScalars(hierarchy, region, query);
  subdivided.Insert(grid.Depth(), 0, CornerBrick());
  const DiamondSet set(grid, subdivided);
  EncodingHeader header;
  header.Kind = Model::Relevant;
  header.Dimensions = grid.Dimensions();
  header.Region = region;
  header.ErrorScale = hierarchy.Codes().Scale();
  header.ExactIsovertices = exactIsovertices;
  header.IsAnswer = true;
  header.RelevantCount = set.Size();
  return Encode(header, grid, hierarchy.Samples(), set, ErrorCode::Always, parallelFor);
}

}
