// SPDX-License-Identifier: BSD-3-Clause
#include "Build/Assembly.h"

#include "Build/DiamondExchange.h"
#include "Hierarchy/EncodingPasses.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace isodiamond
{
namespace
{

/** The lists of the diamonds of all portions. @param sizeOf as for ListSizes() */
template <typename T, typename SizeOf>
std::vector<T> AssembleLists(const PeerPortion& portion, const DiamondExchange& exchange,
  const DiamondSet& members, const std::vector<T>& own, const DiamondEdges& edges, SizeOf sizeOf)
{
  std::vector<std::uint8_t> sizes;
  std::uint64_t owned = 0;
  portion.Others().Together(
    [&]
    {
      sizes = ListSizes(edges, sizeOf);
      members.ForEach([&](const Place& place, std::uint32_t rank)
        { owned += portion.Diamonds().Owns(Centre(place)[2]) ? sizes[rank] : 0; });
    });
  const std::vector<std::uint64_t> ofAll = portion.Others().Gather({ owned });
  return exchange.Lists(own, sizes, std::accumulate(ofAll.begin(), ofAll.end(), std::size_t{ 0 }));
}

}

Encoding Assemble(const PeerPortion& portion, Encoding own, const IsodiamondHierarchy& hierarchy,
  const DiamondSet& kept)
{
  const DiamondSet& members = hierarchy.Diamonds();
  const auto owns = [&](int slice) { return portion.Diamonds().Owns(slice); };
  const DiamondExchange exchange(portion, members, kept, owns);
  // Arrays are dropped once they have been given.
  EncodingArrays<OwnedArray>& from = own.Arrays;
  const auto give = [&](auto& values) { return exchange.Values(std::exchange(values, {})); };
  const auto giveLists = [&](auto& values, auto sizeOf)
  {
    return AssembleLists(
      portion, exchange, members, std::exchange(values, {}), hierarchy.EdgesByRank(), sizeOf);
  };
  Encoding whole;
  whole.Header = own.Header;
  portion.Others().Together([&] { WriteBricks(kept, whole.Arrays); });
  whole.Arrays.Isovertices = giveLists(from.Isovertices, &DiamondEdges::IsovertexCount);
  if (own.Header.Region.IsVolume())
  {
    std::visit([&](auto& values)
      { whole.InsideValues = giveLists(values, &DiamondEdges::IsInside); },
      own.InsideValues);
  }
  else
  {
    whole.InsideValues = std::move(own.InsideValues);
  }
  whole.Arrays.InteriorCodes = give(from.InteriorCodes);
  whole.Arrays.Records = give(from.Records);

  std::vector<std::uint64_t> followers;
  std::copy_if(from.Followers.begin(), from.Followers.end(), std::back_inserter(followers),
    [&](std::uint64_t code) { return owns(Centre(PlaceOfCentre(code))[2]); });
  whole.Arrays.Followers = portion.Others().Gather(followers);
  std::sort(whole.Arrays.Followers.begin(), whole.Arrays.Followers.end());
  return whole;
}

}
