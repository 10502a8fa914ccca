// SPDX-License-Identifier: BSD-3-Clause
#ifndef Benchmark_h
#define Benchmark_h

#include "Results.h"
#include "Volumes.h"

#include <vector>

/**
 * @file Benchmark.h
 * Which contestants run on a volume.
 */
namespace benchmark
{

struct BenchmarkOptions
{
  int Threads = 1;
  int Repetitions = 5;
  bool IsPaper = false; ///< only what Table 2 and figure 15 need
  bool IsAll = false;   ///< also what takes minutes
  std::vector<Shape> Shapes = { Shape::Isosurface, Shape::IntervalVolume };
  bool HasDistance = true; ///< the distance metric beside the field metric
};

/** What a volume is, without anything measured yet. */
VolumeResult DescribeVolume(const Volume& volume);

/** Peak memory of all contestants that start from the volume. To be measured for all volumes before
 *  any times: see MeasureMemory(). */
void MeasureMemoryOf(const Volume& volume, const BenchmarkOptions& options, VolumeResult& result);

/** Times of all contestants, and what they made. */
void MeasureTimesOf(const Volume& volume, const BenchmarkOptions& options, VolumeResult& result);

}

#endif
