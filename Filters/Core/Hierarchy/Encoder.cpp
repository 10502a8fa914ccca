// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/Encoder.h"

#include "Hierarchy/DiamondReader.h"
#include "Hierarchy/EncodingPasses.h"

namespace isodiamond
{

Encoded Encode(const EncodingHeader& header, const Grid& grid, const AnySamples& samples,
  const DiamondSet& set, ErrorCode::Type code, const ParallelFor& parallelFor,
  const SignLattice* signs, bool withEdges)
{
  EncodingPasses passes(header, set, parallelFor);
  std::visit(
    [&](const auto& view)
    {
      using Value = typename std::decay_t<decltype(view)>::Value;
      const auto encode = [&](const auto& signOf)
      {
        const DiamondReader reader(header, grid, view, signOf);
        passes.Count(reader);
        passes.WriteIsovertices(0, set.ScaleCount(), EncodingPasses::AllSlices,
          [&](const Place& place, int vertex) { return reader.Edge(place, vertex); });
        passes.MakeRoomForValues<Value>();
        passes.WriteInsideValues(EncodingPasses::AllSlices, reader);
      };
      if (signs != nullptr)
      {
        encode(LatticeSigns<Value>(*signs));
      }
      else
      {
        encode(SampleSigns<Value>(header.Region, view));
      }
    },
    samples);
  return passes.Take(code, withEdges);
}

}
