// SPDX-License-Identifier: BSD-3-Clause
// Work spaces: each is used by one thread at a time, and no more are made than needed.
#include "Field/WorkSpaces.h"
#include "Tools/CoreTestTools.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

using namespace isodiamond;

namespace
{

struct Space
{
  std::atomic<bool> IsInUse{ false };
};

}

TEST(WorkSpaces, LendEachToOneThreadAtATime)
{
  std::atomic<int> made{ 0 };
  std::atomic<int> shared{ 0 };
  WorkSpaces<Space> spaces(
    [&]
    {
      ++made;
      return std::make_unique<Space>();
    });
  test::ThreadedFor(3)(200, 1,
    [&](std::int64_t, std::int64_t)
    {
      spaces.Lend(
        [&](Space& space)
        {
          shared += space.IsInUse.exchange(true) ? 1 : 0;
          std::this_thread::yield();
          space.IsInUse = false;
        });
    });
  EXPECT_EQ(shared, 0);
  EXPECT_GE(made, 1);
  EXPECT_LE(made, 3);
}

TEST(WorkSpaces, AreLeftAloneAfterAnException)
{
  int made = 0;
  WorkSpaces<int> spaces([&] { return std::make_unique<int>(made++); });
  EXPECT_THROW(spaces.Lend([](int&) { throw std::runtime_error("stopped"); }), std::runtime_error);
  spaces.Lend([](int& number) { EXPECT_EQ(number, 1) << "another one"; });
  spaces.Lend([](int& number) { EXPECT_EQ(number, 1) << "the same again"; });
}
