// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasures.h"
#include "DistanceError/WayBack.h"

namespace isodiamond
{

void MeasureBack(const IsodiamondHierarchy& relevant, const AffineLengths& lengths,
  const HiddenCells* hidden, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const ParallelFor& parallelFor)
{
  MeasureAllBack(relevant, lengths, hidden, code, codes, parallelFor);
}

}
