// SPDX-License-Identifier: BSD-3-Clause
// Aborted at random moments: the output is empty or whole, and the filter works again.
#include "FilterTestTools.h"

#include "vtkAlgorithm.h"
#include "vtkFieldData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

namespace
{

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/** Stops an algorithm at one of its progress events, or at the first one after a time. */
class Stopper : public vtkCommand
{
public:
  vtkTypeMacro(Stopper, vtkCommand);
  static Stopper* New() { return new Stopper; }

  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
    const bool isTime = this->Count++ == this->Event || Clock::now() - this->Start > this->Time;
    if (isTime && !this->HasStopped)
    {
      this->HasStopped = true;
      // The executive itself reports 0 before the work, and 1 after it.
      const double progress = *static_cast<double*>(data);
      this->IsAtWork = progress > 0.0 && progress < 1.0;
      algorithm->SetAbortExecute(1);
    }
  }

  void StopAt(int event, Seconds time)
  {
    this->Count = 0;
    this->Event = event;
    this->Start = Clock::now();
    this->Time = time;
    this->HasStopped = false;
    this->IsAtWork = false;
  }
  void NeverStop() { this->StopAt(-1, Seconds(1e9)); }

  int Count = 0;
  bool HasStopped = false;
  bool IsAtWork = false;

private:
  int Event = -1;
  Clock::time_point Start;
  Seconds Time{ 1e9 };
};

using MakeFilter = std::function<vtkSmartPointer<vtkAlgorithm>()>;

vtkDataSet* OutputOf(vtkAlgorithm* algorithm)
{
  return vtkDataSet::SafeDownCast(algorithm->GetOutputDataObject(0));
}

void ExpectEmpty(vtkDataSet* output)
{
  EXPECT_EQ(output->GetNumberOfPoints(), 0);
  EXPECT_EQ(output->GetNumberOfCells(), 0);
  EXPECT_EQ(output->GetPointData()->GetNumberOfArrays(), 0);
  EXPECT_EQ(output->GetFieldData()->GetNumberOfArrays(), 0);
}

/** Stops new filters by turns at random events and after random times. */
void ExpectStops(const MakeFilter& make, int moments, unsigned int seed)
{
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto whole = make();
  vtkNew<Stopper> watch;
  whole->AddObserver(vtkCommand::ProgressEvent, watch);
  watch->NeverStop();
  const Clock::time_point start = Clock::now();
  whole->Update();
  const Seconds length = Clock::now() - start;
  ASSERT_GT(OutputOf(whole)->GetNumberOfCells(), 0);
  int stoppedAtWork = 0;
  for (int moment = 0; moment < moments; ++moment)
  {
    const auto filter = make();
    const auto messages = test::Watch(filter);
    vtkNew<Stopper> stopper;
    filter->AddObserver(vtkCommand::ProgressEvent, stopper);
    // The first stop is surely at work. How many events come, besides the phases', depends on time.
    const int any = static_cast<int>(random() % watch->Count);
    const int event = moment == 0 ? 2 : (moment % 2 == 0 ? any : -1);
    const double part = std::uniform_real_distribution<double>(0.0, 1.0)(random);
    stopper->StopAt(event, event < 0 ? part * length : Seconds(1e9));
    SCOPED_TRACE("event " + std::to_string(event) + ", at " + std::to_string(part));
    filter->Update();
    stoppedAtWork += stopper->IsAtWork ? 1 : 0;
    if (stopper->IsAtWork || OutputOf(filter)->GetNumberOfPoints() == 0)
    {
      ExpectEmpty(OutputOf(filter));
    }
    else
    {
      EXPECT_EQ(test::Difference(OutputOf(filter), OutputOf(whole)), "");
    }
    filter->SetAbortExecute(0);
    filter->Modified();
    stopper->NeverStop();
    filter->Update();
    EXPECT_EQ(test::Difference(OutputOf(filter), OutputOf(whole)), "");
    EXPECT_EQ(messages->ErrorCount, 0) << messages->Errors;
  }
  EXPECT_GT(stoppedAtWork, 0);
}

}

TEST(Cancel, Contour)
{
  const auto image = test::PhantomImage({ 40, 40, 40 }, 1.0);
  ExpectStops(
    [&]
    {
      const auto contour = vtkSmartPointer<vtkIsodiamondContour>::New();
      contour->SetInputData(image);
      contour->SetValue(0, 50.0);
      contour->SetValue(1, 30.0);
      contour->SetErrorTolerance(0.2);
      contour->SetMinimumPieceSize(20);
      return contour;
    },
    25, 1);
}

TEST(Cancel, IntervalVolume)
{
  const auto image = test::PhantomImage({ 32, 32, 32 }, 1.0);
  ExpectStops(
    [&]
    {
      const auto volume = vtkSmartPointer<vtkIsodiamondIntervalVolume>::New();
      volume->SetInputData(image);
      volume->SetIsorange(30.0, 70.0);
      volume->SetErrorTolerance(0.1);
      return volume;
    },
    25, 2);
}

TEST(Cancel, SimulationQuality)
{
  const auto image = test::PhantomImage({ 20, 20, 20 }, 5.0);
  ExpectStops(
    [&]
    {
      const auto volume = vtkSmartPointer<vtkIsodiamondIntervalVolume>::New();
      volume->SetInputData(image);
      volume->SetIsorange(50.0, 200.0);
      volume->SimulationQualityOn();
      return volume;
    },
    10, 3);
}

TEST(Cancel, Builder)
{
  const auto image = test::PhantomImage({ 48, 48, 48 }, 1.0);
  const auto make = [&](int model)
  {
    return [&image, model]
    {
      const auto builder = vtkSmartPointer<vtkIsodiamondBuilder>::New();
      builder->SetInputData(image);
      builder->SetIsovalue(50.0);
      builder->SetModel(model);
      return builder;
    };
  };
  ExpectStops(make(vtkIsodiamondHierarchy::MINIMAL), 15, 3);
  ExpectStops(make(vtkIsodiamondHierarchy::RELEVANT), 5, 4);
  // An HD is built in one phase, so small ones report nothing while at work.
  vtkNew<Stopper> stopper;
  const auto builder = make(vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)();
  builder->AddObserver(vtkCommand::ProgressEvent, stopper);
  stopper->StopAt(1, Seconds(1e9));
  builder->Update();
  ExpectEmpty(builder->GetOutput());
}

TEST(Cancel, Extractor)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::PhantomImage({ 64, 64, 64 }, 1.0));
  for (const bool isScalars : { false, true })
  {
    builder->SetIsovalue(50.0);
    builder->SetModel(
      isScalars ? vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS : vtkIsodiamondHierarchy::MINIMAL);
    builder->Update();
    ExpectStops(
      [&]
      {
        const auto extractor = vtkSmartPointer<vtkIsodiamondExtractor>::New();
        extractor->SetInputData(builder->GetOutput());
        return extractor;
      },
      15, 5);
  }
}

TEST(Cancel, TheExtractorBehindAnAbortedBuilderIsEmptyAndSoWholeAgain)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::PhantomImage({ 24, 24, 24 }, 1.0));
  builder->SetIsovalue(50.0);
  vtkNew<Stopper> stopper;
  builder->AddObserver(vtkCommand::ProgressEvent, stopper);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  const auto messages = test::Watch(extractor); // its errors: an input without a hierarchy
  extractor->Update();
  const vtkIdType cells = extractor->GetOutput()->GetNumberOfCells();
  ASSERT_GT(cells, 0);
  builder->SetIsovalue(40.0);
  stopper->StopAt(2, Seconds(1e9));
  extractor->Update();
  ASSERT_TRUE(stopper->HasStopped);
  ExpectEmpty(extractor->GetOutput());
  EXPECT_EQ(extractor->GetNumberOfFrontDiamonds(), 0);
  builder->SetAbortExecute(0);
  builder->SetIsovalue(50.0);
  stopper->NeverStop();
  extractor->Update();
  EXPECT_EQ(extractor->GetOutput()->GetNumberOfCells(), cells);
}
