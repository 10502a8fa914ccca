// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_GridGeometry_h
#define isodiamond_GridGeometry_h

#include "Field/AffineMap.h"
#include "Field/CellBounds.h"
#include "Field/Vector.h"
#include "Lattice/Lattice.h"

#include <array>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace isodiamond
{

/** The coordinates of a rectilinear grid: one for every sample on each axis. */
using AxisCoordinates = std::array<std::vector<double>, 3>;

/** The positions of a curvilinear grid: one for every sample, x fastest. It owns nothing. */
struct SamplePositions
{
  std::variant<const float*, const double*> Coordinates; ///< three per sample
  std::array<int, 3> Dimensions{};
};

/**
 * Where the samples of a grid are in the world: by an affine map, by coordinates on each axis, or
 * by a position for each.
 *
 * Between samples positions are interpolated trilinearly, so a mesh without cracks in index space
 * has none in the world; beyond the grid they are extrapolated from the outermost cells.
 */
class GridGeometry
{
public:
  GridGeometry(const AffineMap& map) // NOLINT(google-explicit-constructor): the usual case
    : Map(map)
  {
  }
  /** @param shift index of the grid's first sample: 1 behind a layer of padding */
  explicit GridGeometry(AxisCoordinates coordinates, int shift = 0)
    : Map(std::move(coordinates))
    , Shift(shift)
  {
  }
  explicit GridGeometry(const SamplePositions& positions, int shift = 0);

  ///@{
  /** The affine map, the coordinates on each axis, or the samples' positions: that by which the
   *  geometry is given. */
  const AffineMap* Affine() const { return std::get_if<AffineMap>(&this->Map); }
  const AxisCoordinates* Axes() const { return std::get_if<AxisCoordinates>(&this->Map); }
  const SamplePositions* Positions() const { return std::get_if<SamplePositions>(&this->Map); }
  ///@}

  /** The world position of a position in index space. */
  Vector operator()(const Vector& index) const;

  /** The position in index space of one in the world; not for a curvilinear grid. Not a number
   *  where samples coincide. */
  Vector IndexAt(const Vector& position) const;

  /** The derivatives of the position with respect to the index on each axis, at a sample: central
   *  differences, one-sided at the grid's ends. */
  std::array<Vector, 3> DerivativesAt(const Point& sample) const;

  ///@{
  /** The dimensions of the grid without padding, the position of one of its samples, and the layers
   *  of padding around them; not for an affine map. */
  std::array<int, 3> Dimensions() const;
  Vector SampleAt(const Point& sample) const;
  int Padding() const { return this->Shift; }
  /** Of a sample or, from its outermost cell, of a point of the padding. Both count. */
  Vector PaddedAt(const Point& point) const;
  ///@}

  /** The least distance between neighbouring samples along an axis. For a curvilinear grid, in
   *  which samples may coincide, about the mean one, on the axis where that is least; 0 if it is
   *  not finite. */
  double SmallestStep() const;

  /** Where the cells of a curvilinear grid are, padding included; made when first asked for, and
   *  shared with all copies. @pre all positions are finite */
  const CellBounds& CellsInWorld() const;

  /** Whether floats tell places apart that are a 256th of the smallest step from each other, as
   *  isovertices can be: floats have to be closer, as in a turned grid no coordinate may differ by
   *  as much. For a curvilinear grid, whether its own positions are floats.
   *  @param last the index of the last sample, padding included */
  bool FitsFloats(const Point& last) const;

  /** Whether orientation is reversed from index space to the world; for a curvilinear grid, at its
   *  middle. */
  bool Mirrors() const;

private:
  /** What is known of a curvilinear grid's cells. */
  struct OfCells;

  std::variant<AffineMap, AxisCoordinates, SamplePositions> Map;
  int Shift = 0;
  double MeanStep = 0.0;          ///< see SmallestStep(); of a curvilinear grid
  std::shared_ptr<OfCells> Cells; ///< likewise
};

}

#endif
