// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra for simulations as VTK data: angles, values, distances, hierarchies, hidden cells,
// errors.
#include "FilterTestTools.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMeshQuality.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** The volume of a ball, half a voxel tolerated or what is said. */
vtkSmartPointer<vtkIsodiamondIntervalVolume> Ball(vtkImageData* image, double tolerance)
{
  auto volume = vtkSmartPointer<vtkIsodiamondIntervalVolume>::New();
  volume->SetInputData(image);
  volume->SetIsorange(0.0, Infinity);
  volume->SetErrorMetricToDistance();
  volume->SetErrorTolerance(tolerance);
  volume->SimulationQualityOn();
  return volume;
}

/** The smallest dihedral angle by VTK's own measure. */
double SmallestAngle(vtkUnstructuredGrid* mesh)
{
  double smallest = 180.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    smallest = std::min(smallest, vtkMeshQuality::TetMinAngle(mesh->GetCell(i)));
  }
  return smallest;
}

/** What of a mesh's boundary is on the lower surface. */
vtkSmartPointer<vtkPolyData> LowerSurface(vtkUnstructuredGrid* mesh)
{
  vtkNew<vtkDataSetSurfaceFilter> boundary;
  boundary->SetInputData(mesh);
  boundary->Update();
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(boundary->GetOutput()->GetPoints());
  vtkNew<vtkCellArray> cells;
  vtkDataArray* surfaces = boundary->GetOutput()->GetPointData()->GetArray("Surface");
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < boundary->GetOutput()->GetNumberOfCells(); ++i)
  {
    boundary->GetOutput()->GetCellPoints(i, ids);
    const bool isOn = std::all_of(ids->begin(), ids->end(),
      [&](vtkIdType id) { return surfaces->GetComponent(id, 0) == -1.0; });
    if (isOn)
    {
      cells->InsertNextCell(ids);
    }
  }
  surface->SetPolys(cells);
  return surface;
}

double Told(vtkUnstructuredGrid* mesh, const char* name)
{
  return mesh->GetFieldData()->GetArray(name)->GetComponent(0, 0);
}

}

TEST(SimulationQuality, TellsTheAnglesThatItReaches)
{
  const auto volume = Ball(test::BallImage({ 33, 33, 33 }), 0.5);
  volume->SimulationQualityOff();
  volume->Update();
  const vtkIdType plain = volume->GetOutput()->GetNumberOfCells();
  EXPECT_LT(SmallestAngle(volume->GetOutput()), 5.0);
  EXPECT_EQ(volume->GetSmallestDihedralAngle(), 0.0);
  EXPECT_EQ(volume->GetLargestDihedralAngle(), 0.0);
  volume->SimulationQualityOn();
  volume->Update();
  EXPECT_LT(volume->GetOutput()->GetNumberOfCells(), plain);
  EXPECT_NEAR(volume->GetSmallestDihedralAngle(), SmallestAngle(volume->GetOutput()), 1e-9);
  EXPECT_GE(volume->GetSmallestDihedralAngle(), 15.0);
  EXPECT_LE(volume->GetLargestDihedralAngle(), 165.0);
  EXPECT_GT(volume->GetLargestDihedralAngle(), 90.0);
  EXPECT_EQ(Told(volume->GetOutput(), "SmallestDihedralAngle"), volume->GetSmallestDihedralAngle());
  EXPECT_EQ(Told(volume->GetOutput(), "LargestDihedralAngle"), volume->GetLargestDihedralAngle());
}

TEST(SimulationQuality, KeepsTheToleranceBothWays)
{
  // Two voxels and more, in one direction: away from the floor that cells of full resolution make.
  const auto image = test::BallImage({ 49, 49, 49 });
  const auto full = Ball(image, 0.0);
  full->SimulationQualityOff();
  full->Update();
  const auto fullSurface = LowerSurface(full->GetOutput());
  for (const double tolerance : { 1.0, 2.0, 4.0 })
  {
    const auto volume = Ball(image, tolerance);
    volume->Update();
    const auto surface = LowerSurface(volume->GetOutput());
    EXPECT_LT(surface->GetNumberOfCells(), fullSurface->GetNumberOfCells() / 2);
    EXPECT_LE(test::LargestDistance(surface, fullSurface), tolerance);
    EXPECT_LE(test::LargestDistance(fullSurface, surface), tolerance);
  }
}

TEST(SimulationQuality, HasValuesLevelsAndOtherArrays)
{
  const auto image = test::MakeImage(
    { 17, 17, 17 }, [](double x, double y, double z) { return x + 0.7 * y - 0.45 * z - 7.3; });
  const auto volume = Ball(image, 0.0);
  volume->ComputeGradientsOn();
  volume->Update();
  vtkUnstructuredGrid* mesh = volume->GetOutput();
  ASSERT_GT(mesh->GetNumberOfPoints(), 0);
  vtkDataArray* values = mesh->GetPointData()->GetArray("density");
  vtkDataArray* surfaces = mesh->GetPointData()->GetArray("Surface");
  vtkDataArray* gradients = mesh->GetPointData()->GetArray("Gradient");
  EXPECT_EQ(mesh->GetPointData()->GetScalars(), values);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    const double value = p[0] + 0.7 * p[1] - 0.45 * p[2] - 7.3;
    EXPECT_NEAR(values->GetComponent(i, 0), value, 0.02); // isovertices are at 256ths of an edge
    EXPECT_EQ(surfaces->GetComponent(i, 0) == -1.0, std::abs(value) < 0.02);
    EXPECT_NEAR(gradients->GetComponent(i, 1), 0.7, 1e-5);
  }
  vtkDataArray* levels = mesh->GetCellData()->GetArray("Level");
  ASSERT_EQ(levels->GetNumberOfTuples(), mesh->GetNumberOfCells());
  EXPECT_EQ(levels->GetRange()[1], 4.0);
}

TEST(SimulationQuality, IsTheSameFromAHierarchyAndWithThreads)
{
  const auto image = test::BallImage({ 25, 25, 25 });
  const auto volume = Ball(image, 1.0);
  volume->SetNumberOfThreads(1);
  volume->Update();
  vtkNew<vtkUnstructuredGrid> one;
  one->DeepCopy(volume->GetOutput());
  volume->SetNumberOfThreads(4);
  volume->Update();
  EXPECT_EQ(test::Difference(one, volume->GetOutput()), "");

  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetShapeToIntervalVolume();
  builder->SetIsorange(0.0, Infinity);
  builder->SetErrorMetricToDistance();
  builder->PreserveTopologyOn();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetErrorTolerance(1.0);
  extractor->SimulationQualityOn();
  extractor->Update();
  EXPECT_EQ(extractor->GetOutput()->GetNumberOfCells(), one->GetNumberOfCells());
  EXPECT_EQ(extractor->GetOutput()->GetNumberOfPoints(), one->GetNumberOfPoints());
  EXPECT_EQ(extractor->GetSmallestDihedralAngle(), volume->GetSmallestDihedralAngle());
}

TEST(SimulationQuality, LeavesOutBlankCells)
{
  const auto image = test::BallImage({ 25, 25, 25 });
  const auto whole = Ball(image, 1.0);
  whole->Update();
  image->AllocateCellGhostArray();
  for (int i = 0; i < 24 * 24; ++i)
  {
    image->GetCellGhostArray()->SetValue(12 * 24 * 24 + i, vtkDataSetAttributes::HIDDENCELL);
  }
  const auto cut = Ball(image, 1.0);
  cut->Update();
  ASSERT_GT(cut->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_GT(SmallestAngle(cut->GetOutput()), 0.0);
  for (vtkIdType i = 0; i < cut->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const double z = cut->GetOutput()->GetPoint(i)[2];
    EXPECT_TRUE(z <= 12.0 || z >= 13.0) << z;
  }
}

TEST(SimulationQuality, WorksInRegionsViewsAndOtherWorlds)
{
  const auto image = test::BallImage({ 33, 33, 33 });
  image->SetSpacing(0.5, 0.75, 1.0);
  const auto volume = Ball(image, 0.25);
  volume->UseRegionOfInterestOn();
  volume->SetRegionOfInterest(0.0, 8.0, 0.0, 24.0, 0.0, 32.0);
  volume->SetOutsideErrorTolerance(3.0);
  volume->Update();
  const vtkIdType inRegion = volume->GetOutput()->GetNumberOfCells();
  EXPECT_GT(volume->GetSmallestDihedralAngle(), 3.0);
  volume->UseRegionOfInterestOff();
  volume->Update();
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), inRegion);

  const auto uneven = Ball(nullptr, 0.5);
  uneven->SetInputData(test::Rectilinear(test::BallImage({ 25, 25, 25 }), test::UnevenPlace));
  uneven->Update();
  EXPECT_GT(uneven->GetSmallestDihedralAngle(), 0.0);

  // By the field metric nothing is measured.
  volume->SetErrorMetricToField();
  volume->SetErrorTolerance(0.01);
  volume->Update();
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_GT(volume->GetSmallestDihedralAngle(), 0.0);
}

TEST(SimulationQuality, IsNotForSurfaces)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::BallImage({ 9, 9, 9 }));
  contour->SetValue(0, 0.0);
  contour->SimulationQualityOn();
  const auto messages = test::Watch(contour);
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("SimulationQuality is for interval volumes"), std::string::npos);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
}

TEST(SimulationQuality, OfNothingIsEmpty)
{
  const auto volume = Ball(test::BallImage({ 9, 9, 9 }), 0.5);
  volume->SetIsorange(1000.0, 2000.0);
  const auto messages = test::Watch(volume);
  volume->Update();
  EXPECT_EQ(messages->ErrorCount, 0);
  EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(volume->GetSmallestDihedralAngle(), 0.0);
}
