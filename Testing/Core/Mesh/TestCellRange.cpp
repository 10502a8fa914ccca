// SPDX-License-Identifier: BSD-3-Clause
// Ranges of a mesh's cells, and shares of the mesh, have these cells of the whole mesh, and the
// points that they use.
#include "Mesh/IntervalExtraction.h"
#include "Mesh/SurfaceExtraction.h"
#include "Tools/RandomTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <type_traits>

using namespace isodiamond;

namespace
{

/** What is compared of a range. */
struct Range
{
  std::vector<std::vector<float>> Points; ///< position, number among those stored, surface
  std::vector<std::vector<std::int32_t>> Cells;
  std::vector<std::int16_t> Levels;
};

/** Some cells and their points, picked from the whole mesh by hand. */
Range Picked(const Range& whole, const std::vector<CellRange>& ranges)
{
  Range range;
  for (const CellRange& cells : ranges)
  {
    for (std::int64_t i = cells.First; i < cells.Last; ++i)
    {
      range.Cells.push_back(whole.Cells[i]);
      range.Levels.push_back(whole.Levels[i]);
    }
  }
  std::map<std::int32_t, std::int32_t> newIds; // in the order of the whole
  for (const std::vector<std::int32_t>& cell : range.Cells)
  {
    for (const std::int32_t id : cell)
    {
      newIds[id] = 0;
    }
  }
  for (auto& [id, newId] : newIds)
  {
    newId = static_cast<std::int32_t>(range.Points.size());
    range.Points.push_back(whole.Points[id]);
  }
  for (std::vector<std::int32_t>& cell : range.Cells)
  {
    for (std::int32_t& id : cell)
    {
      id = newIds.at(id);
    }
  }
  return range;
}

std::vector<std::vector<std::int32_t>> CellsOf(const std::vector<std::int32_t>& ids, int size)
{
  std::vector<std::vector<std::int32_t>> cells;
  for (auto id = ids.begin(); id != ids.end(); id += size)
  {
    cells.emplace_back(id, id + size);
  }
  return cells;
}

template <typename Extraction>
void ReadPoints(const Extraction& extraction, Range& range)
{
  range.Points.resize(extraction.PointCount());
  extraction.ForEachPoint(
    [&](const MeshPoint& point)
    {
      EXPECT_TRUE(range.Points.at(point.Id).empty()) << "twice";
      range.Points[point.Id] = { static_cast<float>(point.Index[0]),
        static_cast<float>(point.Index[1]), static_cast<float>(point.Index[2]),
        static_cast<float>(point.Stored), static_cast<float>(point.Surface) };
    });
}

/** What to write of a mesh. */
struct Wanted
{
  MeshShare Share;
  std::optional<CellRange> Cells; ///< among all that are counted; if not set, the share's
  bool AreAllPointsKept = false;
};

/** @param write (cells, ids, levels) */
template <int Size, typename Extraction, typename Write>
Range Written(Extraction& extraction, const Wanted& wanted, const Write& write)
{
  const std::vector<CellRange> cells =
    wanted.Cells ? std::vector<CellRange>{ *wanted.Cells } : OwnCells(extraction.Dealt());
  Range range;
  const std::int64_t count = TotalOf(cells);
  std::vector<std::int32_t> ids(Size * count);
  range.Levels.resize(count);
  std::int64_t written = 0;
  for (const CellRange& some : cells)
  {
    write(some, ids.data() + Size * written, range.Levels.data() + written);
    written += some.Count();
  }
  if (!wanted.AreAllPointsKept)
  {
    extraction.KeepPointsOf(ids.data(), Size * count);
  }
  range.Cells = CellsOf(ids, Size);
  ReadPoints(extraction, range);
  return range;
}

/** @param use (extraction, corners of a cell, write) */
template <typename Use>
auto WithExtraction(
  const RefinedSet& refined, const MeshShare& share, const ParallelFor& parallelFor, const Use& use)
{
  if (refined.Hierarchy().Region().IsVolume())
  {
    IntervalExtraction extraction(refined, parallelFor, share);
    return use(extraction, std::integral_constant<int, 4>{},
      [&](const CellRange& range, std::int32_t* ids, std::int16_t* levels)
      { extraction.WriteTetrahedra(range, false, ids, levels); });
  }
  SurfaceExtraction extraction(refined, parallelFor, share);
  return use(extraction, std::integral_constant<int, 3>{},
    [&](const CellRange& range, std::int32_t* ids, std::int16_t* levels)
    { extraction.WriteTriangles(range, false, ids, levels); });
}

Range Written(const RefinedSet& refined, const Wanted& wanted, const ParallelFor& parallelFor)
{
  return WithExtraction(refined, wanted.Share, parallelFor,
    [&](auto& extraction, auto size, const auto& write)
    { return Written<size>(extraction, wanted, write); });
}

/** The cells of a share, by their numbers in the whole mesh. */
std::vector<CellRange> OwnCellsOfAll(
  const RefinedSet& refined, MeshShare share, const ParallelFor& parallelFor)
{
  share.WithIdsOfAll = true;
  return WithExtraction(refined, share, parallelFor,
    [](auto& extraction, auto, const auto&) { return OwnCells(extraction.Dealt()); });
}

void ExpectPicked(const Range& range, const Range& whole, const std::vector<CellRange>& cells)
{
  const Range expected = Picked(whole, cells);
  ASSERT_EQ(range.Cells, expected.Cells);
  ASSERT_EQ(range.Points, expected.Points);
  ASSERT_EQ(range.Levels, expected.Levels);
}

/** Each cell is in one share, and shares are the same whether all cells are counted or not. */
void ExpectShares(
  const RefinedSet& refined, const Range& whole, int count, const ParallelFor& parallelFor)
{
  std::vector<int> owners(whole.Cells.size());
  for (int number = 0; number <= count; ++number)
  {
    const MeshShare share{ number, count, false };
    const std::vector<CellRange> own = OwnCellsOfAll(refined, share, parallelFor);
    for (const CellRange& cells : own)
    {
      ASSERT_LE(cells.Last, static_cast<std::int64_t>(owners.size()));
      std::for_each(
        owners.begin() + cells.First, owners.begin() + cells.Last, [](int& owner) { ++owner; });
    }
    for (const bool withIdsOfAll : { false, true })
    {
      SCOPED_TRACE(testing::Message() << number << " of " << count << ' ' << withIdsOfAll);
      const Wanted wanted{ { number, count, withIdsOfAll }, {}, false };
      ASSERT_NO_FATAL_FAILURE(ExpectPicked(Written(refined, wanted, parallelFor), whole, own));
    }
  }
  ASSERT_EQ(owners, std::vector<int>(owners.size(), 1));
}

void Check(std::uint32_t seed)
{
  test::Random random(seed);
  const test::RandomSamples field(random, 40, 6000);
  const Isoregion region = test::RandomRegion(random, field);
  SCOPED_TRACE(test::Describe(field, region));
  const test::OwningOptions options = test::RandomOptions(random, field.Dimensions);
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options), SerialFor);
  const ParallelFor threads = test::ThreadedFor(3);
  for (const Query& query : { Query{}, test::RandomQuery(random, *built.Hierarchy, options.World) })
  {
    const RefinedSet refined(*built.Hierarchy, query, SerialFor);
    const Range whole = Written(refined, { {}, {}, true }, SerialFor);
    const int count = static_cast<int>(whole.Cells.size());
    for (int i = 0; i < 4; ++i)
    {
      CellRange cells = { test::Pick(random, count + 1), test::Pick(random, count + 1) };
      cells = { std::min(cells.First, cells.Last), std::max(cells.First, cells.Last) };
      ASSERT_NO_FATAL_FAILURE(
        ExpectPicked(Written(refined, { {}, cells, false }, threads), whole, { cells }));
    }
    ASSERT_NO_FATAL_FAILURE(ExpectShares(refined, whole, 1 + test::Pick(random, 9), threads));
  }
}

}

TEST(CellRange, IsThatOfTheWholeMesh)
{
  test::ForRandomSeeds(Check);
}
