// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MapBounds_h
#define isodiamond_MapBounds_h

#include "Field/PeerPortion.h"
#include "Hierarchy/ErrorCode.h"
#include "Lattice/DiamondSet.h"

#include <array>
#include <cstdint>
#include <vector>

namespace isodiamond
{

/**
 * Bounds of the way back that the way forth finds as it goes, for each tetrahedron of each diamond
 * above scale 0: for the many of scale 0 a map of the whole domain tells as much (DomainMap.h).
 *
 * Let a map take every isovertex of full resolution in a tetrahedron to a point of the patch: one
 * on an edge to the patch's corner on it; one on a triangle to a point of the patch's side in it;
 * one inside to any. Linear over the triangles of full resolution, it takes the border of their
 * surface to that of the patch, covering each side of the latter an odd number of times. So all of
 * a flat patch is covered, and no point of it is farther from the surface than the farthest
 * isovertex is from its image. For a patch of two triangles, which can be bent, the bend is added.
 *
 * There is no bound where an isovertex lies on an edge that the patch does not cross, or on a
 * triangle where it has no side; nor where nobody has looked at one.
 *
 * Peers that each have some of the isovertices find bounds for these: the greatest counts.
 */
class MapBounds
{
public:
  /** Where nobody has looked. No bound has this code: the least is ErrorCode::Least. */
  static constexpr ErrorCode::Type None = 0;

  /** Of one diamond and one surface, by tetrahedron, numbered as by ForEachParentHalf(). */
  using OfDiamond = std::array<ErrorCode::Type, 8>;
  static constexpr OfDiamond NoneOfDiamond{};

  /** No bounds, of no diamonds: none are wanted. */
  MapBounds() = default;

  /** No bounds yet, for the diamonds above scale 0. */
  MapBounds(const DiamondSet& diamonds, int surfaceCount)
  {
    const std::vector<Brick>& last = diamonds.Level(0).Bricks; // in the order of ranks
    const std::size_t count = last.empty() ? diamonds.Size() : last.front().First;
    for (int surface = 0; surface < surfaceCount; ++surface)
    {
      this->Codes[surface].assign(count, NoneOfDiamond);
    }
  }

  bool AreWanted() const { return !this->Codes[0].empty(); }

  /** @param rank of the diamond */
  const OfDiamond& Of(int surface, std::uint32_t rank) const
  {
    return rank < this->Codes[surface].size() ? this->Codes[surface][rank] : NoneOfDiamond;
  }

  /** @param rank of a diamond above scale 0 @param code ErrorCode::Always if there is no bound */
  void Set(int surface, std::uint32_t rank, int tetrahedron, ErrorCode::Type code)
  {
    this->Codes[surface][rank][tetrahedron] = code;
  }

  ///@{
  /** Puts together the bounds that peers have found, for the same diamonds or for portions. */
  void Merge(Peers& peers)
  {
    for (std::vector<OfDiamond>& codes : this->Codes)
    {
      static_assert(sizeof(OfDiamond) == 8 * sizeof(ErrorCode::Type), "codes in a row");
      if (!codes.empty())
      {
        peers.Max(codes.data()->data(), static_cast<std::int64_t>(8 * codes.size()));
      }
    }
  }
  void Merge(const PeerPortion& portion)
  {
    for (std::vector<OfDiamond>& codes : this->Codes)
    {
      if (!codes.empty())
      {
        portion.Max(codes, 1);
      }
    }
  }
  ///@}

private:
  std::array<std::vector<OfDiamond>, 2> Codes;
};

}

#endif
