// SPDX-License-Identifier: BSD-3-Clause
#include "Field/SignLattice.h"

#include "Field/SmallPieces.h"

#include <algorithm>

namespace isodiamond
{
namespace
{

/** Thresholds one row of samples into bits. */
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
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    for (int scale = 0; scale <= grid.Depth(); ++scale)
    {
      this->Levels[scale][surface] = BitTiles(grid.SampledPositions(scale));
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
    this->Levels[0][surface].Or(peers);
  }
}

void SignLattice::Complete(const ParallelFor& parallelFor, std::int64_t minimumPieceSize)
{
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    BitTiles& finest = this->Levels[0][surface];
    if (minimumPieceSize > 1)
    {
      std::vector<std::uint64_t> rows = finest.AllRows();
      this->Removed += RemoveSmallPieces(
        { rows.data(), finest.Count(), finest.WordCount() }, minimumPieceSize, parallelFor);
      finest = BitTiles(finest.Count());
      finest.Set(0, finest.Count()[2], rows, parallelFor);
    }
    finest.Compress();
    for (std::size_t scale = 1; scale < this->Levels.size(); ++scale)
    {
      BitTiles& level = this->Levels[scale][surface];
      level = this->Levels[scale - 1][surface].Coarser(level.Count());
    }
  }
}

/** Packs the samples' own scale: by thresholding. */
void SignLattice::PackSamples(const SampleSlab& slab, int surface, const ParallelFor& parallelFor)
{
  BitTiles& finest = this->Levels[0][surface];
  const std::array<int, 3>& count = finest.Count();
  const double isovalue = this->Region.Isovalue(surface);
  const bool closed = this->Region.IsAbove(surface, isovalue); // its own rule for equal values
  const int slices = slab.End() - slab.First;
  const std::int64_t rows = std::int64_t{ 1 } * count[1] * slices;
  std::vector<std::uint64_t> words(rows * finest.WordCount());
  const auto pack = [&](const auto& view, const auto& isAbove)
  {
    parallelFor(rows, 256,
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t row = begin; row < end; ++row)
        {
          PackRow(view.Pointer() + row * count[0], count[0], isAbove,
            words.data() + row * finest.WordCount());
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
  finest.Set(slab.First, slices, words, parallelFor);
}

SignLattice::Row SignLattice::Load(int scale, int x0, int y, int z) const
{
  const std::array<int, 3>& count = this->Levels[scale][0].Count();
  Row row;
  if (y < 0 || z < 0 || y >= count[1] || z >= count[2] || x0 > count[0])
  {
    return row;
  }
  row.Sampled = (1U << std::min(10, count[0] - x0 + 1)) - (x0 == 0 ? 2U : 1U);
  const std::int64_t word = x0 >> 6; // holds the eight; the bit before or after may be in another
  const int bit = x0 & 63;
  for (int surface = 0; surface < this->Surfaces; ++surface)
  {
    const BitTiles& bits = this->Levels[scale][surface];
    const BitTiles::Row words = bits.RowAt(y, z);
    const std::uint64_t from = word < bits.WordCount() ? words[word] >> bit << 1 : 0; // from x0 on
    const bool isNext = bit == 56 && word + 1 < bits.WordCount();
    const std::uint64_t after = isNext ? words[word + 1] << 9 : 0;
    const std::uint64_t before = x0 > 0 ? words[(x0 - 1) >> 6] >> ((x0 - 1) & 63) & 1U : 0;
    row.Above[surface] = static_cast<std::uint32_t>(before | from | after) & row.Sampled;
  }
  return row;
}

}
