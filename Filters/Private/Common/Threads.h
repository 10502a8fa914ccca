// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Threads_h
#define vtkIsodiamond_Threads_h

#include "Field/Parallel.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

/**
 * @file Threads.h
 * The core's parallel-for on vtkSMPTools.
 *
 * VTK as packaged with ParaView starts with the backend "Sequential"; unless the user chose one
 * (by VTK_SMP_BACKEND_IN_USE or in code) a filter runs in a local scope with all cores, which
 * leaves the global setting as it was. The backend "STDThread" starts threads for every loop, and
 * ends the program where it cannot: loops start their own instead, as many as can be had. The scope
 * swaps a global: filters must not run it at the same time in different threads.
 */
namespace vtkIsodiamond
{

/** Keeps the first exception of several threads, which would end the program, for the caller. */
class ExceptionKeeper
{
public:
  template <typename Functor>
  void Run(Functor&& f)
  {
    try
    {
      f();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Kept = this->Kept ? this->Kept : std::current_exception();
    }
  }

  void Rethrow() const
  {
    if (this->Kept)
    {
      std::rethrow_exception(this->Kept);
    }
  }

private:
  std::mutex Mutex;
  std::exception_ptr Kept;
};

/** Runs work in a number of threads at once, or in fewer where no more can be started. */
inline void RunInThreads(std::int64_t count, const std::function<void()>& work)
{
  ExceptionKeeper exceptions;
  std::vector<std::thread> threads;
  try
  {
    threads.reserve(static_cast<std::size_t>(count));
    for (std::int64_t other = 1; other < count; ++other)
    {
      threads.emplace_back([&] { exceptions.Run(work); });
    }
  }
  catch (const std::system_error&)
  {
  }
  catch (const std::bad_alloc&)
  {
  }
  exceptions.Run(work);
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  exceptions.Rethrow();
}

/** A loop in threads that take range after range of it. */
inline void ForInThreads(int threads, std::int64_t count, std::int64_t grain,
  const std::function<void(std::int64_t, std::int64_t)>& body)
{
  constexpr std::int64_t rangesOfThread = 4;
  const std::int64_t range = std::max(grain, count / (rangesOfThread * threads));
  std::atomic<std::int64_t> next(0);
  RunInThreads(std::min<std::int64_t>(threads, (count + range - 1) / range),
    [&]
    {
      for (std::int64_t first = next.fetch_add(range); first < count; first = next.fetch_add(range))
      {
        body(first, std::min(first + range, count));
      }
    });
}

inline isodiamond::ParallelFor SMPFor()
{
  return [](std::int64_t count, std::int64_t grain,
           const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
    if (threads > 1 && count > grain && std::strcmp(vtkSMPTools::GetBackend(), "STDThread") == 0)
    {
      ForInThreads(threads, count, grain, body);
      return;
    }
    ExceptionKeeper exceptions;
    vtkSMPTools::For(0, count, grain,
      [&](std::int64_t begin, std::int64_t end) { exceptions.Run([&] { body(begin, end); }); });
    exceptions.Rethrow();
  };
}

/** Runs f in a local scope of vtkSMPTools. */
template <typename Functor>
void RunScoped(const vtkSMPTools::Config& config, Functor&& f)
{
  // The scope must end before an exception propagates, or its backend would stay set.
  ExceptionKeeper exceptions;
  vtkSMPTools::LocalScope(config, [&] { exceptions.Run(std::forward<Functor>(f)); });
  exceptions.Rethrow();
}

/** Runs f with a number of threads, 0 for all cores. */
template <typename Functor>
void RunThreaded(int numberOfThreads, Functor&& f)
{
  const bool sequential = std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
    std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr;
  const std::string backend = sequential ? "STDThread" : vtkSMPTools::GetBackend();
  RunScoped(vtkSMPTools::Config{ numberOfThreads, backend, false }, std::forward<Functor>(f));
}

/** Runs f, whose loops are in VTK itself, without threads, which might fail to start. */
template <typename Functor>
void RunSerial(Functor&& f)
{
  RunScoped(vtkSMPTools::Config{ 1, "Sequential", false }, std::forward<Functor>(f));
}

}

#endif
