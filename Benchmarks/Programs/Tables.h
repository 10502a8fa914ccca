// SPDX-License-Identifier: BSD-3-Clause
#ifndef Tables_h
#define Tables_h

#include "Results.h"

#include <ostream>

/**
 * @file Tables.h
 * Results in Markdown, for people.
 */
namespace benchmark
{

/** All contestants on a volume, with ratios. */
void PrintVolume(const VolumeResult& volume, std::ostream& out);

/** The paper's Table 2 for all volumes. */
void PrintTable2(const Report& report, std::ostream& out);

/** The paper's figure 15 in numbers: front and time of RI and MI relative to HD. */
void PrintFigure15(const Report& report, std::ostream& out);

/** What must hold, what was measured, and whether it holds. */
void PrintBars(const std::vector<Bar>& bars, std::ostream& out);

}

#endif
