// SPDX-License-Identifier: BSD-3-Clause
#include "Hierarchy/Encoder.h"

#include "Hierarchy/IsovertexPlacement.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace isodiamond
{
namespace
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

  /** An edge with these signs along it. @param step between the points at the ends of a step */
  EdgeSamples<T> Along(EdgeSamples<T> edge, const Point& /*centre*/, const Point& /*step*/) const
  {
    return edge;
  }

private:
  const Isoregion& Region;
  const SampleView<T>& Samples;
};

/** The same where small pieces were removed: the signs of what is left. */
template <typename T>
class RemainingSigns
{
public:
  explicit RemainingSigns(const SignLattice& signs)
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

/** Reads signs, isovertices and inside values of diamonds off the samples. */
template <typename T, typename Signs>
class DiamondReader
{
public:
  DiamondReader(const EncodingHeader& header, const Grid& grid, const SampleView<T>& samples,
    const Signs& signs)
    : Region(header.Region)
    , Exact(header.ExactIsovertices)
    , TheGrid(grid)
    , Samples(samples)
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
    return this->TheGrid.IsSampled(centre) ? this->SignOf(centre, this->Samples.Index(centre)) : 0;
  }

  bool IsInside(const Place& place) const
  {
    return this->Region.IsVolume() && this->Sign(place) == InsideSign;
  }

  T Value(const Place& place) const
  {
    return this->Samples.Pointer()[this->Samples.Index(Centre(place))];
  }

  /** The edges of a diamond with an isovertex. */
  std::uint16_t CrossedEdges(const Place& place) const
  {
    std::uint32_t crossed = 0;
    const Point centre = Centre(place);
    if (this->TheGrid.IsSampled(centre))
    {
      const int half = 1 << place.Scale;
      const bool isWhole = this->TheGrid.IsSampled(centre + Point{ half, half, half }) &&
        this->TheGrid.IsSampled(centre + Point{ -half, -half, -half });
      const int sign = this->Sign(place);
      const int parity = Parity(place.Position);
      const ParityTable& shape = tables::Parities[parity];
      for (int i = 0; i < shape.VertexCount; ++i)
      {
        if (isWhole || this->TheGrid.IsSampled(centre + half * shape.Offsets[i]))
        {
          crossed |= (this->SignOfVertex(place, i) != sign ? 1U : 0U) << i;
        }
      }
    }
    return static_cast<std::uint16_t>(crossed);
  }

  /** The number of isovertices of a diamond. @param crossed its CrossedEdges() */
  int CountIsovertices(const Place& place, std::uint16_t crossed) const
  {
    int count = PopCount(crossed);
    if (this->Region.IsVolume() && crossed != 0)
    {
      const int sign = this->Sign(place);
      ForEachBit(crossed,
        [&](int vertex)
        { count += std::abs(sign - this->SignOfVertex(place, vertex)) == 2 ? 1 : 0; });
    }
    return count;
  }

  /** Writes the coefficients of a diamond: those on surface 0, then 1. @return the end */
  std::uint8_t* WriteIsovertices(
    const Place& place, std::uint16_t crossed, std::uint8_t* next) const
  {
    std::array<std::uint8_t, MaximumVertices> upper{};
    int upperCount = 0;
    const int sign = this->Sign(place);
    ForEachBit(crossed,
      [&](int vertex)
      {
        const int otherSign = this->SignOfVertex(place, vertex);
        const auto edge = this->Edge(place, vertex);
        if (std::abs(sign - otherSign) == 2)
        {
          const std::array<std::uint8_t, 2> both = IsovertexCoefficients(edge, this->Region);
          *next++ = both[0];
          upper[upperCount++] = both[1];
        }
        else if (std::min(sign, otherSign) == 0)
        {
          *next++ = IsovertexCoefficient(edge, this->Region, 0);
        }
        else
        {
          upper[upperCount++] = IsovertexCoefficient(edge, this->Region, 1);
        }
      });
    return std::copy(upper.begin(), upper.begin() + upperCount, next);
  }

private:
  /** The sign of a vertex that has a sample. */
  int SignOfVertex(const Place& place, int vertex) const
  {
    const Point centre = Centre(place);
    const int half = 1 << place.Scale;
    const int parity = Parity(place.Position);
    return this->SignOf(centre + half * tables::Parities[parity].Offsets[vertex],
      this->Samples.Index(centre) + half * this->Strides[parity][vertex]);
  }

  /** An edge in unit steps, or for linear isovertices in one. */
  auto Edge(const Place& place, int vertex) const
  {
    const Point centre = Centre(place);
    const int parity = Parity(place.Position);
    const int length = 1 << place.Scale;
    const int step = this->Exact ? 1 : length;
    const EdgeSamples<T> values(this->Samples.Pointer() + this->Samples.Index(centre),
      step * this->Strides[parity][vertex], this->Exact ? length : 1);
    return this->SignOf.Along(values, centre, step * tables::Parities[parity].Offsets[vertex]);
  }

  const Isoregion& Region;
  bool Exact;
  const Grid& TheGrid;
  const SampleView<T>& Samples;
  const Signs& SignOf;
  /** By parity and vertex, in samples. */
  std::array<std::array<std::int64_t, MaximumVertices>, 8> Strides{};
};

/** What the bricks before a brick hold. */
struct BrickOffset
{
  std::int64_t Isovertices = 0;
  std::int64_t InsideValues = 0;
};

template <typename T, typename Signs>
void EncodeDiamonds(const EncodingHeader& header, const Grid& grid, const SampleView<T>& samples,
  const Signs& signs, const DiamondSet& set, ErrorCode::Type code, const ParallelFor& parallelFor,
  Encoding& encoding)
{
  const DiamondReader<T, Signs> reader(header, grid, samples, signs);
  const std::vector<BrickPlace> bricks = AllBricks(set);
  const std::int64_t brickCount = static_cast<std::int64_t>(bricks.size());
  const auto forEachDiamond = [&](const auto& body)
  {
    ForEachIndex(parallelFor, brickCount, 16,
      [&](std::int64_t i)
      {
        set.ForEachInBrick(bricks[i].Scale, set.Level(bricks[i].Scale).Bricks[bricks[i].Index],
          [&](const Place& place, std::uint32_t rank) { body(i, place, rank); });
      });
  };

  // Count what every brick holds. Records have the crossed edges first.
  std::vector<BrickOffset> next(brickCount + 1);
  encoding.Arrays.Records.resize(set.Size());
  forEachDiamond(
    [&](std::int64_t i, const Place& place, std::uint32_t rank)
    {
      const std::uint16_t crossed = reader.CrossedEdges(place);
      encoding.Arrays.Records[rank] = crossed;
      next[i + 1].Isovertices += reader.CountIsovertices(place, crossed);
      next[i + 1].InsideValues += reader.IsInside(place) ? 1 : 0;
    });

  // Prefix sum.
  for (std::int64_t i = 0; i < brickCount; ++i)
  {
    next[i + 1].Isovertices += next[i].Isovertices;
    next[i + 1].InsideValues += next[i].InsideValues;
  }
  if (next[brickCount].Isovertices > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("more than 2^32 - 1 isovertices");
  }

  // Write.
  std::vector<T> insideValues(next[brickCount].InsideValues);
  encoding.Arrays.Isovertices.resize(next[brickCount].Isovertices);
  std::uint8_t* isovertices = encoding.Arrays.Isovertices.data();
  forEachDiamond(
    [&](std::int64_t i, const Place& place, std::uint32_t rank)
    {
      std::uint16_t& record = encoding.Arrays.Records[rank];
      next[i].Isovertices =
        reader.WriteIsovertices(place, record, isovertices + next[i].Isovertices) - isovertices;
      record = Record::Pack(code, reader.Sign(place));
      if (reader.IsInside(place))
      {
        insideValues[next[i].InsideValues++] = reader.Value(place);
      }
    });
  encoding.InsideValues = std::move(insideValues);
}

}

Encoding Encode(const EncodingHeader& header, const Grid& grid, const AnySamples& samples,
  const DiamondSet& set, ErrorCode::Type code, const ParallelFor& parallelFor,
  const SignLattice* signs)
{
  Encoding encoding;
  encoding.Header = header;
  std::size_t bricks = 0;
  for (int scale = 0; scale < set.ScaleCount(); ++scale)
  {
    bricks += set.Level(scale).Bricks.size();
  }
  encoding.Arrays.BrickIndices.reserve(bricks);
  encoding.Arrays.BrickMasks.reserve(8 * bricks);
  for (int scale = set.ScaleCount() - 1; scale >= 0; --scale)
  {
    const std::vector<Brick>& bricks = set.Level(scale).Bricks;
    encoding.Arrays.BrickCounts.push_back(static_cast<std::uint32_t>(bricks.size()));
    for (const Brick& brick : bricks)
    {
      encoding.Arrays.BrickIndices.push_back(brick.BoxIndex);
      encoding.Arrays.BrickMasks.insert(
        encoding.Arrays.BrickMasks.end(), brick.Occupancy.begin(), brick.Occupancy.end());
    }
  }
  std::visit(
    [&](const auto& view)
    {
      using Value = typename std::decay_t<decltype(view)>::Value;
      const auto encode = [&](const auto& signOf)
      { EncodeDiamonds(header, grid, view, signOf, set, code, parallelFor, encoding); };
      if (signs != nullptr)
      {
        encode(RemainingSigns<Value>(*signs));
      }
      else
      {
        encode(SampleSigns<Value>(header.Region, view));
      }
    },
    samples);
  return encoding;
}

}
