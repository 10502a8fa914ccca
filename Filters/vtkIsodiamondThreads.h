// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamondThreads_h
#define vtkIsodiamondThreads_h

#include "Parallel.h"

#include "vtkSMPTools.h"

#include <cstdlib>
#include <cstring>
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

inline isodiamond::ParallelFor SMPFor()
{
  return [](std::int64_t count, std::int64_t grain,
           const std::function<void(std::int64_t, std::int64_t)>& body)
  { vtkSMPTools::For(0, count, grain, body); };
}

/** Runs f with a number of threads, 0 for all cores. */
template <typename Functor>
void RunThreaded(int numberOfThreads, Functor&& f)
{
  const bool sequential = std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0 &&
    std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr;
  const std::string backend = sequential ? "STDThread" : vtkSMPTools::GetBackend();
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config{ numberOfThreads, backend, false }, std::forward<Functor>(f));
}

}

#endif
