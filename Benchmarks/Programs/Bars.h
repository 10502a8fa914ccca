// SPDX-License-Identifier: BSD-3-Clause
#ifndef Bars_h
#define Bars_h

#include "Results.h"

#include <vector>

namespace benchmark
{

/**
 * Judges what must hold of Isodiamonds: a bar for each demand and each volume that the run has
 * figures for. The demands are for volumes of 256^3 samples or more; smaller ones are judged all
 * the same.
 */
std::vector<Bar> JudgeBars(const Report& report);

}

#endif
