// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_MeshOptimizer_h
#define isodiamond_MeshOptimizer_h

#include "Simplification/Simplification.h"

namespace isodiamond
{

/** Decimation by the library meshoptimizer; null where the program was built without it. */
Decimation MeshOptimizer();

}

#endif
