// SPDX-License-Identifier: BSD-3-Clause
// Filters whose properties and inputs change between updates, at random: always like new ones.
#include "FilterTestTools.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkShortArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/** All that a filter can be told, and its input. */
struct Settings
{
  vtkSmartPointer<vtkDataSet> Input;
  std::string Array = "density";
  std::vector<double> Isovalues = { 0.0 };
  std::array<double, 2> Isorange = { -0.2, 0.2 };
  double Tolerance = 0.0;
  int Target = 0;
  bool OneTolerance = false;
  int Unit = vtkIsodiamondVolumeAlgorithm::WORLD_UNITS;
  int OutputType = vtkIsodiamondExtractor::UNSTRUCTURED_GRID;
  double InteriorTolerance = VTK_DOUBLE_MAX;
  bool UseInterior = true;
  bool UseRegion = false;
  std::array<double, 6> Region = { 2.0, 6.0, 2.0, 6.0, 2.0, 6.0 };
  double OutsideTolerance = VTK_DOUBLE_MAX;
  bool ViewDependent = false;
  std::array<double, 3> ViewPosition = { 0.0, 0.0, 30.0 };
  double ViewAngle = 30.0;
  double PixelTolerance = 20.0;
  int Precision = vtkAlgorithm::DEFAULT_PRECISION;
  int Threads = 1;
  bool GlobalIds = false;
  int Metric = vtkIsodiamondHierarchy::DISTANCE;
  bool ExactIsovertices = true;
  bool PreserveFeatures = true;
  bool PreserveTopology = true;
  int MinimumPieceSize = 0;
  bool Attributes = true;
  int CacheSize = 512;
  bool Normals = true;
  bool Gradients = false;
  bool Scalars = true;
  bool CloseBoundary = false;
  int Model = vtkIsodiamondHierarchy::MINIMAL;
  int Shape = vtkIsodiamondHierarchy::ISOSURFACE;
  bool RefineInterior = false;
  bool OtherArrays = false;
};

/** Changes settings one at a time, to others that make sense and, less often, to some that do
 *  not. */
class Changer
{
public:
  Changer(unsigned int seed, bool onlyImages)
    : Random(seed)
    , OnlyImages(onlyImages)
  {
  }

  vtkSmartPointer<vtkDataSet> NewInput()
  {
    const auto size = [this] { return 9 + static_cast<int>(this->Random() % 5); };
    const std::array<int, 3> dimensions = { size(), size(), size() };
    const auto image = test::BallImage(dimensions);
    vtkNew<vtkDoubleArray> other;
    other->SetName("other");
    vtkNew<vtkShortArray> integers;
    integers->SetName("integers");
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      other->InsertNextValue(0.1 + std::sin(0.01 * static_cast<double>(i)));
      integers->InsertNextValue(static_cast<short>(i % 100));
    }
    image->GetPointData()->AddArray(other);
    image->GetPointData()->AddArray(integers);
    switch (this->OnlyImages ? 2 + this->Random() % 3 : this->Random() % 5)
    {
      case 0:
        return test::Rectilinear(image, test::UnevenPlace);
      case 1:
        return StructuredFrom(image);
      case 2:
        image->AllocatePointGhostArray();
        image->GetPointGhostArray()->SetValue(
          image->GetNumberOfPoints() / 3, vtkDataSetAttributes::HIDDENPOINT);
        return image;
      default:
        return image;
    }
  }

  void Change(Settings& settings)
  {
    // Nonsense is taken back in the next step, as most steps should have an output.
    const bool isNonsense = this->Repair != nullptr;
    if (isNonsense)
    {
      this->Repair(settings);
      this->Repair = nullptr;
      return;
    }
    if (this->OneOf(12))
    {
      this->MakeNonsense(settings);
      return;
    }
    switch (this->Random() % 6)
    {
      case 0:
        this->ChangeInput(settings);
        break;
      case 1:
        this->ChangeShape(settings);
        break;
      case 2:
      case 3:
        this->ChangeQuery(settings);
        break;
      case 4:
        this->ChangeBuild(settings);
        break;
      default:
        this->ChangeOutput(settings);
        break;
    }
  }

private:
  bool OneOf(unsigned int count) { return this->Random() % count == 0; }
  double Between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Random);
  }

  void ChangeInput(Settings& settings)
  {
    switch (this->Random() % 4)
    {
      case 0:
        this->ChangeSamples(settings.Input);
        break;
      case 1:
        this->ChangePlace(settings.Input);
        break;
      case 2:
        settings.Array = settings.Array == "density" ? "other" : "density";
        break;
      default:
        settings.Input = this->NewInput();
        break;
    }
  }

  void ChangeSamples(vtkDataSet* input)
  {
    vtkDataArray* array = input->GetPointData()->GetArray("density");
    for (int i = 0; i < 20; ++i)
    {
      const auto at = static_cast<vtkIdType>(this->Random() % array->GetNumberOfTuples());
      array->SetTuple1(at, -array->GetTuple1(at));
    }
    array->Modified();
    input->Modified();
  }

  void ChangePlace(vtkDataSet* input)
  {
    const double value = this->Between(0.5, 1.5);
    if (vtkImageData* image = vtkImageData::SafeDownCast(input))
    {
      this->OneOf(2) ? image->SetSpacing(1.0, value, 1.0) : image->SetOrigin(value, 0.0, 0.0);
    }
    else if (vtkRectilinearGrid* grid = vtkRectilinearGrid::SafeDownCast(input))
    {
      vtkDataArray* x = grid->GetXCoordinates();
      x->SetTuple1(0, x->GetTuple1(0) - value);
      x->Modified();
      grid->Modified();
    }
    else if (vtkPointSet* points = vtkPointSet::SafeDownCast(input))
    {
      points->GetPoints()->SetPoint(0, -value, 0.0, 0.0);
      points->GetPoints()->Modified();
      points->Modified();
    }
  }

  static vtkSmartPointer<vtkDataSet> StructuredFrom(vtkImageData* image)
  {
    auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
    grid->SetDimensions(image->GetDimensions());
    vtkNew<vtkPoints> points;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double* p = image->GetPoint(i);
      points->InsertNextPoint(p[0] + 0.1 * p[1], p[1], p[2] + 0.01 * p[0] * p[0]);
    }
    grid->SetPoints(points);
    grid->GetPointData()->ShallowCopy(image->GetPointData());
    return grid;
  }

  void ChangeShape(Settings& settings)
  {
    const double low = this->Between(-0.4, 0.2);
    settings.Isorange = { low, this->OneOf(4) ? Infinity : low + this->Between(0.05, 0.5) };
    settings.Isovalues.clear();
    for (unsigned int count = this->Random() % 4; count > 0; --count)
    {
      settings.Isovalues.push_back(0.1 * static_cast<int>(this->Random() % 6) - 0.25);
    }
    if (this->OneOf(3))
    {
      settings.Shape = 1 - settings.Shape;
    }
  }

  void ChangeQuery(Settings& settings)
  {
    switch (this->Random() % 8)
    {
      case 6:
        settings.Target = this->OneOf(2) ? 0 : static_cast<int>(this->Random() % 2000);
        settings.UseInterior = !this->OneOf(3);
        break;
      case 7:
        settings.Unit = 1 - settings.Unit;
        settings.OutputType = 1 - settings.OutputType;
        break;
      case 0:
        settings.Tolerance = this->OneOf(3) ? 0.0 : this->Between(0.0, 0.5);
        break;
      case 1:
        settings.InteriorTolerance = this->OneOf(3) ? VTK_DOUBLE_MAX : this->Between(0.0, 0.5);
        break;
      case 2:
        settings.UseRegion = !settings.UseRegion;
        break;
      case 3:
        for (int axis = 0; axis < 3; ++axis)
        {
          settings.Region[2 * axis] = this->Between(-2.0, 8.0);
          settings.Region[2 * axis + 1] = settings.Region[2 * axis] + this->Between(-1.0, 9.0);
        }
        break;
      case 4:
        settings.OutsideTolerance = this->OneOf(3) ? VTK_DOUBLE_MAX : this->Between(0.0, 2.0);
        break;
      default:
        settings.ViewDependent = !settings.ViewDependent;
        settings.ViewPosition[0] = this->Between(-20.0, 20.0);
        settings.PixelTolerance = this->Between(0.0, 40.0);
        break;
    }
  }

  void ChangeBuild(Settings& settings)
  {
    switch (this->Random() % 9)
    {
      case 0:
        settings.Metric = 1 - settings.Metric;
        break;
      case 1:
        settings.ExactIsovertices = !settings.ExactIsovertices;
        break;
      case 2:
        settings.PreserveFeatures = !settings.PreserveFeatures;
        break;
      case 3:
        settings.CloseBoundary = !settings.CloseBoundary;
        break;
      case 4:
        settings.RefineInterior = !settings.RefineInterior;
        break;
      case 5:
        settings.OtherArrays = !settings.OtherArrays;
        break;
      case 6:
        settings.PreserveTopology = !settings.PreserveTopology;
        break;
      case 7:
        settings.MinimumPieceSize = this->OneOf(2) ? 0 : static_cast<int>(this->Random() % 30);
        break;
      default:
        settings.Model = static_cast<int>(this->Random() % 3);
        break;
    }
  }

  void ChangeOutput(Settings& settings)
  {
    switch (this->Random() % 9)
    {
      case 0:
        settings.Precision = static_cast<int>(this->Random() % 3);
        break;
      case 1:
        settings.Threads = static_cast<int>(this->Random() % 4);
        break;
      case 2:
        settings.Attributes = !settings.Attributes;
        break;
      case 3:
        settings.CacheSize = this->OneOf(2) ? 0 : 512;
        break;
      case 4:
        settings.Normals = !settings.Normals;
        break;
      case 5:
        settings.Gradients = !settings.Gradients;
        break;
      case 6:
        settings.GlobalIds = !settings.GlobalIds;
        break;
      case 7:
        settings.OneTolerance = !settings.OneTolerance;
        break;
      default:
        settings.Scalars = !settings.Scalars;
        break;
    }
  }

  /** Sets nonsense, and keeps how to take it back. */
  template <typename T>
  void Break(Settings& settings, T Settings::*member, const T& nonsense)
  {
    this->Repair = [member, good = settings.*member](Settings& broken) { broken.*member = good; };
    settings.*member = nonsense;
  }

  void MakeNonsense(Settings& settings)
  {
    switch (this->Random() % 8)
    {
      case 0:
        this->Break(settings, &Settings::Isorange, { 0.2, -0.2 });
        break;
      case 1:
        this->Break(settings, &Settings::Tolerance, -1.0);
        break;
      case 2:
        this->Break(settings, &Settings::Tolerance, NotANumber);
        break;
      case 3:
        this->Break(settings, &Settings::Array, std::string("nowhere"));
        break;
      case 4:
        this->Break(settings, &Settings::InteriorTolerance, NotANumber);
        break;
      case 5:
        this->Break(settings, &Settings::Isovalues, { 0.0, NotANumber });
        break;
      case 6:
        settings.ViewDependent = true;
        this->Break(settings, &Settings::ViewAngle, 180.0);
        break;
      default:
        this->Break(
          settings, &Settings::Input, vtkSmartPointer<vtkDataSet>(test::BallImage({ 9, 9, 1 })));
        break;
    }
  }

  std::mt19937 Random;
  bool OnlyImages;
  std::function<void(Settings&)> Repair;
};

/** One filter or several that make a mesh as settings say. */
class Subject
{
public:
  virtual ~Subject() = default;
  virtual vtkIdType RemovedPieces() = 0;
  virtual void Apply(const Settings& settings) = 0;
  virtual std::vector<vtkAlgorithm*> Filters() = 0;

  /** @return whether there were errors */
  bool Update()
  {
    const int before = this->Errors();
    this->Filters().back()->Update();
    return this->Errors() > before;
  }
  vtkDataSet* Output()
  {
    return vtkDataSet::SafeDownCast(this->Filters().back()->GetOutputDataObject(0));
  }

protected:
  void Listen()
  {
    for (vtkAlgorithm* filter : this->Filters())
    {
      this->Heard.push_back(test::Watch(filter));
    }
  }

private:
  int Errors()
  {
    int errors = 0;
    for (const auto& messages : this->Heard)
    {
      errors += messages->ErrorCount;
    }
    return errors;
  }

  std::vector<vtkSmartPointer<test::Messages>> Heard;
};

void ApplyQuery(const Settings& settings, vtkIsodiamondAlgorithm* filter)
{
  filter->SetErrorTolerance(settings.Tolerance);
  filter->SetTargetNumberOfTriangles(settings.Target);
  filter->SetUseRegionOfInterest(settings.UseRegion);
  filter->SetRegionOfInterest(settings.Region.data());
  filter->SetOutsideErrorTolerance(settings.OutsideTolerance);
  filter->SetViewDependent(settings.ViewDependent);
  filter->SetViewPosition(settings.ViewPosition.data());
  filter->SetViewAngle(settings.ViewAngle);
  filter->SetPixelTolerance(settings.PixelTolerance);
  filter->SetOutputPointsPrecision(settings.Precision);
  filter->SetNumberOfThreads(settings.Threads);
  filter->SetGenerateGlobalIds(settings.GlobalIds);
}

void ApplyInput(const Settings& settings, vtkAlgorithm* filter)
{
  filter->SetInputDataObject(0, settings.Input);
  filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, settings.Array.c_str());
}

void ApplyVolume(const Settings& settings, vtkIsodiamondVolumeAlgorithm* filter)
{
  ApplyQuery(settings, filter);
  ApplyInput(settings, filter);
  filter->SetErrorMetric(settings.Metric);
  filter->SetToleranceUnit(settings.Unit);
  filter->SetOneTolerance(settings.OneTolerance);
  filter->SetExactIsovertices(settings.ExactIsovertices);
  filter->SetPreserveFeatures(settings.PreserveFeatures);
  filter->SetPreserveTopology(settings.PreserveTopology);
  filter->SetMinimumPieceSize(settings.MinimumPieceSize);
  filter->SetInterpolateAttributes(settings.Attributes);
  filter->SetCacheSize(settings.CacheSize);
}

class ContourSubject : public Subject
{
public:
  ContourSubject() { this->Listen(); }
  void Apply(const Settings& settings) override
  {
    ApplyVolume(settings, this->Contour);
    this->Contour->SetComputeNormals(settings.Normals);
    this->Contour->SetComputeGradients(settings.Gradients);
    this->Contour->SetComputeScalars(settings.Scalars);
    this->Contour->SetCloseBoundary(settings.CloseBoundary);
    const auto count = static_cast<int>(settings.Isovalues.size());
    this->Contour->SetNumberOfContours(count);
    for (int i = 0; i < count; ++i)
    {
      this->Contour->SetValue(i, settings.Isovalues[i]);
    }
  }
  std::vector<vtkAlgorithm*> Filters() override { return { this->Contour }; }
  vtkIdType RemovedPieces() override { return this->Contour->GetNumberOfRemovedPieces(); }

private:
  vtkNew<vtkIsodiamondContour> Contour;
};

class VolumeSubject : public Subject
{
public:
  VolumeSubject() { this->Listen(); }
  void Apply(const Settings& settings) override
  {
    ApplyVolume(settings, this->Volume);
    this->Volume->SetIsorange(settings.Isorange[0], settings.Isorange[1]);
    this->Volume->SetInteriorTolerance(settings.InteriorTolerance);
    this->Volume->SetUseInteriorTolerance(settings.UseInterior);
    this->Volume->SetComputeGradients(settings.Gradients);
  }
  std::vector<vtkAlgorithm*> Filters() override { return { this->Volume }; }
  vtkIdType RemovedPieces() override { return this->Volume->GetNumberOfRemovedPieces(); }

private:
  vtkNew<vtkIsodiamondIntervalVolume> Volume;
};

class PipelineSubject : public Subject
{
public:
  PipelineSubject()
  {
    this->Extractor->SetInputConnection(this->Builder->GetOutputPort());
    this->Listen();
  }
  void Apply(const Settings& settings) override
  {
    ApplyInput(settings, this->Builder);
    this->Builder->SetModel(settings.Model);
    this->Builder->SetShape(settings.Shape);
    const double isovalue = settings.Isovalues.empty() ? 0.0 : settings.Isovalues.back();
    this->Builder->SetIsovalue(isovalue);
    this->Builder->SetIsorange(settings.Isorange[0], settings.Isorange[1]);
    this->Builder->SetErrorMetric(settings.Metric);
    this->Builder->SetExactIsovertices(settings.ExactIsovertices);
    this->Builder->SetPreserveFeatures(settings.PreserveFeatures);
    this->Builder->SetPreserveTopology(settings.PreserveTopology);
    this->Builder->SetMinimumPieceSize(settings.MinimumPieceSize);
    this->Builder->SetRefineInterior(settings.RefineInterior);
    this->Builder->SetCloseBoundary(settings.CloseBoundary);
    this->Builder->SetComputeNormals(settings.OtherArrays);
    this->Builder->SetNumberOfThreads(settings.Threads);
    ApplyQuery(settings, this->Extractor);
    this->Extractor->SetOutputType(settings.OutputType);
    this->Extractor->SetInteriorTolerance(settings.InteriorTolerance);
    this->Extractor->SetUseInteriorTolerance(settings.UseInterior);
    // Only an HD can give another shape or value than its own; RI and MI warn.
    this->Extractor->SetShape(settings.Gradients ? settings.Shape : -1);
    this->Extractor->StoreIsovalue(isovalue + 0.05);
    this->Extractor->SetUseIsovalue(settings.Scalars);
    this->Extractor->SetPreserveTopology(settings.PreserveTopology);
  }
  std::vector<vtkAlgorithm*> Filters() override { return { this->Builder, this->Extractor }; }
  vtkIdType RemovedPieces() override
  {
    vtkIsodiamondHierarchy* hierarchy = this->Builder->GetHierarchy();
    const bool isEmpty = hierarchy->GetFieldData()->GetNumberOfArrays() == 0; // after an error
    return isEmpty ? 0 : hierarchy->GetNumberOfRemovedPieces();
  }

private:
  vtkNew<vtkIsodiamondBuilder> Builder;
  vtkNew<vtkIsodiamondExtractor> Extractor;
};

template <typename Made>
void ExpectSameAsNew(int steps, unsigned int seed, bool onlyImages)
{
  Changer changer(seed, onlyImages);
  Settings settings;
  settings.Input = changer.NewInput();
  Made subject;
  int errors = 0;
  int meshes = 0;
  for (int step = 0; step < steps; ++step)
  {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
    changer.Change(settings);
    subject.Apply(settings);
    const bool isRefused = subject.Update();
    Made fresh;
    Settings copied = settings;
    copied.Input = vtkSmartPointer<vtkDataSet>::Take(settings.Input->NewInstance());
    copied.Input->DeepCopy(settings.Input);
    fresh.Apply(copied);
    const bool isFreshRefused = fresh.Update();
    ASSERT_EQ(test::Difference(subject.Output(), fresh.Output()), "");
    ASSERT_EQ(subject.RemovedPieces(), fresh.RemovedPieces());
    if (isFreshRefused)
    {
      ++errors;
      EXPECT_EQ(subject.Output()->GetNumberOfPoints(), 0);
    }
    // After a step that changes nothing, nothing is executed again, so no error is repeated.
    EXPECT_LE(isRefused, isFreshRefused);
    meshes += fresh.Output()->GetNumberOfCells() > 0 ? 1 : 0;
  }
  EXPECT_GT(errors, steps / 50);
  EXPECT_GT(meshes, steps / 3);
}

}

TEST(Modify, AContourIsAsANewOne)
{
  ExpectSameAsNew<ContourSubject>(500, 1, false);
}

TEST(Modify, AnIntervalVolumeIsAsANewOne)
{
  ExpectSameAsNew<VolumeSubject>(500, 2, false);
}

TEST(Modify, BuilderAndExtractorAreAsNewOnes)
{
  ExpectSameAsNew<PipelineSubject>(500, 3, true);
}
