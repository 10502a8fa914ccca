// SPDX-License-Identifier: BSD-3-Clause
#include "OtherContestants.h"

#include "FilterContestant.h"

#include "vtkContourFilter.h"
#include "vtkDataArray.h"
#include "vtkDataSetTriangleFilter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkQuadricDecimation.h"
#include "vtkTableBasedClipDataSet.h"

namespace benchmark
{
namespace
{

template <typename Filter>
vtkSmartPointer<Filter> MakeContour(const Task& task)
{
  auto contour = vtkSmartPointer<Filter>::New();
  contour->SetInputData(task.Volume.Image);
  contour->SetValue(0, task.Volume.Isovalue);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  return contour;
}

vtkSmartPointer<vtkTableBasedClipDataSet> MakeClip(const char* array, double value, bool below)
{
  auto clip = vtkSmartPointer<vtkTableBasedClipDataSet>::New();
  clip->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
  clip->SetValue(value);
  clip->SetInsideOut(below);
  return clip;
}

std::vector<vtkSmartPointer<vtkAlgorithm>> MakeClips(const Task& task)
{
  const char* array = task.Volume.Image->GetPointData()->GetScalars()->GetName();
  const auto lower = MakeClip(array, task.Volume.Isorange[0], false);
  const auto upper = MakeClip(array, task.Volume.Isorange[1], true);
  lower->SetInputData(task.Volume.Image);
  lower->ReleaseDataFlagOn(); // IsoVolume keeps only the second's output
  upper->SetInputConnection(lower->GetOutputPort());
  return { lower, upper };
}

}

vtkSmartPointer<vtkFlyingEdges3D> MakeFlyingEdges(const Task& task)
{
  return MakeContour<vtkFlyingEdges3D>(task);
}

Contestant FlyingEdgesContestant(const Task& task, int threads)
{
  Contestant contestant = FilterContestant(
    threads > 0 ? "vtkFlyingEdges3D, " + std::to_string(threads) + " threads" : "vtkFlyingEdges3D",
    { MakeFlyingEdges(task) });
  contestant.StartsFromVolume = threads == 0;
  contestant.Threads = threads;
  return contestant;
}

Contestant ContourFilterContestant(const Task& task)
{
  Contestant contestant =
    FilterContestant("vtkContourFilter", { MakeContour<vtkContourFilter>(task) });
  contestant.StartsFromVolume = true;
  return contestant;
}

Contestant DecimationContestant(const Task& task, const Goal& triangles)
{
  const auto contour = MakeFlyingEdges(task);
  const auto decimation = vtkSmartPointer<vtkQuadricDecimation>::New();
  decimation->SetInputConnection(contour->GetOutputPort());
  decimation->VolumePreservationOff();
  decimation->AttributeErrorMetricOff();
  Contestant contestant =
    FilterContestant("flying edges + vtkQuadricDecimation", { contour, decimation });
  contestant.Run = [contour, decimation, triangles]
  {
    contour->Modified();
    contour->Update();
    const double all = contour->GetOutput()->GetNumberOfCells();
    decimation->SetTargetReduction(*triangles > 0.0 ? 1.0 - *triangles / all : 0.9);
    decimation->Update();
  };
  contestant.StartsFromVolume = true;
  return contestant;
}

Contestant ClipContestant(const Task& task)
{
  Contestant contestant = FilterContestant("vtkTableBasedClipDataSet twice", MakeClips(task));
  contestant.StartsFromVolume = true;
  return contestant;
}

Contestant ClipToTetrahedraContestant(const Task& task)
{
  std::vector<vtkSmartPointer<vtkAlgorithm>> filters = MakeClips(task);
  const auto tetrahedra = vtkSmartPointer<vtkDataSetTriangleFilter>::New();
  tetrahedra->SetInputConnection(filters.back()->GetOutputPort());
  filters.push_back(tetrahedra);
  return FilterContestant("the same + vtkDataSetTriangleFilter", filters);
}

}
