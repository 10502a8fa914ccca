// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Samples_h
#define isodiamond_Samples_h

#include "Field/Parallel.h"
#include "Lattice/Lattice.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

namespace isodiamond
{

class Peers;

/** The place of a lattice point among the samples, x fastest. */
inline constexpr std::int64_t SampleIndex(const std::array<int, 3>& dimensions, const Point& point)
{
  return (std::int64_t{ point[2] } * dimensions[1] + point[1]) * dimensions[0] + point[0];
}

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

  std::int64_t Index(const Point& point) const { return SampleIndex(this->Dims, point); }

  double operator()(const Point& point) const
  {
    const std::int64_t index = this->Index(point);
    assert(index >= 0 && index < this->Size());
    return static_cast<double>(this->Data[index]);
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

/** Owned values of any of the scalar types. */
using AnyValues = std::variant<std::vector<float>, std::vector<double>, std::vector<std::int8_t>,
  std::vector<std::uint8_t>, std::vector<std::int16_t>, std::vector<std::uint16_t>,
  std::vector<std::int32_t>, std::vector<std::uint32_t>, std::vector<std::int64_t>,
  std::vector<std::uint64_t>>;

/** A view of owned values as a row of samples. */
AnySamples ViewOf(const AnyValues& values);

/** The number of samples, and the bytes of one. */
std::int64_t SizeOf(const AnySamples& samples);
int BytesOfSample(const AnySamples& samples);

/** The sample at a lattice point of the grid. */
inline double SampleAt(const AnySamples& samples, const Point& point)
{
  return std::visit([&](const auto& view) { return view(point); }, samples);
}

/** A range of slices of a volume, end excluded. */
struct SliceRange
{
  int Begin = 0;
  int End = 0;
};

/** Some whole slices of a volume: one that is larger than memory comes slab by slab. Slabs may
 *  share slices. */
struct SampleSlab
{
  AnySamples Samples; ///< as long and wide as the volume
  int First = 0;      ///< the first of the volume's slices that it has

  /** The slice behind its last one. */
  int End() const;
};

/** Tells which samples are finite; fast where all are. */
class Finiteness
{
public:
  explicit Finiteness(const AnySamples& samples);

  /** For a volume that comes in slabs, all of which have to be added.
   *  @param dimensions of the volume */
  explicit Finiteness(const std::array<int, 3>& dimensions)
    : Dimensions(dimensions)
  {
  }
  void Add(const SampleSlab& slab);
  /** Adds what peers have added. */
  void Merge(Peers& peers);

  bool All() const { return this->NotFinite.empty(); }
  bool operator()(const Point& point) const
  {
    const std::int64_t index = this->All() ? 0 : SampleIndex(this->Dimensions, point);
    return this->All() || ((this->NotFinite[index >> 6] >> (index & 63)) & 1U) == 0;
  }

private:
  void MakeRoom();

  std::array<int, 3> Dimensions;
  std::vector<std::uint64_t> NotFinite; ///< a bit each, by index; empty as long as all are finite
};

/** Smallest and largest finite sample; {0, 0} if there is none. */
struct ValueRange
{
  double Minimum = 0.0;
  double Maximum = 0.0;
};

/** The range of all finite samples. */
ValueRange FiniteRange(const AnySamples& samples, const ParallelFor& parallelFor = SerialFor);

/** The same for a volume that comes in slabs. */
class FiniteRangeOfSlabs
{
public:
  void Add(const AnySamples& samples, const ParallelFor& parallelFor = SerialFor);
  void Merge(Peers& peers);
  ValueRange Range() const { return this->IsAny ? this->Known : ValueRange{}; }

private:
  ValueRange Known;
  bool IsAny = false;
};

}

#endif
