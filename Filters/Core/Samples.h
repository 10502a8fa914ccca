// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Samples_h
#define isodiamond_Samples_h

#include "Lattice.h"

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <variant>

namespace isodiamond
{

/**
 * A view of a volume of samples: dimensions and a pointer, x fastest. It owns nothing.
 *
 * Values are compared and interpolated in double precision: 64-bit integers beyond 2^53 are
 * rounded.
 */
template <typename T>
class SampleView
{
public:
  using Value = T;

  SampleView() = default;
  SampleView(const T* data, const std::array<int, 3>& dimensions)
    : Data(data)
    , Dims(dimensions)
  {
  }

  const T* Pointer() const { return this->Data; }
  const std::array<int, 3>& Dimensions() const { return this->Dims; }
  std::int64_t Size() const
  {
    return std::int64_t{ 1 } * this->Dims[0] * this->Dims[1] * this->Dims[2];
  }

  std::int64_t Index(const Point& point) const
  {
    return (std::int64_t{ point[2] } * this->Dims[1] + point[1]) * this->Dims[0] + point[0];
  }

  double operator()(const Point& point) const
  {
    return static_cast<double>(this->Data[this->Index(point)]);
  }

private:
  const T* Data = nullptr;
  std::array<int, 3> Dims{};
};

/** A view of samples of any of the scalar types. */
using AnySamples = std::variant<SampleView<float>, SampleView<double>, SampleView<std::int8_t>,
  SampleView<std::uint8_t>, SampleView<std::int16_t>, SampleView<std::uint16_t>,
  SampleView<std::int32_t>, SampleView<std::uint32_t>, SampleView<std::int64_t>,
  SampleView<std::uint64_t>>;

/** The sample at a lattice point of the grid. */
inline double SampleAt(const AnySamples& samples, const Point& point)
{
  return std::visit([&](const auto& view) { return view(point); }, samples);
}

/** Smallest and largest finite sample; {0, 0} if there is none. */
struct ValueRange
{
  double Minimum = 0.0;
  double Maximum = 0.0;

  /** Whether values on both sides of the isovalue occur: some F > isovalue, some not. */
  bool Crosses(double isovalue) const
  {
    return this->Maximum > isovalue && !(this->Minimum > isovalue);
  }
};

/** The range of all finite samples. */
ValueRange FiniteRange(const AnySamples& samples);

/**
 * The sign of a value for an isovalue: 1 above it, 0 on or below it. NaN counts as below.
 * (The paper's formula in section 2.1 is misprinted; its text says this.)
 */
inline int SignOf(double value, double isovalue)
{
  return value > isovalue ? 1 : 0;
}

/**
 * The coefficient of an isovertex on the edge from a diamond's centre to one of its vertices: the
 * position of the linear crossing in 1/256 of the edge, from the centre. Kept in 1..255 so that
 * isovertices never coincide with lattice vertices; 128 where an end is not finite.
 */
inline std::uint8_t IsovertexCoefficient(double centre, double vertex, double isovalue)
{
  if (!std::isfinite(centre) || !std::isfinite(vertex))
  {
    return 128;
  }
  const double steps = std::floor(256.0 * ((isovalue - centre) / (vertex - centre)) + 0.5);
  return static_cast<std::uint8_t>(
    steps < 1.0 ? 1.0 : (steps > 255.0 ? 255.0 : (steps == steps ? steps : 128.0)));
}

}

#endif
