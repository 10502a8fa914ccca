// SPDX-License-Identifier: BSD-3-Clause
// Regions of interest through the filters: geometry, properties, counts, bad input. The sets behind
// them are compared with the reference in Testing/Core/Refinement/TestRegion.cpp.
#include "FilterTestTools.h"

#include "vtkDiamondMesh.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/** The triangles with all corners in a box. */
test::Triangles Within(const test::Triangles& triangles, const double box[6])
{
  test::Triangles within;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(within),
    [&](const auto& triangle)
    {
      return std::all_of(triangle.begin(), triangle.end(),
        [&](const std::array<double, 3>& p)
        {
          return p[0] >= box[0] && p[0] <= box[1] && p[1] >= box[2] && p[1] <= box[3] &&
            p[2] >= box[4] && p[2] <= box[5];
        });
    });
  return within;
}

vtkSmartPointer<vtkIsodiamondContour> MakeContour(vtkImageData* image)
{
  auto contour = vtkSmartPointer<vtkIsodiamondContour>::New();
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  return contour;
}

}

TEST(RegionOfInterest, HasTheUniformMeshInside)
{
  const auto image = test::BallImage({ 41, 41, 41 });
  image->SetSpacing(0.5, 1.0, 2.0);
  image->SetOrigin(10.0, 0.0, -5.0);
  const auto contour = MakeContour(image);
  for (const double tolerance : { 0.0, 0.2 })
  {
    contour->UseRegionOfInterestOff();
    contour->SetErrorTolerance(tolerance);
    contour->Update();
    const test::Triangles uniform = test::SortedTriangles(contour->GetOutput());
    double box[6] = { 13.0, 19.0, 2.0, 21.0, 30.0, 80.0 };
    contour->UseRegionOfInterestOn();
    contour->SetRegionOfInterest(box);
    contour->Update();
    const test::Triangles varying = test::SortedTriangles(contour->GetOutput());
    EXPECT_LT(varying.size(), 2 * uniform.size() / 3);
    EXPECT_GT(Within(uniform, box).size(), 50U);
    EXPECT_TRUE(Within(varying, box) == Within(uniform, box));
    EXPECT_EQ(test::BoundaryEdges(contour->GetOutput()), 0);
  }
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
}

TEST(RegionOfInterest, IsABoxOfTheWorldWhateverTheDirection)
{
  const auto image = test::BallImage({ 33, 33, 33 });
  vtkNew<vtkMatrix3x3> direction; // by 30 degrees about z
  direction->SetElement(0, 0, std::sqrt(0.75));
  direction->SetElement(0, 1, -0.5);
  direction->SetElement(1, 0, 0.5);
  direction->SetElement(1, 1, std::sqrt(0.75));
  image->SetDirectionMatrix(direction);
  const auto contour = MakeContour(image);
  contour->Update();
  const test::Triangles uniform = test::SortedTriangles(contour->GetOutput());
  double bounds[6];
  contour->GetOutput()->GetBounds(bounds);
  double box[6] = { bounds[0], 0.5 * (bounds[0] + bounds[1]), bounds[2], bounds[3],
    0.5 * (bounds[4] + bounds[5]), bounds[5] };
  contour->UseRegionOfInterestOn();
  contour->SetRegionOfInterest(box);
  contour->Update();
  const test::Triangles varying = test::SortedTriangles(contour->GetOutput());
  EXPECT_LT(varying.size(), 2 * uniform.size() / 3);
  EXPECT_TRUE(Within(varying, box) == Within(uniform, box));
}

TEST(RegionOfInterest, GivesTheSameMeshInAllModelsAndSteps)
{
  const auto image = test::BallImage({ 29, 33, 30 });
  for (const int shape :
    { vtkIsodiamondHierarchy::ISOSURFACE, vtkIsodiamondHierarchy::INTERVAL_VOLUME })
  {
    std::vector<vtkSmartPointer<vtkPointSet>> meshes;
    for (const int model : { vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS,
           vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
    {
      vtkNew<vtkIsodiamondBuilder> builder;
      builder->SetInputData(image);
      builder->SetModel(model);
      builder->SetShape(shape);
      builder->SetIsorange(0.0, 0.2);
      vtkNew<vtkIsodiamondExtractor> extractor;
      extractor->SetInputConnection(builder->GetOutputPort());
      extractor->SetErrorTolerance(0.01);
      extractor->UseRegionOfInterestOn();
      extractor->SetRegionOfInterest(10, 40, -5, 20, 3, 15);
      extractor->SetOutsideErrorTolerance(0.1);
      extractor->Update();
      meshes.emplace_back(extractor->GetOutput());
    }
    ASSERT_GT(meshes[0]->GetNumberOfCells(), 100);
    for (const auto& mesh : meshes)
    {
      ASSERT_EQ(mesh->GetNumberOfPoints(), meshes[0]->GetNumberOfPoints());
      ASSERT_EQ(mesh->GetNumberOfCells(), meshes[0]->GetNumberOfCells());
      for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          ASSERT_EQ(mesh->GetPoint(i)[axis], meshes[0]->GetPoint(i)[axis]);
        }
      }
    }
  }
}

TEST(RegionOfInterest, MovesByPositionAndSize)
{
  vtkNew<vtkIsodiamondExtractor> extractor;
  vtkNew<vtkIsodiamondContour> contour;
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  const auto check = [](auto* filter)
  {
    EXPECT_FALSE(filter->GetUseRegionOfInterest());
    EXPECT_EQ(filter->GetOutsideErrorTolerance(), VTK_DOUBLE_MAX);
    filter->SetRegionOfInterestPosition(1.0, 2.0, 3.0);
    filter->SetRegionOfInterestSize(10.0, 20.0, 30.0);
    const double expected[6] = { 1.0, 11.0, 2.0, 22.0, 3.0, 33.0 };
    EXPECT_TRUE(std::equal(expected, expected + 6, filter->GetRegionOfInterest()));
    const vtkMTimeType time = filter->GetMTime();
    filter->SetRegionOfInterestPosition(1.0, 2.0, 3.0);
    filter->SetRegionOfInterestSize(10.0, 20.0, 30.0);
    EXPECT_EQ(filter->GetMTime(), time);
    filter->SetRegionOfInterestPosition(-1.0, 2.0, 3.0);
    EXPECT_GT(filter->GetMTime(), time);
    EXPECT_EQ(filter->GetRegionOfInterest()[1], 9.0);
  };
  check(extractor.Get());
  check(contour.Get());
  check(volume.Get());
}

TEST(RegionOfInterest, AtItsExtremes)
{
  const auto image = test::BallImage({ 33, 33, 33 });
  const auto contour = MakeContour(image);
  contour->Update();
  const test::Triangles fine = test::SortedTriangles(contour->GetOutput());
  contour->SetErrorTolerance(1.0);
  contour->Update();
  const test::Triangles coarse = test::SortedTriangles(contour->GetOutput());
  contour->SetErrorTolerance(VTK_DOUBLE_MAX);
  contour->Update();
  const test::Triangles coarsest = test::SortedTriangles(contour->GetOutput());
  contour->SetErrorTolerance(0.0);
  contour->UseRegionOfInterestOn();
  const auto with = [&](std::array<double, 6> region, double outside)
  {
    contour->SetRegionOfInterest(region.data());
    contour->SetOutsideErrorTolerance(outside);
    contour->Update();
    return test::SortedTriangles(contour->GetOutput());
  };
  EXPECT_TRUE(with({ -1, 40, -1, 40, -1, 40 }, Infinity) == fine);
  EXPECT_TRUE(with({ -Infinity, Infinity, -Infinity, Infinity, -Infinity, Infinity }, 1.0) == fine);
  EXPECT_TRUE(with({ 100, 200, 0, 32, 0, 32 }, 1.0) == coarse);
  EXPECT_TRUE(with({ 20, 10, 0, 32, 0, 32 }, 1.0) == coarse);
  EXPECT_TRUE(with({ 1, 0, 1, 0, 1, 0 }, Infinity) == coarsest);
  EXPECT_TRUE(with({ 100, 200, 0, 32, 0, 32 }, 1e-12) == fine);
  // 0 chooses: four times the error tolerance or a voxel, whichever is more.
  EXPECT_TRUE(with({ 100, 200, 0, 32, 0, 32 }, 0.0) == coarse);
  contour->SetErrorTolerance(0.25);
  EXPECT_TRUE(with({ 100, 200, 0, 32, 0, 32 }, 0.0) == coarse);
  contour->SetErrorTolerance(0.5);
  EXPECT_TRUE(with({ 100, 200, 0, 32, 0, 32 }, 0.0) == with({ 100, 200, 0, 32, 0, 32 }, 2.0));
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
}

TEST(RegionOfInterest, WarnsOfBoxesWithoutSize)
{
  const double inf = Infinity;
  const auto contour = MakeContour(test::BallImage({ 9, 9, 9 }));
  const auto messages = test::Watch(contour);
  const auto warns = [&](std::array<double, 6> region)
  {
    const int before = messages->WarningCount;
    contour->SetRegionOfInterest(region.data());
    contour->Update();
    EXPECT_EQ(messages->ErrorCount, 0);
    return messages->WarningCount - before;
  };
  EXPECT_EQ(warns({ 4, 3, 0, 8, 0, 8 }), 0) << "it is not used";
  contour->UseRegionOfInterestOn();
  EXPECT_EQ(warns({ 4, 3, 0, 8, 0, 8.5 }), 1);
  EXPECT_EQ(warns({ 1, 0, 1, 0, 1, 0 }), 1);
  EXPECT_EQ(warns({ 1, 1, 2, 2, 3, 3 }), 1);
  EXPECT_EQ(warns({ 0, 8, 0, 8, 4, 4 }), 0) << "a slice";
  EXPECT_EQ(warns({ -inf, inf, 2, 2, 3, 3 }), 0) << "a line";

  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 9, 9, 9 }));
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->UseRegionOfInterestOn();
  extractor->SetRegionOfInterest(1, 0, 1, 0, 1, 0);
  extractor->SetTargetNumberOfTriangles(500);
  const auto ofExtractor = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(ofExtractor->WarningCount, 1) << ofExtractor->Warnings;
}

TEST(RegionOfInterest, RefusesWhatIsNoBoxOrTolerance)
{
  const auto contour = MakeContour(test::BallImage({ 9, 9, 9 }));
  contour->UseRegionOfInterestOn();
  contour->SetRegionOfInterest(0, NotANumber, 0, 1, 0, 1);
  auto messages = test::Watch(contour);
  const std::string backend = vtkSMPTools::GetBackend();
  contour->Update();
  EXPECT_EQ(vtkSMPTools::GetBackend(), backend); // the filter's own threads leave no trace
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("region of interest"), std::string::npos);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
  contour->SetRegionOfInterest(0, 1, 0, 1, 0, 1);
  contour->SetOutsideErrorTolerance(-1.0);
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 2);
  EXPECT_NE(messages->Errors.find("outside error tolerance"), std::string::npos);
  contour->UseRegionOfInterestOff(); // the outside tolerance does not matter then
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 2);
  contour->UseRegionOfInterestOn();
  contour->SetOutsideErrorTolerance(0.0);
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 2);
  EXPECT_GT(contour->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(RegionOfInterest, CountsOfTheLastExecution)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 17, 17, 17 }));
  builder->SetModelToRelevant();
  vtkNew<vtkIsodiamondExtractor> extractor;
  EXPECT_EQ(extractor->GetNumberOfSubdividedDiamonds(), 0);
  EXPECT_EQ(extractor->GetNumberOfFrontDiamonds(), 0);
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->Update();
  vtkIsodiamondHierarchy* hierarchy = builder->GetHierarchy();
  // At full resolution all that is stored, then less and less.
  vtkIdType subdivided = extractor->GetNumberOfSubdividedDiamonds();
  vtkIdType front = extractor->GetNumberOfFrontDiamonds();
  EXPECT_EQ(subdivided,
    hierarchy->GetNumberOfActiveIsodiamonds() + hierarchy->GetNumberOfRelevantIsodiamonds());
  EXPECT_GT(front, 0);
  extractor->SetErrorTolerance(0.05);
  EXPECT_EQ(extractor->GetNumberOfSubdividedDiamonds(), subdivided); // not executed yet
  extractor->Update();
  EXPECT_LT(extractor->GetNumberOfSubdividedDiamonds(), subdivided);
  EXPECT_LT(extractor->GetNumberOfFrontDiamonds(), front);
  subdivided = extractor->GetNumberOfSubdividedDiamonds();
  front = extractor->GetNumberOfFrontDiamonds();
  // An HD counts the same, an MI less; the diamond mesh has the same query.
  vtkNew<vtkDiamondMesh> mesh;
  mesh->SetInputConnection(builder->GetOutputPort());
  mesh->SetErrorTolerance(0.05);
  mesh->Update();
  EXPECT_EQ(mesh->GetNumberOfSubdividedDiamonds(), subdivided);
  EXPECT_EQ(mesh->GetNumberOfFrontDiamonds(), front);
  builder->SetModelToHierarchyOfDiamonds();
  extractor->Update();
  EXPECT_EQ(extractor->GetNumberOfSubdividedDiamonds(), subdivided);
  EXPECT_EQ(extractor->GetNumberOfFrontDiamonds(), front);
  builder->SetModelToMinimal();
  extractor->Update();
  EXPECT_LT(extractor->GetNumberOfSubdividedDiamonds(), subdivided);
  EXPECT_LT(extractor->GetNumberOfFrontDiamonds(), front);
  // After an error there is nothing to count.
  extractor->SetErrorTolerance(-1.0);
  const auto messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_EQ(extractor->GetNumberOfSubdividedDiamonds(), 0);
  EXPECT_EQ(extractor->GetNumberOfFrontDiamonds(), 0);
}
