// SPDX-License-Identifier: BSD-3-Clause
// Meshes for a target number of cells, and the table of numbers at other tolerances.
#include "FilterTestTools.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUniformGrid.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

template <typename Filter>
vtkIdType CellsOf(Filter* filter)
{
  filter->Update();
  return filter->GetOutput()->GetNumberOfCells();
}

/** Expects at most 5 % less than a target, and the same at the tolerance that the filter tells. */
template <typename Filter>
void ExpectTargetIsMet(Filter* filter, vtkIdType target)
{
  SCOPED_TRACE(target);
  filter->SetTargetNumberOfTriangles(target);
  const vtkIdType cells = CellsOf(filter);
  EXPECT_LE(cells, target);
  EXPECT_GT(cells, 0.95 * target);
  const double tolerance = filter->GetAchievedTolerance();
  EXPECT_GT(tolerance, 0.0);
  EXPECT_EQ(
    filter->GetOutput()->GetFieldData()->GetArray("AchievedTolerance")->GetTuple1(0), tolerance);
  filter->SetTargetNumberOfTriangles(0);
  filter->SetErrorTolerance(tolerance);
  EXPECT_EQ(CellsOf(filter), cells);
  EXPECT_EQ(filter->GetAchievedTolerance(), tolerance);
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetArray("AchievedTolerance"), nullptr);
  // It is the least tolerance that does: codes are 2^-9 apart.
  filter->SetErrorTolerance(tolerance * (1.0 - 1.0 / 500.0));
  EXPECT_GT(CellsOf(filter), target);
}

vtkSmartPointer<vtkImageData> Image()
{
  return test::PhantomImage({ 40, 33, 36 }, 2.0);
}

}

TEST(Target, OfASurface)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(Image());
  contour->SetValue(0, 50.0);
  const vtkIdType full = CellsOf(contour.GetPointer());
  for (const double part : { 0.8, 0.5, 0.3 })
  {
    ExpectTargetIsMet(contour.GetPointer(), static_cast<vtkIdType>(part * full));
  }
  contour->SetTargetNumberOfTriangles(full);
  EXPECT_EQ(CellsOf(contour.GetPointer()), full);
  EXPECT_EQ(contour->GetAchievedTolerance(), 0.0);
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
}

// In units of voxels, rounding must not make it a little less.
TEST(Target, IsMetAgainAtWhatIsTold)
{
  for (int i = 0; i < 20; ++i)
  {
    const auto image = test::PhantomImage({ 20, 20, 20 }, 5.0);
    const double spacing = 1.0 + 0.0741341 * i;
    image->SetSpacing(spacing, spacing, spacing);
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(image);
    contour->SetValue(0, 50.0);
    contour->SetToleranceUnitToVoxels();
    for (const int target : { 500, 800, 1200, 1600, 2000 })
    {
      contour->SetTargetNumberOfTriangles(target);
      const vtkIdType cells = CellsOf(contour.GetPointer());
      contour->SetErrorTolerance(contour->GetAchievedTolerance());
      contour->SetTargetNumberOfTriangles(0);
      EXPECT_EQ(CellsOf(contour.GetPointer()), cells) << spacing;
    }
    contour->SetErrorTolerance(0.1);
    contour->Update();
    EXPECT_EQ(contour->GetAchievedTolerance(), 0.1) << spacing;
  }
}

TEST(Target, IsTheSumOfAllIsovalues)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(Image());
  contour->SetValue(0, 50.0);
  contour->SetValue(1, 30.0);
  contour->SetErrorMetricToField();
  const vtkIdType full = CellsOf(contour.GetPointer());
  ExpectTargetIsMet(contour.GetPointer(), full / 2);
}

TEST(Target, WithARegionOfInterest)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(Image());
  contour->SetValue(0, 50.0);
  contour->UseRegionOfInterestOn();
  contour->SetRegionOfInterest(0, 20, 0, 20, 0, 40);
  const vtkIdType full = CellsOf(contour.GetPointer());
  contour->SetErrorTolerance(VTK_DOUBLE_MAX);
  const vtkIdType coarsest = CellsOf(contour.GetPointer());
  ExpectTargetIsMet(contour.GetPointer(), (full + coarsest) / 2);
}

TEST(Target, OfTetrahedra)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(Image());
  volume->SetIsorange(30.0, 70.0);
  const vtkIdType full = CellsOf(volume.GetPointer());
  ExpectTargetIsMet(volume.GetPointer(), full / 2);
  volume->SetInteriorTolerance(0.5);
  volume->SetErrorTolerance(VTK_DOUBLE_MAX);
  const vtkIdType coarsest = CellsOf(volume.GetPointer());
  ExpectTargetIsMet(volume.GetPointer(), (full + coarsest) / 2);
}

TEST(Target, OfHierarchies)
{
  for (const int model : { vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS,
         vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
  {
    SCOPED_TRACE(model);
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(Image());
    builder->SetIsovalue(50.0);
    builder->SetModel(model);
    builder->SetErrorMetricToAutomatic();
    vtkNew<vtkIsodiamondExtractor> extractor;
    extractor->SetInputConnection(builder->GetOutputPort());
    const vtkIdType full = CellsOf(extractor.GetPointer());
    EXPECT_EQ(builder->GetHierarchy()->GetErrorMetric(),
      model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS ? vtkIsodiamondHierarchy::FIELD
                                                             : vtkIsodiamondHierarchy::DISTANCE);
    ExpectTargetIsMet(extractor.GetPointer(), full / 2);
  }
}

TEST(Target, ThatNoMeshMeets)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(Image());
  contour->SetValue(0, 50.0);
  contour->SetErrorTolerance(VTK_DOUBLE_MAX);
  const vtkIdType coarsest = CellsOf(contour.GetPointer());
  auto messages = test::Watch(contour);
  contour->SetTargetNumberOfTriangles(coarsest - 1);
  EXPECT_EQ(CellsOf(contour.GetPointer()), coarsest);
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_NE(messages->Warnings.find(std::to_string(coarsest)), std::string::npos);
  EXPECT_TRUE(std::isfinite(contour->GetAchievedTolerance()));
  contour->SetTargetNumberOfTriangles(coarsest);
  EXPECT_EQ(CellsOf(contour.GetPointer()), coarsest);
  EXPECT_EQ(messages->WarningCount, 1);
}

// What lies in hidden cells does not count; there is no table of numbers, which would count it.
TEST(Target, WhereCellsAreHidden)
{
  vtkNew<vtkUniformGrid> grid;
  grid->ShallowCopy(Image());
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells() / 2; ++cell)
  {
    grid->BlankCell(cell);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 50.0);
  auto messages = test::Watch(contour);
  const vtkIdType full = CellsOf(contour.GetPointer());
  ExpectTargetIsMet(contour.GetPointer(), full / 2);
  EXPECT_EQ(contour->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  contour->SetErrorTolerance(VTK_DOUBLE_MAX);
  const vtkIdType coarsest = CellsOf(contour.GetPointer());
  contour->SetTargetNumberOfTriangles(coarsest);
  EXPECT_EQ(CellsOf(contour.GetPointer()), coarsest);
  EXPECT_EQ(messages->WarningCount, 0);
}

// Two meshes are made to find that out, and the last one.
// Noise on few samples, which needs more tetrahedra for simulations than without: then full
// resolution is a wrong guess.
TEST(Target, IsMetWhereFullResolutionWouldMeetItOnlyAsItIs)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 8);
  image->AllocateScalars(VTK_FLOAT, 1);
  vtkDataArray* const values = image->GetPointData()->GetScalars();
  std::mt19937 random(17);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      sum += static_cast<double>(random()) / random.max() - 0.5;
    }
    values->SetComponent(i, 0, 1.7 * sum);
  }
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(image);
  volume->SetIsorange(-0.3, 0.6);
  const vtkIdType plain = CellsOf(volume.GetPointer());
  volume->SimulationQualityOn();
  ASSERT_GT(CellsOf(volume.GetPointer()), plain);
  volume->SetErrorTolerance(2.0);
  ASSERT_LT(CellsOf(volume.GetPointer()), plain);
  volume->SetTargetNumberOfTriangles(plain);
  EXPECT_LE(CellsOf(volume.GetPointer()), plain);
}

TEST(Target, ThatNoSimplifiedMeshMeets)
{
  vtkNew<vtkIsodiamondContour> contour;
  const auto image = Image();
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->SimplifyOn();
  contour->SetErrorTolerance(image->GetLength());
  const vtkIdType coarsest = CellsOf(contour.GetPointer());
  auto messages = test::Watch(contour);
  constexpr vtkIdType tooFew = 10;
  contour->SetTargetNumberOfTriangles(tooFew);
  const vtkIdType fewest = CellsOf(contour.GetPointer());
  EXPECT_LE(fewest, coarsest);
  EXPECT_GT(fewest, tooFew);
  EXPECT_EQ(messages->WarningCount, 1);
  contour->SetErrorTolerance(contour->GetAchievedTolerance());
  contour->SetTargetNumberOfTriangles(0);
  EXPECT_EQ(CellsOf(contour.GetPointer()), fewest);
  // A coarser mesh can have more triangles: fewer are looked for between.
  contour->SetTargetNumberOfTriangles(fewest);
  EXPECT_EQ(CellsOf(contour.GetPointer()), fewest);
  contour->SetTargetNumberOfTriangles(coarsest);
  EXPECT_LE(CellsOf(contour.GetPointer()), coarsest);
  EXPECT_LT(contour->GetAchievedTolerance(), image->GetLength());
  EXPECT_EQ(messages->WarningCount, 1);
}

TEST(Target, TableOfTolerances)
{
  vtkNew<vtkIsodiamondContour> contour;
  const auto image = Image();
  image->SetSpacing(0.25, 0.25, 0.5);
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->SetValue(1, 20.0);
  contour->SetToleranceUnitToVoxels();
  contour->SetErrorTolerance(3.0);
  contour->Update();
  vtkNew<vtkFieldData> table;
  table->DeepCopy(contour->GetOutput()->GetFieldData());
  const std::string prefix = "Triangles at tolerance ";
  EXPECT_EQ(table->GetNumberOfArrays(), 10);
  for (int i = 0; i < table->GetNumberOfArrays(); ++i)
  {
    const std::string name = table->GetArrayName(i);
    ASSERT_EQ(name.rfind(prefix, 0), 0U) << name;
    contour->SetErrorTolerance(std::stod(name.substr(prefix.size())));
    EXPECT_EQ(CellsOf(contour.GetPointer()), table->GetArray(i)->GetTuple1(0)) << name;
  }
  // The table goes down from 2 % of the diagonal, 1.7 voxels.
  EXPECT_NE(table->GetArray("Triangles at tolerance 1"), nullptr);
  EXPECT_EQ(table->GetArray("Triangles at tolerance 2"), nullptr);
  EXPECT_NEAR(contour->GetErrorToleranceRange()[1], 1.7, 0.1);
}
