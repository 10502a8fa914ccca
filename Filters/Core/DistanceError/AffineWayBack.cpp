// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasuresOf.h"

namespace isodiamond
{

template void DistanceMeasures<AffineLengths>::Back(const IsodiamondHierarchy&,
  const AffineLengths&, const BeforeWayBack&, const ErrorCode&, std::vector<ErrorCode::Type>&,
  const Loops&);

}
