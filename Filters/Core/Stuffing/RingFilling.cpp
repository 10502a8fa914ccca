// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/RingFilling.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isodiamond
{

double FillRing(const LocalMesh& mesh, std::uint32_t a, std::uint32_t b,
  const std::vector<std::uint32_t>& ring, std::vector<Corners>& fresh)
{
  constexpr std::size_t most = MostAround + 1;
  const int count = static_cast<int>(ring.size());
  std::array<std::array<double, most>, most> sines{};
  std::array<std::array<int, most>, most> middles{};
  for (int i = 0; i + 1 < count; ++i)
  {
    sines[i][i + 1] = 1.0;
  }
  for (int length = 2; length < count; ++length)
  {
    for (int i = 0; i + length < count; ++i)
    {
      const int k = i + length;
      sines[i][k] = -HUGE_VAL;
      for (int j = i + 1; j < k; ++j)
      {
        const double sine =
          std::min({ sines[i][j], sines[j][k], mesh.SineOf(Corners{ ring[i], ring[j], ring[k], b }),
            mesh.SineOf(Corners{ ring[i], ring[k], ring[j], a }) });
        if (sine > sines[i][k])
        {
          sines[i][k] = sine;
          middles[i][k] = j;
        }
      }
    }
  }
  std::vector<std::pair<int, int>> open = { { 0, count - 1 } };
  while (!open.empty())
  {
    const auto [i, k] = open.back();
    open.pop_back();
    if (k - i < 2)
    {
      continue;
    }
    const int j = middles[i][k];
    fresh.push_back({ ring[i], ring[j], ring[k], b });
    fresh.push_back({ ring[i], ring[k], ring[j], a });
    open.emplace_back(i, j);
    open.emplace_back(j, k);
  }
  return sines[0][count - 1];
}

}
