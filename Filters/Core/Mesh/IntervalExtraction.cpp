// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/IntervalExtraction.h"

#include "Mesh/CellWriting.h"
#include "Mesh/PatchPoints.h"
#include "Mesh/VertexWindow.h"
#include "Patches/IntervalCases.h"
#include "Patches/IntervalPatches.h"
#include "Patches/SurfacePatch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isodiamond
{
namespace
{

/** The most points and tetrahedra that a case of IntervalPatches() has. */
constexpr int MaximumPoints = 8;
constexpr int MaximumTetrahedra = 6;

/** A case of IntervalPatches() with every point listed once. */
struct PatchTable
{
  /** A point: where in AgePointPlaces it is, and how many bits after that. */
  struct TablePoint
  {
    std::uint8_t Index = 0;
    std::uint8_t Bits = 0;
  };

  int PointCount = 0;
  int TetrahedronCount = 0;
  std::array<TablePoint, MaximumPoints> Points{};
  std::array<std::array<std::uint8_t, 4>, MaximumTetrahedra> Tetrahedra{}; ///< indices of Points
};

PatchTable::TablePoint MakeTablePoint(const PatchPoint& point)
{
  PatchTable::TablePoint result;
  result.Index = static_cast<std::uint8_t>(
    point.IsVertex() ? point.Younger() : EdgeByAge(point.Younger(), point.Older()));
  result.Bits = static_cast<std::uint8_t>(
    DiamondPoints::Isovertex(point.Surface(), 0) - DiamondPoints::Isovertex(0, 0));
  return result;
}

PatchTable MakePatchTable(const std::vector<PatchTetrahedron>& patch)
{
  PatchTable table;
  std::vector<PatchPoint> points;
  for (const PatchTetrahedron& tetrahedron : patch)
  {
    std::array<std::uint8_t, 4>& corners = table.Tetrahedra.at(table.TetrahedronCount++);
    for (int i = 0; i < 4; ++i)
    {
      const auto point = std::find(points.begin(), points.end(), tetrahedron[i]);
      corners[i] = static_cast<std::uint8_t>(point - points.begin());
      if (point == points.end())
      {
        points.push_back(tetrahedron[i]);
        table.Points.at(table.PointCount++) = MakeTablePoint(tetrahedron[i]);
      }
    }
  }
  return table;
}

/** By case. */
using PatchTables = std::array<PatchTable, 81>;

const PatchTables& AllPatchTables()
{
  static const PatchTables tables = []
  {
    PatchTables all;
    std::transform(IntervalPatches().begin(), IntervalPatches().end(), all.begin(), MakePatchTable);
    return all;
  }();
  return tables;
}

/** Writes the tetrahedra of one brick's leaves, one after the other. */
template <typename Id>
class TetrahedronWriter
{
public:
  TetrahedronWriter(const IsodiamondHierarchy& hierarchy, const VertexWindow& window, bool mirrored,
    Id* connectivity, std::int16_t* levels)
    : Hierarchy(hierarchy)
    , Window(window)
    , Tables(AllPatchTables())
    , Places(PointsByAge())
    , Mirrored(mirrored)
    , Next(connectivity)
    , NextLevel(levels)
  {
  }

  void Write(const LeafParent& parent)
  {
    const IntervalCases cases(this->Hierarchy, parent.Rank, parent.Type);
    const int level = this->Hierarchy.SampleGrid().Depth() - 1 - parent.LeafScale();
    const DiamondPoints* own = this->Window.At(parent.At.Position);
    const auto& places = this->Places[parent.Type];
    parent.ForEachLeaf(
      [&](int half)
      {
        const PatchTable& patch = this->Tables[cases(half)];
        std::array<Id, MaximumPoints> ids;
        for (int i = 0; i < patch.PointCount; ++i)
        {
          const PatchPointPlace& place = places[half][patch.Points[i].Index];
          ids[i] = static_cast<Id>(own[place.Distance].Id(place.Bit + patch.Points[i].Bits));
        }
        const bool flip = parent.Shape().HalfTetrahedra[half].OddByAge != this->Mirrored;
        for (int i = 0; i < patch.TetrahedronCount; ++i)
        {
          const std::array<std::uint8_t, 4>& corners = patch.Tetrahedra[i];
          this->Next[0] = ids[corners[0]];
          this->Next[1] = ids[corners[1]];
          this->Next[2] = ids[corners[flip ? 3 : 2]];
          this->Next[3] = ids[corners[flip ? 2 : 3]];
          this->Next += 4;
          *this->NextLevel++ = static_cast<std::int16_t>(level);
        }
      });
  }

private:
  const IsodiamondHierarchy& Hierarchy;
  const VertexWindow& Window;
  const PatchTables& Tables;
  const PatchPointTable<AgePointPlaces>& Places;
  bool Mirrored;
  Id* Next;
  std::int16_t* NextLevel;
};

}

int CountTetrahedra(const IsodiamondHierarchy& hierarchy, const LeafParent& parent)
{
  const PatchTables& tables = AllPatchTables();
  const IntervalCases cases(hierarchy, parent.Rank, parent.Type);
  int tetrahedra = 0;
  parent.ForEachLeaf([&](int half) { tetrahedra += tables[cases(half)].TetrahedronCount; });
  return tetrahedra;
}

IntervalExtraction::IntervalExtraction(
  const RefinedSet& refined, const ParallelFor& parallelFor, const MeshShare& share)
  : MeshExtraction({ refined, share, Grid::MaximumDepth, parallelFor,
      [&](const LeafParent& parent) { return CountTetrahedra(refined.Hierarchy(), parent); } })
{
}

template <typename Value, typename Side>
void IntervalExtraction::WriteValues(Value* values, Side* surfaces) const
{
  const Isoregion& region = this->Passes.Hierarchy().Region();
  std::array<Value, 2> isovalues{};
  for (int surface = 0; surface < 2; ++surface)
  {
    const double isovalue = region.Isovalue(surface);
    isovalues[surface] = std::isfinite(isovalue) ? static_cast<Value>(isovalue)
                                                 : std::numeric_limits<Value>::quiet_NaN();
  }
  std::visit(
    [&](const auto& insideValues)
    {
      this->ForEachPoint(
        [&, inside = insideValues.Pointer()](const MeshPoint& point)
        {
          surfaces[point.Id] = static_cast<Side>(point.Surface);
          values[point.Id] = point.Surface == 0 ? static_cast<Value>(inside[point.Stored])
                                                : isovalues[point.Surface < 0 ? 0 : 1];
        });
    },
    this->Passes.Hierarchy().InsideValues());
}

template <typename Id>
void IntervalExtraction::WriteTetrahedra(
  const CellRange& range, bool mirrored, Id* connectivity, std::int16_t* levels) const
{
  WriteCellsOf<4>(this->Passes, range, connectivity, levels,
    [&](std::int64_t brick, Id* ids, std::int16_t* levelsOfIds)
    {
      const VertexWindow window(this->Passes, brick);
      TetrahedronWriter<Id> writer(this->Passes.Hierarchy(), window, mirrored, ids, levelsOfIds);
      this->Passes.ForEachLeafParent(
        brick, [&](const LeafParent& parent) { writer.Write(parent); });
    });
}

template void IntervalExtraction::WriteValues(float*, std::int8_t*) const;
template void IntervalExtraction::WriteValues(double*, std::int8_t*) const;
template void IntervalExtraction::WriteValues(float*, std::int16_t*) const;
template void IntervalExtraction::WriteValues(double*, std::int16_t*) const;
template void IntervalExtraction::WriteTetrahedra(
  const CellRange&, bool, std::int32_t*, std::int16_t*) const;
template void IntervalExtraction::WriteTetrahedra(
  const CellRange&, bool, long long*, std::int16_t*) const;

}
