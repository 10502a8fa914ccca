// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_Peers_h
#define isodiamond_Peers_h

#include "Field/Parallel.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Processes that build one hierarchy together, as seen by one of them: each has some slabs of the
 * volume, and takes its share of the work. Their results are combined, so that in the end all have
 * the same, bit for bit, as one process alone would find.
 *
 * All of them call the same functions in the same order, and each call waits for the others. So
 * anything that may fail in one of them alone has to be done Together().
 */
class Peers
{
public:
  virtual ~Peers() = default;

  /** How many there are, and which of them this is, from 0 on. */
  virtual int Count() const = 0;
  virtual int Rank() const = 0;

  ///@{
  /** Combine values: the bits that are set anywhere, the greatest. */
  virtual void Or(std::uint8_t* bytes, std::int64_t count) = 0;
  virtual void Max(std::uint16_t* values, std::int64_t count) = 0;
  virtual void Max(double* values, std::int64_t count) = 0;
  ///@}

  /** The same for the bits of any values. */
  template <typename T>
  void Or(std::vector<T>& values)
  {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_same_v<T, bool>, "plain bits");
    this->Or(reinterpret_cast<std::uint8_t*>(values.data()),
      static_cast<std::int64_t>(values.size() * sizeof(T)));
  }

  /** The lists of all peers, one after the other. */
  std::vector<std::uint64_t> Gather(const std::vector<std::uint64_t>& own)
  {
    std::vector<double> sizes(this->Count(), 0.0);
    sizes[this->Rank()] = static_cast<double>(own.size());
    this->Max(sizes.data(), this->Count());
    std::size_t all = 0;
    std::size_t before = 0;
    for (int i = 0; i < this->Count(); ++i)
    {
      all += static_cast<std::size_t>(sizes[i]);
      before += i < this->Rank() ? static_cast<std::size_t>(sizes[i]) : 0;
    }
    std::vector<std::uint64_t> values;
    this->Together(
      [&]
      {
        values.assign(all, 0);
        std::copy(own.begin(), own.end(), values.begin() + static_cast<std::ptrdiff_t>(before));
      });
    this->Or(values);
    return values;
  }

  /** Whether something is true at any of them. */
  bool Any(bool here)
  {
    double any = here ? 1.0 : 0.0;
    this->Max(&any, 1);
    return any > 0.0;
  }

  /** Does a piece of work, within which peers may be called only in such pieces, the same ones in
   *  all processes.
   *  @throws if it throws at any of them */
  template <typename Work>
  void Together(Work&& work)
  {
    std::exception_ptr problem;
    try
    {
      work();
    }
    catch (...)
    {
      problem = std::current_exception();
    }
    const bool hasFailed = this->Any(problem != nullptr);
    if (problem)
    {
      std::rethrow_exception(problem);
    }
    if (hasFailed)
    {
      throw std::runtime_error("Another process of those that work together has failed.");
    }
  }
};

/** Work that may fail, with peers or alone. @param peers may be null */
template <typename Work>
void InStep(Peers* peers, Work&& work)
{
  if (peers != nullptr)
  {
    peers->Together(std::forward<Work>(work));
  }
  else
  {
    work();
  }
}

/** Whether something is true here, or at any of the peers. @param peers may be null */
inline bool IsAnywhere(Peers* peers, bool here)
{
  return peers != nullptr ? peers->Any(here) : here;
}

/** The loops of a process: over everything, and over its share of what peers do together. */
struct Loops
{
  ParallelFor Whole;
  ParallelFor Share;

  /** Alone: everything is its share. */
  template <typename For>
  Loops(const For& whole) // NOLINT(google-explicit-constructor): that is what most are
    : Whole(whole)
    , Share(whole)
  {
  }

  /** Each process takes some ranges of a loop, dealt out in turn. @param peers may be null */
  Loops(const ParallelFor& whole, const Peers* peers)
    : Loops(whole)
  {
    if (peers != nullptr)
    {
      this->Share = [whole, part = peers->Rank(), parts = peers->Count()](std::int64_t count,
                      std::int64_t grain,
                      const std::function<void(std::int64_t, std::int64_t)>& body)
      {
        const std::int64_t ranges = (count + grain - 1) / grain;
        ForEachIndex(whole, (ranges - part + parts - 1) / parts, 1,
          [&](std::int64_t i)
          {
            const std::int64_t begin = (part + i * parts) * grain;
            body(begin, std::min(begin + grain, count));
          });
      };
    }
  }
};

}

#endif
