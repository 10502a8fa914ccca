// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Parallel_h
#define isodiamond_Parallel_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

/**
 * @file Parallel.h
 * The core starts no threads of its own: it is given its parallel-for.
 *
 * Its uses in the core are loops over independent ranges that write to places of their own
 * (count -> prefix sum -> write), so results do not depend on how the ranges are cut or run; or
 * serial work in steps, which can report progress and be aborted.
 */
namespace isodiamond
{

/** Runs body(begin, end) over ranges that cover [0, count) once. @param grain least range size. */
using ParallelFor = std::function<void(std::int64_t count, std::int64_t grain,
  const std::function<void(std::int64_t begin, std::int64_t end)>& body)>;

/** Runs body(i) for all i in [0, count). @param grain least number of them in a range */
template <typename Count, typename Body>
void ForEachIndex(const ParallelFor& parallelFor, Count count, std::int64_t grain, const Body& body)
{
  parallelFor(static_cast<std::int64_t>(count), grain,
    [&body](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        body(i);
      }
    });
}

/** Runs body(i) for all i in [0, count), one after the other, calling the parallel-for once for
 *  each step: so work that has to be done in order can report progress, and be aborted. */
template <typename Body>
void InSteps(const ParallelFor& parallelFor, std::size_t count, std::size_t step, const Body& body)
{
  for (std::size_t first = 0; first < count; first += step)
  {
    const std::size_t last = std::min(count, first + step);
    parallelFor(1, 1,
      [&](std::int64_t /*begin*/, std::int64_t /*end*/)
      {
        for (std::size_t i = first; i < last; ++i)
        {
          body(i);
        }
      });
  }
}

/** Called when a phase of some work begins, with the part of the whole that it is, from 0 to 1. */
using Progress = std::function<void(const char* phase, double begin, double end)>;

/** The parallel-for of one thread. */
inline void SerialFor(std::int64_t count, std::int64_t /*grain*/,
  const std::function<void(std::int64_t, std::int64_t)>& body)
{
  if (count > 0)
  {
    body(0, count);
  }
}

}

#endif
