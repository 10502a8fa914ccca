// SPDX-License-Identifier: BSD-3-Clause
// Searching for several steps at once gives what searching for each in its turn gives.
#include "Stuffing/SearchAhead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

using namespace isodiamond;

namespace
{

/** A row of points, of which four after each other are a tetrahedron. */
class Row
{
public:
  explicit Row(std::size_t count)
    : Stars(count, count - 3, CornersOf)
  {
  }
  static std::array<std::uint32_t, 4> CornersOf(std::size_t tetrahedron)
  {
    const auto first = static_cast<std::uint32_t>(tetrahedron);
    return { first, first + 1, first + 2, first + 3 };
  }
  CellsAtPoints::Cells StarOf(std::uint32_t point) const { return this->Stars[point]; }

private:
  CellsAtPoints Stars;
};

/** Adds to the value of a point those around it, if their sum is odd. */
class Sums
{
public:
  explicit Sums(std::size_t count)
    : Mesh(count)
    , Values(count)
  {
    std::minstd_rand random(count);
    std::generate(this->Values.begin(), this->Values.end(), [&] { return random() / 16; });
  }

  std::uint32_t SumAround(std::uint32_t point)
  {
    ++this->SearchCount;
    std::uint32_t sum = 0;
    for (const std::uint32_t tetrahedron : this->Mesh.StarOf(point))
    {
      for (const std::uint32_t corner : this->Mesh.CornersOf(tetrahedron))
      {
        sum += this->Values[corner];
      }
    }
    return sum;
  }
  void Add(std::uint32_t point, std::uint32_t sum)
  {
    if (sum % 2 != 0)
    {
      this->Values[point] += sum;
      this->Touched.BeginChange();
      this->Touched.Touch(this->Mesh, this->Mesh.StarOf(point));
    }
  }

  void RunAhead(const std::vector<std::uint32_t>& order, std::size_t atOnce)
  {
    SearchAhead(
      SerialFor, order.size(), atOnce, this->Touched,
      [&](std::size_t i) { return this->SumAround(order[i]); },
      [&](std::size_t i, std::uint32_t /*sum*/, int changes)
      { return this->Touched.IsTouched(order[i], changes); },
      [&](std::size_t i, std::uint32_t sum) { this->Add(order[i], sum); });
  }

  Row Mesh;
  std::vector<std::uint32_t> Values;
  TouchedPoints Touched;
  int SearchCount = 0;
};

}

TEST(SearchAhead, DoesWhatSearchingInTurnDoes)
{
  constexpr std::size_t count = 500;
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), std::minstd_rand(7));

  Sums inTurn(count);
  for (const std::uint32_t point : order)
  {
    inTurn.Add(point, inTurn.SumAround(point));
  }
  ASSERT_GT(inTurn.Touched.Changes(), 100);
  ASSERT_LT(inTurn.Touched.Changes(), 400);
  for (const std::size_t atOnce : { std::size_t{ 1 }, std::size_t{ 7 }, std::size_t{ 64 }, count })
  {
    Sums ahead(count);
    ahead.RunAhead(order, atOnce);
    EXPECT_EQ(ahead.Values, inTurn.Values) << atOnce;
    EXPECT_EQ(ahead.Touched.Changes(), inTurn.Touched.Changes()) << atOnce;
  }
}

TEST(SearchAhead, SearchesAgainOnlyForWhatHasBeenTouched)
{
  constexpr std::size_t count = 500;
  std::vector<std::uint32_t> apart;
  for (std::uint32_t point = 0; point < count; point += 10)
  {
    apart.push_back(point);
  }
  Sums ahead(count);
  ahead.RunAhead(apart, count);
  EXPECT_GT(ahead.Touched.Changes(), 10);
  EXPECT_EQ(ahead.SearchCount, static_cast<int>(apart.size()));
}
