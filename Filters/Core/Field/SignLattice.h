// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SignLattice_h
#define isodiamond_SignLattice_h

#include "Field/Isoregion.h"
#include "Field/Peers.h"

#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The signs of all samples, a bit for each surface, for every scale a lattice of its own: bit
 * (x, y, z) of scale s says whether the sample at (x, y, z) << s lies above the surface. It is the
 * one pass over the volume that building from samples needs for classification; all scales
 * together take 1/7 of a byte a sample and surface.
 *
 * Where small pieces are removed, these are the signs of what is left, and they can be others than
 * the samples'; SmallPieces.h.
 */
class SignLattice
{
public:
  /** @param minimumPieceSize pieces of fewer samples are removed, of each surface by itself */
  SignLattice(const Grid& grid, const AnySamples& samples, const Isoregion& region,
    const ParallelFor& parallelFor, std::int64_t minimumPieceSize = 0);

  ///@{
  /** Of a volume that comes in slabs: all are to be added, then it is to be completed. */
  SignLattice(const Grid& grid, const Isoregion& region);
  void Add(const SampleSlab& slab, const ParallelFor& parallelFor);
  /** What peers have added. */
  void Merge(Peers& peers);
  void Complete(const ParallelFor& parallelFor, std::int64_t minimumPieceSize = 0);
  ///@}

  int SurfaceCount() const { return this->Surfaces; }

  /** How many pieces were removed; if none, the signs are the samples'. */
  std::int64_t RemovedPieces() const { return this->Removed; }

  /** Sign of a sampled position. */
  int Sign(int scale, const Point& position) const
  {
    const Level& level = this->Levels[scale];
    int sign = 0;
    for (int surface = 0; surface < this->Surfaces; ++surface)
    {
      const std::uint64_t word =
        level.Bits[surface][level.RowIndex(position[1], position[2]) + (position[0] >> 6)];
      sign += static_cast<int>((word >> (position[0] & 63)) & 1U);
    }
    return sign;
  }

  /**
   * Ten positions of a row, x0 - 1 .. x0 + 8 (bit 0 is x0 - 1; x0 a multiple of 8): which lie above
   * each surface, and which are sampled. Positions without a sample lie above none.
   */
  struct Row
  {
    std::array<std::uint32_t, 2> Above{};
    std::uint32_t Sampled = 0;

    /** Which lie on or below a surface. */
    std::uint32_t Below(int surface) const { return this->Sampled & ~this->Above[surface]; }
  };
  Row Load(int scale, int x0, int y, int z) const;

private:
  struct Level
  {
    std::array<int, 3> Count{};
    std::int64_t Words = 0;                         ///< words a row
    std::array<std::vector<std::uint64_t>, 2> Bits; ///< by surface

    std::int64_t RowIndex(int y, int z) const
    {
      return (std::int64_t{ z } * this->Count[1] + y) * this->Words;
    }
  };

  void PackSamples(const SampleSlab& slab, int surface, const ParallelFor& parallelFor);
  static void Coarsen(const Level& fine, int surface, Level& level);

  Isoregion Region;
  int Surfaces = 1;
  std::int64_t Removed = 0;
  std::vector<Level> Levels;
};

}

#endif
