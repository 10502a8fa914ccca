// SPDX-License-Identifier: BSD-3-Clause
#include "Bars.h"

#include "Measurement.h"
#include "PaperFigures.h"

#include <algorithm>

namespace benchmark
{
namespace
{

/** Collects bars of one volume at a time; bars without a measured figure are left out. */
class Judge
{
public:
  explicit Judge(std::vector<Bar>& bars)
    : Bars(bars)
  {
  }

  void At(const std::string& where) { this->Where = where; }
  void AtMost(int number, const std::string& what, double measured, double limit)
  {
    this->Add({ number, what, this->Where, measured, limit, true });
  }
  void AtLeast(int number, const std::string& what, double measured, double limit)
  {
    this->Add({ number, what, this->Where, measured, limit, false });
  }

private:
  void Add(const Bar& bar)
  {
    if (std::isfinite(bar.Measured))
    {
      this->Bars.push_back(bar);
    }
  }

  std::vector<Bar>& Bars;
  std::string Where;
};

double Time(const Table& table, const std::string& contestant, double tolerance = NAN)
{
  return table.Get(contestant, "milliseconds", tolerance);
}

/** The time of extraction to a tenth by the metric whose count of triangles simplification has to
 *  match: distance, if it was measured. */
double TenthTime(const Table& table)
{
  const double time = Time(table, "MI extract a tenth, distance");
  return std::isfinite(time) ? time : Time(table, "MI extract a tenth, field");
}

/** 1: extraction at tolerance 0, by the one-step filter without scalars and normals. */
void JudgeExtraction(const VolumeResult& volume, double bandwidth, Judge& judge)
{
  const std::string ours = "one step, new tolerance";
  const Table& table = volume.Isosurface;
  const double time = Time(table, ours);
  // A surface of fewer triangles than a twentieth of the samples counts as sparse.
  const bool isSparse = table.Get("vtkFlyingEdges3D", "cells") < 0.05 * volume.SampleCount();
  judge.AtMost(1, std::string("extraction / flying edges, ") + (isSparse ? "sparse" : "dense"),
    time / Time(table, "vtkFlyingEdges3D"), isSparse ? 0.25 : 1.0);
  judge.AtMost(1, "ns a triangle", 1e6 * time / table.Get(ours, "cells"), 30.0);
  // Two threads gain either enough or all that the memory's bandwidth allows.
  constexpr double enough = 1.6;
  const double twoThreads = Time(table, ours + ", 2 threads");
  const double gain = time / twoThreads;
  const double bytes = table.Get(ours, "output bytes") + table.Get("MI build, field", "bytes");
  const double used = bytes / (twoThreads / 1000.0) / bandwidth;
  if (gain >= enough || gain / enough >= used / 0.8)
  {
    judge.AtLeast(1, "speed-up by two threads", gain, enough);
  }
  else
  {
    judge.AtLeast(1, "hierarchy + output bytes by two threads / bandwidth", used, 0.8);
  }
}

/** 2: a tenth of the triangles. */
void JudgeTenth(const VolumeResult& volume, Judge& judge)
{
  const Table& table = volume.Isosurface;
  for (const std::string metric : { "field", "distance" })
  {
    judge.AtMost(2, "a tenth of the triangles / all, " + metric,
      Time(table, "MI extract a tenth, " + metric) / Time(table, "MI extract, " + metric, 0.0),
      0.125);
  }
  judge.AtMost(2, "new tolerance in one step / extraction",
    Time(table, "one step, new tolerance, a tenth") / TenthTime(table), 1.1);
}

/** 3: contouring and simplification to the same number of triangles. */
void JudgeSimplification(const VolumeResult& volume, Judge& judge)
{
  const Table& table = volume.Isosurface;
  const double ours = TenthTime(table);
  judge.AtLeast(3, "contour + meshoptimizer / extraction of a tenth",
    Time(table, "flying edges + meshopt_simplify") / ours, 20.0);
  judge.AtLeast(3, "contour + quadric decimation / extraction of a tenth",
    Time(table, "flying edges + vtkQuadricDecimation") / ours, 300.0);
}

/** 4: bytes. */
void JudgeBytes(const VolumeResult& volume, Shape shape, Judge& judge)
{
  const bool isSurface = shape == Shape::Isosurface;
  const std::string of = isSurface ? ", isosurface" : ", interval volume";
  const PaperFigures paper = FindPaperFigures(volume, shape);
  judge.AtMost(4, "bytes of MI / 12 (m_a + m_c) + v_i + 2" + of, paper.MIBytes / paper.MIFormula,
    isSurface ? 0.5 : 0.55);
  judge.AtMost(4, "bytes of RI / 12 (m_a + m_r) + v_i + 2" + of, paper.RIBytes / paper.RIFormula,
    isSurface ? 0.5 : 0.55);
  judge.AtLeast(
    4, "indexed mesh / MI" + of, paper.MeshBytes / paper.MIBytes, isSurface ? 9.0 : 17.0);
  judge.AtMost(4, "MI / RI in the paper's encoding (about)" + of, paper.MIFormula / paper.RIFormula,
    isSurface ? 0.65 : 0.78);
  const Table& table = volume.Of(shape);
  judge.AtMost(4, "GetStorageSize off the sum of the arrays" + of,
    std::abs(paper.MIBytes - table.Get("MI build, field", "bytes of arrays")), 0.0);
}

/** 5: builds. */
void JudgeBuilds(const VolumeResult& volume, Judge& judge)
{
  const Table& table = volume.Isosurface;
  const double flyingEdges = Time(table, "vtkFlyingEdges3D");
  const double samples = volume.SampleCount();
  for (const std::string metric : { "field", "distance" })
  {
    const std::string build = "MI build, " + metric;
    judge.AtMost(5, build + " / flying edges", Time(table, build) / flyingEdges,
      metric == "field" ? 6.0 : 12.0);
    judge.AtMost(5, build + ": (input + peak memory) / (1.25 input as floats + 2 results)",
      (volume.BytesOfSample * samples + table.Get(build, "peak bytes")) /
        (1.25 * 4.0 * samples + 2.0 * table.Get(build, "bytes")),
      1.0);
  }
  judge.AtMost(5, "HD build / flying edges", Time(table, "HD build, field") / flyingEdges, 16.0);
  judge.AtMost(5, "bytes of HD a voxel", table.Get("HD build, field", "bytes") / samples, 8.0);
}

/** 9: what a first Apply shows, against ParaView's Contour. */
void JudgeFirstApply(const VolumeResult& volume, Judge& judge)
{
  const Table& table = volume.Isosurface;
  judge.AtMost(9, "first full resolution in one step / vtkContourFilter",
    Time(table, "one step, full resolution") / Time(table, "vtkContourFilter"), 1.0);
}

/** 6: interval volumes against IsoVolume. */
void JudgeIntervalVolume(const VolumeResult& volume, Judge& judge)
{
  const Table& table = volume.IntervalVolume;
  const std::string clip = "vtkTableBasedClipDataSet twice";
  for (const std::string metric : { "field", "distance" })
  {
    const std::string ours = "one step, " + metric;
    judge.AtLeast(
      6, "IsoVolume / build + extraction, " + metric, Time(table, clip) / Time(table, ours), 5.0);
    judge.AtMost(6, "peak memory of build + extraction / IsoVolume, " + metric,
      table.Get(ours, "peak bytes") / table.Get(clip, "peak bytes"), 0.25);
  }
  judge.AtLeast(
    6, "IsoVolume / extraction", Time(table, clip) / Time(table, "MI extract, field", 0.0), 30.0);
}

/** 7: growth of extraction from one volume to another of the same field at twice the size. */
void JudgeGrowth(const VolumeResult& small, const VolumeResult& large, Judge& judge)
{
  const std::string ours = "one step, new tolerance";
  const auto ratio = [&](const std::string& figure)
  { return large.Isosurface.Get(ours, figure) / small.Isosurface.Get(ours, figure); };
  judge.AtMost(7, "growth of time / of triangles, from half the size",
    ratio("milliseconds") / ratio("cells"), 1.3);
}

/** The median front of MI relative to HD at tolerances above 0 for which MI has one. */
double RelativeFront(const Table& table)
{
  std::vector<double> ratios;
  for (const Row& row : table.Rows)
  {
    if (row.Contestant == "HD extract, field" && row.Tolerance.Value > 0.0)
    {
      ratios.push_back(
        table.Get("MI extract, field", "front", row.Tolerance.Value) / row.Figures.Get("front"));
    }
  }
  return Median(ratios);
}

/** 8: figure 15, where the paper has numbers. */
void JudgeFigure15(const VolumeResult& volume, Shape shape, Judge& judge)
{
  const Table& table = volume.Of(shape);
  const bool isSurface = shape == Shape::Isosurface;
  const std::string of = isSurface ? ", isosurface" : ", interval volume";
  judge.AtMost(8, "time of MI / HD at tolerance 0" + of,
    Time(table, "MI extract, field", 0.0) / Time(table, "HD extract, field", 0.0), 0.5);
  judge.AtMost(8, "front of MI / HD at tolerances above 0 (about)" + of, RelativeFront(table),
    isSurface ? 0.25 : 0.5);
}

bool IsTwice(const VolumeResult& large, const VolumeResult& small)
{
  return large.Name == small.Name && large.Dimensions[0] == 2 * small.Dimensions[0];
}

}

std::vector<Bar> JudgeBars(const Report& report)
{
  std::vector<Bar> bars;
  Judge judge(bars);
  for (const VolumeResult& volume : report.Volumes)
  {
    judge.At(volume.Title());
    JudgeExtraction(volume, report.MemoryBandwidth, judge);
    JudgeTenth(volume, judge);
    JudgeSimplification(volume, judge);
    JudgeBuilds(volume, judge);
    JudgeIntervalVolume(volume, judge);
    JudgeFirstApply(volume, judge);
    for (const Shape shape : { Shape::Isosurface, Shape::IntervalVolume })
    {
      JudgeBytes(volume, shape, judge);
      JudgeFigure15(volume, shape, judge);
    }
    for (const VolumeResult& other : report.Volumes)
    {
      if (IsTwice(volume, other))
      {
        JudgeGrowth(other, volume, judge);
      }
    }
  }
  std::stable_sort(
    bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.Number < b.Number; });
  return bars;
}

}
