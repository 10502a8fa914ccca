// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/StreamedEncoder.h"

#include "Hierarchy/DiamondReader.h"

namespace isodiamond
{
StreamedEncoder::StreamedEncoder(const EncodingHeader& header, const Grid& grid,
  const DiamondSet& set, ErrorCode::Type code, const SignLattice& signs,
  const ParallelFor& parallelFor)
  : Header(header)
  , TheGrid(grid)
  , Set(set)
  , Code(code)
  , Signs(signs)
  , Passes(header, set, parallelFor)
  , Gathered(grid.Dimensions(), {})
{
  static_assert(1 << (FirstLongScale - 1) == Overlap, "a slab has all of the short edges");
  const LatticeSigns<std::uint8_t> signOf(signs);
  this->Passes.Count(DiamondReader(
    header, grid, SampleView<std::uint8_t>(nullptr, grid.Dimensions()), signOf)); // signs only
  this->Gathered = this->WantedSamples();
}

GatheredEdge StreamedEncoder::LongEdge(
  const GatheredSamples* values, const Place& place, int vertex) const
{
  const Point& offset = tables::Parities[Parity(place.Position)].Offsets[vertex];
  const int length = 1 << place.Scale;
  const bool exact = this->Header.ExactIsovertices;
  return { values, EdgeSigns(this->Signs, Centre(place), (exact ? 1 : length) * offset),
    exact ? length : 1 };
}

GatheredSamples StreamedEncoder::WantedSamples() const
{
  std::vector<std::int64_t> wanted;
  this->Passes.ForEachCounted(FirstLongScale,
    [&](const Place& place, std::uint32_t crossed)
    {
      ForEachBit(crossed,
        [&](int vertex)
        {
          ForEachNeeded(this->LongEdge(nullptr, place, vertex),
            [&](const Point& point)
            { wanted.push_back(SampleIndex(this->TheGrid.Dimensions(), point)); });
        });
    });
  return { this->TheGrid.Dimensions(), std::move(wanted) };
}

void StreamedEncoder::Add(const SampleSlab& slab, const SliceRange& slices)
{
  this->Gathered.Add(slab);
  std::visit(
    [&](const auto& view)
    {
      using Value = typename std::decay_t<decltype(view)>::Value;
      const LatticeSigns<Value> signOf(this->Signs);
      const DiamondReader reader(this->Header, this->TheGrid, view, signOf, slab.First);
      if (!this->HasValues)
      {
        this->Passes.MakeRoomForValues<Value>();
        this->HasValues = true;
      }
      this->Passes.WriteIsovertices(0, FirstLongScale, slices,
        [&](const Place& place, int vertex) { return reader.Edge(place, vertex); });
      this->Passes.WriteInsideValues(slices, reader);
    },
    slab.Samples);
}

void StreamedEncoder::Skip(const SliceRange& slices)
{
  this->Passes.Skip(FirstLongScale, slices);
}

void StreamedEncoder::Merge(Peers& peers, bool areSetsOther)
{
  if (!areSetsOther)
  {
    this->Passes.Merge(peers);
  }
  this->Gathered.Merge(peers);
}

Encoded StreamedEncoder::Finish()
{
  this->Passes.WriteIsovertices(FirstLongScale, this->Set.ScaleCount(), EncodingPasses::AllSlices,
    [&](const Place& place, int vertex) { return this->LongEdge(&this->Gathered, place, vertex); });
  return this->Passes.Take(this->Code, true);
}

}
