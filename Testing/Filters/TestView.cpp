// SPDX-License-Identifier: BSD-3-Clause
// View-dependent meshes: the promise in pixels, no cracks, one mesh from all models.
#include "FilterTestTools.h"

#include "vtkCell.h"
#include "vtkCellLocator.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace
{

/** The largest error of a mesh in pixels, over the points at full resolution. */
double LargestErrorInPixels(
  vtkPolyData* mesh, vtkPolyData* full, const double eye[3], double angle, double height)
{
  vtkNew<vtkCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  double largest = 0.0;
  for (vtkIdType i = 0; i < full->GetNumberOfPoints(); ++i)
  {
    double vertex[3];
    full->GetPoint(i, vertex);
    double nearest[3];
    vtkIdType cell = 0;
    int sub = 0;
    double squared = 0.0;
    locator->FindClosestPoint(vertex, nearest, cell, sub, squared);
    const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(vertex, eye));
    const double pixel =
      2.0 * std::tan(0.5 * vtkMath::RadiansFromDegrees(angle)) * distance / height;
    largest = std::max(largest, std::sqrt(squared) / pixel);
  }
  return largest;
}

/** The corners of all cells, sorted: equal for the same mesh in any order. */
std::vector<std::vector<double>> SortedCells(vtkDataSet* mesh)
{
  std::vector<std::vector<double>> cells(mesh->GetNumberOfCells());
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkPoints* corners = mesh->GetCell(i)->GetPoints();
    for (vtkIdType corner = 0; corner < corners->GetNumberOfPoints(); ++corner)
    {
      const double* p = corners->GetPoint(corner);
      cells[i].insert(cells[i].end(), p, p + 3);
    }
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

void SetView(vtkIsodiamondAlgorithm* filter, const double eye[3], double pixels)
{
  filter->ViewDependentOn();
  filter->SetViewPosition(eye[0], eye[1], eye[2]);
  filter->SetViewAngle(40.0);
  filter->SetViewHeight(100.0);
  filter->SetPixelTolerance(pixels);
}

/** Looks at a grid from its middle, and from outside. */
void ExpectErrorsWithinPixels(vtkDataSet* grid)
{
  double centre[3];
  grid->GetCenter(centre);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 0.0);
  contour->Update();
  vtkNew<vtkPolyData> full;
  full->DeepCopy(contour->GetOutput());
  for (const double away : { 0.0, 30.0, 300.0 })
  {
    const double eye[3] = { centre[0] + away, centre[1] - 0.5 * away, centre[2] + 0.1 * away };
    SetView(contour, eye, 1.0);
    contour->Update();
    EXPECT_EQ(test::BoundaryEdges(contour->GetOutput()), 0);
    EXPECT_LT(contour->GetOutput()->GetNumberOfCells(), full->GetNumberOfCells());
    EXPECT_LE(LargestErrorInPixels(contour->GetOutput(), full, eye, 40.0, 100.0), 1.001);
  }
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
}

}

TEST(View, ErrorsStayWithinThePixelTolerance)
{
  const auto image = test::BallImage({ 49, 49, 49 });
  image->SetSpacing(1.0, 0.8, 1.5);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->Update();
  vtkNew<vtkPolyData> full;
  full->DeepCopy(contour->GetOutput());
  const double eyes[3][3] = { { 24, 20, 36 }, { 60, 30, 40 }, { -400, 20, 300 } };
  vtkIdType before = std::numeric_limits<vtkIdType>::max();
  for (const auto& eye : eyes)
  {
    for (const double pixels : { 0.3, 1.0 })
    {
      SetView(contour, eye, pixels);
      contour->Update();
      vtkPolyData* mesh = contour->GetOutput();
      EXPECT_EQ(test::BoundaryEdges(mesh), 0);
      // Coordinates are floats.
      EXPECT_LE(LargestErrorInPixels(mesh, full, eye, 40.0, 100.0), 1.001 * pixels);
    }
    EXPECT_LT(contour->GetOutput()->GetNumberOfCells(), before); // each eye is farther away
    before = contour->GetOutput()->GetNumberOfCells();
  }
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
  // Nothing is tolerated: full resolution. An error tolerance that is greater counts instead.
  contour->SetPixelTolerance(0.0);
  contour->Update();
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), full->GetNumberOfCells());
  contour->SetErrorTolerance(1.0);
  contour->Update();
  const vtkIdType uniform = contour->GetOutput()->GetNumberOfCells();
  contour->ViewDependentOff();
  contour->Update();
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), uniform);
}

TEST(View, ErrorsStayWithinThePixelToleranceOnUnevenGrids)
{
  const auto image = test::BallImage({ 45, 45, 45 });
  ExpectErrorsWithinPixels(test::Rectilinear(image, test::UnevenPlace));
  ExpectErrorsWithinPixels(test::Structured(image, test::BentPlace));
}

TEST(View, IsFinerNearTheEyeThanAnEqualToleranceNeeds)
{
  const auto image = test::PhantomImage({ 64, 64, 64 }, 0.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  const double eye[3] = { -20, 32, 32 };
  SetView(contour, eye, 1.0);
  contour->Update();
  const vtkIdType seen = contour->GetOutput()->GetNumberOfCells();
  contour->ViewDependentOff();
  // For all, what is tolerated at the sample nearest to the eye.
  contour->SetErrorTolerance(2.0 * std::tan(vtkMath::RadiansFromDegrees(20.0)) * 20.0 / 100.0);
  contour->Update();
  EXPECT_LT(1.3 * seen, contour->GetOutput()->GetNumberOfCells());
}

TEST(View, AllModelsAgreeAndRegionsOfInterestStay)
{
  const auto image = test::PhantomImage({ 40, 33, 45 }, 3.0);
  const double eye[3] = { 10, 20, 120 };
  for (const bool isVolume : { false, true })
  {
    for (const bool withRegion : { false, true })
    {
      std::vector<std::vector<double>> expected;
      for (const int model : { vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
      {
        vtkNew<vtkIsodiamondBuilder> builder;
        builder->SetInputData(image);
        builder->SetErrorMetricToDistance();
        builder->SetModel(model);
        builder->SetIsovalue(50.0);
        builder->SetIsorange(50.0, 1e9);
        builder->SetShape(isVolume ? 1 : 0);
        vtkNew<vtkIsodiamondExtractor> extractor;
        extractor->SetInputConnection(builder->GetOutputPort());
        SetView(extractor, eye, 1.0);
        extractor->SetUseRegionOfInterest(withRegion);
        extractor->SetRegionOfInterest(0, 10, 0, 10, 0, 10);
        extractor->SetOutsideErrorTolerance(3.0);
        extractor->Update();
        const auto cells = SortedCells(extractor->GetOutput());
        EXPECT_FALSE(cells.empty());
        if (model == vtkIsodiamondHierarchy::RELEVANT)
        {
          expected = cells;
        }
        EXPECT_TRUE(cells == expected) << cells.size() << " cells, not " << expected.size();
      }
    }
  }
}

TEST(View, RefusesWhatMakesNoSense)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  const auto messages = test::Watch(contour);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  int errors = 0;
  const auto expectError = [&](const char* text)
  {
    messages->Errors.clear();
    contour->Update();
    EXPECT_EQ(messages->ErrorCount, ++errors);
    EXPECT_NE(messages->Errors.find(text), std::string::npos) << messages->Errors;
    EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
  };
  contour->ViewDependentOn();
  contour->SetErrorMetricToField();
  expectError("distance metric");
  contour->SetErrorMetricToDistance();
  contour->SetViewAngle(180.0);
  expectError("view angle");
  contour->SetViewAngle(nan);
  expectError("view angle");
  contour->SetViewAngle(30.0);
  contour->SetViewHeight(0.0);
  expectError("view height");
  contour->SetViewHeight(100.0);
  contour->SetPixelTolerance(-1.0);
  expectError("pixel tolerance");
  contour->SetPixelTolerance(1.0);
  contour->SetViewPosition(nan, 0.0, 0.0);
  expectError("viewpoint");
  contour->SetViewPosition(8.0, 8.0, 8.0);
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, errors);
  EXPECT_GT(contour->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkIsodiamondBuilder> builder; // with the field metric
  builder->SetInputData(image);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->ViewDependentOn();
  const auto others = test::Watch(extractor);
  extractor->Update();
  EXPECT_NE(others->Errors.find("distance metric"), std::string::npos) << others->Errors;
}
