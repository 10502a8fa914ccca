// SPDX-License-Identifier: BSD-3-Clause
#include "JsonFile.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace benchmark
{
namespace
{

std::string Text(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
  {
    if (c == '"' || c == '\\')
    {
      quoted += '\\';
    }
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "\"";
}

std::string Number(double number)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::digits10);
  text << number;
  return std::isfinite(number) ? text.str() : "null";
}

std::string Enclosed(char open, const std::vector<std::string>& items, char close)
{
  std::string text(1, open);
  for (const std::string& item : items)
  {
    text += (text.size() > 1 ? ", " : "") + item;
  }
  return text + close + "\n";
}

/** Applies write to all items. */
template <typename Items, typename Write>
std::string Array(const Items& items, const Write& write)
{
  std::vector<std::string> texts;
  for (const auto& item : items)
  {
    texts.push_back(write(item));
  }
  return Enclosed('[', texts, ']');
}

std::string Object(const std::vector<std::pair<std::string, std::string>>& members)
{
  std::vector<std::string> texts;
  for (const auto& [name, value] : members)
  {
    texts.push_back(Text(name) + ": " + value);
  }
  return Enclosed('{', texts, '}');
}

std::string RowObject(const Row& row)
{
  std::vector<std::pair<std::string, std::string>> members = { { "contestant",
    Text(row.Contestant) } };
  if (row.Tolerance.In != Tolerance::Unit::None)
  {
    members.emplace_back("tolerance", Number(row.Tolerance.Value));
    members.emplace_back("tolerance unit", Text(row.Tolerance.UnitName()));
  }
  for (const auto& [name, value] : row.Figures.All())
  {
    members.emplace_back(name, Number(value));
  }
  return Object(members);
}

std::string VolumeObject(const VolumeResult& volume)
{
  return Object({ { "name", Text(volume.Name) }, { "title", Text(volume.Title()) },
    { "dimensions", Array(volume.Dimensions, Number) }, { "type", Text(volume.ScalarType) },
    { "range", Array(volume.Range, Number) }, { "isovalue", Number(volume.Isovalue) },
    { "isorange", Array(volume.Isorange, Number) },
    { "isosurface", Array(volume.Isosurface.Rows, RowObject) },
    { "interval volume", Array(volume.IntervalVolume.Rows, RowObject) } });
}

std::string BarObject(const Bar& bar)
{
  return Object({ { "bar", Number(bar.Number) }, { "what", Text(bar.What) },
    { "volume", Text(bar.Where) }, { "measured", Number(bar.Measured) },
    { bar.IsUpperLimit ? "at most" : "at least", Number(bar.Limit) },
    { "met", bar.IsMet() ? "true" : "false" } });
}

}

void WriteJson(const Report& report, const std::string& path)
{
  std::ofstream file(path);
  file << Object({ { "processor", Text(report.Processor) }, { "VTK", Text(report.Version) },
    { "threads", Number(report.Threads) }, { "repetitions", Number(report.Repetitions) },
    { "bytes a second, copying", Number(report.MemoryBandwidth) },
    { "volumes", Array(report.Volumes, VolumeObject) },
    { "bars", Array(report.Bars, BarObject) } });
  file.close();
  if (!file)
  {
    throw std::runtime_error("Cannot write \"" + path + "\".");
  }
}

}
