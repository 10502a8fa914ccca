// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceTests.h"

#include "DistanceError/DistanceMeasures.h"

#include <type_traits>
#include <variant>

namespace isodiamond
{

DistanceTests::DistanceTests(
  const TestedHierarchy& tested, const GridGeometry& world, const ParallelFor& parallelFor)
  : Tested(tested)
  , InWorld(WorldLengthsOf(world))
{
  const HiddenCells* const hidden =
    tested.Hidden != nullptr && tested.Hidden->Any() ? tested.Hidden : nullptr;
  this->Tested.Hidden = hidden;
  for (int surface = 0; surface < tested.Relevant.Region().SurfaceCount(); ++surface)
  {
    this->Surfaces.emplace_back(tested.Relevant, surface, hidden, parallelFor);
  }
}

std::vector<std::uint8_t> DistanceTests::Exceed(
  const std::vector<TestedDiamond>& diamonds, const ParallelFor& parallelFor) const
{
  std::vector<std::uint8_t> exceed(diamonds.size(), 0);
  for (const TestedSurface& surface : this->Surfaces)
  {
    std::visit(
      [&](const auto& lengths)
      {
        DistanceMeasures<std::decay_t<decltype(lengths)>>::Test(
          surface, this->Tested, lengths, diamonds, exceed, parallelFor);
      },
      this->InWorld);
  }
  return exceed;
}

}
