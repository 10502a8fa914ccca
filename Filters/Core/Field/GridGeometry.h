// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_GridGeometry_h
#define isodiamond_GridGeometry_h

#include "Field/AffineMap.h"
#include "Field/Vector.h"
#include "Lattice/Lattice.h"

#include <array>
#include <utility>
#include <variant>
#include <vector>

namespace isodiamond
{

/** A coordinate for every sample on each axis: of a rectilinear grid. */
using AxisCoordinates = std::array<std::vector<double>, 3>;

/** A position for every sample, x fastest: of a curvilinear grid. It owns nothing. */
struct SamplePositions
{
  std::variant<const float*, const double*> Coordinates; ///< three a sample
  std::array<int, 3> Dimensions{};
};

/**
 * Where the samples of a grid are in the world: by an affine map, by coordinates on each axis, or
 * by a position for each.
 *
 * Between samples positions are interpolated trilinearly, so a mesh without cracks in index space
 * has none in the world; beyond the grid they are extrapolated from the outermost cells. The
 * distances of WorldLengths.h need an affine map, or coordinates on each axis.
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
  explicit GridGeometry(const SamplePositions& positions, int shift = 0)
    : Map(positions)
    , Shift(shift)
  {
  }

  ///@{
  /** The affine map, or the coordinates on each axis, if it is one or these. */
  const AffineMap* Affine() const { return std::get_if<AffineMap>(&this->Map); }
  const AxisCoordinates* Axes() const { return std::get_if<AxisCoordinates>(&this->Map); }
  ///@}

  /** The world position of one in index space. */
  Vector operator()(const Vector& index) const;

  /** The derivatives of the position by the index on each axis, at a sample: central differences,
   *  one-sided at the grid's ends. */
  std::array<Vector, 3> DerivativesAt(const Point& sample) const;

  ///@{
  /** The dimensions of the grid without padding, the position of a sample of it, and the layers of
   *  padding before the first; not of an affine map. */
  std::array<int, 3> Dimensions() const;
  Vector SampleAt(const Point& sample) const;
  int Padding() const { return this->Shift; }
  ///@}

  /** The least distance of two samples next to each other along an axis; 0 of a curvilinear grid,
   *  where nothing is asked of it. */
  double SmallestStep() const;

  /** Whether orientation turns around from index space to the world; of a curvilinear grid that of
   *  its middle. */
  bool Mirrors() const;

private:
  std::variant<AffineMap, AxisCoordinates, SamplePositions> Map;
  int Shift = 0;
};

}

#endif
