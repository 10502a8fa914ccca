// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SignLattice_h
#define isodiamond_SignLattice_h

#include "Field/BitTiles.h"
#include "Field/Isoregion.h"
#include "Field/Peers.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * The signs of all samples, one bit for each surface, with a lattice of its own for every scale:
 * bit (x, y, z) of scale s says whether the sample at (x, y, z) << s lies above the surface.
 * Filling it is the one pass over the volume that building from samples needs for classification;
 * all scales together take 1/7 of a byte per sample and surface, where the surface is: see
 * BitTiles.h.
 *
 * Where small pieces are removed, these are the signs of what is left, and they can differ from the
 * samples'; SmallPieces.h.
 */
class SignLattice
{
public:
  /** @param minimumPieceSize pieces of fewer samples are removed, for each surface separately */
  SignLattice(const Grid& grid, const AnySamples& samples, const Isoregion& region,
    const ParallelFor& parallelFor, std::int64_t minimumPieceSize = 0);

  ///@{
  /** For a volume that comes in slabs: all have to be added, then it has to be completed. */
  SignLattice(const Grid& grid, const Isoregion& region);
  void Add(const SampleSlab& slab, const ParallelFor& parallelFor);
  /** Adds what peers have added. */
  void Merge(Peers& peers);
  void Complete(const ParallelFor& parallelFor, std::int64_t minimumPieceSize = 0);
  ///@}

  int SurfaceCount() const { return this->Surfaces; }

  /** How many pieces were removed; if none, the signs are the samples'. */
  std::int64_t RemovedPieces() const { return this->Removed; }

  /** Sign of a sampled position. */
  int Sign(int scale, const Point& position) const
  {
    int sign = 0;
    for (int surface = 0; surface < this->Surfaces; ++surface)
    {
      const std::uint64_t word =
        this->Levels[scale][surface].RowAt(position[1], position[2])[position[0] >> 6];
      sign += static_cast<int>((word >> (position[0] & 63)) & 1U);
    }
    return sign;
  }

  /** Whether no surface passes between the samples of a brick and of one layer around it, as far as
   *  that can be told without looking at each. */
  bool AreEqualAround(int scale, const Point& origin) const
  {
    const Point first = origin + Point{ -1, -1, -1 };
    const Point last = origin + Point{ 8, 8, 8 };
    const std::array<BitTiles, 2>& level = this->Levels[scale];
    return level[0].AreEqual(first, last) &&
      (this->Surfaces == 1 || level[1].AreEqual(first, last));
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
  void PackSamples(const SampleSlab& slab, int surface, const ParallelFor& parallelFor);

  Isoregion Region;
  int Surfaces = 1;
  std::int64_t Removed = 0;
  std::vector<std::array<BitTiles, 2>> Levels; ///< by surface
};

}

#endif
