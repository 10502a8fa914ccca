// SPDX-License-Identifier: BSD-3-Clause
#ifndef FaultInjection_h
#define FaultInjection_h

#include <atomic>
#include <limits>

/** Allocations that fail. Who links this has its operator new and malloc; for glibc. */
namespace test
{

constexpr long Never = std::numeric_limits<long>::max();

/** Makes allocations fail, from one of them on, while it is armed. */
class Fault
{
public:
  /** @param first the first that fails @param count how many do */
  void Arm(long first, long count)
  {
    this->First = first;
    this->Count = count;
    this->Seen = 0;
    this->Armed = true;
  }
  bool IsArmed() const { return this->Armed; }
  void Disarm() { this->Armed = false; }

  bool FailsNext()
  {
    if (!this->Armed)
    {
      return false;
    }
    const long number = this->Seen++;
    return number >= this->First && number - this->First < this->Count;
  }
  long NumberSeen() const { return this->Seen; }

private:
  std::atomic<bool> Armed{ false };
  std::atomic<long> Seen{ 0 };
  std::atomic<long> First{ Never };
  std::atomic<long> Count{ 0 };
};

/** operator new as called by the filters: VTK itself breaks where its own fails. */
extern Fault OfNew;
/** malloc and realloc of many bytes, called by anyone: VTK's arrays. */
extern Fault OfMalloc;

/** Whether it is known which calls are the filters'. */
bool KnowsFilters();

}

#endif
