// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/Shortfall.h"

#include <numeric>
#include <utility>

namespace isodiamond
{

std::vector<std::uint32_t> WorstFirst(
  const LocalMesh& mesh, double wanted, std::vector<std::uint32_t> some)
{
  some.erase(std::remove_if(some.begin(), some.end(),
               [&](std::uint32_t tetrahedron) { return !IsBad(mesh, wanted, tetrahedron); }),
    some.end());
  std::sort(some.begin(), some.end());
  some.erase(std::unique(some.begin(), some.end()), some.end());
  std::stable_sort(some.begin(), some.end(),
    [&](std::uint32_t a, std::uint32_t b) { return mesh.SineOf(a) < mesh.SineOf(b); });
  return some;
}

std::vector<std::uint32_t> WorstFirst(const LocalMesh& mesh, double wanted)
{
  std::vector<std::uint32_t> all(mesh.Mesh().Tetrahedra.size());
  std::iota(all.begin(), all.end(), 0U);
  return WorstFirst(mesh, wanted, std::move(all));
}

}
