// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Dealing.h"

#include "FieldError/MidpointOrder.h"
#include "Hierarchy/EncodingPasses.h"
#include "Hierarchy/StreamedEncoder.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

DiamondSet TellersOf(const DiamondMask& all, const Grid& grid, const std::vector<SliceRange>& slabs)
{
  const auto isTold = [&](int scale, int slice)
  {
    return scale >= std::min(Dealing::FirstCommonScale, grid.Depth()) ||
      std::any_of(slabs.begin(), slabs.end(),
        [&](const SliceRange& slab) { return slice >= slab.Begin && slice < slab.End; });
  };
  return { grid, all, [&](int scale, int z) {
            return isTold(scale, z << scale) ? ~std::uint64_t{ 0 } : std::uint64_t{ 0 };
          } };
}

}

static_assert(Dealing::FirstCommonScale <= StreamedEncoder::FirstLongScale &&
    Dealing::FirstCommonScale <= MidpointOrder::MaximumScale + 1,
  "long edges and large domains are those of all peers");

Dealing::Dealing(const Grid& grid, const PeerPortion& portion, const DiamondSet& members,
  const std::vector<SliceRange>& slabs)
  : Portion(portion)
  , Members(members)
  , Told(TellersOf(portion.All(), grid, slabs))
{
}

DiamondExchange Dealing::Exchange() const
{
  return { this->Portion, this->Told, this->Members, [](int) { return true; } };
}

Encoded Dealing::Deal(Encoded told) const
{
  // Arrays are dropped once they have been dealt.
  const DiamondExchange exchange = this->Exchange();
  const auto deal = [&](auto& values) { values = exchange.Values(std::exchange(values, {})); };
  const DiamondEdges& edges = told.Edges; // first of what is told, then of what is had
  const auto dealLists = [&](auto& values, const std::vector<std::uint8_t>& sizes, auto sizeOf)
  {
    const std::vector<std::uint8_t> had = ListSizes(edges, sizeOf);
    values = exchange.Lists(
      std::exchange(values, {}), sizes, std::accumulate(had.begin(), had.end(), std::size_t{ 0 }));
  };
  EncodingArrays<OwnedArray>& arrays = told.Encoding.Arrays;
  std::vector<std::uint8_t> isovertices;
  std::vector<std::uint8_t> inside;
  this->Portion.Others().Together(
    [&]
    {
      isovertices = ListSizes(edges, &DiamondEdges::IsovertexCount);
      inside = ListSizes(edges, &DiamondEdges::IsInside);
      arrays.BrickCounts.clear();
      arrays.BrickIndices.clear();
      arrays.BrickMasks.clear();
      WriteBricks(this->Members, arrays);
      told.Diamonds = this->Members;
    });
  deal(arrays.Records);
  deal(told.Edges.LowerAndKinds);
  deal(told.Edges.Upper);
  dealLists(arrays.Isovertices, isovertices, &DiamondEdges::IsovertexCount);
  if (told.Encoding.Header.Region.IsVolume())
  {
    std::visit([&](auto& values) { dealLists(values, inside, &DiamondEdges::IsInside); },
      told.Encoding.InsideValues);
  }
  return told;
}

std::vector<ErrorCode::Type> Dealing::Deal(const std::vector<ErrorCode::Type>& told) const
{
  return this->Exchange().Values(told);
}

}
