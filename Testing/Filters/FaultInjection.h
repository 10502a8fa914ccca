// SPDX-License-Identifier: BSD-3-Clause
#ifndef FaultInjection_h
#define FaultInjection_h

#include <atomic>
#include <limits>

/** Allocations that fail. A program that links this gets its operator new and malloc; for glibc. */
namespace test
{

constexpr long Never = std::numeric_limits<long>::max();

/** While armed, makes one or more allocations in a row fail. */
class Fault
{
public:
  /** @param first number of the first that fails, from 0 @param count how many fail */
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

/** operator new when the filters call it: VTK itself breaks where its own calls fail. */
extern Fault OfNew;
/** malloc and realloc of many bytes, whoever calls them: for VTK's arrays. */
extern Fault OfMalloc;

/** Whether it is known which calls are the filters'. */
bool KnowsFilters();

}

#endif
