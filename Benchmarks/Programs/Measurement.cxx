// SPDX-License-Identifier: BSD-3-Clause
#include "Measurement.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iostream>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace benchmark
{
namespace
{

constexpr double EnoughMilliseconds = 6000.0;

double Milliseconds(const std::function<void()>& f)
{
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
    .count();
}

void Prepare(const Contestant& contestant)
{
  if (contestant.Prepare)
  {
    contestant.Prepare();
  }
}

/** The peak memory of this process, in bytes. */
double PeakOfThisProcess()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss); // Linux counts kilobytes
}

/** Brings all pages of the program and its libraries into memory, so that they do not count as
 *  memory of a contestant. */
void LoadPrograms()
{
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
  {
    std::istringstream fields(line);
    std::size_t begin = 0;
    std::size_t end = 0;
    char dash = 0;
    fields >> std::hex >> begin >> dash >> end;
    if (line.find('/') != std::string::npos)
    {
      madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_READ);
    }
  }
}

/** The peak memory, in bytes, of a child process that calls f; NaN if it failed. */
double PeakOfChild(const std::function<void()>& f)
{
  malloc_trim(0); // free memory here must not be a reserve for the child
  int ends[2];
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("There is no pipe to a child process.");
  }
  std::cout.flush();
  const pid_t child = fork();
  if (child == 0)
  {
    int status = 1;
    try
    {
      LoadPrograms();
      f();
      const double peak = PeakOfThisProcess();
      status = write(ends[1], &peak, sizeof(peak)) == sizeof(peak) ? 0 : 1;
    }
    catch (const std::exception& problem)
    {
      std::cerr << problem.what() << "\n";
    }
    _exit(status);
  }
  close(ends[1]);
  double peak = NAN;
  if (child < 0 || read(ends[0], &peak, sizeof(peak)) != sizeof(peak))
  {
    peak = NAN;
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return peak;
}

}

double Median(std::vector<double> values)
{
  if (values.empty())
  {
    return NAN;
  }
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void RunOnThreads(int threads, const std::function<void()>& f)
{
  const char* backend = threads == 1 ? "Sequential" : "STDThread";
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads, backend, false }, f);
}

void MeasureTimes(
  const std::vector<Contestant>& contestants, int repetitions, int threads, Table& table)
{
  std::vector<std::vector<double>> times(contestants.size());
  for (int round = 0; round < repetitions; ++round)
  {
    for (std::size_t i = 0; i < contestants.size(); ++i)
    {
      const Contestant& contestant = contestants[i];
      if (std::accumulate(times[i].begin(), times[i].end(), 0.0) > EnoughMilliseconds)
      {
        continue;
      }
      if (round == 0)
      {
        Prepare(contestant);
      }
      RunOnThreads(contestant.Threads > 0 ? contestant.Threads : threads,
        [&] { times[i].push_back(Milliseconds(contestant.Run)); });
      if (round == 0)
      {
        contestant.Describe(table.At(contestant.Name, contestant.Tolerance).Figures);
      }
      contestant.Release();
    }
  }
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    Figures& figures = table.At(contestants[i].Name, contestants[i].Tolerance).Figures;
    figures.Set("milliseconds", Median(times[i]));
    figures.Set("runs", static_cast<double>(times[i].size()));
  }
}

void MeasureMemory(const std::vector<Contestant>& contestants, int threads, Table& table)
{
  const double volumeOnly = PeakOfChild([] {});
  for (const Contestant& contestant : contestants)
  {
    if (contestant.StartsFromVolume)
    {
      const double peak = PeakOfChild(
        [&]
        {
          Prepare(contestant);
          RunOnThreads(contestant.Threads > 0 ? contestant.Threads : threads, contestant.Run);
        });
      table.At(contestant.Name, contestant.Tolerance).Figures.Set("peak bytes", peak - volumeOnly);
    }
  }
}

double MeasureMemoryBandwidth(int threads)
{
  constexpr vtkIdType block = 1 << 20;
  constexpr vtkIdType blocks = 256;
  std::vector<char> from(block * blocks, 1);
  std::vector<char> to(block * blocks, 2);
  double best = HUGE_VAL;
  for (int i = 0; i < 5; ++i)
  {
    RunOnThreads(threads,
      [&]
      {
        best = std::min(best,
          Milliseconds(
            [&]
            {
              vtkSMPTools::For(0, blocks, 1,
                [&](vtkIdType begin, vtkIdType end) {
                  std::memcpy(
                    to.data() + begin * block, from.data() + begin * block, (end - begin) * block);
                });
            }));
      });
  }
  return 2.0 * block * blocks / (best / 1000.0);
}

}
