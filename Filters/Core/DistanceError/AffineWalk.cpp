// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasuresOf.h"

namespace isodiamond
{

template void DistanceMeasures<AffineLengths>::Coarse(
  const IsovertexClusters&, const AffineLengths&, ErrorMaxima&, const Loops&);

}
