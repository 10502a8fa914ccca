// SPDX-License-Identifier: BSD-3-Clause
#include "Field/Samples.h"

#include <limits>

namespace isodiamond
{

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

Finiteness::Finiteness(const AnySamples& samples)
  : Samples(samples)
  , AreAll(std::visit(
      [](const auto& view)
      {
        using T = typename std::decay_t<decltype(view)>::Value;
        bool all = true;
        for (std::int64_t i = 0; std::is_floating_point_v<T> && i < view.Size(); ++i)
        {
          all &= view.Pointer()[i] - view.Pointer()[i] == T{ 0 };
        }
        return all;
      },
      samples))
{
}

ValueRange FiniteRange(const AnySamples& samples)
{
  return std::visit(
    [](const auto& view)
    {
      using T = typename std::decay_t<decltype(view)>::Value;
      T low = std::numeric_limits<T>::max();
      T high = std::numeric_limits<T>::lowest();
      const T* data = view.Pointer();
      for (std::int64_t i = 0; i < view.Size(); ++i)
      {
        // x - x is 0 exactly for finite values
        if (std::is_integral_v<T> || data[i] - data[i] == T{ 0 })
        {
          low = data[i] < low ? data[i] : low;
          high = data[i] > high ? data[i] : high;
        }
      }
      return low <= high ? ValueRange{ static_cast<double>(low), static_cast<double>(high) }
                         : ValueRange{};
    },
    samples);
}

}
