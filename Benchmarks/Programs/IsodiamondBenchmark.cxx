// SPDX-License-Identifier: BSD-3-Clause
// Isodiamonds beside what people use: time, memory, bytes and triangles. See --help.
#include "Bars.h"
#include "Benchmark.h"
#include "JsonFile.h"
#include "Measurement.h"
#include "Tables.h"

#include "vtkVersion.h"

#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace
{

using namespace benchmark;

constexpr const char* Usage =
  R"(Usage: IsodiamondBenchmark [OPTIONS] [FILE[:ISOVALUE[:LOWER:UPPER]] ...]

Measures Isodiamonds beside vtkFlyingEdges3D, vtkContourFilter, simplification of meshes, OpenVDB
and clipping to a range of values, all in one process. Prints Markdown and writes JSON.

  FILE             a volume: NAME_XxYxZ_TYPE.raw (uint8, int16, uint16, float32), .nrrd, .nhdr,
                   .nii or .nii.gz; its isovalue and isorange [the paper's for its volumes, else
                   from the samples' range]
  --size N[,N...]  sizes of the synthetic volumes [256; none beside files]
  --fields A[,B]   of marschner-lobb, gyroid (with metaballs), phantom (noisy CT), odd (the
                   gyroid with an odd number of samples, different on each axis) [all]
  --shape S        isosurface or interval-volume only [both]
  --metric field   without the distance metric
  --threads N      for all contestants; with 1 also what two threads gain [1]
  --repetitions N  all contestants run in turn, so many times, slow ones less often; the median
                   counts [5]
  --paper          only the paper's Table 2 and figure 15
  --pad            pads with zeros to (2^N + 1)^3, as the paper does for its Table 2
  --all            also what takes minutes: decimation and clipping of more than 300^3 samples,
                   cutting what was clipped of more than 40^3 into tetrahedra
  --json FILE      where to write [benchmark.json]
)";

struct Arguments
{
  BenchmarkOptions Options;
  std::vector<int> Sizes;
  std::vector<std::string> Fields = FieldNames();
  std::vector<std::string> Files;
  std::string Json = "benchmark.json";
  bool Pad = false;
  bool Help = false;
};

int PositiveNumber(const std::string& text, int most)
{
  std::istringstream stream(text);
  int number = 0;
  if (!(stream >> number) || !stream.eof() || number < 1 || number > most)
  {
    throw std::invalid_argument(
      "\"" + text + "\" is not a number from 1 to " + std::to_string(most) + ".");
  }
  return number;
}

std::vector<std::string> Split(const std::string& list)
{
  std::vector<std::string> items;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');)
  {
    items.push_back(item);
  }
  return items;
}

/** Takes an option and its value. @return false if there is no such option */
bool TakeOption(const std::string& option, const std::string& value, Arguments& arguments)
{
  if (option == "--size")
  {
    for (const std::string& size : Split(value))
    {
      arguments.Sizes.push_back(PositiveNumber(size, 2048));
    }
  }
  else if (option == "--fields")
  {
    arguments.Fields = Split(value);
  }
  else if (option == "--threads")
  {
    arguments.Options.Threads = PositiveNumber(value, 1024);
  }
  else if (option == "--repetitions")
  {
    arguments.Options.Repetitions = PositiveNumber(value, 1000);
  }
  else if (option == "--shape" && (value == "isosurface" || value == "interval-volume"))
  {
    arguments.Options.Shapes = { value == "isosurface" ? Shape::Isosurface
                                                       : Shape::IntervalVolume };
  }
  else if (option == "--metric" && value == "field")
  {
    arguments.Options.HasDistance = false;
  }
  else if (option == "--json")
  {
    arguments.Json = value;
  }
  else
  {
    return false;
  }
  return true;
}

bool TakeFlag(const std::string& flag, Arguments& arguments)
{
  bool* const switched = flag == "--paper" ? &arguments.Options.IsPaper
    : flag == "--all"                      ? &arguments.Options.IsAll
    : flag == "--pad"                      ? &arguments.Pad
    : flag == "--help" || flag == "-h"     ? &arguments.Help
                                           : nullptr;
  if (switched)
  {
    *switched = true;
  }
  return switched != nullptr;
}

Arguments Parse(const std::vector<std::string>& words)
{
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    if (words[i].empty() || words[i][0] != '-')
    {
      arguments.Files.push_back(words[i]);
    }
    else if (!TakeFlag(words[i], arguments))
    {
      const std::string value = i + 1 < words.size() ? words[i + 1] : "";
      if (value.empty() || !TakeOption(words[i], value, arguments))
      {
        throw std::invalid_argument("There is no option " + words[i] +
          (value.empty() ? " without a value" : " \"" + value + "\"") + "; see --help.");
      }
      ++i;
    }
  }
  if (arguments.Files.empty() && arguments.Sizes.empty())
  {
    arguments.Sizes = { 256 };
  }
  return arguments;
}

std::vector<VolumeSource> Sources(const Arguments& arguments)
{
  std::vector<VolumeSource> sources;
  for (const std::string& field : arguments.Fields)
  {
    for (const int size : arguments.Sizes)
    {
      sources.push_back(SyntheticVolume(field, size));
    }
  }
  for (const std::string& file : arguments.Files)
  {
    sources.push_back(VolumeFile(file));
  }
  if (arguments.Pad)
  {
    for (VolumeSource& source : sources)
    {
      source.Make = [make = source.Make] { return PadAsPaper(make()); };
    }
  }
  return sources;
}

std::string Processor()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("model name", 0) == 0)
    {
      return line.substr(line.find(':') + 2);
    }
  }
  return "";
}

Report Measure(const Arguments& arguments)
{
  const BenchmarkOptions& options = arguments.Options;
  Report report;
  report.Processor = Processor();
  report.Version = vtkVersion::GetVTKVersion();
  report.Threads = options.Threads;
  report.Repetitions = options.Repetitions;
  const std::vector<VolumeSource> sources = Sources(arguments);
  for (const VolumeSource& source : sources)
  {
    std::cerr << "Memory: " << source.Name << "\n";
    const Volume volume = source.Make();
    report.Volumes.push_back(DescribeVolume(volume));
    MeasureMemoryOf(volume, options, report.Volumes.back());
  }
  report.MemoryBandwidth = MeasureMemoryBandwidth(options.Threads == 1 ? 2 : options.Threads);
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    std::cerr << "Time: " << report.Volumes[i].Title() << "\n";
    MeasureTimesOf(sources[i].Make(), options, report.Volumes[i]);
  }
  report.Bars = JudgeBars(report);
  return report;
}

void Print(const Report& report, bool isPaper)
{
  std::cout << "# Isodiamonds beside others\n\n"
            << report.Processor << ", VTK " << report.Version << ", " << report.Threads
            << " thread(s); medians of " << report.Repetitions
            << " interleaved runs. Ratios can be compared between machines, times cannot.\n\n";
  if (!isPaper)
  {
    for (const VolumeResult& volume : report.Volumes)
    {
      PrintVolume(volume, std::cout);
    }
  }
  else
  {
    PrintTable2(report, std::cout);
    PrintFigure15(report, std::cout);
  }
  PrintBars(report.Bars, std::cout);
}

}

int main(int argc, char* argv[])
{
  try
  {
    const Arguments arguments = Parse({ argv + 1, argv + argc });
    if (arguments.Help)
    {
      std::cout << Usage;
      return 0;
    }
    const Report report = Measure(arguments);
    Print(report, arguments.Options.IsPaper);
    WriteJson(report, arguments.Json);
    std::cout << "Written: " << arguments.Json << "\n";
  }
  catch (const std::exception& problem)
  {
    std::cerr << "IsodiamondBenchmark: " << problem.what() << "\n";
    return 1;
  }
  return 0;
}
