// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/AllWaysBack.h"
#include "DistanceError/DistanceMeasures.h"

namespace isodiamond
{

void MeasureBack(const IsodiamondHierarchy& relevant, const AffineLengths& lengths,
  const BeforeWayBack& known, const ErrorCode& code, std::vector<ErrorCode::Type>& codes,
  const Loops& loops)
{
  AllWaysBack(relevant, lengths, known, code, codes, loops).Run();
}

}
