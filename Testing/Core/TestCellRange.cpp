// SPDX-License-Identifier: BSD-3-Clause
// Ranges of a mesh's cells: those cells of the whole mesh, and the points that they use, whatever
// the range.
#include "Mesh/IntervalExtraction.h"
#include "Mesh/SurfaceExtraction.h"
#include "RandomTestTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

using namespace isodiamond;

namespace
{

/** What a range is compared by: cells with whole points, and the points. */
struct Range
{
  std::vector<std::vector<float>> Points; ///< position, number among those stored, surface
  std::vector<std::vector<std::int32_t>> Cells;
  std::vector<std::int8_t> Levels;
};

/** Some cells, picked from the whole mesh by hand. */
Range Picked(const Range& whole, const CellRange& cells)
{
  Range range;
  std::map<std::int32_t, std::int32_t> newIds; // in the order of the whole
  for (std::int64_t i = cells.First; i < cells.Last; ++i)
  {
    for (const std::int32_t id : whole.Cells[i])
    {
      newIds[id] = 0;
    }
  }
  for (auto& [id, newId] : newIds)
  {
    newId = static_cast<std::int32_t>(range.Points.size());
    range.Points.push_back(whole.Points[id]);
  }
  for (std::int64_t i = cells.First; i < cells.Last; ++i)
  {
    range.Cells.push_back(whole.Cells[i]);
    for (std::int32_t& id : range.Cells.back())
    {
      id = newIds.at(id);
    }
    range.Levels.push_back(whole.Levels[i]);
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

/** @param cells null for all of them, as they are without a range
 *  @param write (cells, ids, levels) */
template <int Size, typename Extraction, typename Write>
Range Written(
  Extraction& extraction, const CellRange& all, const CellRange* cells, const Write& write)
{
  const CellRange& written = cells != nullptr ? *cells : all;
  Range range;
  std::vector<std::int32_t> ids(Size * written.Count());
  range.Levels.resize(written.Count());
  write(written, ids.data(), range.Levels.data());
  if (cells != nullptr)
  {
    extraction.KeepPointsOf(ids.data(), Size * written.Count());
  }
  range.Cells = CellsOf(ids, Size);
  ReadPoints(extraction, range);
  return range;
}

Range WrittenSurface(
  const RefinedSet& refined, const CellRange* cells, const ParallelFor& parallelFor)
{
  SurfaceExtraction extraction(refined, parallelFor);
  return Written<3>(extraction, { 0, extraction.TriangleCount() }, cells,
    [&](const CellRange& range, std::int32_t* ids, std::int8_t* levels)
    { extraction.WriteTriangles(range, false, ids, levels); });
}

Range WrittenVolume(
  const RefinedSet& refined, const CellRange* cells, const ParallelFor& parallelFor)
{
  IntervalExtraction extraction(refined, parallelFor);
  return Written<4>(extraction, { 0, extraction.TetrahedronCount() }, cells,
    [&](const CellRange& range, std::int32_t* ids, std::int8_t* levels)
    { extraction.WriteTetrahedra(range, false, ids, levels); });
}

void Check(std::uint32_t seed)
{
  test::Random random(seed);
  const test::RandomSamples field(random, 40, 6000);
  const Isoregion region = test::RandomRegion(random, field);
  SCOPED_TRACE(test::Describe(field, region));
  const BuildOptions options = test::RandomOptions(random, field.Dimensions);
  const test::Built built(
    BuildIsodiamonds(Model::Minimal, field.View(), region, SerialFor, options), SerialFor);
  const ParallelFor threads = test::ThreadedFor(3);
  for (const Query& query : { Query{}, test::RandomQuery(random, *built.Hierarchy, options.World) })
  {
    const RefinedSet refined(*built.Hierarchy, query, SerialFor);
    const auto written = [&](const CellRange* cells, const ParallelFor& parallelFor)
    {
      return region.IsVolume() ? WrittenVolume(refined, cells, parallelFor)
                               : WrittenSurface(refined, cells, parallelFor);
    };
    const Range whole = written(nullptr, SerialFor);
    const int count = static_cast<int>(whole.Cells.size());
    for (int i = 0; i < 4; ++i)
    {
      CellRange cells = { test::Pick(random, count + 1), test::Pick(random, count + 1) };
      cells = { std::min(cells.First, cells.Last), std::max(cells.First, cells.Last) };
      const Range range = written(&cells, threads);
      const Range expected = Picked(whole, cells);
      ASSERT_EQ(range.Cells, expected.Cells) << cells.First << " to " << cells.Last;
      ASSERT_EQ(range.Points, expected.Points) << cells.First << " to " << cells.Last;
      ASSERT_EQ(range.Levels, expected.Levels) << cells.First << " to " << cells.Last;
    }
  }
}

}

TEST(CellRange, IsThatOfTheWholeMesh)
{
  test::ForRandomSeeds(Check);
}
