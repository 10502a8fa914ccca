// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_SearchAhead_h
#define isodiamond_SearchAhead_h

#include "Field/Parallel.h"
#include "Stuffing/TouchedPoints.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Does work in order of which each step is a long search, and a short change of a mesh: searches
 * for some steps at the same time, and then makes their changes one after the other. What an
 * earlier one of these may have made untrue is searched for again when its turn comes. So all is as
 * if each had been searched for in its turn, whatever the number of threads.
 *
 * @param count steps in all
 * @param atOnce steps that are searched for at the same time: the more, the more have to be
 *        searched for again; the fewer, the less there is for threads to do
 * @param touched receives what the changes touch
 * @param search (step) -> what is found; may only read
 * @param isOld (step, found, changes) -> whether a search may find something else since there were
 *        so many changes
 * @param change (step, found)
 */
template <typename Search, typename IsOld, typename Change>
void SearchAhead(const ParallelFor& parallelFor, std::size_t count, std::size_t atOnce,
  const TouchedPoints& touched, const Search& search, const IsOld& isOld, const Change& change)
{
  std::vector<decltype(search(std::size_t{ 0 }))> found(std::min(atOnce, count));
  for (std::size_t first = 0; first < count; first += atOnce)
  {
    const std::size_t some = std::min(atOnce, count - first);
    ForEachIndex(parallelFor, some, 1,
      [&](std::int64_t i) { found[i] = search(first + static_cast<std::size_t>(i)); });
    const int before = touched.Changes();
    for (std::size_t i = 0; i < some; ++i)
    {
      if (touched.Changes() != before && isOld(first + i, found[i], before))
      {
        found[i] = search(first + i);
      }
      change(first + i, std::move(found[i]));
    }
  }
}

}

#endif
