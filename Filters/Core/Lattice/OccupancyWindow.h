// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_OccupancyWindow_h
#define isodiamond_OccupancyWindow_h

#include "Lattice/DiamondSet.h"

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace isodiamond
{

/**
 * Which lattice points of a cube are centres of a scale's diamonds, one byte each.
 *
 * A pass that needs many neighbours of every diamond of a brick finds them at fixed distances in
 * the array, without a search or a branch.
 */
template <int Width>
class OccupancyWindow
{
public:
  /** An empty window. */
  OccupancyWindow() = default;

  OccupancyWindow(const BrickLevel& level, const Point& first) { this->Fill(level, first); }

  /** To be called once. @param first position of the window */
  void Fill(const BrickLevel& level, const Point& first)
  {
    this->First = first;
    const Point last = first + Point{ Width - 1, Width - 1, Width - 1 };
    level.ForEachBrickBetween(first, last,
      [&](std::int64_t index, const Point& origin)
      {
        ForEachWordBetween(level.Bricks[index].Occupancy, origin, first, last,
          [&](int z, std::uint64_t bits)
          {
            const int start = this->IndexAt(origin + Point{ 0, 0, z });
            ForEachBit(bits,
              [&](int bit)
              {
                const int index = start + (bit & 7) + Width * (bit >> 3);
                assert(Holds(index));
                this->Bytes[index] = 1;
              });
          });
      });
  }

  /** Which of the lattice points at given distances from a position have a diamond, as a mask. */
  template <std::size_t Count>
  std::uint32_t Around(
    const Point& position, const std::array<std::int16_t, Count>& distances) const
  {
    const int index = this->IndexAt(position);
    const std::uint8_t* centre = this->Bytes.data() + index;
    std::uint32_t mask = 0;
    for (std::size_t i = 0; i < Count; ++i)
    {
      assert(Holds(index + distances[i]));
      mask |= static_cast<std::uint32_t>(centre[distances[i]]) << i;
    }
    return mask;
  }

  /** @param offset of a lattice point from a position */
  static constexpr int Distance(const Point& offset)
  {
    return offset[0] + Width * (offset[1] + Width * offset[2]);
  }

private:
  /** Also for the start of a row, which may lie before the window. */
  int IndexAt(const Point& position) const { return Distance(position) - Distance(this->First); }

  static bool Holds(int index) { return index >= 0 && index < Width * Width * Width; }

  Point First{};
  std::array<std::uint8_t, std::size_t{ Width } * Width * Width> Bytes{};
};

/** Distances from a diamond to its vertices in a cube of this width, by parity. */
template <int Width>
constexpr std::array<std::array<std::int16_t, MaximumVertices>, 8> MakeVertexDistances()
{
  std::array<std::array<std::int16_t, MaximumVertices>, 8> distances{};
  for (std::size_t parity = 1; parity < distances.size(); ++parity)
  {
    const ParityTable& shape = tables::Parities[parity];
    for (int i = 0; i < shape.VertexCount; ++i)
    {
      distances[parity][i] =
        static_cast<std::int16_t>(OccupancyWindow<Width>::Distance(shape.Offsets[i]));
    }
  }
  return distances;
}

}

#endif
