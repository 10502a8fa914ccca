// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsodiamondTask.h"

#include "vtkIsodiamondThreads.h"

#include "vtkVersion.h"

#include <algorithm>

namespace vtkIsodiamond
{
namespace
{

using Clock = std::chrono::steady_clock;

constexpr double BatchSeconds = 0.03;
/** The first batch: a batch has to wait for all threads, and most loops are short; but where a
 * single step is worth a thread, few are long enough. */
std::int64_t FirstBatch(std::int64_t grain)
{
  return grain > 1 ? 64 * grain : 4;
}

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
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
    std::int64_t batch = FirstBatch(grain);
    for (std::int64_t begin = 0; begin < count;)
    {
      const std::int64_t size = std::min(batch, count - begin);
      const Clock::time_point start = Clock::now();
      run(size, grain,
        [&](std::int64_t first, std::int64_t last) { body(begin + first, begin + last); });
      begin += size;
      // How many loops a phase has is not known: each takes half of what is left.
      this->Done += 0.5 * (this->End - this->Done) * static_cast<double>(size) / count;
      if (SecondsSince(this->Told) > BatchSeconds)
      {
        this->Tell();
      }
      const double factor = BatchSeconds / std::max(SecondsSince(start), 1e-6);
      batch = std::max(grain,
        static_cast<std::int64_t>(std::clamp(factor, 0.25, 2.0) * static_cast<double>(batch)));
    }
  };
}

void HandleException(vtkAlgorithm* filter, vtkDataObject* output)
{
  output->Initialize();
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

}
