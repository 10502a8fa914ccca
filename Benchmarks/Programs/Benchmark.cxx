// SPDX-License-Identifier: BSD-3-Clause
#include "Benchmark.h"

#include "IsodiamondContestants.h"
#include "OtherContestants.h"

#include <thread>

namespace benchmark
{
namespace
{

using Hierarchy = vtkSmartPointer<vtkIsodiamondHierarchy>;

// For more samples than these, --all is needed.
constexpr vtkIdType SlowSamples = 300 * 300 * 300;    // decimation, clipping
constexpr vtkIdType TetrahedraSamples = 40 * 40 * 40; // cutting clipped cells into tetrahedra

constexpr double PaperTolerances[] = { 0.0, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0 }; // % of the range
constexpr double DistanceTolerances[] = { 0.0, 0.1, 0.25, 0.5, 1.0, 2.0 };    // voxels

void Append(std::vector<Contestant>& contestants, const std::vector<Contestant>& others)
{
  contestants.insert(contestants.end(), others.begin(), others.end());
}

/** Those that start from the volume, whose memory is measured too. */
std::vector<Contestant> FromVolume(
  const Task& task, const BenchmarkOptions& options, const Goal& goal)
{
  const vtkIdType samples = options.IsAll ? 0 : task.Volume.Image->GetNumberOfPoints();
  std::vector<Contestant> contestants;
  for (const Model& model : { HD, RIField, MIField })
  {
    contestants.push_back(BuildContestant(task, model));
  }
  if (options.IsPaper)
  {
    return contestants;
  }
  contestants.push_back(FullResolutionContestant(task));
  contestants.push_back(OneStepContestant(task, vtkIsodiamondHierarchy::FIELD));
  if (options.HasDistance)
  {
    contestants.push_back(BuildContestant(task, RIDistance));
    contestants.push_back(BuildContestant(task, MIDistance));
    contestants.push_back(OneStepContestant(task, vtkIsodiamondHierarchy::DISTANCE));
  }
  if (task.Shape == Shape::Isosurface)
  {
    contestants.push_back(FlyingEdgesContestant(task));
    contestants.push_back(ContourFilterContestant(task));
    Append(contestants, OpenVDBContestants(task));
    Append(contestants, MeshOptimizerContestants(task, goal));
    if (samples <= SlowSamples)
    {
      contestants.push_back(DecimationContestant(task, goal));
    }
    return contestants;
  }
  if (samples <= SlowSamples)
  {
    contestants.push_back(ClipContestant(task));
  }
  if (samples <= TetrahedraSamples)
  {
    contestants.push_back(ClipToTetrahedraContestant(task));
  }
  return contestants;
}

/** One model's extractions. */
template <typename Tolerances>
void AddExtractions(const Task& task, const Model& model, vtkIsodiamondHierarchy* hierarchy,
  const Tolerances& tolerances, std::vector<Contestant>& contestants)
{
  for (const double tolerance : tolerances)
  {
    contestants.push_back(ExtractContestant(task, model, hierarchy, tolerance));
  }
}

/** Extraction to a tenth by one metric. @return what it kept; NaN if there is no such level */
Level AddTenth(const Task& task, const Model& model, vtkIsodiamondHierarchy* hierarchy,
  std::vector<Contestant>& contestants)
{
  const Level level = FindLevel(task, model, hierarchy, 0.1);
  if (level.Cells > 0.0)
  {
    const char* const metric = model.Metric == vtkIsodiamondHierarchy::FIELD ? "field" : "distance";
    contestants.push_back(ExtractContestant(
      task, model, hierarchy, level.Tolerance, std::string("MI extract a tenth, ") + metric));
  }
  return level;
}

/** What one-step filters do when only the tolerance is new. */
void AddNewTolerances(
  const Task& task, int metric, const Level& tenth, std::vector<Contestant>& contestants)
{
  contestants.push_back(NewToleranceContestant(task, metric, 0.0, "one step, new tolerance"));
  if (tenth.Cells > 0.0)
  {
    contestants.push_back(
      NewToleranceContestant(task, metric, tenth.Tolerance, "one step, new tolerance, a tenth"));
  }
  if (task.Threads == 1 && std::thread::hardware_concurrency() > 1)
  {
    contestants.push_back(
      NewToleranceContestant(task, metric, 0.0, "one step, new tolerance, 2 threads", 2));
  }
}

/** Those that start from hierarchies. */
std::vector<Contestant> FromHierarchies(
  const Task& task, const BenchmarkOptions& options, const Goal& goal)
{
  std::vector<Contestant> contestants;
  const Hierarchy hd = BuildHierarchy(task, HD);
  const Hierarchy ri = BuildHierarchy(task, RIField);
  const Hierarchy mi = BuildHierarchy(task, MIField);
  AddExtractions(task, MIField, mi, PaperTolerances, contestants);
  if (options.IsPaper)
  {
    AddExtractions(task, RIField, ri, PaperTolerances, contestants);
    AddExtractions(task, HD, hd, PaperTolerances, contestants);
    return contestants;
  }
  const std::array<double, 2> ends = { PaperTolerances[0], PaperTolerances[5] };
  AddExtractions(task, RIField, ri, ends, contestants);
  AddExtractions(task, HD, hd, ends, contestants);
  Level tenth = AddTenth(task, MIField, mi, contestants);
  if (options.HasDistance)
  {
    const Hierarchy distance = BuildHierarchy(task, MIDistance);
    AddExtractions(task, MIDistance, distance, DistanceTolerances, contestants);
    contestants.push_back(CheckContestant(MIDistance, distance));
    tenth = AddTenth(task, MIDistance, distance, contestants);
  }
  *goal = tenth.Cells;
  const int metric =
    options.HasDistance ? vtkIsodiamondHierarchy::DISTANCE : vtkIsodiamondHierarchy::FIELD;
  AddNewTolerances(task, metric, tenth, contestants);
  if (task.Threads == 1 && task.Shape == Shape::Isosurface &&
    std::thread::hardware_concurrency() > 1)
  {
    contestants.push_back(FlyingEdgesContestant(task, 2));
  }
  return contestants;
}

}

#ifndef ISODIAMONDS_HAVE_MESHOPTIMIZER
std::vector<Contestant> MeshOptimizerContestants(const Task&, const Goal&)
{
  return {};
}
#endif

#ifndef ISODIAMONDS_HAVE_OPENVDB
std::vector<Contestant> OpenVDBContestants(const Task&)
{
  return {};
}
#endif

VolumeResult DescribeVolume(const Volume& volume)
{
  VolumeResult result;
  result.Name = volume.Name;
  volume.Image->GetDimensions(result.Dimensions.data());
  result.ScalarType = volume.Image->GetScalarTypeAsString();
  result.BytesOfSample = volume.Image->GetScalarSize();
  result.Range = volume.Range();
  result.Isovalue = volume.Isovalue;
  result.Isorange = volume.Isorange;
  return result;
}

void MeasureMemoryOf(const Volume& volume, const BenchmarkOptions& options, VolumeResult& result)
{
  for (const Shape shape : options.Shapes)
  {
    const Task task = { volume, shape, options.Threads };
    const Goal goal = std::make_shared<double>(0.0);
    MeasureMemory(FromVolume(task, options, goal), options.Threads, result.Of(shape));
  }
}

void MeasureTimesOf(const Volume& volume, const BenchmarkOptions& options, VolumeResult& result)
{
  for (const Shape shape : options.Shapes)
  {
    const Task task = { volume, shape, options.Threads };
    const Goal goal = std::make_shared<double>(0.0);
    std::vector<Contestant> contestants = FromVolume(task, options, goal);
    Append(contestants, FromHierarchies(task, options, goal));
    MeasureTimes(contestants, options.Repetitions, options.Threads, result.Of(shape));
  }
}

}
