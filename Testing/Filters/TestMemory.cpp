// SPDX-License-Identifier: BSD-3-Clause
// Allocations that fail: an error and an empty output, and a filter that works again afterwards.
// FaultInjection replaces the allocation functions of its whole program, so this is one of its own.
#include "FaultInjection.h"
#include "FilterTestTools.h"

#include "vtkAlgorithm.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkDiamondMesh.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkIsodiamondPoints.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <set>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

using test::Fault;
using test::Never;
using test::OfMalloc;
using test::OfNew;

/** What is to fail in the next executions. */
struct Injection
{
  Fault* Target = nullptr;
  long First = Never;
  long Count = 0;
};
Injection Injected;

/** A filter in which allocations fail while it executes, not while VTK's pipeline is at work. */
template <typename Filter>
class Injecting : public Filter
{
public:
  static Injecting* New()
  {
    auto* filter = new Injecting;
    filter->InitializeObjectBase();
    return filter;
  }

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    const bool isData = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) != 0;
    if (isData && Injected.Target)
    {
      Injected.Target->Arm(Injected.First, Injected.Count);
    }
    const vtkTypeBool result = Filter::ProcessRequest(request, inputVector, outputVector);
    OfNew.Disarm();
    OfMalloc.Disarm();
    return result;
  }
};

template <typename Filter>
vtkSmartPointer<Injecting<Filter>> NewInjecting()
{
  return vtkSmartPointer<Injecting<Filter>>::New();
}

vtkDataSet* OutputOf(vtkAlgorithm* algorithm)
{
  return vtkDataSet::SafeDownCast(algorithm->GetOutputDataObject(0));
}

bool IsEmpty(vtkDataSet* data)
{
  return data->GetNumberOfPoints() == 0 && data->GetNumberOfCells() == 0 &&
    data->GetPointData()->GetNumberOfArrays() == 0 &&
    data->GetFieldData()->GetNumberOfArrays() == 0;
}

using MakeFilter = std::function<vtkSmartPointer<vtkAlgorithm>()>;

/** Numbers of allocations to fail: the first of so many, and some of the others at random. */
std::set<long> Chosen(long count, unsigned int seed)
{
  constexpr long first = 40;
  constexpr long others = 110;
  std::set<long> chosen;
  std::mt19937 random(seed);
  for (long i = 0; i < std::min(first, count); ++i)
  {
    chosen.insert(i);
  }
  for (long i = 0; i < others && count > first; ++i)
  {
    chosen.insert(static_cast<long>(random() % count));
  }
  return chosen;
}

/** Lets allocations fail in new filters. @param failures how many in a row */
void ExpectErrors(const MakeFilter& make, Fault& fault, long failures, unsigned int seed)
{
  Injected = { &fault, Never, 0 };
  const auto whole = make();
  whole->Update();
  const long count = fault.NumberSeen();
  ASSERT_FALSE(IsEmpty(OutputOf(whole)));
  ASSERT_GT(count, 0);
  for (const long first : Chosen(count, seed))
  {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", allocation " + std::to_string(first) + " of " +
      std::to_string(count));
    Injected = { &fault, first, failures };
    const auto filter = make();
    const auto messages = test::Watch(filter);
    ASSERT_NO_THROW(filter->Update());
    Injected = {};
    const bool isWhole = messages->ErrorCount == 0 && !IsEmpty(OutputOf(filter));
    if (isWhole || (failures == 1 && messages->ErrorCount == 0))
    {
      // It was for something optional, or there were fewer this time: batches are cut by time.
      EXPECT_EQ(test::Difference(OutputOf(filter), OutputOf(whole)), "");
    }
    else
    {
      EXPECT_TRUE(IsEmpty(OutputOf(filter)));
      EXPECT_LE(messages->ErrorCount, 1) << messages->Errors; // without memory, maybe none
    }
    filter->Modified();
    filter->Update();
    ASSERT_EQ(test::Difference(OutputOf(filter), OutputOf(whole)), "");
  }
}

void ExpectAllErrors(const MakeFilter& make, unsigned int seed)
{
  {
    SCOPED_TRACE("one new");
    ExpectErrors(make, OfNew, 1, seed);
  }
  {
    SCOPED_TRACE("all that is new");
    ExpectErrors(make, OfNew, Never, seed);
  }
  SCOPED_TRACE("arrays");
  ExpectErrors(make, OfMalloc, Never, seed);
}

vtkSmartPointer<vtkImageData> ImageWithAttributes(int size)
{
  const auto image = test::BallImage({ size, size, size });
  vtkNew<vtkDoubleArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(image->GetNumberOfPoints());
  other->Fill(2.0);
  image->GetPointData()->AddArray(other);
  return image;
}

constexpr int Size = 14;

}

namespace
{

/** A contour of the value 0. */
template <typename Contour>
vtkSmartPointer<Injecting<Contour>> NewContour(vtkDataSet* input)
{
  const auto contour = NewInjecting<Contour>();
  contour->SetInputData(input);
  contour->SetValue(0, 0.0);
  return contour;
}

}

TEST(Memory, KnowsTheFilters)
{
  EXPECT_TRUE(test::KnowsFilters());
}

TEST(Memory, Contour)
{
  const auto image = ImageWithAttributes(Size);
  for (const bool isClosed : { false, true })
  {
    ExpectAllErrors(
      [&]
      {
        const auto contour = NewContour<vtkIsodiamondContour>(image);
        contour->SetErrorTolerance(0.01);
        contour->SetMinimumPieceSize(5);
        contour->ComputeGradientsOn();
        contour->SetCloseBoundary(isClosed);
        return contour;
      },
      1);
  }
}

TEST(Memory, ContourOfAGridWithHiddenCells)
{
  const auto image = ImageWithAttributes(Size);
  image->AllocatePointGhostArray();
  image->GetPointGhostArray()->SetValue(
    image->GetNumberOfPoints() / 3, vtkDataSetAttributes::HIDDENPOINT);
  const auto grid = test::Rectilinear(image, test::UnevenPlace);
  ExpectAllErrors(
    [&]
    {
      const auto contour = NewContour<vtkIsodiamondContour>(grid);
      return contour;
    },
    2);
}

namespace
{

/** A contour of which the second of three pieces is asked for. */
class PieceOfContour : public vtkIsodiamondContour
{
protected:
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    vtkInformation* output = outputVector->GetInformationObject(0);
    output->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 1);
    output->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 3);
    return this->vtkIsodiamondContour::RequestUpdateExtent(request, inputVector, outputVector);
  }
};

}

TEST(Memory, PieceOfAContour)
{
  const auto image = ImageWithAttributes(Size);
  ExpectAllErrors(
    [&]
    {
      const auto contour = NewContour<PieceOfContour>(image);
      return contour;
    },
    9);
}

TEST(Memory, ContourOfOneTolerance)
{
  const auto image = ImageWithAttributes(Size);
  ExpectAllErrors(
    [&]
    {
      const auto contour = NewContour<vtkIsodiamondContour>(image);
      contour->SetErrorTolerance(0.01);
      contour->OneToleranceOn();
      return contour;
    },
    3);
}

TEST(Memory, ContourOfSeveralValues)
{
  // Not malloc: vtkAppendPolyData calls it itself, after the filter has made sure that it can.
  const auto image = ImageWithAttributes(Size);
  const MakeFilter make = [&]
  {
    const auto contour = NewContour<vtkIsodiamondContour>(image);
    contour->SetValue(1, 0.1);
    return contour;
  };
  ExpectErrors(make, OfNew, 1, 3);
}

TEST(Memory, IntervalVolume)
{
  const auto image = ImageWithAttributes(Size);
  ExpectAllErrors(
    [&]
    {
      const auto volume = NewInjecting<vtkIsodiamondIntervalVolume>();
      volume->SetInputData(image);
      volume->SetIsorange(-0.1, 0.2);
      volume->SetInteriorTolerance(0.05);
      return volume;
    },
    4);
}

TEST(Memory, BuilderAndWhatReadsHierarchies)
{
  const auto image = ImageWithAttributes(Size);
  for (int model = 0; model < 3; ++model)
  {
    SCOPED_TRACE("model " + std::to_string(model));
    const MakeFilter makeBuilder = [&]
    {
      const auto builder = NewInjecting<vtkIsodiamondBuilder>();
      builder->SetInputData(image);
      builder->SetModel(model);
      if (model != vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
      {
        builder->PreserveTopologyOn();
        builder->SetMinimumPieceSize(5);
        builder->ComputeNormalsOn();
        builder->AddPointArray("other");
      }
      return builder;
    };
    ExpectAllErrors(makeBuilder, 5);
    const auto builder = makeBuilder();
    builder->Update();
    // A copy that is no vtkIsodiamondHierarchy is read anew by each filter.
    vtkNew<vtkPolyData> hierarchy;
    hierarchy->ShallowCopy(builder->GetOutputDataObject(0));
    const auto makeReader = [&](auto make) -> MakeFilter
    {
      return [&hierarchy, make]
      {
        const auto filter = make();
        filter->SetInputDataObject(0, hierarchy);
        return filter;
      };
    };
    ExpectAllErrors(makeReader(NewInjecting<vtkIsodiamondExtractor>), 6);
    ExpectAllErrors(makeReader(NewInjecting<vtkDiamondMesh>), 7);
    if (model != vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS)
    {
      ExpectAllErrors(makeReader(NewInjecting<vtkIsodiamondPoints>), 8);
    }
  }
}

TEST(Memory, CountsOnDemand)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(ImageWithAttributes(Size));
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetErrorTolerance(0.1);
  extractor->Update();
  ASSERT_GT(extractor->GetOutput()->GetNumberOfCells(), 0);
  const auto messages = test::Watch(extractor);
  OfNew.Arm(0, 1);
  EXPECT_EQ(extractor->GetNumberOfFrontDiamonds(), 0);
  OfNew.Disarm();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_GT(extractor->GetNumberOfFrontDiamonds(), 0);
  EXPECT_GT(extractor->GetNumberOfSubdividedDiamonds(), 0);
}

namespace
{

/** Threads' arenas reserve memory that could be used whatever the limit: so one for all threads. */
[[maybe_unused]] const int OneArena = mallopt(M_ARENA_MAX, 1);

/** The size of the process's address space, in bytes. */
rlim_t AddressSpace()
{
  long pages = 0;
  if (FILE* file = std::fopen("/proc/self/statm", "r"))
  {
    if (std::fscanf(file, "%ld", &pages) != 1)
    {
      pages = 0;
    }
    std::fclose(file);
  }
  return static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/** Runs a filter with some bytes more than the process has; then without a limit. @return 0 if it
 *  failed as it should, 3 if there was enough memory, otherwise what went wrong */
int RunLimited(const MakeFilter& make, rlim_t bytes)
{
  // Where TBB 2022.3 finds no memory it waits for itself forever, in any program.
  if (std::strcmp(vtkSMPTools::GetBackend(), "TBB") == 0)
  {
    vtkSMPTools::SetBackend("Sequential");
  }
  const auto filter = make();
  const auto messages = test::Watch(filter);
  malloc_trim(0); // or what is free would be used
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  const rlim_t soft = limit.rlim_cur;
  limit.rlim_cur = AddressSpace() + bytes;
  setrlimit(RLIMIT_AS, &limit);
  filter->Update();
  limit.rlim_cur = soft;
  setrlimit(RLIMIT_AS, &limit);
  const bool isEmpty = IsEmpty(OutputOf(filter));
  if (isEmpty != (messages->ErrorCount > 0))
  {
    return 1;
  }
  filter->Modified();
  filter->Update();
  if (IsEmpty(OutputOf(filter)))
  {
    return 2;
  }
  return isEmpty ? 0 : 3;
}

/** Runs a filter in child processes, with more and more memory until there is enough. */
void ExpectErrorsWithLimits(const MakeFilter& make)
{
  constexpr rlim_t mebibyte = 1 << 20;
  int failures = 0;
  for (rlim_t bytes = mebibyte / 4; bytes < 1024 * mebibyte; bytes += bytes / 4)
  {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0)
    {
      _exit(RunLimited(make, bytes));
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << bytes << " bytes: signal " << WTERMSIG(status);
    if (WEXITSTATUS(status) == 3)
    {
      EXPECT_GT(failures, 0);
      return;
    }
    EXPECT_EQ(WEXITSTATUS(status), 0) << bytes << " bytes";
    ++failures;
  }
  ADD_FAILURE() << "there was never enough memory";
}

}

TEST(Memory, LimitedContour)
{
  const auto image = ImageWithAttributes(64);
  ExpectErrorsWithLimits(
    [&]
    {
      const auto contour = vtkSmartPointer<vtkIsodiamondContour>::New();
      contour->SetInputData(image);
      contour->SetValue(0, 0.0);
      contour->SetValue(1, 0.1);
      contour->SetErrorMetricToField();
      return contour;
    });
}

TEST(Memory, LimitedContourWithHiddenCells)
{
  const auto image = ImageWithAttributes(64);
  image->AllocatePointGhostArray();
  image->GetPointGhostArray()->SetValue(
    image->GetNumberOfPoints() / 3, vtkDataSetAttributes::HIDDENPOINT);
  ExpectErrorsWithLimits(
    [&]
    {
      const auto contour = vtkSmartPointer<vtkIsodiamondContour>::New();
      contour->SetInputData(image);
      contour->SetValue(0, 0.0);
      return contour;
    });
}

TEST(Memory, LimitedIntervalVolume)
{
  const auto image = ImageWithAttributes(64);
  ExpectErrorsWithLimits(
    [&]
    {
      const auto volume = vtkSmartPointer<vtkIsodiamondIntervalVolume>::New();
      volume->SetInputData(image);
      volume->SetIsorange(0.0, 1e9);
      volume->SetErrorMetricToField();
      volume->SetInteriorTolerance(0.0);
      return volume;
    });
}

TEST(Memory, LimitedBuilderAndExtractor)
{
  const auto image = ImageWithAttributes(96);
  ExpectErrorsWithLimits(
    [&]
    {
      const auto builder = vtkSmartPointer<vtkIsodiamondBuilder>::New();
      builder->SetInputData(image);
      builder->SetModelToHierarchyOfDiamonds();
      return builder;
    });
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetShapeToIntervalVolume();
  builder->SetIsorange(0.0, 1e9);
  builder->Update();
  ExpectErrorsWithLimits(
    [&]
    {
      const auto extractor = vtkSmartPointer<vtkIsodiamondExtractor>::New();
      extractor->SetInputData(builder->GetOutput());
      return extractor;
    });
}
