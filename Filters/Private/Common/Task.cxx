// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Common/Task.h"

#include "Private/Common/Threads.h"

#include "vtkVersion.h"

#include <algorithm>
#include <atomic>

namespace vtkIsodiamond
{
namespace
{

using Clock = std::chrono::steady_clock;

/** All threads stop together for progress and an abort. */
constexpr std::chrono::milliseconds BatchLength(30);

/** In this time a phase of many short loops gets through two thirds of its progress. */
constexpr std::chrono::duration<double> LongPhase(10.0);
/** A step: long compared to a look at the clock, short compared to a batch. */
constexpr std::chrono::milliseconds StepLength(1);

/** Takes step after step of what is left of a loop, until a time. */
void WorkUntil(Clock::time_point end, std::int64_t count, std::int64_t grain,
  std::atomic<std::int64_t>& next, const std::function<void(std::int64_t, std::int64_t)>& body)
{
  std::int64_t step = grain;
  for (Clock::time_point start = Clock::now(); start < end;)
  {
    const std::int64_t first = next.fetch_add(step);
    if (first >= count)
    {
      return;
    }
    body(first, std::min(first + step, count));
    const Clock::time_point now = Clock::now();
    if (now - start < StepLength)
    {
      step = std::min(2 * step, 8 * grain); // no more: those that follow may be longer
    }
    else if (now - start > 2 * StepLength)
    {
      step = std::max(grain, step / 2);
    }
    start = now;
  }
}

/** To be called within a catch. */
void Report(vtkAlgorithm* filter)
{
  try
  {
    throw;
  }
  catch (const Aborted&)
  {
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorWithObjectMacro(filter, "There is not enough memory.");
  }
  catch (const std::exception& problem)
  {
    vtkErrorWithObjectMacro(filter, << problem.what());
  }
}

bool IsAborted(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220901)
  return filter->CheckAbort();
#else
  return filter->GetAbortExecute() != 0;
#endif
}

}

void Task::Begin(const char* phase, double begin, double end)
{
  const double length = this->Last - this->First;
  this->Done = std::max(this->Done, this->First + begin * length);
  this->End = this->First + end * length;
  this->Filter->SetProgressText(phase);
  this->Tell();
}

Task Task::Part(double begin, double end) const
{
  Task part(*this);
  const double length = this->Last - this->First;
  part.First = this->First + begin * length;
  part.Last = this->First + end * length;
  part.Done = part.First;
  part.End = part.First;
  return part;
}

isodiamond::Progress Task::Report()
{
  return [this](const char* phase, double begin, double end) { this->Begin(phase, begin, end); };
}

void Task::Tell()
{
  this->Filter->UpdateProgress(this->Done);
  this->Told = Clock::now();
  if (IsAborted(this->Filter))
  {
    throw Aborted();
  }
}

isodiamond::ParallelFor Task::For()
{
  return [this, run = SMPFor()](std::int64_t count, std::int64_t grain,
           const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    const int workers = vtkSMPTools::GetEstimatedNumberOfThreads();
    std::atomic<std::int64_t> next(0);
    for (std::int64_t done = 0; done < count;)
    {
      const Clock::time_point start = Clock::now();
      const Clock::time_point end = start + BatchLength;
      run(count - done > grain ? workers : 1, 1,
        [&](std::int64_t first, std::int64_t last)
        {
          for (std::int64_t worker = first; worker < last; ++worker)
          {
            WorkUntil(end, count, grain, next, body);
          }
        });
      const std::int64_t before = done;
      done = std::min(next.load(), count);
      // How many loops a phase has is not known: each takes half of what is left, or less if it is
      // short, as there may be thousands.
      const std::chrono::duration<double> taken = Clock::now() - start;
      const double part =
        std::min(0.5 * static_cast<double>(done - before) / count, taken / LongPhase);
      this->Done += part * (this->End - this->Done);
      if (Clock::now() - this->Told > BatchLength)
      {
        this->Tell();
      }
    }
  };
}

void ReportException(vtkAlgorithm* filter) noexcept
{
  try
  {
    Report(filter);
  }
  catch (const std::bad_alloc&)
  {
    // No memory even to say so. VTK's pipeline expects no exceptions.
  }
}

}
