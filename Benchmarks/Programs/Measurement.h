// SPDX-License-Identifier: BSD-3-Clause
#ifndef Measurement_h
#define Measurement_h

#include "Results.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/**
 * @file Measurement.h
 * Time and memory of contestants.
 */
namespace benchmark
{

/** Something whose time is measured. Its functions share what they capture. */
struct Contestant
{
  std::string Name;
  benchmark::Tolerance Tolerance;
  std::function<void()> Run;               ///< what is measured
  std::function<void(Figures&)> Describe;  ///< what the last run made
  std::function<void()> Release;           ///< frees it, so that each run has fresh memory
  std::function<void()> Prepare = nullptr; ///< before the first run; not measured
  bool StartsFromVolume = false;           ///< and not from what another one made
  int Threads = 0;                         ///< 0 for as many as the others
};

/** NaN if there are none. */
double Median(std::vector<double> values);

/** Runs f with a number of threads in VTK's filters; ours are told theirs separately. */
void RunOnThreads(int threads, const std::function<void()>& f);

/**
 * Runs all contestants in turn, round by round, so that a machine's drift is the same for all. Puts
 * into the row of each its median "milliseconds", how many "runs" there were, and what it tells of
 * itself. One that has taken more than six seconds in all does not run again.
 */
void MeasureTimes(
  const std::vector<Contestant>& contestants, int repetitions, int threads, Table& table);

/**
 * Puts the "peak bytes" of those contestants that start from the volume into their rows: the peak
 * memory of a process that ran only the one contestant, once, less that of a process that only held
 * the volume. Both are forked: this process must not have run anything so far that leaves threads
 * behind.
 */
void MeasureMemory(const std::vector<Contestant>& contestants, int threads, Table& table);

/** Bytes a second, read and written, of copying between arrays larger than any cache. */
double MeasureMemoryBandwidth(int threads);

}

#endif
