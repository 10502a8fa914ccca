// SPDX-License-Identifier: BSD-3-Clause
#include "DistanceError/DistanceMeasuresOf.h"

namespace isodiamond
{

template struct DistanceMeasures<AxesLengths>;

}
