// SPDX-License-Identifier: BSD-3-Clause
#include "Encoder.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace isodiamond
{
namespace
{

/** Reads signs, isovertices and inside values of diamonds off the samples. */
template <typename T>
class BrickEncoder
{
public:
  BrickEncoder(const Isoregion& region, const Grid& grid, const SampleView<T>& samples)
    : Region(region)
    , Domain(grid)
    , Samples(samples)
  {
  }

  int Sign(const Place& place) const
  {
    const Point centre = Centre(place);
    return this->Domain.IsSampled(centre) ? this->Region.SignOf(this->Samples(centre)) : 0;
  }

  bool IsInside(const Place& place) const
  {
    return this->Region.IsVolume() && this->Sign(place) == InsideSign;
  }

  T Value(const Place& place) const
  {
    return this->Samples.Pointer()[this->Samples.Index(Centre(place))];
  }

  /** Calls body(coefficient) for the isovertices of a diamond: those on surface 0, then 1. */
  template <typename Body>
  void ForEachIsovertex(const Place& place, Body&& body) const
  {
    std::array<std::array<std::uint8_t, MaximumVertices>, 2> coefficients{};
    const std::array<int, 2> counts = this->Isovertices(place, coefficients);
    for (int surface = 0; surface < 2; ++surface)
    {
      for (int i = 0; i < counts[surface]; ++i)
      {
        body(coefficients[surface][i]);
      }
    }
  }

private:
  std::array<int, 2> Isovertices(const Place& place,
    std::array<std::array<std::uint8_t, MaximumVertices>, 2>& coefficients) const
  {
    std::array<int, 2> counts{};
    const Point centre = Centre(place);
    if (!this->Domain.IsSampled(centre))
    {
      return counts;
    }
    const double value = this->Samples(centre);
    const int sign = this->Region.SignOf(value);
    const ParityTable& shape = tables::Parities[Parity(place.Position)];
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      const Point vertex = centre + (1 << place.Scale) * shape.Offsets[i];
      if (!this->Domain.IsSampled(vertex))
      {
        continue;
      }
      const double other = this->Samples(vertex);
      const int otherSign = this->Region.SignOf(other);
      if (std::abs(sign - otherSign) == 2)
      {
        const std::array<std::uint8_t, 2> both = IsovertexCoefficients(value, other, this->Region);
        coefficients[0][counts[0]++] = both[0];
        coefficients[1][counts[1]++] = both[1];
      }
      else if (sign != otherSign)
      {
        const int surface = std::min(sign, otherSign);
        coefficients[surface][counts[surface]++] =
          IsovertexCoefficient(value, other, this->Region.Isovalue(surface));
      }
    }
    return counts;
  }

  const Isoregion& Region;
  const Grid& Domain;
  const SampleView<T>& Samples;
};

/** What the bricks before a brick hold. */
struct BrickOffset
{
  std::int64_t Isovertices = 0;
  std::int64_t InsideValues = 0;
};

template <typename T>
void EncodeDiamonds(const EncodingHeader& header, const Grid& grid, const SampleView<T>& samples,
  const DiamondSet& set, const std::vector<ErrorCode::Type>& thresholds,
  const ParallelFor& parallelFor, Encoding& encoding)
{
  const BrickEncoder<T> encoder(header.Region, grid, samples);
  const std::vector<BrickPlace> bricks = AllBricks(set);
  const std::int64_t brickCount = static_cast<std::int64_t>(bricks.size());
  const auto forEachDiamond = [&](const auto& body)
  {
    parallelFor(brickCount, 16,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          set.ForEachInBrick(bricks[i].Scale, set.Level(bricks[i].Scale).Bricks[bricks[i].Index],
            [&](const Place& place, std::uint32_t rank) { body(i, place, rank); });
        }
      });
  };

  // Count: records, and what every brick holds.
  std::vector<BrickOffset> next(brickCount + 1);
  encoding.Arrays.Records.resize(set.Size());
  forEachDiamond(
    [&](std::int64_t i, const Place& place, std::uint32_t rank)
    {
      encoding.Arrays.Records[rank] = Record::Pack(thresholds[rank], encoder.Sign(place));
      encoder.ForEachIsovertex(place, [&](std::uint8_t) { ++next[i + 1].Isovertices; });
      next[i + 1].InsideValues += encoder.IsInside(place) ? 1 : 0;
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
  forEachDiamond(
    [&](std::int64_t i, const Place& place, std::uint32_t /*rank*/)
    {
      encoder.ForEachIsovertex(place,
        [&](std::uint8_t coefficient)
        { encoding.Arrays.Isovertices[next[i].Isovertices++] = coefficient; });
      if (encoder.IsInside(place))
      {
        insideValues[next[i].InsideValues++] = encoder.Value(place);
      }
    });
  encoding.InsideValues = std::move(insideValues);
}

}

Encoding Encode(const EncodingHeader& header, const Grid& grid, const AnySamples& samples,
  const DiamondSet& set, const std::vector<ErrorCode::Type>& thresholds,
  const ParallelFor& parallelFor)
{
  Encoding encoding;
  encoding.Header = header;
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
  std::visit([&](const auto& view)
    { EncodeDiamonds(header, grid, view, set, thresholds, parallelFor, encoding); },
    samples);
  return encoding;
}

}
