// SPDX-License-Identifier: BSD-3-Clause
#ifndef Bars_h
#define Bars_h

#include "Results.h"

#include <vector>

namespace benchmark
{

/**
 * Judges what Isodiamonds must hold, one line for each demand and volume that the run has figures
 * for. They are demanded of volumes of 256^3 samples or more; smaller ones are judged all the same.
 */
std::vector<Bar> JudgeBars(const Report& report);

}

#endif
