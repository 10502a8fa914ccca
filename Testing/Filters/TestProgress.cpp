// SPDX-License-Identifier: BSD-3-Clause
// Progress in named phases, and aborting at any report of it.
#include "FilterTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <thread>

namespace
{

/** Listens to an algorithm's progress, and aborts at one of the reports. */
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }
  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
    const double progress = *static_cast<double*>(data);
    // The executive itself reports 0 before and 1 after the work.
    if (progress > 0.0 && progress < 1.0)
    {
      EXPECT_GE(progress, this->Last) << algorithm->GetProgressText();
      EXPECT_EQ(std::this_thread::get_id(), this->Thread);
      this->Last = progress;
      if (algorithm->GetProgressText())
      {
        this->Phases.insert(algorithm->GetProgressText());
        this->Begins.emplace(algorithm->GetProgressText(), progress);
      }
    }
    if (this->Count++ == this->AbortAt)
    {
      algorithm->SetAbortExecute(1);
    }
  }
  void Start(int abortAt)
  {
    this->Last = 0.0;
    this->Count = 0;
    this->AbortAt = abortAt;
    this->Phases.clear();
    this->Begins.clear();
  }

  double Last = 0.0;
  int Count = 0;
  int AbortAt = -1;
  std::set<std::string> Phases;
  std::map<std::string, double> Begins; ///< of phases
  std::thread::id Thread = std::this_thread::get_id();
};

vtkIdType CellsOf(vtkAlgorithm* algorithm)
{
  return vtkDataSet::SafeDownCast(algorithm->GetOutputDataObject(0))->GetNumberOfCells();
}

/** Aborts a filter at each of its first reports. Expects an empty mesh at least twice, and the
 *  whole one after each. */
void ExpectAborts(vtkAlgorithm* filter, vtkIdType expected)
{
  ASSERT_GT(expected, 0);
  vtkNew<Listener> listener;
  filter->AddObserver(vtkCommand::ProgressEvent, listener);
  const auto messages = test::Watch(filter);
  int aborted = 0;
  for (int at = 0; at < 12; ++at)
  {
    filter->Modified();
    listener->Start(at);
    filter->Update();
    if (filter->GetAbortExecute() == 0)
    {
      break; // it had no more reports
    }
    const bool wasInTime = listener->Count - 1 <= at + 2; // its last may be the executive's
    EXPECT_TRUE(wasInTime);
    if (CellsOf(filter) == 0)
    {
      ++aborted;
    }
    filter->SetAbortExecute(0);
    filter->Modified();
    listener->Start(-1);
    filter->Update();
    EXPECT_EQ(CellsOf(filter), expected) << at;
  }
  EXPECT_GE(aborted, 2);
  EXPECT_EQ(messages->ErrorCount, 0) << messages->Errors;
}

}

TEST(Progress, HasNamedPhasesInOrder)
{
  const auto image = test::PhantomImage({ 64, 64, 64 }, 1.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->SetValue(1, 30.0);
  contour->SetErrorTolerance(0.5);
  vtkNew<Listener> listener;
  contour->AddObserver(vtkCommand::ProgressEvent, listener);
  contour->Update();
  for (const char* phase : { "Classifying diamonds", "Placing isovertices", "Measuring errors",
         "Finding thresholds", "Refining", "Extracting the mesh" })
  {
    EXPECT_EQ(listener->Phases.count(phase), 1U) << phase;
  }
  EXPECT_GT(listener->Last, 0.8);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetIsovalue(50.0);
  vtkNew<Listener> ofBuilder;
  builder->AddObserver(vtkCommand::ProgressEvent, ofBuilder);
  builder->Update();
  EXPECT_EQ(ofBuilder->Phases.count("Measuring errors"), 1U);
}

// The mesh that is not for simulations, which comes first, takes little of the time.
TEST(Progress, OfSimulationQualityIsNotAtItsEndFromTheStart)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(test::PhantomImage({ 32, 32, 32 }, 1.0));
  volume->SetIsorange(50.0, 200.0);
  volume->SetErrorTolerance(0.5);
  volume->Update(); // measures errors
  volume->SimulationQualityOn();
  vtkNew<Listener> listener;
  volume->AddObserver(vtkCommand::ProgressEvent, listener);
  volume->Update();
  ASSERT_EQ(listener->Begins.count("Improving tetrahedra"), 1U);
  EXPECT_LT(listener->Begins["Improving tetrahedra"], 0.9);
  EXPECT_GT(listener->Last, listener->Begins["Improving tetrahedra"]);
}

// Each mesh that is tried takes the same part of what is left.
TEST(Progress, EndsEarlyWhereThereIsNoRoomForGoodAngles)
{
  std::mt19937 random(5);
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(test::MakeImage(
    { 7, 7, 7 }, [&](double, double, double) { return (random() % 10000) / 10000.0; }));
  volume->SetIsorange(0.5, 0.55);
  volume->SetErrorTolerance(0.5);
  volume->Update();
  volume->SimulationQualityOn();
  vtkNew<Listener> listener;
  volume->AddObserver(vtkCommand::ProgressEvent, listener);
  volume->Update();
  EXPECT_LT(volume->GetSmallestDihedralAngle(), 10.0);
  EXPECT_GT(listener->Last, 0.2);
  EXPECT_LT(listener->Last, 0.95); // after the tenth mesh
}

TEST(Progress, FullResolutionWaitsForNoErrors)
{
  const auto image = test::PhantomImage({ 40, 40, 40 }, 1.0);
  vtkNew<vtkIsodiamondContour> contour;
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  contour->SetValue(0, 50.0);
  volume->SetIsorange(50.0, 110.0);
  for (vtkIsodiamondVolumeAlgorithm* filter : { static_cast<vtkIsodiamondVolumeAlgorithm*>(contour),
         static_cast<vtkIsodiamondVolumeAlgorithm*>(volume) })
  {
    filter->SetInputData(image);
    vtkNew<Listener> listener;
    filter->AddObserver(vtkCommand::ProgressEvent, listener);
    filter->Update();
    EXPECT_GT(CellsOf(filter), 0);
    EXPECT_EQ(listener->Phases.count("Placing isovertices"), 1U);
    EXPECT_EQ(listener->Phases.count("Measuring errors"), 0U);
    listener->Start(-1);
    filter->SetErrorTolerance(0.5);
    filter->Update();
    EXPECT_EQ(listener->Phases.count("Measuring errors"), 1U);
    EXPECT_EQ(listener->Phases.count("Placing isovertices"), 0U);
    listener->Start(-1);
    filter->SetErrorTolerance(0.0);
    filter->Update();
    EXPECT_EQ(listener->Phases.count("Measuring errors"), 0U);
    listener->Start(-1);
    filter->SetErrorTolerance(1.0);
    filter->Update();
    EXPECT_EQ(listener->Phases.count("Measuring errors"), 0U);
    EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
  }
}

TEST(Progress, OneToleranceWaitsForNoErrorsOfOthers)
{
  const auto image = test::PhantomImage({ 40, 40, 40 }, 1.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->OneToleranceOn();
  vtkNew<Listener> listener;
  contour->AddObserver(vtkCommand::ProgressEvent, listener);
  const auto measures = [&]
  {
    listener->Start(-1);
    contour->Update();
    EXPECT_EQ(listener->Phases.count("Finding thresholds"), 0U);
    return listener->Phases.count("Measuring errors") == 1U;
  };
  EXPECT_FALSE(measures());
  contour->SetErrorTolerance(0.5);
  EXPECT_TRUE(measures());
  contour->ComputeNormalsOff(); // the same mesh
  EXPECT_FALSE(measures());
  contour->SetErrorTolerance(1.0);
  EXPECT_TRUE(measures());
  contour->SetErrorTolerance(0.0);
  EXPECT_FALSE(measures());
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
}

TEST(Progress, AnAbortedMeasurementIsDoneAgain)
{
  const auto image = test::PhantomImage({ 64, 64, 64 }, 1.0);
  for (const bool oneTolerance : { false, true })
  {
    const auto setUp = [&](vtkIsodiamondContour* contour)
    {
      contour->SetInputData(image);
      contour->SetValue(0, 50.0);
      contour->SetOneTolerance(oneTolerance);
    };
    vtkNew<vtkIsodiamondContour> reference;
    setUp(reference);
    reference->SetErrorTolerance(0.5);
    reference->Update();
    int aborted = 0;
    for (int at = 0; at < 12; ++at)
    {
      vtkNew<vtkIsodiamondContour> contour;
      setUp(contour);
      contour->Update();
      contour->SetErrorTolerance(0.5);
      vtkNew<Listener> listener;
      contour->AddObserver(vtkCommand::ProgressEvent, listener);
      listener->Start(at);
      contour->Update();
      aborted += CellsOf(contour) == 0 ? 1 : 0;
      contour->SetAbortExecute(0);
      contour->Modified();
      listener->Start(-1);
      contour->Update();
      EXPECT_EQ(test::Difference(contour->GetOutput(), reference->GetOutput()), "") << at;
    }
    EXPECT_GE(aborted, 2);
  }
}

TEST(Progress, AnAbortedContourIsEmptyAndTheNextIsWhole)
{
  const auto image = test::PhantomImage({ 64, 64, 64 }, 1.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->SetCacheSize(0);
  contour->Update();
  ExpectAborts(contour, CellsOf(contour)); // with the hierarchy at hand
  vtkNew<vtkIsodiamondContour> fresh;
  fresh->SetInputData(image);
  fresh->SetValue(0, 50.0);
  fresh->SetErrorMetricToField();
  vtkNew<Listener> listener;
  fresh->AddObserver(vtkCommand::ProgressEvent, listener);
  listener->Start(2); // while it builds
  fresh->Update();
  EXPECT_EQ(CellsOf(fresh), 0);
  EXPECT_EQ(fresh->GetNumberOfBuilds(), 0);
  fresh->SetAbortExecute(0);
  fresh->Modified();
  listener->Start(-1);
  fresh->Update();
  EXPECT_EQ(CellsOf(fresh), CellsOf(contour));
}

TEST(Progress, AllFiltersCanBeAborted)
{
  const auto image = test::PhantomImage({ 48, 48, 48 }, 1.0);
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(image);
  volume->SetIsorange(50.0, 1e9);
  volume->Update();
  ExpectAborts(volume, CellsOf(volume));
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetIsovalue(50.0);
  builder->Update();
  const vtkIdType stored = builder->GetHierarchy()->GetStorageSize();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->Update();
  ExpectAborts(extractor, CellsOf(extractor));
  for (const bool isScalars : { false, true })
  {
    vtkNew<vtkIsodiamondBuilder> aborted;
    aborted->SetInputData(image);
    aborted->SetIsovalue(50.0);
    aborted->SetModel(
      isScalars ? vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS : vtkIsodiamondHierarchy::MINIMAL);
    vtkNew<Listener> listener;
    aborted->AddObserver(vtkCommand::ProgressEvent, listener);
    listener->Start(1);
    aborted->Update();
    EXPECT_EQ(aborted->GetHierarchy()->GetNumberOfPoints(), 0);
    aborted->SetAbortExecute(0);
    aborted->Modified();
    listener->Start(-1);
    aborted->Update();
    EXPECT_GT(aborted->GetHierarchy()->GetStorageSize(), 0);
    if (!isScalars)
    {
      EXPECT_EQ(aborted->GetHierarchy()->GetStorageSize(), stored);
    }
  }
}
