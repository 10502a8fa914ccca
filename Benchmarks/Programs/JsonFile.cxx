// SPDX-License-Identifier: BSD-3-Clause
#include "JsonFile.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <stdexcept>

namespace benchmark
{

using Json = nlohmann::ordered_json;

// The library finds these by name, so they are in no unnamed namespace. It writes NaN as null.

static void to_json(Json& json, const Row& row)
{
  json["contestant"] = row.Contestant;
  if (row.Tolerance.In != Tolerance::Unit::None)
  {
    json["tolerance"] = row.Tolerance.Value;
    json["tolerance unit"] = row.Tolerance.UnitName();
  }
  for (const auto& [name, value] : row.Figures.All())
  {
    json[name] = value;
  }
}

static void to_json(Json& json, const VolumeResult& volume)
{
  json = { { "name", volume.Name }, { "title", volume.Title() },
    { "dimensions", volume.Dimensions }, { "type", volume.ScalarType }, { "range", volume.Range },
    { "isovalue", volume.Isovalue }, { "isorange", volume.Isorange },
    { "isosurface", volume.Isosurface.Rows }, { "interval volume", volume.IntervalVolume.Rows } };
}

static void to_json(Json& json, const Bar& bar)
{
  json = { { "bar", bar.Number }, { "what", bar.What }, { "volume", bar.Where },
    { "measured", bar.Measured }, { bar.IsUpperLimit ? "at most" : "at least", bar.Limit },
    { "met", bar.IsMet() } };
}

void WriteJson(const Report& report, const std::string& path)
{
  const Json json = { { "processor", report.Processor }, { "VTK", report.Version },
    { "threads", report.Threads }, { "repetitions", report.Repetitions },
    { "bytes a second, copying", report.MemoryBandwidth }, { "volumes", report.Volumes },
    { "bars", report.Bars } };
  std::ofstream file(path);
  // Names of files need not be UTF-8.
  file << json.dump(1, ' ', false, Json::error_handler_t::replace) << "\n";
  file.close();
  if (!file)
  {
    throw std::runtime_error("Cannot write \"" + path + "\".");
  }
}

}
