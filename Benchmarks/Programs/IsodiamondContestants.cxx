// SPDX-License-Identifier: BSD-3-Clause
#include "IsodiamondContestants.h"

#include "FilterContestant.h"

#include "vtkFieldData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkIsodiamondVolumeAlgorithm.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <memory>

namespace benchmark
{
namespace
{

const char* MetricName(int metric)
{
  return metric == vtkIsodiamondHierarchy::FIELD ? "field" : "distance";
}

/** "MI build, field" and the like, for "build". */
std::string NameOf(const Model& model, const std::string& what)
{
  static const char* const kinds[] = { "HD", "RI", "MI" };
  return std::string(kinds[model.Kind]) + " " + what + ", " + MetricName(model.Metric);
}

/** From the unit that is shown to people to that of the metric's filters. */
double AbsoluteTolerance(const Volume& volume, int metric, double tolerance)
{
  const std::array<double, 2> range = volume.Range();
  return metric == vtkIsodiamondHierarchy::FIELD ? tolerance / 100.0 * (range[1] - range[0])
                                                 : tolerance * volume.Voxel();
}

/** In the unit that is shown to people: the whole range, or the image's diagonal. */
double LargestTolerance(const Volume& volume, int metric)
{
  return metric == vtkIsodiamondHierarchy::FIELD ? 100.0
                                                 : volume.Image->GetLength() / volume.Voxel();
}

vtkSmartPointer<vtkIsodiamondBuilder> MakeBuilder(const Task& task, const Model& model)
{
  auto builder = vtkSmartPointer<vtkIsodiamondBuilder>::New();
  builder->SetInputData(task.Volume.Image);
  builder->SetModel(model.Kind);
  builder->SetErrorMetric(model.Metric);
  builder->SetShape(task.Shape == Shape::Isosurface ? vtkIsodiamondHierarchy::ISOSURFACE
                                                    : vtkIsodiamondHierarchy::INTERVAL_VOLUME);
  builder->SetIsovalue(task.Volume.Isovalue);
  builder->SetIsorange(task.Volume.Isorange.data());
  builder->SetNumberOfThreads(task.Threads);
  return builder;
}

vtkSmartPointer<vtkIsodiamondExtractor> MakeExtractor(
  const Task& task, vtkIsodiamondHierarchy* hierarchy)
{
  auto extractor = vtkSmartPointer<vtkIsodiamondExtractor>::New();
  extractor->SetInputData(hierarchy);
  extractor->SetNumberOfThreads(task.Threads);
  return extractor;
}

/** The bytes of the arrays that hold the hierarchy: all its own arrays but those of its header. */
double BytesOfArrays(vtkFieldData* arrays)
{
  double bytes = 0.0;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = arrays->GetAbstractArray(i);
    const std::string name = array->GetName();
    if (name.rfind("Isodiamond", 0) == 0 && name != "IsodiamondHeader" &&
      name != "IsodiamondParameters" && name != "IsodiamondArrayName")
    {
      bytes += static_cast<double>(array->GetNumberOfValues()) * array->GetDataTypeSize();
    }
  }
  return bytes;
}

void DescribeHierarchy(vtkIsodiamondHierarchy* hierarchy, Figures& figures)
{
  figures.Set("bytes", hierarchy->GetStorageSize());
  figures.Set("bytes of arrays", BytesOfArrays(hierarchy->GetFieldData()));
  if (hierarchy->GetModel() != vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
  {
    figures.Set("active", hierarchy->GetNumberOfActiveIsodiamonds());
    figures.Set("relevant", hierarchy->GetNumberOfRelevantIsodiamonds());
    figures.Set("creation", hierarchy->GetNumberOfCreationIsodiamonds());
    figures.Set("isovertices", hierarchy->GetNumberOfIsovertices());
  }
}

vtkSmartPointer<vtkIsodiamondVolumeAlgorithm> Configured(
  const vtkSmartPointer<vtkIsodiamondVolumeAlgorithm>& filter, const Task& task, int metric,
  double tolerance)
{
  filter->SetInputData(task.Volume.Image);
  filter->SetErrorMetric(metric);
  filter->SetErrorTolerance(AbsoluteTolerance(task.Volume, metric, tolerance));
  filter->SetNumberOfThreads(task.Threads);
  return filter;
}

/** So small that the mesh is full resolution, but not 0, for which no errors are measured. */
constexpr double LeastTolerance = 1e-300;

vtkSmartPointer<vtkIsodiamondVolumeAlgorithm> MakeOneStep(
  const Task& task, int metric, double tolerance)
{
  if (task.Shape == Shape::IntervalVolume)
  {
    auto volume = vtkSmartPointer<vtkIsodiamondIntervalVolume>::New();
    volume->SetIsorange(task.Volume.Isorange[0], task.Volume.Isorange[1]);
    return Configured(volume, task, metric, tolerance);
  }
  auto contour = vtkSmartPointer<vtkIsodiamondContour>::New();
  contour->SetValue(0, task.Volume.Isovalue);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  return Configured(contour, task, metric, tolerance);
}

Contestant OneStep(const std::string& name, const Task& task, int metric, double tolerance)
{
  const auto filter = std::make_shared<vtkSmartPointer<vtkAlgorithm>>();
  Contestant contestant;
  contestant.Name = name;
  contestant.Run = [filter, task, metric, tolerance]
  {
    *filter = MakeOneStep(task, metric, tolerance);
    (*filter)->Update();
  };
  contestant.Describe = [filter](Figures& figures) { DescribeMesh(*filter, figures); };
  contestant.Release = [filter] { *filter = nullptr; };
  contestant.StartsFromVolume = true;
  return contestant;
}

}

Tolerance Model::ToleranceOf(double value) const
{
  return this->Metric == vtkIsodiamondHierarchy::FIELD ? Tolerance::Percent(value)
                                                       : Tolerance::Voxels(value);
}

vtkSmartPointer<vtkIsodiamondHierarchy> BuildHierarchy(const Task& task, const Model& model)
{
  const vtkSmartPointer<vtkIsodiamondBuilder> builder = MakeBuilder(task, model);
  builder->Update();
  vtkSmartPointer<vtkIsodiamondHierarchy> hierarchy = builder->GetHierarchy();
  hierarchy->GetStorageSize(); // checks it
  return hierarchy;
}

Level FindLevel(
  const Task& task, const Model& model, vtkIsodiamondHierarchy* hierarchy, double fraction)
{
  const vtkSmartPointer<vtkIsodiamondExtractor> extractor = MakeExtractor(task, hierarchy);
  const auto levelAt = [&](double tolerance) -> Level
  {
    extractor->SetErrorTolerance(AbsoluteTolerance(task.Volume, model.Metric, tolerance));
    extractor->Update();
    return { tolerance, static_cast<double>(extractor->GetOutput()->GetNumberOfCells()) };
  };
  Level fine = levelAt(0.0);
  const double most = fraction * fine.Cells;
  Level coarse = levelAt(LargestTolerance(task.Volume, model.Metric));
  if (fine.Cells == 0.0 || coarse.Cells > most)
  {
    return {};
  }
  for (int i = 0; i < 20 && coarse.Tolerance - fine.Tolerance > 0.01 * coarse.Tolerance; ++i)
  {
    const Level middle = levelAt(0.5 * (fine.Tolerance + coarse.Tolerance));
    (middle.Cells > most ? fine : coarse) = middle;
  }
  return coarse;
}

Contestant BuildContestant(const Task& task, const Model& model)
{
  const vtkSmartPointer<vtkIsodiamondBuilder> builder = MakeBuilder(task, model);
  Contestant contestant = FilterContestant(NameOf(model, "build"), { builder });
  contestant.Describe = [builder](Figures& figures)
  { DescribeHierarchy(builder->GetHierarchy(), figures); };
  contestant.StartsFromVolume = true;
  return contestant;
}

Contestant CheckContestant(const Model& model, vtkIsodiamondHierarchy* hierarchy)
{
  auto arrays = vtkSmartPointer<vtkPolyData>::New();
  arrays->ShallowCopy(hierarchy);
  Contestant contestant;
  contestant.Name = NameOf(model, "check");
  contestant.Run = [arrays]
  {
    vtkSmartPointer<vtkIsodiamondHierarchy>::Take(vtkIsodiamondHierarchy::FromPolyData(arrays))
      ->GetStorageSize();
  };
  contestant.Describe = [](Figures&) {};
  contestant.Release = [] {};
  return contestant;
}

Contestant ExtractContestant(const Task& task, const Model& model,
  vtkIsodiamondHierarchy* hierarchy, double tolerance, const std::string& name)
{
  const vtkSmartPointer<vtkIsodiamondExtractor> extractor = MakeExtractor(task, hierarchy);
  extractor->SetErrorTolerance(AbsoluteTolerance(task.Volume, model.Metric, tolerance));
  Contestant contestant =
    FilterContestant(name.empty() ? NameOf(model, "extract") : name, { extractor });
  contestant.Tolerance = model.ToleranceOf(tolerance);
  contestant.Describe = [extractor](Figures& figures)
  {
    DescribeMesh(extractor, figures);
    figures.Set("subdivided", extractor->GetNumberOfSubdividedDiamonds());
    figures.Set("front", extractor->GetNumberOfFrontDiamonds());
  };
  return contestant;
}

Contestant OneStepContestant(const Task& task, int metric)
{
  return OneStep(std::string("one step, ") + MetricName(metric), task, metric, LeastTolerance);
}

Contestant FullResolutionContestant(const Task& task)
{
  return OneStep("one step, full resolution", task, vtkIsodiamondHierarchy::DISTANCE, 0.0);
}

Contestant NewToleranceContestant(
  const Task& task, int metric, double tolerance, const std::string& name, int threads)
{
  Task own = task;
  own.Threads = threads > 0 ? threads : task.Threads;
  const vtkSmartPointer<vtkIsodiamondVolumeAlgorithm> filter = MakeOneStep(own, metric, tolerance);
  Contestant contestant = FilterContestant(name, { filter });
  contestant.Tolerance = Model{ vtkIsodiamondHierarchy::MINIMAL, metric }.ToleranceOf(tolerance);
  contestant.Prepare = [filter]
  {
    const double wanted = filter->GetErrorTolerance();
    filter->SetErrorTolerance(LeastTolerance); // builds and measures
    filter->Update();
    filter->SetErrorTolerance(wanted);
    filter->Update();
  };
  contestant.Threads = threads;
  return contestant;
}

}
