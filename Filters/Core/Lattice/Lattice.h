// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Lattice_h
#define isodiamond_Lattice_h

#include <array>
#include <cstdint>

/**
 * @file Lattice.h
 * The nested lattice whose vertices are the diamonds, and the grid of samples that lies in it.
 *
 * There are two concepts here. The *lattice* is the set of integer points of the base cube
 * [0, 2^N]^3; every one of them but the cube's 8 corners is the central vertex of exactly one
 * diamond, so a diamond needs no other name than its point. The *grid* is the box of samples
 * [0, X] x [0, Y] x [0, Z] that the cube covers; it is all the data there is. Tetrahedra without
 * a point strictly inside the grid's box do not exist here, just like those outside the cube.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", TVCG 2010, section 3.
 */
namespace isodiamond
{

/** A lattice point, or an offset between two of them; x, y, z. */
using Point = std::array<std::int32_t, 3>;

inline constexpr Point operator+(const Point& a, const Point& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

inline constexpr Point operator*(std::int32_t factor, const Point& a)
{
  return { factor * a[0], factor * a[1], factor * a[2] };
}

/** A point of the lattice as a number, with 21 bits for each coordinate: see Grid::MaximumDepth. */
inline constexpr std::uint64_t PackedPoint(const Point& point)
{
  return static_cast<std::uint64_t>(point[0]) | static_cast<std::uint64_t>(point[1]) << 21 |
    static_cast<std::uint64_t>(point[2]) << 42;
}

/** Parity pattern of a point: bit i is set where coordinate i is odd. */
inline constexpr int Parity(const Point& position)
{
  return (position[0] & 1) | ((position[1] & 1) << 1) | ((position[2] & 1) << 2);
}

/**
 * The grid of samples inside the smallest base cube that covers it.
 *
 * A diamond of scale s sits at `position << s`; its vertices at `(position + offset) << s` with
 * offsets in {-1, 0, 1}^3 (see DiamondTables.h). Positions run over a box per scale; it reaches
 * one layer past the samples where they do not end on the scale's own lattice, because diamonds
 * centred outside can still hold tetrahedra that reach into the grid.
 */
class Grid
{
public:
  /** Largest N supported: coordinates stay far from the limits of 32-bit arithmetic. */
  static constexpr int MaximumDepth = 20;

  Grid() = default;

  /** @param dimensions samples per axis, each at least 2 and at most 2^MaximumDepth + 1. */
  explicit Grid(const std::array<int, 3>& dimensions);

  /** Samples per axis. */
  const std::array<int, 3>& Dimensions() const { return this->Dims; }

  /** N: the base cube is [0, 2^N]^3; at least 1. */
  int Depth() const { return this->N; }

  /** Coordinate of the last sample on an axis. */
  int Last(int axis) const { return this->Dims[axis] - 1; }

  /** Number of positions of one scale per axis, those past the samples included. */
  std::array<int, 3> Positions(int scale) const
  {
    const int below = (1 << scale) - 1; // rounds up
    return { ((this->Last(0) + below) >> scale) + 1, ((this->Last(1) + below) >> scale) + 1,
      ((this->Last(2) + below) >> scale) + 1 };
  }

  /** Number of positions of one scale that hold a sample, per axis. */
  std::array<int, 3> SampledPositions(int scale) const;

  /** The scale of a lattice point: the least number of trailing zeros, N for the corners. */
  int Scale(const Point& point) const;

  /** Whether the point has a sample. */
  bool IsSampled(const Point& point) const
  {
    return point[0] >= 0 && point[1] >= 0 && point[2] >= 0 && point[0] < this->Dims[0] &&
      point[1] < this->Dims[1] && point[2] < this->Dims[2];
  }

  /** Whether a position of a scale can hold a diamond with a tetrahedron in the grid. */
  bool IsValid(const Point& position, int scale) const
  {
    const std::array<int, 3> count = this->Positions(scale);
    return position[0] >= 0 && position[1] >= 0 && position[2] >= 0 && position[0] < count[0] &&
      position[1] < count[1] && position[2] < count[2];
  }

  /**
   * Whether one of the diamond's tetrahedra in the grid has a vertex without a sample. Such a
   * diamond has no interpolant and is always subdivided when it carries or leads to the surface.
   */
  bool SticksOut(const Point& position, int scale) const;

private:
  std::array<int, 3> Dims = { 2, 2, 2 };
  int N = 1;
};

}

#endif
