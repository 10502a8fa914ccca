// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_DiamondReader_h
#define isodiamond_DiamondReader_h

#include "Hierarchy/IsodiamondHierarchy.h"
#include "Hierarchy/IsovertexPlacement.h"

#include <array>
#include <cstdint>

namespace isodiamond
{

/** The signs of the samples. */
template <typename T>
class SampleSigns
{
public:
  SampleSigns(const Isoregion& region, const SampleView<T>& samples)
    : Region(region)
    , Samples(samples)
  {
  }

  /** The sign of a lattice point that has a sample. @param index of the sample */
  int operator()(const Point& /*point*/, std::int64_t index) const
  {
    return this->Region.SignOf(static_cast<double>(this->Samples.Pointer()[index]));
  }

  /** An edge with these signs along it, given the diamond's centre and the offset between the ends
   *  of a step. */
  EdgeSamples<T> Along(EdgeSamples<T> edge, const Point& /*centre*/, const Point& /*step*/) const
  {
    return edge;
  }

private:
  const Isoregion& Region;
  const SampleView<T>& Samples;
};

/** The signs of a lattice: where small pieces were removed, or the volume comes in slabs. */
template <typename T>
class LatticeSigns
{
public:
  explicit LatticeSigns(const SignLattice& signs)
    : Signs(signs)
  {
  }

  int operator()(const Point& point, std::int64_t /*index*/) const
  {
    return this->Signs.Sign(0, point);
  }

  SignedEdgeSamples<T> Along(
    const EdgeSamples<T>& edge, const Point& centre, const Point& step) const
  {
    return { edge, this->Signs, centre, step };
  }

private:
  const SignLattice& Signs;
};

/** Reads the signs, inside values and samples along the edges of diamonds from the samples of a
 *  volume, or of a slab that has all vertices of the diamonds. */
template <typename T, typename Signs>
class DiamondReader
{
public:
  using Value = T;

  /** All but the header must outlive it. @param first the first slice that the samples have */
  DiamondReader(const EncodingHeader& header, const Grid& grid, const SampleView<T>& samples,
    const Signs& signs, int first = 0)
    : Region(header.Region)
    , Exact(header.ExactIsovertices)
    , TheGrid(grid)
    , Samples(samples)
    , Before(samples.Index({ 0, 0, first }))
    , SignOf(signs)
  {
    const std::int64_t row = samples.Dimensions()[0];
    const std::int64_t slice = row * samples.Dimensions()[1];
    for (int parity = 1; parity < 8; ++parity)
    {
      const ParityTable& shape = tables::Parities[parity];
      for (int i = 0; i < shape.VertexCount; ++i)
      {
        const Point& offset = shape.Offsets[i];
        this->Strides[parity][i] = offset[0] + offset[1] * row + offset[2] * slice;
      }
    }
  }

  int Sign(const Place& place) const
  {
    const Point centre = Centre(place);
    return this->TheGrid.IsSampled(centre) ? this->SignOf(centre, this->IndexOf(centre)) : 0;
  }

  /** The sample at the centre. */
  T ValueAt(const Place& place) const
  {
    return this->Samples.Pointer()[this->IndexOf(Centre(place))];
  }

  /** The signs of a diamond's vertices. @param sign its Sign() */
  DiamondSigns SignsOf(const Place& place, int sign) const
  {
    const Point centre = Centre(place);
    const int half = 1 << place.Scale;
    const int parity = Parity(place.Position);
    const ParityTable& shape = tables::Parities[parity];
    const std::int64_t index = this->IndexOf(centre);
    const auto signOf = [&](int vertex) // beyond the last one, that of the centre
    {
      return this->SignOf(
        centre + half * shape.Offsets[vertex], index + half * this->Strides[parity][vertex]);
    };
    const std::uint32_t sampled = SampledVertices(this->TheGrid, place);
    if (sampled == (1U << shape.VertexCount) - 1U) // then the centre has a sample, too
    {
      return DiamondSigns::ReadAll(this->Region, sign, sampled, signOf);
    }
    return DiamondSigns::Read(
      this->Region, this->TheGrid.IsSampled(centre) ? sign : -1, sampled, signOf);
  }

  /** An edge in unit steps, or in a single step for linear isovertices. */
  auto Edge(const Place& place, int vertex) const
  {
    const Point centre = Centre(place);
    const int parity = Parity(place.Position);
    const int length = 1 << place.Scale;
    const int step = this->Exact ? 1 : length;
    const EdgeSamples<T> values(this->Samples.Pointer() + this->IndexOf(centre),
      step * this->Strides[parity][vertex], this->Exact ? length : 1);
    return this->SignOf.Along(values, centre, step * tables::Parities[parity].Offsets[vertex]);
  }

private:
  std::int64_t IndexOf(const Point& point) const
  {
    return this->Samples.Index(point) - this->Before;
  }

  Isoregion Region;
  bool Exact;
  const Grid& TheGrid;
  SampleView<T> Samples;
  std::int64_t Before; ///< samples of the volume before these
  const Signs& SignOf;
  /** By parity and vertex, in samples. */
  std::array<std::array<std::int64_t, MaximumVertices>, 8> Strides{};
};

}

#endif
