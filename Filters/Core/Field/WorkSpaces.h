// SPDX-License-Identifier: BSD-3-Clause
#ifndef isodiamond_WorkSpaces_h
#define isodiamond_WorkSpaces_h

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace isodiamond
{

/**
 * Spaces that the ranges of a parallel loop work in and leave behind: one for each thread that runs
 * at a time, made when there is none to spare, used by one range after the other.
 *
 * What a range finds in its space must not affect its results: threads decide which one it gets.
 */
template <typename Space>
class WorkSpaces
{
public:
  explicit WorkSpaces(std::function<std::unique_ptr<Space>()> make)
    : Make(std::move(make))
  {
  }

  /** Calls use(space) with a space that nobody else uses meanwhile. Threads may call it
   *  concurrently. */
  template <typename Use>
  void Lend(Use&& use)
  {
    std::unique_ptr<Space> space = this->Take();
    use(*space);
    this->GiveBack(std::move(space)); // after an exception it is not needed any more
  }

private:
  std::unique_ptr<Space> Take()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Access);
      if (!this->Spare.empty())
      {
        std::unique_ptr<Space> space = std::move(this->Spare.back());
        this->Spare.pop_back();
        return space;
      }
    }
    return this->Make();
  }

  void GiveBack(std::unique_ptr<Space> space)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    this->Spare.push_back(std::move(space));
  }

  std::function<std::unique_ptr<Space>()> Make;
  std::mutex Access;
  std::vector<std::unique_ptr<Space>> Spare;
};

}

#endif
