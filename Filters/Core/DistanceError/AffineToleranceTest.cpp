// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/ToleranceTest.h"

namespace isodiamond
{

void TestTolerances(const TestedSurface& surface, const TestedHierarchy& tested,
  const AffineLengths& lengths, const std::vector<TestedDiamond>& diamonds,
  std::vector<std::uint8_t>& exceeds, const ParallelFor& parallelFor)
{
  TestAll(surface, tested, lengths, diamonds, exceeds, parallelFor);
}

}
