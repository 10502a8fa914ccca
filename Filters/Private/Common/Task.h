// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Task_h
#define vtkIsodiamond_Task_h

#include "Field/Parallel.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"

#include <chrono>
#include <exception>
#include <new>
#include <utility>

namespace vtkIsodiamond
{

/** Thrown where a filter's work ends because its user asked for that. */
struct Aborted : std::exception
{
  const char* what() const noexcept override { return "aborted"; }
};

/**
 * Work of a filter that its user can watch and stop. Its phases have names, and a part of the whole
 * each; its loops run in batches of about 30 ms, after which all threads wait. Then progress is
 * reported and a request to abort checked for, both in the thread that runs the filter: observers
 * may touch what they like. How loops are cut does not change results (see Parallel.h).
 */
class Task
{
public:
  explicit Task(vtkAlgorithm* filter)
    : Filter(filter)
  {
  }

  /** Begins the next phase, from begin until end of the whole, 0 to 1. @throws Aborted */
  void Begin(const char* phase, double begin, double end);

  /** A task that is a part of this one. */
  Task Part(double begin, double end) const;

  /** Loops of this task, which must outlive them. @throws Aborted */
  isodiamond::ParallelFor For();

  /** The core's progress, as progress of this task, which must outlive the result. */
  isodiamond::Progress Report();

private:
  void Tell();

  vtkAlgorithm* Filter;
  double First = 0.0; ///< the task's part of the whole
  double Last = 1.0;
  double Done = 0.0; ///< of the whole
  double End = 0.0;  ///< of the phase
  std::chrono::steady_clock::time_point Told;
};

/** Parts of a task for work that is repeated nobody knows how often: each time it gets the same
 * part of what is left. */
class Rounds
{
public:
  /** @param whole must outlive it @param begin where the first one begins, 0 to 1 */
  Rounds(const Task& whole, double begin, double part)
    : Whole(whole)
    , Done(begin)
    , PartOfRest(part)
  {
  }

  Task Next()
  {
    const double begin =
      std::exchange(this->Done, this->Done + this->PartOfRest * (1.0 - this->Done));
    return this->Whole.Part(begin, this->Done);
  }

private:
  const Task& Whole;
  double Done;
  double PartOfRest;
};

/** To be called within a catch: tells a filter's user what went wrong, unless it was an abort. No
 *  exception leaves it. */
void ReportException(vtkAlgorithm* filter) noexcept;

/** Runs work(task) of a filter's execution. @return false after an error; the output is then
 *  empty */
template <typename Work>
bool Succeeds(vtkAlgorithm* filter, vtkDataObject* output, Work&& work)
{
  try
  {
    Task task(filter);
    work(task);
    return true;
  }
  catch (...)
  {
    output->Initialize();
    ReportException(filter);
    return false;
  }
}

/** The same. @return what RequestData returns: a failed execution is one with an error and an empty
 *  output */
template <typename Work>
int Execute(vtkAlgorithm* filter, vtkDataObject* output, Work&& work)
{
  Succeeds(filter, output, std::forward<Work>(work));
  return 1;
}

}

#endif
