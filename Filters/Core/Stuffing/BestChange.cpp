// SPDX-License-Identifier: BSD-3-Clause
#include "Stuffing/BestChange.h"

#include "Stuffing/ChangeSearch.h"

namespace isodiamond
{

Change BestChange(
  const LocalMesh& mesh, const ImprovementOptions& options, std::uint32_t tetrahedron)
{
  return ChangeSearch(mesh, options).FindBest(tetrahedron);
}

bool Helps(const Change& change, const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron)
{
  return ChangeSearch(mesh, options).Helps(change, tetrahedron);
}

Change AnyChange(const LocalMesh& mesh, const ImprovementOptions& options,
  std::uint32_t tetrahedron, std::minstd_rand& random)
{
  return ChangeSearch(mesh, options, &random).FindAny(tetrahedron);
}

}
