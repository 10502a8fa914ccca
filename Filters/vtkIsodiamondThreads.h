// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondThreads_h
#define vtkIsodiamondThreads_h

#include "Parallel.h"

#include "vtkSMPTools.h"

#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <string>
#include <utility>

/**
 * @file vtkIsodiamondThreads.h
 * The core's parallel-for on vtkSMPTools.
 *
 * VTK as packaged with ParaView starts with the backend "Sequential"; unless the user chose one
 * (by VTK_SMP_BACKEND_IN_USE or in code) a filter runs in a local scope with all cores, which
 * leaves the global setting as it was. The scope swaps a global: filters must not run it at the
 * same time in different threads.
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

inline isodiamond::ParallelFor SMPFor()
{
  return [](std::int64_t count, std::int64_t grain,
           const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    ExceptionKeeper exceptions;
    vtkSMPTools::For(0, count, grain,
      [&](std::int64_t begin, std::int64_t end) { exceptions.Run([&] { body(begin, end); }); });
    exceptions.Rethrow();
  };
}

/** Runs f with a number of threads, 0 for all cores. */
template <typename Functor>
void RunThreaded(int numberOfThreads, Functor&& f)
{
  const bool sequential = std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
    std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr;
  const std::string backend = sequential ? "STDThread" : vtkSMPTools::GetBackend();
  // The scope must end before an exception goes on, or its backend would stay.
  ExceptionKeeper exceptions;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ numberOfThreads, backend, false },
    [&] { exceptions.Run(std::forward<Functor>(f)); });
  exceptions.Rethrow();
}

}

#endif
