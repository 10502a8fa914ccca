// SPDX-License-Identifier: BSD-3-Clause
#include "Encoder.h"

#include <limits>
#include <stdexcept>

namespace isodiamond
{
namespace
{

/** A brick with its scale: all bricks of a set in one list, so that one loop covers them. */
struct ScaledBrick
{
  int Scale = 0;
  const Brick* Bricks = nullptr;
};

std::vector<ScaledBrick> AllBricks(const DiamondSet& set)
{
  std::vector<ScaledBrick> all;
  for (int scale = set.ScaleCount() - 1; scale >= 0; --scale)
  {
    for (const Brick& brick : set.Level(scale).Bricks)
    {
      all.push_back({ scale, &brick });
    }
  }
  return all;
}

template <typename T>
class BrickEncoder
{
public:
  BrickEncoder(const EncodingHeader& header, const Grid& grid, const SampleView<T>& samples)
    : Isovalue(header.Isovalue)
    , Domain(grid)
    , Samples(samples)
  {
  }

  /** Calls edge(index, centre value, vertex value) for every subdivision edge with a crossing. */
  template <typename Body>
  void ForEachIsovertex(const Place& place, Body&& body) const
  {
    const Point centre = Centre(place);
    if (!this->Domain.IsSampled(centre))
    {
      return;
    }
    const double value = this->Samples(centre);
    const int sign = SignOf(value, this->Isovalue);
    const ParityTable& shape = tables::Parities[Parity(place.Position)];
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      const Point vertex = centre + (1 << place.Scale) * shape.Offsets[i];
      if (this->Domain.IsSampled(vertex))
      {
        const double other = this->Samples(vertex);
        if (SignOf(other, this->Isovalue) != sign)
        {
          body(value, other);
        }
      }
    }
  }

  int Sign(const Place& place) const
  {
    const Point centre = Centre(place);
    return this->Domain.IsSampled(centre) ? SignOf(this->Samples(centre), this->Isovalue) : 0;
  }

private:
  double Isovalue;
  const Grid& Domain;
  const SampleView<T>& Samples;
};

template <typename T>
void EncodeDiamonds(const EncodingHeader& header, const Grid& grid, const SampleView<T>& samples,
  const DiamondSet& set, const std::vector<ErrorCode::Type>& thresholds,
  const ParallelFor& parallelFor, Encoding& encoding)
{
  const BrickEncoder<T> encoder(header, grid, samples);
  const std::vector<ScaledBrick> bricks = AllBricks(set);
  const std::int64_t brickCount = static_cast<std::int64_t>(bricks.size());

  // Count: records, and the isovertices of every brick.
  std::vector<std::int64_t> first(brickCount + 1, 0);
  encoding.Arrays.Records.resize(set.Size());
  parallelFor(brickCount, 16,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        set.ForEachInBrick(bricks[i].Scale, *bricks[i].Bricks,
          [&](const Place& place, std::uint32_t rank)
          {
            encoding.Arrays.Records[rank] = Record::Pack(thresholds[rank], encoder.Sign(place));
            encoder.ForEachIsovertex(place, [&](double, double) { ++first[i + 1]; });
          });
      }
    });

  // Prefix sum.
  for (std::int64_t i = 0; i < brickCount; ++i)
  {
    first[i + 1] += first[i];
  }
  if (first[brickCount] > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::length_error("more than 2^32 - 1 isovertices");
  }

  // Write.
  encoding.Arrays.Isovertices.resize(first[brickCount]);
  parallelFor(brickCount, 16,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        std::uint8_t* next = encoding.Arrays.Isovertices.data() + first[i];
        set.ForEachInBrick(bricks[i].Scale, *bricks[i].Bricks,
          [&](const Place& place, std::uint32_t /*rank*/)
          {
            encoder.ForEachIsovertex(place,
              [&](double centre, double vertex)
              { *next++ = IsovertexCoefficient(centre, vertex, header.Isovalue); });
          });
      }
    });
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
