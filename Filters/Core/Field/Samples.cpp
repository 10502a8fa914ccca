// SPDX-License-Identifier: BSD-3-Clause
#include "Field/Samples.h"

#include "Field/Peers.h"

#include <algorithm>
#include <array>
#include <limits>

namespace isodiamond
{
namespace
{

template <typename T>
bool IsFinite(T value)
{
  return std::is_integral_v<T> || value - value == T{ 0 };
}

/** The least and the greatest of some values; NaN is ignored. */
template <typename T>
struct Ends
{
  T Low = std::numeric_limits<T>::max();
  T High = std::numeric_limits<T>::lowest();

  void Add(T value)
  {
    this->Low = value < this->Low ? value : this->Low;
    this->High = value > this->High ? value : this->High;
  }
};

/** The same for an array. In separate lanes, so that no value waits for the one before. */
template <typename T>
Ends<T> EndsInLanes(const T* values, std::int64_t count)
{
  constexpr int width = 64 / sizeof(T);
  Ends<T> ends;
  std::array<T, width> low;
  std::array<T, width> high;
  low.fill(ends.Low);
  high.fill(ends.High);
  std::int64_t i = 0;
  for (; i + width <= count; i += width)
  {
    for (int lane = 0; lane < width; ++lane)
    {
      const T value = values[i + lane];
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
    }
  }
  ends.Low = *std::min_element(low.begin(), low.end());
  ends.High = *std::max_element(high.begin(), high.end());
  std::for_each(values + i, values + count, [&](T value) { ends.Add(value); });
  return ends;
}

/** The least and the greatest of the finite values among some. */
template <typename T>
Ends<T> FiniteEnds(const T* values, std::int64_t count)
{
  Ends<T> ends = EndsInLanes(values, count);
  if (!IsFinite(ends.Low) || !IsFinite(ends.High))
  {
    ends = Ends<T>();
    std::for_each(values, values + count,
      [&](T value)
      {
        if (IsFinite(value))
        {
          ends.Add(value);
        }
      });
  }
  return ends;
}

}

AnySamples ViewOf(const AnyValues& values)
{
  return std::visit(
    [](const auto& array) -> AnySamples
    {
      using T = typename std::decay_t<decltype(array)>::value_type;
      return SampleView<T>(array.data(), { static_cast<int>(array.size()), 1, 1 });
    },
    values);
}

std::int64_t SizeOf(const AnySamples& samples)
{
  return std::visit([](const auto& view) { return view.Size(); }, samples);
}

int BytesOfSample(const AnySamples& samples)
{
  return std::visit([](const auto& view)
    { return static_cast<int>(sizeof(typename std::decay_t<decltype(view)>::Value)); },
    samples);
}

int SampleSlab::End() const
{
  return this->First +
    std::visit([](const auto& view) { return view.Dimensions()[2]; }, this->Samples);
}

Finiteness::Finiteness(const AnySamples& samples)
  : Finiteness(std::visit([](const auto& view) { return view.Dimensions(); }, samples))
{
  this->Add({ samples, 0 });
}

void Finiteness::Add(const SampleSlab& slab)
{
  const std::int64_t first = SampleIndex(this->Dimensions, { 0, 0, slab.First });
  std::visit(
    [&](const auto& view)
    {
      using T = typename std::decay_t<decltype(view)>::Value;
      const T* const data = view.Pointer();
      bool all = true;
      for (std::int64_t i = 0; std::is_floating_point_v<T> && i < view.Size(); ++i)
      {
        all &= IsFinite(data[i]);
      }
      if (all)
      {
        return;
      }
      this->MakeRoom();
      for (std::int64_t i = 0; i < view.Size(); ++i)
      {
        const std::int64_t index = first + i;
        this->NotFinite[index >> 6] |= std::uint64_t{ IsFinite(data[i]) ? 0U : 1U } << (index & 63);
      }
    },
    slab.Samples);
}

void Finiteness::MakeRoom()
{
  const auto [x, y, z] = this->Dimensions;
  this->NotFinite.resize((std::int64_t{ x } * y * z + 63) / 64);
}

void Finiteness::Merge(Peers& peers)
{
  if (peers.Any(!this->All()))
  {
    this->MakeRoom();
    peers.Or(this->NotFinite);
  }
}

ValueRange FiniteRange(const AnySamples& samples, const ParallelFor& parallelFor)
{
  FiniteRangeOfSlabs whole;
  whole.Add(samples, parallelFor);
  return whole.Range();
}

void FiniteRangeOfSlabs::Merge(Peers& peers)
{
  constexpr double none = -std::numeric_limits<double>::infinity();
  std::array<double, 2> ends = { this->IsAny ? -this->Known.Minimum : none,
    this->IsAny ? this->Known.Maximum : none };
  peers.Max(ends.data(), 2);
  this->IsAny = ends[1] > none;
  this->Known = { -ends[0], ends[1] };
}

void FiniteRangeOfSlabs::Add(const AnySamples& samples, const ParallelFor& parallelFor)
{
  std::visit(
    [&](const auto& view)
    {
      using T = typename std::decay_t<decltype(view)>::Value;
      constexpr std::int64_t most = 1 << 18; // at a time
      std::vector<Ends<T>> parts((view.Size() + most - 1) / most);
      ForEachIndex(parallelFor, parts.size(), 1,
        [&](std::int64_t i) {
          parts[i] = FiniteEnds(view.Pointer() + most * i, std::min(most, view.Size() - most * i));
        });
      for (const Ends<T>& ends : parts)
      {
        if (ends.Low <= ends.High)
        {
          const auto low = static_cast<double>(ends.Low);
          const auto high = static_cast<double>(ends.High);
          this->Known.Minimum = this->IsAny ? std::min(this->Known.Minimum, low) : low;
          this->Known.Maximum = this->IsAny ? std::max(this->Known.Maximum, high) : high;
          this->IsAny = true;
        }
      }
    },
    samples);
}

}
