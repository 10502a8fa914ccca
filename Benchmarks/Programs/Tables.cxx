// SPDX-License-Identifier: BSD-3-Clause
#include "Tables.h"

#include "PaperFigures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace benchmark
{
namespace
{

/** With decimals; "-" for what was not measured. */
std::string Fixed(double value, int decimals)
{
  if (!std::isfinite(value))
  {
    return "-";
  }
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

/** With three decimals below 1, and fewer above: none from 100 on. */
std::string Short(double value)
{
  const double size = std::abs(value);
  return Fixed(value, size < 1.0 ? 3 : size < 10.0 ? 2 : size < 100.0 ? 1 : 0);
}

/** As short as it can be, with up to six significant digits. */
std::string Value(double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

std::string Interval(const std::array<double, 2>& ends)
{
  return "[" + Value(ends[0]) + ", " + Value(ends[1]) + "]";
}

/** A whole number, with separators. */
std::string Count(double value)
{
  std::string text = Fixed(value, 0);
  for (int at = static_cast<int>(text.size()) - 3; at > 0 && std::isfinite(value); at -= 3)
  {
    text.insert(at, ",");
  }
  return text;
}

std::string Megabytes(double bytes)
{
  return Short(bytes / 1e6);
}

void PrintRow(const std::vector<std::string>& cells, std::ostream& out)
{
  out << "|";
  for (const std::string& cell : cells)
  {
    out << " " << cell << " |";
  }
  out << "\n";
}

/** @param textColumns how many columns hold words; the others hold numbers */
void PrintHead(const std::vector<std::string>& titles, std::size_t textColumns, std::ostream& out)
{
  PrintRow(titles, out);
  for (std::size_t i = 0; i < titles.size(); ++i)
  {
    out << (i < textColumns ? "|---" : "|---:");
  }
  out << "|\n";
}

void PrintContestants(const Table& table, const std::string& reference, std::ostream& out)
{
  PrintHead({ "contestant", "tolerance", "ms", "x reference", "cells", "ns a cell", "bytes",
              "bytes a cell", "peak MB", "subdivided", "front" },
    2, out);
  const double unit = table.Get(reference, "milliseconds");
  const double fullCells = table.Get("MI extract, field", "cells", 0.0);
  for (const Row& row : table.Rows)
  {
    const auto figure = [&](const char* name) { return row.Figures.Get(name); };
    const double time = figure("milliseconds");
    PrintRow({ row.Contestant, row.Tolerance.Text(), Short(time), Short(time / unit),
               Count(figure("cells")), Short(1e6 * time / figure("cells")), Count(figure("bytes")),
               Short(figure("bytes") / fullCells), Megabytes(figure("peak bytes")),
               Count(figure("subdivided")), Count(figure("front")) },
      out);
  }
  out << "\n";
}

void PrintTable2Row(const VolumeResult& volume, Shape shape, std::ostream& out)
{
  const PaperFigures paper = FindPaperFigures(volume, shape);
  const std::string value =
    shape == Shape::Isosurface ? Value(volume.Isovalue) : Interval(volume.Isorange);
  PrintRow(
    { volume.Title(), value, Count(paper.Isovertices), Count(paper.Relevant), Count(paper.Creation),
      Count(paper.Active), Count(paper.Points), Count(paper.Cells), Count(paper.MIFormula),
      Count(paper.RIFormula), Count(paper.MIBytes), Count(paper.RIBytes), Count(paper.MeshBytes),
      Short(paper.RIFormula / paper.MIFormula), Short(paper.RIBytes / paper.MIBytes) },
    out);
}

void PrintFigure15Rows(const VolumeResult& volume, Shape shape, std::ostream& out)
{
  const Table& table = volume.Of(shape);
  for (auto row = table.Rows.rbegin(); row != table.Rows.rend(); ++row) // the largest first
  {
    if (row->Contestant != "HD extract, field")
    {
      continue;
    }
    std::vector<std::string> cells = { volume.Title(),
      shape == Shape::Isosurface ? "isosurface" : "interval volume", row->Tolerance.Text() };
    for (const char* figure : { "front", "milliseconds" })
    {
      const double ofHD = row->Figures.Get(figure);
      cells.push_back(figure == std::string("front") ? Count(ofHD) : Short(ofHD));
      for (const char* other : { "RI extract, field", "MI extract, field" })
      {
        cells.push_back(Short(table.Get(other, figure, row->Tolerance.Value) / ofHD));
      }
    }
    PrintRow(cells, out);
  }
}

}

void PrintVolume(const VolumeResult& volume, std::ostream& out)
{
  out << "## " << volume.Title() << ", " << volume.ScalarType << "\n\n";
  if (!volume.Isosurface.Rows.empty())
  {
    out << "Isosurface of " << Value(volume.Isovalue)
        << "; the reference is vtkFlyingEdges3D. Bytes a cell: of the full resolution's cells.\n\n";
    PrintContestants(volume.Isosurface, "vtkFlyingEdges3D", out);
  }
  if (!volume.IntervalVolume.Rows.empty())
  {
    out << "Interval volume of " << Interval(volume.Isorange)
        << "; the reference is vtkTableBasedClipDataSet twice (IsoVolume).\n\n";
    PrintContestants(volume.IntervalVolume, "vtkTableBasedClipDataSet twice", out);
  }
}

void PrintTable2(const Report& report, std::ostream& out)
{
  out << "## Table 2\n\nBytes of MI and RI in the paper's encoding and in ours, and of the indexed "
         "mesh.\n\n";
  PrintHead({ "volume", "value(s)", "v_i", "m_r", "m_c", "m_a", "v", "t", "MI, paper's",
              "RI, paper's", "MI, ours", "RI, ours", "mesh", "RI/MI, paper's", "RI/MI, ours" },
    2, out);
  for (const VolumeResult& volume : report.Volumes)
  {
    PrintTable2Row(volume, Shape::Isosurface, out);
    PrintTable2Row(volume, Shape::IntervalVolume, out);
  }
  out << "\n";
}

void PrintFigure15(const Report& report, std::ostream& out)
{
  out << "## Figure 15\n\nFront size and time of an extraction; of RI and MI relative to HD.\n\n";
  PrintHead(
    { "volume", "shape", "tolerance", "front of HD", "RI", "MI", "ms of HD", "RI", "MI" }, 3, out);
  for (const VolumeResult& volume : report.Volumes)
  {
    PrintFigure15Rows(volume, Shape::Isosurface, out);
    PrintFigure15Rows(volume, Shape::IntervalVolume, out);
  }
  out << "\n";
}

void PrintBars(const std::vector<Bar>& bars, std::ostream& out)
{
  const auto met =
    std::count_if(bars.begin(), bars.end(), [](const Bar& bar) { return bar.IsMet(); });
  out << "## What must hold: " << met << " of " << bars.size()
      << "\n\nDemanded of volumes of 256^3 samples or more; bold is what does not hold.\n\n";

  // A line for each demand, a column for each volume.
  std::vector<std::string> titles = { "bar", "what", "limit" };
  std::vector<std::vector<std::string>> lines;
  const auto add = [](std::vector<std::string>& list, const std::string& item)
  {
    const auto at = std::find(list.begin(), list.end(), item) - list.begin();
    if (at == static_cast<std::ptrdiff_t>(list.size()))
    {
      list.push_back(item);
    }
    return static_cast<std::size_t>(at);
  };
  for (const Bar& bar : bars)
  {
    add(titles, bar.Where);
  }
  std::vector<std::string> demands;
  for (const Bar& bar : bars)
  {
    const std::size_t line = add(demands, std::to_string(bar.Number) + bar.What);
    if (line == lines.size())
    {
      lines.emplace_back(titles.size(), "-");
      lines[line][0] = std::to_string(bar.Number);
      lines[line][1] = bar.What;
      lines[line][2] = (bar.IsUpperLimit ? "<= " : ">= ") + Short(bar.Limit);
    }
    const std::string measured = Short(bar.Measured);
    lines[line][add(titles, bar.Where)] = bar.IsMet() ? measured : "**" + measured + "**";
  }
  PrintHead(titles, 2, out);
  for (const std::vector<std::string>& line : lines)
  {
    PrintRow(line, out);
  }
  out << "\n";
}

}
