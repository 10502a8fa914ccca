// SPDX-License-Identifier: BSD-3-Clause
#include "Field/SignLattice.h"

#include "Field/SmallPieces.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Threshold one row of samples into bits. */
template <typename T, typename IsAbove>
void PackRow(const T* row, int count, const IsAbove& isAbove, std::uint64_t* words)
{
  for (int begin = 0; begin < count; begin += 64)
  {
    const int end = std::min(begin + 64, count);
    std::uint64_t word = 0;
    for (int x = begin; x < end; ++x)
    {
      word |= static_cast<std::uint64_t>(isAbove(static_cast<double>(row[x]))) << (x - begin);
    }
    words[begin / 64] = word;
  }
}

/** The even bits of a word, packed into its lower half. */
std::uint64_t EvenBits(std::uint64_t word)
{
  word &= 0x5555555555555555ULL;
  word = (word | (word >> 1)) & 0x3333333333333333ULL;
  word = (word | (word >> 2)) & 0x0f0f0f0f0f0f0f0fULL;
  word = (word | (word >> 4)) & 0x00ff00ff00ff00ffULL;
  word = (word | (word >> 8)) & 0x0000ffff0000ffffULL;
  return (word | (word >> 16)) & 0x00000000ffffffffULL;
}

}

SignLattice::SignLattice(const Grid& grid, const AnySamples& samples, const Isoregion& region,
  const ParallelFor& parallelFor, std::int64_t minimumPieceSize)
  : SignLattice(grid, region)
{
  this->Add({ samples, 0 }, parallelFor);
  this->Complete(parallelFor, minimumPieceSize);
}

SignLattice::SignLattice(const Grid& grid, const Isoregion& region)
  : Region(region)
  , Surfaces(region.SurfaceCount())
  , Levels(grid.Depth() + 1)
{
  for (int scale = 0; scale <= grid.Depth(); ++scale)
  {
    Level& level = this->Levels[scale];
    level.Count = grid.SampledPositions(scale);
    level.Words = (level.Count[0] + 63) / 64;
    for (int surface = 0; surface < this->Surfaces; ++surface)
    {
      level.Bits[surface].resize(level.Words * level.Count[1] * level.Count[2]);
    }
  }
}

void SignLattice::Add(const SampleSlab& slab, const ParallelFor& parallelFor)
{
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    this->PackSamples(slab, surface, parallelFor);
  }
}

void SignLattice::Merge(Peers& peers)
{
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    peers.Or(this->Levels[0].Bits[surface]);
  }
}

void SignLattice::Complete(const ParallelFor& parallelFor, std::int64_t minimumPieceSize)
{
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    if (minimumPieceSize > 1)
    {
      Level& finest = this->Levels[0];
      this->Removed += RemoveSmallPieces(
        { finest.Bits[surface].data(), finest.Count, finest.Words }, minimumPieceSize, parallelFor);
    }
    for (std::size_t scale = 1; scale < this->Levels.size(); ++scale)
    {
      Coarsen(this->Levels[scale - 1], surface, this->Levels[scale]);
    }
  }
}

/** The samples' own scale: a threshold. */
void SignLattice::PackSamples(const SampleSlab& slab, int surface, const ParallelFor& parallelFor)
{
  Level& finest = this->Levels[0];
  const double isovalue = this->Region.Isovalue(surface);
  const bool closed = this->Region.IsAbove(surface, isovalue); // its own rule for equal values
  const std::int64_t rows = std::int64_t{ 1 } * finest.Count[1] * (slab.End() - slab.First);
  std::uint64_t* const words = finest.Bits[surface].data() + finest.RowIndex(0, slab.First);
  const auto pack = [&](const auto& view, const auto& isAbove)
  {
    parallelFor(rows, 256,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t row = begin; row < end; ++row)
        {
          PackRow(view.Pointer() + row * finest.Count[0], finest.Count[0], isAbove,
            words + row * finest.Words);
        }
      });
  };
  std::visit(
    [&](const auto& view)
    {
      if (closed)
      {
        pack(view, [isovalue](double value) { return value >= isovalue; });
      }
      else
      {
        pack(view, [isovalue](double value) { return value > isovalue; });
      }
    },
    slab.Samples);
}

/** Every second bit of every second row of every second slice. */
void SignLattice::Coarsen(const Level& fine, int surface, Level& level)
{
  for (int z = 0; z < level.Count[2]; ++z)
  {
    for (int y = 0; y < level.Count[1]; ++y)
    {
      const std::uint64_t* from = fine.Bits[surface].data() + fine.RowIndex(2 * y, 2 * z);
      std::uint64_t* to = level.Bits[surface].data() + level.RowIndex(y, z);
      for (std::int64_t word = 0; word < fine.Words; ++word)
      {
        to[word / 2] |= EvenBits(from[word]) << (32 * (word % 2));
      }
    }
  }
}

SignLattice::Row SignLattice::Load(int scale, int x0, int y, int z) const
{
  const Level& level = this->Levels[scale];
  Row row;
  if (y < 0 || z < 0 || y >= level.Count[1] || z >= level.Count[2] || x0 > level.Count[0])
  {
    return row;
  }
  row.Sampled = (1U << std::min(10, level.Count[0] - x0 + 1)) - (x0 == 0 ? 2U : 1U);
  const std::int64_t word = x0 >> 6; // has the eight; one before or after may lie in another
  const int bit = x0 & 63;
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    const std::uint64_t* const words = level.Bits[surface].data() + level.RowIndex(y, z);
    const std::uint64_t from = word < level.Words ? words[word] >> bit << 1 : 0; // from x0 on
    const bool isNext = bit == 56 && word + 1 < level.Words;
    const std::uint64_t after = isNext ? words[word + 1] << 9 : 0;
    const std::uint64_t before = x0 > 0 ? words[(x0 - 1) >> 6] >> ((x0 - 1) & 63) & 1U : 0;
    row.Above[surface] = static_cast<std::uint32_t>(before | from | after) & row.Sampled;
  }
  return row;
}

}
