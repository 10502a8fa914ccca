// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_test_ThreadPeers_h
#define isodiamond_test_ThreadPeers_h

#include "Field/Peers.h"

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace test
{

/** Peers that are threads: they combine their values in memory. */
class ThreadPeers
{
public:
  explicit ThreadPeers(int count)
    : Places(count)
    , Traffics(count)
  {
  }

  /** What one of them gave to the others. */
  struct Traffic
  {
    std::int64_t Bytes = 0;
    std::int64_t Meetings = 0;
  };
  const Traffic& TrafficOf(int rank) const { return this->Traffics[rank]; }

  /** Runs body(peers) in all of them. */
  void Run(const std::function<void(isodiamond::Peers&)>& body)
  {
    std::vector<std::thread> threads;
    for (int rank = 0; rank < this->Count(); ++rank)
    {
      threads.emplace_back(
        [&, rank]
        {
          Peer peer(*this, rank);
          body(peer);
        });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  }

private:
  class Peer : public isodiamond::Peers
  {
  public:
    Peer(ThreadPeers& all, int rank)
      : All(all)
      , Number(rank)
    {
    }
    int Count() const override { return this->All.Count(); }
    int Rank() const override { return this->Number; }
    void Or(std::uint8_t* bytes, std::int64_t count) override
    {
      this->Combine(bytes, count, [](auto a, auto b) { return a | b; });
    }
    void Max(std::uint16_t* values, std::int64_t count) override
    {
      this->Combine(values, count, [](auto a, auto b) { return std::max(a, b); });
    }
    void Max(double* values, std::int64_t count) override
    {
      this->Combine(values, count, [](auto a, auto b) { return std::max(a, b); });
    }

  private:
    template <typename T, typename Operation>
    void Combine(T* values, std::int64_t count, const Operation& operation)
    {
      Traffic& traffic = this->All.Traffics[this->Number];
      traffic.Bytes += count * static_cast<std::int64_t>(sizeof(T));
      ++traffic.Meetings;
      this->All.Places[this->Number] = values;
      this->All.Meet();
      // Each combines a part of the values, in its own place: nobody else reads that part.
      const std::int64_t begin = count * this->Number / this->Count();
      const std::int64_t end = count * (this->Number + 1) / this->Count();
      for (const void* place : this->All.Places)
      {
        const T* const others = static_cast<const T*>(place);
        std::transform(others + begin, others + end, values + begin, values + begin, operation);
      }
      this->All.Meet();
      std::vector<T> all(count);
      for (int part = 0; part < this->Count(); ++part)
      {
        const T* const combined = static_cast<const T*>(this->All.Places[part]);
        std::copy(combined + count * part / this->Count(),
          combined + count * (part + 1) / this->Count(),
          all.begin() + count * part / this->Count());
      }
      this->All.Meet();
      std::copy(all.begin(), all.end(), values);
    }

    ThreadPeers& All;
    int Number;
  };

  int Count() const { return static_cast<int>(this->Places.size()); }

  /** Waits for all others. */
  void Meet()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    const int meeting = this->Meetings;
    if (++this->Waiting == this->Count())
    {
      this->Waiting = 0;
      ++this->Meetings;
      this->Changed.notify_all();
    }
    this->Changed.wait(lock, [&] { return meeting != this->Meetings; });
  }

  std::vector<const void*> Places;
  std::vector<Traffic> Traffics;
  std::mutex Mutex;
  std::condition_variable Changed;
  int Waiting = 0;
  int Meetings = 0;
};

/** Calls check(make(peers)) in each of some peers; the checks run one after the other, as
 *  expectations have to. */
template <typename Make, typename Check>
void ForEachPeer(int count, const Make& make, const Check& check)
{
  std::mutex mutex;
  ThreadPeers(count).Run(
    [&](isodiamond::Peers& own)
    {
      const auto made = make(own);
      const std::lock_guard<std::mutex> lock(mutex);
      check(made);
    });
}

}

#endif
