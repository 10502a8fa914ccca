// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasuresOf.h"

namespace isodiamond
{

template void DistanceMeasures<AffineLengths>::Test(const TestedSurface&, const TestedHierarchy&,
  const AffineLengths&, const std::vector<TestedDiamond>&, std::vector<std::uint8_t>&,
  const ParallelFor&);

}
