// SPDX-License-Identifier: BSD-3-Clause
// Volumes that are larger than memory: sources that give slab after slab of an image.
#include "FilterTestTools.h"

#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkImageAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include <sys/resource.h>

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/** Makes just the part of an image that it is asked for, and counts requests. */
class PartsSource : public vtkImageAlgorithm
{
public:
  vtkTypeMacro(PartsSource, vtkImageAlgorithm);
  static PartsSource* New();

  std::array<int, 6> WholeExtent = { -3, 29, 2, 32, 5, 67 };
  std::function<double(double, double, double)> Function = [](double x, double y, double z)
  {
    const double bump = std::sin(0.7 * x) * std::cos(0.5 * y) + std::sin(0.4 * z);
    return 14.0 - std::hypot(x - 13.0, y - 16.0, 0.5 * (z - 36.0)) + bump;
  };
  bool HasOther = true;
  const char* NameOfOther = "other";
  bool CanMakeParts = true;
  bool MakesMore = false;  ///< slices than it is asked for
  bool MakesOther = false; ///< slices than it is asked for
  bool HasGhosts = false;
  int FailsAt = -1; ///< the number of the request that fails

  int Requests = 0;
  vtkIdType MostVoxels = 0; ///< of any one request

protected:
  PartsSource()
  {
    this->SetNumberOfInputPorts(0);
    this->SetNumberOfOutputPorts(2); // the second one's values are less by 3
  }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    for (int port = 0; port < 2; ++port)
    {
      vtkInformation* info = outputVector->GetInformationObject(port);
      info->Set(Pipeline::WHOLE_EXTENT(), this->WholeExtent.data(), 6);
      info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), this->CanMakeParts ? 1 : 0);
      vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 1);
    }
    return 1;
  }

  int RequestData(
    vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    if (this->Requests++ == this->FailsAt)
    {
      return 0;
    }
    const int port = std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()));
    vtkInformation* info = outputVector->GetInformationObject(port);
    int extent[6];
    info->Get(Pipeline::UPDATE_EXTENT(), extent);
    if (this->MakesMore)
    {
      extent[4] = std::max(extent[4] - 2, this->WholeExtent[4]);
      extent[5] = std::min(extent[5] + 1, this->WholeExtent[5]);
    }
    if (this->MakesOther && this->Requests > 1)
    {
      ++extent[4];
    }
    vtkImageData* image = vtkImageData::GetData(info);
    image->SetExtent(extent);
    image->SetOrigin(0.5, -2.0, 100.0);
    image->SetSpacing(1.0, 0.75, 1.25);
    vtkNew<vtkFloatArray> density;
    density->SetName("density");
    vtkNew<vtkUnsignedCharArray> other;
    other->SetName(this->NameOfOther);
    const vtkIdType count = image->GetNumberOfPoints();
    density->SetNumberOfTuples(count);
    other->SetNumberOfTuples(this->HasOther ? count : 0);
    this->MostVoxels = std::max(this->MostVoxels, count);
    vtkIdType id = 0;
    for (int z = extent[4]; z <= extent[5]; ++z)
    {
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        for (int x = extent[0]; x <= extent[1]; ++x, ++id)
        {
          density->SetValue(id, static_cast<float>(this->Function(x, y, z) - 3.0 * port));
          if (this->HasOther)
          {
            other->SetValue(id, static_cast<unsigned char>(7 * x + 3 * y + z));
          }
        }
      }
    }
    image->GetPointData()->SetScalars(density);
    if (this->HasOther)
    {
      image->GetPointData()->AddArray(other);
    }
    if (this->HasGhosts)
    {
      vtkUnsignedCharArray* ghosts = image->AllocatePointGhostArray();
      for (vtkIdType point = 0; point < count; ++point)
      {
        const bool isHidden = extent[0] + point % (extent[1] - extent[0] + 1) == 12;
        ghosts->SetValue(point, isHidden ? vtkDataSetAttributes::HIDDENPOINT : 0);
      }
    }
    return 1;
  }
};
vtkStandardNewMacro(PartsSource);

/** The same filter on the whole image at once, and in blocks. */
template <typename Filter>
struct Both
{
  vtkNew<PartsSource> Source;
  vtkNew<PartsSource> SourceOfParts;
  vtkNew<Filter> AtOnce;
  vtkNew<Filter> InBlocks;

  explicit Both(int blocks)
  {
    this->AtOnce->SetInputConnection(this->Source->GetOutputPort());
    this->AtOnce->SetNumberOfBlocks(1);
    this->InBlocks->SetInputConnection(this->SourceOfParts->GetOutputPort());
    this->InBlocks->SetNumberOfBlocks(blocks);
  }

  template <typename Set>
  void ForEach(const Set& set)
  {
    set(this->AtOnce.Get());
    set(this->InBlocks.Get());
  }

  std::string Difference()
  {
    this->AtOnce->Update();
    this->InBlocks->Update();
    EXPECT_EQ(this->AtOnce->GetNumberOfSlabs(), 1);
    return test::Difference(vtkDataSet::SafeDownCast(this->AtOnce->GetOutputDataObject(0)),
      vtkDataSet::SafeDownCast(this->InBlocks->GetOutputDataObject(0)));
  }
};

}

TEST(Blocks, MakeTheSameSurface)
{
  for (const int blocks : { 2, 3, 7 })
  {
    SCOPED_TRACE(blocks);
    Both<vtkIsodiamondContour> both(blocks);
    both.ForEach(
      [](vtkIsodiamondContour* contour)
      {
        contour->SetValue(0, 0.0);
        contour->SetValue(1, 3.3);
        contour->SetErrorTolerance(0.3);
        contour->ComputeNormalsOn();
        contour->ComputeGradientsOn();
      });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), blocks);
    EXPECT_GT(both.InBlocks->GetOutput()->GetNumberOfPolys(), 1000);
    EXPECT_TRUE(both.InBlocks->GetOutput()->GetPointData()->GetNormals());
    EXPECT_TRUE(both.InBlocks->GetOutput()->GetPointData()->HasArray("other"));
    // A slab shares 8 slices with each of its neighbours.
    const int thickness = (63 + blocks - 1) / blocks + 16;
    EXPECT_LE(both.SourceOfParts->MostVoxels, 33 * 31 * std::min(thickness, 63));

    EXPECT_EQ(both.InBlocks->GetErrorToleranceRange()[1], both.AtOnce->GetErrorToleranceRange()[1]);

    // Later updates ask the source for nothing.
    const int requests = both.SourceOfParts->Requests;
    both.ForEach([](vtkIsodiamondContour* contour) { contour->SetErrorTolerance(0.0); });
    EXPECT_EQ(both.Difference(), "");
    both.ForEach(
      [](vtkIsodiamondContour* contour)
      {
        contour->SetErrorTolerance(0.2);
        contour->UseRegionOfInterestOn();
        contour->SetRegionOfInterest(0, 20, 0, 20, 120, 150);
        contour->SimplifyOn();
      });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.SourceOfParts->Requests, requests);
    EXPECT_EQ(both.InBlocks->GetNumberOfBuilds(), 2);
  }
}

TEST(Blocks, MakeTheSameVolume)
{
  Both<vtkIsodiamondIntervalVolume> both(4);
  both.ForEach(
    [](vtkIsodiamondIntervalVolume* volume)
    {
      volume->SetIsorange(-1.0, 4.5);
      volume->SetMinimumPieceSize(20);
      volume->ComputeGradientsOn();
    });
  for (const double tolerance : { 0.0, 0.4, 1e9 })
  {
    both.ForEach(
      [&](vtkIsodiamondIntervalVolume* volume) { volume->SetErrorTolerance(tolerance); });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_GT(both.InBlocks->GetOutput()->GetNumberOfCells(), 100);
  }
  both.ForEach([](vtkIsodiamondIntervalVolume* volume) { volume->SimulationQualityOn(); });
  both.ForEach([](vtkIsodiamondIntervalVolume* volume) { volume->SetErrorTolerance(1.0); });
  EXPECT_EQ(both.Difference(), "");
  EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), 4);
}

// An array of the input that has the name of one of the mesh's own.
TEST(Blocks, MakeTheSameOfArraysWithNamesOfTheMeshsOwn)
{
  Both<vtkIsodiamondIntervalVolume> both(4);
  both.ForEach([](auto* volume) { volume->SetIsorange(-1.0, 4.5); });
  both.Source->NameOfOther = "Surface";
  both.SourceOfParts->NameOfOther = "Surface";
  EXPECT_EQ(both.Difference(), "");
  EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), 4);
  double range[2];
  both.InBlocks->GetOutput()->GetPointData()->GetArray("Surface")->GetRange(range);
  EXPECT_EQ(range[0], -1.0);
  EXPECT_EQ(range[1], 1.0);
}

TEST(Blocks, MakeTheSameHierarchy)
{
  Both<vtkIsodiamondBuilder> both(5);
  for (const int model : { vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
  {
    both.ForEach(
      [&](vtkIsodiamondBuilder* builder)
      {
        builder->SetModel(model);
        builder->SetErrorMetricToDistance();
        builder->SetIsovalue(1.0);
        builder->AddPointArray("other");
        builder->ComputeNormalsOn();
        builder->PreserveTopologyOn();
      });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), 5);
    both.ForEach(
      [](vtkIsodiamondBuilder* builder)
      {
        builder->ClearPointArrays();
        builder->CloseBoundaryOn();
      });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), 5);
    both.ForEach([](vtkIsodiamondBuilder* builder) { builder->CloseBoundaryOff(); });
  }
  both.InBlocks->AddPointArray("none");
  const auto messages = test::Watch(both.InBlocks);
  both.InBlocks->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
}

TEST(Blocks, MakeTheSameOfErrorsInTheField)
{
  Both<vtkIsodiamondContour> contours(5);
  contours.ForEach(
    [](vtkIsodiamondContour* contour)
    {
      contour->SetValue(0, 0.0);
      contour->SetErrorMetricToField();
    });
  for (const double tolerance : { 0.0, 0.5, 2.0 })
  {
    contours.ForEach([&](vtkIsodiamondContour* contour) { contour->SetErrorTolerance(tolerance); });
    EXPECT_EQ(contours.Difference(), "");
    EXPECT_GT(contours.InBlocks->GetOutput()->GetNumberOfPolys(), 100);
  }
  EXPECT_EQ(contours.InBlocks->GetNumberOfSlabs(), 5);

  Both<vtkIsodiamondIntervalVolume> volumes(4);
  volumes.ForEach(
    [](vtkIsodiamondIntervalVolume* volume)
    {
      volume->SetIsorange(-1.0, 9.0);
      volume->SetInteriorTolerance(0.5);
    });
  vtkIdType finest = 0;
  for (const double tolerance : { 0.0, 1.0 })
  {
    volumes.ForEach(
      [&](vtkIsodiamondIntervalVolume* volume) { volume->SetErrorTolerance(tolerance); });
    EXPECT_EQ(volumes.Difference(), "");
    finest = volumes.InBlocks->GetOutput()->GetNumberOfCells();
  }
  volumes.ForEach([](vtkIsodiamondIntervalVolume* volume) { volume->SetInteriorTolerance(5.0); });
  EXPECT_EQ(volumes.Difference(), "");
  EXPECT_LT(volumes.InBlocks->GetOutput()->GetNumberOfCells(), finest);
  EXPECT_EQ(volumes.InBlocks->GetNumberOfSlabs(), 4);

  Both<vtkIsodiamondBuilder> builders(3);
  builders.ForEach(
    [](vtkIsodiamondBuilder* builder)
    {
      builder->SetShapeToIntervalVolume();
      builder->SetIsorange(-1.0, 9.0);
      builder->RefineInteriorOn();
    });
  for (const int metric : { vtkIsodiamondHierarchy::FIELD, vtkIsodiamondHierarchy::DISTANCE })
  {
    builders.ForEach([&](vtkIsodiamondBuilder* builder) { builder->SetErrorMetric(metric); });
    EXPECT_EQ(builders.Difference(), "");
    EXPECT_EQ(builders.InBlocks->GetNumberOfSlabs(), 3);
  }
}

// The volume is padded with the minimum over all slabs, which is in the last one here.
TEST(Blocks, CloseTheSameBoundary)
{
  const auto throughAllFaces = [](double x, double y, double z)
  { return std::sin(0.4 * x) + std::cos(0.5 * y) + std::sin(0.3 * z) - 0.01 * z; };
  for (const int blocks : { 2, 5 })
  {
    SCOPED_TRACE(blocks);
    Both<vtkIsodiamondContour> both(blocks);
    both.Source->Function = both.SourceOfParts->Function = throughAllFaces;
    both.ForEach(
      [](vtkIsodiamondContour* contour)
      {
        contour->SetValue(0, 0.0);
        contour->SetValue(1, -1.0);
        contour->SetErrorTolerance(0.3);
        contour->ComputeNormalsOn();
      });
    EXPECT_EQ(both.Difference(), "");
    const vtkIdType open = both.InBlocks->GetOutput()->GetNumberOfPolys();
    const int requests = both.SourceOfParts->Requests;
    both.ForEach([](vtkIsodiamondContour* contour) { contour->CloseBoundaryOn(); });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), blocks);
    EXPECT_GT(both.InBlocks->GetOutput()->GetNumberOfPolys(), open + 500);
    EXPECT_TRUE(both.InBlocks->GetOutput()->GetPointData()->HasArray("other"));
    // Each slab once for the minimum, and for each isovalue for signs, isovertices and point data.
    EXPECT_EQ(both.SourceOfParts->Requests - requests, 7 * blocks);
    both.ForEach([](vtkIsodiamondContour* contour) { contour->SetErrorTolerance(0.0); });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.SourceOfParts->Requests - requests, 7 * blocks);
    // Nothing lies below this value, not even the padding: it has no surface.
    both.ForEach([](vtkIsodiamondContour* contour) { contour->SetValue(1, -4.0); });
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), blocks);
  }
}

// More slices than were asked for are welcome.
TEST(Blocks, MayBeLargerThanAskedFor)
{
  Both<vtkIsodiamondContour> both(3);
  both.SourceOfParts->MakesMore = true;
  both.ForEach(
    [](vtkIsodiamondContour* contour)
    {
      contour->SetValue(0, 0.0);
      contour->SetErrorTolerance(0.3);
    });
  EXPECT_EQ(both.Difference(), "");
  EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), 3);
}

TEST(Blocks, AreReadAgainWhenTheSourceChanges)
{
  Both<vtkIsodiamondContour> both(3);
  both.ForEach([](vtkIsodiamondContour* contour) { contour->SetValue(0, 0.0); });
  EXPECT_EQ(both.Difference(), "");
  for (PartsSource* source : { both.Source.Get(), both.SourceOfParts.Get() })
  {
    source->Function = [](double x, double y, double z)
    { return 10.0 - std::hypot(x - 10.0, y - 16.0, z - 30.0); };
    source->Modified();
  }
  EXPECT_EQ(both.Difference(), "");
  EXPECT_EQ(both.InBlocks->GetNumberOfBuilds(), 2);
}

TEST(Blocks, AreThoseOfTheirPort)
{
  Both<vtkIsodiamondContour> both(3);
  both.ForEach([](vtkIsodiamondContour* contour) { contour->SetValue(0, 0.0); });
  for (const int port : { 0, 1, 0 })
  {
    both.AtOnce->SetInputConnection(both.Source->GetOutputPort(port));
    both.InBlocks->SetInputConnection(both.SourceOfParts->GetOutputPort(port));
    EXPECT_EQ(both.Difference(), "");
  }
}

TEST(Blocks, AreOneWithAWarningWhereTheyCannotBe)
{
  const auto check = [](const std::function<void(Both<vtkIsodiamondContour>&)>& set, bool warns)
  {
    Both<vtkIsodiamondContour> both(3);
    both.ForEach([](vtkIsodiamondContour* contour) { contour->SetValue(0, 0.0); });
    set(both);
    const auto messages = test::Watch(both.InBlocks);
    EXPECT_EQ(both.Difference(), "");
    EXPECT_EQ(both.InBlocks->GetNumberOfSlabs(), 1);
    EXPECT_EQ(messages->WarningCount, warns ? 1 : 0) << messages->Warnings;
    EXPECT_EQ(messages->ErrorCount, 0);
  };
  check([](auto& both) { both.SourceOfParts->CanMakeParts = false; }, true);
  // That cells are hidden is known only when the first slab is there.
  check([](auto& both) { both.Source->HasGhosts = both.SourceOfParts->HasGhosts = true; }, true);
  // A small image fits into memory.
  check([](auto& both) { both.InBlocks->SetNumberOfBlocks(0); }, false);
}

TEST(Blocks, ThatCannotBeHadAreAnError)
{
  const auto check = [](const std::function<void(PartsSource*)>& set)
  {
    vtkNew<PartsSource> source;
    set(source);
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputConnection(source->GetOutputPort());
    contour->SetValue(0, 0.0);
    contour->SetNumberOfBlocks(4);
    const auto messages = test::Watch(contour);
    const auto ofPipeline = test::Watch(source);
    const auto ofExecutive = vtkSmartPointer<test::Messages>::New();
    source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, ofExecutive);
    contour->Update();
    EXPECT_EQ(messages->ErrorCount, 1) << messages->Errors;
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
    // And it works again.
    source->FailsAt = -1;
    source->MakesOther = false;
    source->Modified();
    contour->Update();
    EXPECT_GT(contour->GetOutput()->GetNumberOfPoints(), 1000);
    EXPECT_EQ(messages->ErrorCount, 1) << messages->Errors;
  };
  check([](PartsSource* source) { source->FailsAt = 2; });
  check([](PartsSource* source) { source->FailsAt = 5; });
  check([](PartsSource* source) { source->MakesOther = true; });
}

namespace
{

/** The size of the process's address space, in bytes. */
double Memory()
{
  long pages = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  const bool isRead = file && std::fscanf(file, "%ld", &pages) == 1;
  std::fclose(file);
  return isRead ? 4096.0 * pages : 0.0;
}

/** Contours a volume of 512^3 floats, 512 MiB, with so much more memory. @return 0 if it can */
int ContourWithin(double bytes)
{
  vtkNew<PartsSource> source;
  source->WholeExtent = { 0, 511, 0, 511, 0, 511 };
  source->HasOther = false;
  source->Function = [](double x, double y, double z)
  { return (x - 250.0) * (x - 250.0) + (y - 260.0) * (y - 260.0) + (z - 240.0) * (z - 240.0); };
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputConnection(source->GetOutputPort());
  contour->SetValue(0, 2500.0);
  contour->SetErrorTolerance(0.5);
  contour->SetNumberOfBlocks(32);
  contour->SetNumberOfThreads(1);
  const auto limit = static_cast<rlim_t>(Memory() + bytes);
  const rlimit limits{ limit, limit };
  setrlimit(RLIMIT_AS, &limits);
  contour->Update();
  return contour->GetOutput()->GetNumberOfPolys() > 1000 ? 0 : 1;
}

}

TEST(Blocks, NeedLessMemoryThanTheVolume)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
    std::exit(ContourWithin(0.4 * 4.0 * 512 * 512 * 512)), testing::ExitedWithCode(0), "");
}
