// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra for simulations as VTK data: angles, values, distances, hierarchies, hidden cells,
// errors.
#include "FilterTestTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTetra.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** Tetrahedra of a ball, for simulations. */
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

/** The smallest dihedral angle, between half planes along each edge, in degrees. */
double SmallestAngle(vtkUnstructuredGrid* mesh)
{
  double smallest = 180.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkPoints* points = mesh->GetCell(i)->GetPoints();
    for (int a = 0; a < 4; ++a)
    {
      for (int b = 0; b < 4; ++b)
      {
        std::array<int, 2> others{};
        std::array<int, 4> all = { 0, 1, 2, 3 };
        std::copy_if(all.begin(), all.end(), others.begin(),
          [&](int corner) { return corner != a && corner != b; });
        if (a == b)
        {
          continue;
        }
        double from[3];
        double to[3];
        double along[3];
        double sides[2][3];
        points->GetPoint(a, from);
        points->GetPoint(b, to);
        vtkMath::Subtract(to, from, along);
        vtkMath::Normalize(along);
        for (int k = 0; k < 2; ++k)
        {
          points->GetPoint(others[k], to);
          vtkMath::Subtract(to, from, sides[k]);
          const double part = vtkMath::Dot(sides[k], along);
          for (int axis = 0; axis < 3; ++axis)
          {
            sides[k][axis] -= part * along[axis];
          }
        }
        smallest = std::min(
          smallest, vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(sides[0], sides[1])));
      }
    }
  }
  return smallest;
}

double VolumeOf(vtkUnstructuredGrid* mesh)
{
  double volume = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    std::array<std::array<double, 3>, 4> corners{};
    for (int corner = 0; corner < 4; ++corner)
    {
      mesh->GetCell(i)->GetPoints()->GetPoint(corner, corners[corner].data());
    }
    volume += vtkTetra::ComputeVolume(
      corners[0].data(), corners[1].data(), corners[2].data(), corners[3].data());
  }
  return volume;
}

/** The lower surface: the faces on it that only one tetrahedron has. */
vtkSmartPointer<vtkPolyData> LowerSurface(vtkUnstructuredGrid* mesh)
{
  vtkDataArray* surfaces = mesh->GetPointData()->GetArray("Surface");
  std::map<std::array<vtkIdType, 3>, int> counts;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkIdList* ids = mesh->GetCell(i)->GetPointIds();
    for (int apex = 0; apex < 4; ++apex)
    {
      std::array<vtkIdType, 3> face{};
      std::copy_if(ids->begin(), ids->end(), face.begin(),
        [&](vtkIdType id) { return id != ids->GetId(apex); });
      std::sort(face.begin(), face.end());
      ++counts[face];
    }
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& [face, count] : counts)
  {
    if (count == 1 &&
      std::all_of(face.begin(), face.end(),
        [&](vtkIdType id) { return surfaces->GetComponent(id, 0) == -1.0; }))
    {
      cells->InsertNextCell(3, face.data());
    }
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(mesh->GetPoints());
  surface->SetPolys(cells);
  return surface;
}

/** Corners, middles of sides and of triangles. */
vtkSmartPointer<vtkPolyData> SamplesOf(vtkPolyData* surface)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, ids);
    for (const std::array<double, 3>& parts :
      { std::array<double, 3>{ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0.5, 0.5, 0 },
        { 0.5, 0, 0.5 }, { 0, 0.5, 0.5 }, { 1.0 / 3, 1.0 / 3, 1.0 / 3 } })
    {
      double sum[3] = { 0.0, 0.0, 0.0 };
      for (int k = 0; k < 3; ++k)
      {
        double corner[3];
        surface->GetPoint(ids->GetId(k), corner);
        vtkMath::MultiplyScalar(corner, parts[k]);
        vtkMath::Add(sum, corner, sum);
      }
      points->InsertNextPoint(sum);
    }
  }
  auto samples = vtkSmartPointer<vtkPolyData>::New();
  samples->SetPoints(points);
  return samples;
}

/** The share of triangles with an angle below 15 degrees. */
double ShareOfSmallAngles(vtkPolyData* surface)
{
  vtkIdType small = 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, ids);
    double smallest = 180.0;
    for (int k = 0; k < 3; ++k)
    {
      double at[3];
      double sides[2][3];
      surface->GetPoint(ids->GetId(k), at);
      for (int side = 0; side < 2; ++side)
      {
        surface->GetPoint(ids->GetId((k + 1 + side) % 3), sides[side]);
        vtkMath::Subtract(sides[side], at, sides[side]);
      }
      smallest = std::min(
        smallest, vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(sides[0], sides[1])));
    }
    small += smallest < 15.0 ? 1 : 0;
  }
  return static_cast<double>(small) / static_cast<double>(surface->GetNumberOfCells());
}

using Point = std::array<double, 3>;

/** The triangles of the lower surface whose points are all in a box, as sets of points. */
std::set<std::set<Point>> SurfaceIn(vtkUnstructuredGrid* mesh, double begin, double end)
{
  const auto surface = LowerSurface(mesh);
  std::set<std::set<Point>> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, ids);
    std::set<Point> corners;
    bool isIn = true;
    for (const vtkIdType id : *ids)
    {
      Point point{};
      surface->GetPoint(id, point.data());
      isIn = isIn &&
        std::all_of(point.begin(), point.end(), [&](double x) { return x >= begin && x <= end; });
      corners.insert(point);
    }
    if (isIn)
    {
      triangles.insert(corners);
    }
  }
  return triangles;
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
  const auto image = test::BallImage({ 33, 33, 33 });
  const auto bent = test::Structured(image, test::BentPlace);
  for (vtkDataSet* grid : { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(bent) })
  {
    const auto full = Ball(nullptr, 0.0);
    full->SetInputData(grid);
    full->SimulationQualityOff();
    full->Update();
    const auto fullSurface = LowerSurface(full->GetOutput());
    for (const double tolerance : { 0.25, 1.0, 2.0 })
    {
      const auto volume = Ball(nullptr, tolerance);
      volume->SetInputData(grid);
      volume->Update();
      const auto surface = LowerSurface(volume->GetOutput());
      EXPECT_LT(surface->GetNumberOfCells(), fullSurface->GetNumberOfCells() / 2);
      EXPECT_GE(volume->GetSmallestDihedralAngle(), grid == image ? 15.0 : 3.0);
      EXPECT_LE(test::LargestDistance(SamplesOf(surface), fullSurface), tolerance);
      EXPECT_LE(test::LargestDistance(SamplesOf(fullSurface), surface), tolerance);
      EXPECT_EQ(volume->GetToleranceExcess(), 0.0);
    }
  }
}

// These cannot be refined where vertices move too far onto surfaces.
TEST(SimulationQuality, KeepsTheToleranceOfCellsAtFullResolution)
{
  const auto image = test::MakeImage({ 21, 21, 21 },
    [](double x, double y, double z)
    {
      const auto wave = [](double a, double b) { return std::sin(0.5 * a) * std::cos(0.5 * b); };
      return wave(x, y) + wave(y, z) + wave(z, x) - 0.1;
    });
  const auto full = Ball(image, 0.0);
  full->SimulationQualityOff();
  full->Update();
  const auto fullSurface = LowerSurface(full->GetOutput());
  for (const double tolerance : { 0.05, 0.1 })
  {
    const auto volume = Ball(image, tolerance);
    volume->Update();
    const auto surface = LowerSurface(volume->GetOutput());
    EXPECT_LE(test::LargestDistance(SamplesOf(surface), fullSurface), tolerance);
    EXPECT_LE(test::LargestDistance(SamplesOf(fullSurface), surface), tolerance);
    EXPECT_GE(volume->GetSmallestDihedralAngle(), 15.0);
  }
}

// In such rough waves it could be kept only by bad angles. At full resolution vertices move, too.
TEST(SimulationQuality, PutsAnglesBeforeTheToleranceAndTellsByHowMuchThatIsExceeded)
{
  const auto image = test::MakeImage({ 13, 13, 13 },
    [](double x, double y, double z)
    {
      return std::sin(1.7 * x + 1) * std::cos(1.3 * y + 2) +
        std::sin(1.1 * y + 1) * std::cos(1.9 * z) + std::sin(1.5 * z + 1) * std::cos(1.2 * x) - 0.1;
    });
  const auto full = Ball(image, 0.0);
  full->SimulationQualityOff();
  full->Update();
  EXPECT_EQ(full->GetToleranceExcess(), 0.0);
  const auto fullSurface = LowerSurface(full->GetOutput());
  for (const double tolerance : { 0.0, 0.1 })
  {
    const auto volume = Ball(image, tolerance);
    volume->Update();
    EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 1000);
    EXPECT_GE(volume->GetSmallestDihedralAngle(), 15.0);
    EXPECT_LE(volume->GetLargestDihedralAngle(), 165.0);
    const auto surface = LowerSurface(volume->GetOutput());
    const double distance = std::max(test::LargestDistance(SamplesOf(surface), fullSurface),
      test::LargestDistance(SamplesOf(fullSurface), surface));
    EXPECT_GT(volume->GetToleranceExcess(), 0.0);
    EXPECT_GE(tolerance + volume->GetToleranceExcess(), distance);
    EXPECT_LE(tolerance + volume->GetToleranceExcess(), 1.1 * distance + 1.0 / 16.0);
    EXPECT_EQ(Told(volume->GetOutput(), "ToleranceExcess"), volume->GetToleranceExcess());
    EXPECT_EQ(volume->GetAchievedTolerance(), tolerance);
  }
  // Errors of the field are no distances.
  const auto volume = Ball(image, 0.1);
  volume->SetErrorMetricToField();
  volume->Update();
  EXPECT_TRUE(std::isnan(volume->GetToleranceExcess()));
  EXPECT_EQ(volume->GetOutput()->GetFieldData()->GetArray("ToleranceExcess"), nullptr);
  volume->SetErrorTolerance(0.0);
  volume->Update();
  EXPECT_GT(volume->GetToleranceExcess(), 0.0);
}

TEST(SimulationQuality, MakesFewerTetrahedra)
{
  const auto volume = Ball(test::BallImage({ 33, 33, 33 }), 1.0);
  volume->SimulationQualityOff();
  volume->Update();
  const vtkIdType plain = volume->GetOutput()->GetNumberOfCells();
  volume->SimulationQualityOn();
  volume->Update();
  const vtkIdType coarse = volume->GetOutput()->GetNumberOfCells();
  EXPECT_LT(coarse, 0.8 * plain);
  EXPECT_GE(volume->GetSmallestDihedralAngle(), 15.0);
  // With an interior tolerance, points inside stay.
  volume->SetInteriorTolerance(1e9);
  volume->Update();
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), coarse);
}

// What is convex loses volume with each edge that collapses: it may, up to what it would lose
// without SimulationQuality.
TEST(SimulationQuality, LosesNoMoreVolumeThanIsTolerated)
{
  const auto volume = Ball(test::BallImage({ 25, 25, 25 }), 0.0);
  volume->SimulationQualityOff();
  volume->Update();
  const double full = VolumeOf(volume->GetOutput());
  for (const double tolerance : { 1.0, 2.0 })
  {
    volume->SetErrorTolerance(tolerance);
    volume->SimulationQualityOff();
    volume->Update();
    const double plain = VolumeOf(volume->GetOutput());
    const vtkIdType count = volume->GetOutput()->GetNumberOfCells();
    EXPECT_LT(plain, 0.99 * full);
    volume->SimulationQualityOn();
    volume->Update();
    EXPECT_GE(VolumeOf(volume->GetOutput()), 0.995 * plain);
    EXPECT_LE(VolumeOf(volume->GetOutput()), full);
    EXPECT_LT(volume->GetOutput()->GetNumberOfCells(), 0.8 * static_cast<double>(count));
  }
}

TEST(SimulationQuality, MeetsATarget)
{
  const auto volume = Ball(test::BallImage({ 33, 33, 33 }), 0.0);
  volume->SetTargetNumberOfTriangles(2000);
  volume->Update();
  EXPECT_LE(volume->GetOutput()->GetNumberOfCells(), 2000);
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 1000);
  const double achieved = volume->GetAchievedTolerance();
  const vtkIdType cells = volume->GetOutput()->GetNumberOfCells();
  volume->SetTargetNumberOfTriangles(0);
  volume->SetErrorTolerance(achieved);
  volume->Update();
  EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), cells);
  // One that all meshes meet: nothing is tolerated, which is then the same as with no target.
  volume->SetTargetNumberOfTriangles(10000000);
  volume->Update();
  EXPECT_EQ(volume->GetAchievedTolerance(), 0.0);
  const vtkIdType most = volume->GetOutput()->GetNumberOfCells();
  volume->SetTargetNumberOfTriangles(0);
  volume->SetErrorTolerance(0.0);
  volume->Update();
  EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), most);
}

// Errors of the field: nothing gets coarser, but there are other tetrahedra than without.
TEST(SimulationQuality, MeetsATargetOfFieldErrors)
{
  const auto volume = Ball(test::BallImage({ 25, 25, 25 }), 0.0);
  volume->SetErrorMetricToField();
  const auto messages = test::Watch(volume);
  std::vector<vtkIdType> counts;
  for (const double tolerance : { 0.0, 0.5, 2.0 })
  {
    volume->SetErrorTolerance(tolerance);
    volume->Update();
    counts.push_back(volume->GetOutput()->GetNumberOfCells());
  }
  for (const vtkIdType target : counts)
  {
    volume->SetTargetNumberOfTriangles(target);
    volume->Update();
    EXPECT_LE(volume->GetOutput()->GetNumberOfCells(), target);
    EXPECT_GE(volume->GetOutput()->GetNumberOfCells(), 0.9 * static_cast<double>(target));
  }
  EXPECT_EQ(messages->WarningCount, 0);
}

// A hierarchy that can be refined inside would lead to other tetrahedra.
TEST(SimulationQuality, DoesNotDependOnAnInteriorToleranceBefore)
{
  const auto image = test::PhantomImage({ 25, 25, 25 }, 5.0);
  const auto make = [&]
  {
    auto volume = Ball(image, 0.5);
    volume->SetIsorange(50.0, Infinity);
    return volume;
  };
  const auto fresh = make();
  fresh->Update();
  const auto used = make();
  used->SetInteriorTolerance(10.0);
  used->Update();
  EXPECT_NE(test::Difference(used->GetOutput(), fresh->GetOutput()), "");
  used->SetInteriorTolerance(Infinity);
  used->Update();
  EXPECT_EQ(test::Difference(used->GetOutput(), fresh->GetOutput()), "");
}

// Far from the origin single precision moves points: the angles told are those of the output.
TEST(SimulationQuality, TellsTheAnglesOfPointsAsTheyAreStored)
{
  const auto image = test::MakeImage({ 9, 9, 9 },
    [](double x, double y, double z)
    { return std::sin(0.9 * x + 1) * std::cos(0.7 * y) + std::sin(0.8 * z) * std::cos(0.6 * x); });
  image->SetOrigin(3e5, 3e5, 3e5);
  const auto volume = Ball(image, 0.2);
  volume->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  volume->Update();
  EXPECT_NEAR(volume->GetSmallestDihedralAngle(), SmallestAngle(volume->GetOutput()), 1e-6);
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

// In noise some points on the surface move, and are still on it afterwards.
TEST(SimulationQuality, HasAClosedSurfaceInNoise)
{
  std::minstd_rand random(3);
  const auto image = test::MakeImage({ 21, 21, 21 },
    [&](double x, double y, double z)
    {
      const double noise = 6.0 * static_cast<double>(random()) / std::minstd_rand::max();
      return noise + 4.0 -
        std::sqrt(vtkMath::Distance2BetweenPoints(std::array<double, 3>{ x, y, z }.data(),
          std::array<double, 3>{ 10.0, 10.0, 10.0 }.data()));
    });
  const auto volume = Ball(image, 0.0);
  volume->Update();
  std::map<std::pair<vtkIdType, vtkIdType>, int> counts;
  const auto surface = LowerSurface(volume->GetOutput());
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    surface->GetCellPoints(i, ids);
    for (int k = 0; k < 3; ++k)
    {
      ++counts[std::minmax({ ids->GetId(k), ids->GetId((k + 1) % 3) })];
    }
  }
  EXPECT_GT(counts.size(), 1000U);
  EXPECT_TRUE(std::all_of(
    counts.begin(), counts.end(), [](const auto& edge) { return edge.second % 2 == 0; }));
  // Some of its points are on no edge of the grid, and on no diagonal of a cell or of its sides.
  const auto isBetween = [](double coordinate)
  { return std::abs(coordinate - std::round(coordinate)) > 1e-9; };
  int moved = 0;
  std::set<vtkIdType> used;
  for (const auto& edge : counts)
  {
    used.insert({ edge.first.first, edge.first.second });
  }
  for (const vtkIdType id : used)
  {
    double p[3];
    surface->GetPoint(id, p);
    std::set<double> parts;
    for (const double coordinate : p)
    {
      const double part = coordinate - std::floor(coordinate);
      if (isBetween(coordinate))
      {
        parts.insert(std::round(1e6 * std::min(part, 1.0 - part)));
      }
    }
    moved += parts.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(moved, 0);
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

  // With the field metric, no distances are measured.
  volume->SetErrorMetricToField();
  volume->SetErrorTolerance(0.01);
  volume->Update();
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_GT(volume->GetSmallestDihedralAngle(), 0.0);
}

// There nothing could be near enough, and vertices move as they do without a region.
TEST(SimulationQuality, IsThatOfFullResolutionInARegionWhereNothingIsTolerated)
{
  const auto full = Ball(test::BallImage({ 33, 33, 33 }), 0.0);
  full->Update();
  const auto expected = SurfaceIn(full->GetOutput(), 2.0, 16.0);
  EXPECT_GT(expected.size(), 300U);
  full->SimulationQualityOff();
  full->Update();
  const auto fullSurface = LowerSurface(full->GetOutput());

  const auto volume = Ball(test::BallImage({ 33, 33, 33 }), 0.0);
  volume->UseRegionOfInterestOn();
  volume->SetRegionOfInterest(0.0, 18.0, 0.0, 18.0, 0.0, 18.0);
  volume->SetOutsideErrorTolerance(1.0);
  volume->Update();
  EXPECT_EQ(SurfaceIn(volume->GetOutput(), 2.0, 16.0), expected);
  const auto surface = LowerSurface(volume->GetOutput());
  EXPECT_LT(surface->GetNumberOfCells(), fullSurface->GetNumberOfCells() / 2);
  EXPECT_LE(test::LargestDistance(SamplesOf(surface), fullSurface), 1.0);
  EXPECT_LE(test::LargestDistance(SamplesOf(fullSurface), surface), 1.0);
  EXPECT_GE(volume->GetSmallestDihedralAngle(), 15.0);
}

TEST(SimulationQuality, OfSurfacesLeavesFewSmallAngles)
{
  const auto image = test::BallImage({ 21, 21, 21 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->SetErrorMetricToDistance();
  contour->Update();
  vtkNew<vtkPolyData> full;
  full->ShallowCopy(contour->GetOutput());
  EXPECT_GT(ShareOfSmallAngles(full), 0.15);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetIsovalue(0.0);
  builder->SetErrorMetricToDistance();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetOutputTypeToPolyData();
  double withSimplifyAlone = 0.0;
  for (const double tolerance : { 0.0, 0.1, 1.0 })
  {
    contour->SetErrorTolerance(tolerance);
    contour->SimulationQualityOff();
    contour->Update();
    const vtkIdType plain = contour->GetOutput()->GetNumberOfCells();
    contour->SimulationQualityOn();
    contour->Update();
    vtkPolyData* shaped = contour->GetOutput();
    EXPECT_LT(shaped->GetNumberOfCells(), plain / 2);
    EXPECT_LT(ShareOfSmallAngles(shaped), 0.05);
    const double promised = std::max(tolerance, 0.25);
    EXPECT_LE(test::LargestDistance(SamplesOf(shaped), full), promised);
    EXPECT_LE(test::LargestDistance(SamplesOf(full), shaped), promised);
    // The same with Simplify, too, and from a hierarchy.
    extractor->SetErrorTolerance(tolerance);
    extractor->SimplifyOn();
    extractor->SimulationQualityOn();
    extractor->Update();
    EXPECT_EQ(extractor->GetPolyDataOutput()->GetNumberOfCells(), shaped->GetNumberOfCells());
    extractor->SimulationQualityOff();
    extractor->Update();
    withSimplifyAlone =
      std::max(withSimplifyAlone, ShareOfSmallAngles(extractor->GetPolyDataOutput()));
  }
  EXPECT_GT(withSimplifyAlone, 0.1);
  // A target that the mesh of tolerance 0 meets.
  contour->SetErrorTolerance(0.0);
  contour->Update();
  const vtkIdType finest = contour->GetOutput()->GetNumberOfCells();
  contour->SetTargetNumberOfTriangles(2 * finest);
  contour->Update();
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), finest);
  EXPECT_EQ(contour->GetAchievedTolerance(), 0.0);
  EXPECT_EQ(contour->GetSmallestDihedralAngle(), 0.0);
}

TEST(SimulationQuality, OfSurfacesNeedsTheDistanceMetric)
{
  for (const double tolerance : { 0.0, 0.5 })
  {
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(test::BallImage({ 9, 9, 9 }));
    contour->SetValue(0, 0.0);
    contour->SetErrorMetricToField();
    contour->SetErrorTolerance(tolerance);
    contour->SimulationQualityOn();
    const auto messages = test::Watch(contour);
    contour->Update();
    EXPECT_EQ(messages->ErrorCount, 1);
    EXPECT_NE(messages->Errors.find("SimulationQuality of isosurfaces needs the distance metric"),
      std::string::npos);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
  }
}

// An abort after the mesh was made, while its table of cells is counted.
TEST(SimulationQuality, TellsNothingOfAMeshThatWasNotCompleted)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(test::BallImage({ 17, 17, 17 }));
  volume->SetIsorange(0.0, 10.0);
  volume->SetErrorTolerance(0.5);
  volume->SimulationQualityOn();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* filter = static_cast<vtkAlgorithm*>(caller);
      const char* text = filter->GetProgressText();
      filter->SetAbortExecute(text && std::string(text) == "Counting cells" ? 1 : 0);
    });
  const unsigned long observer = volume->AddObserver(vtkCommand::ProgressEvent, stop);
  volume->Update();
  EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(volume->GetAchievedTolerance(), 0.0);
  EXPECT_EQ(volume->GetSmallestDihedralAngle(), 0.0);
  EXPECT_EQ(volume->GetLargestDihedralAngle(), 0.0);
  volume->RemoveObserver(observer);
  volume->SetAbortExecute(0);
  volume->Modified();
  volume->Update();
  EXPECT_EQ(volume->GetAchievedTolerance(), 0.5);
  EXPECT_GT(volume->GetSmallestDihedralAngle(), 0.0);
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

TEST(SimulationQuality, NeedsAWorldWithVolumes)
{
  const auto image = test::BallImage({ 9, 9, 9 });
  const auto volume = Ball(image, 0.0);
  const auto messages = test::Watch(volume);
  int refused = 0;
  for (const double wrong : { HUGE_VAL, 1e308, 0.0, 1.0 })
  {
    image->SetSpacing(1.0, wrong, wrong);
    volume->Update();
    refused += wrong != 1.0 ? 1 : 0;
    EXPECT_EQ(messages->ErrorCount, refused) << wrong;
    EXPECT_EQ(volume->GetOutput()->GetNumberOfCells() > 0, wrong == 1.0);
  }
  image->SetOrigin(0.0, HUGE_VAL, 0.0);
  volume->Update();
  EXPECT_EQ(messages->ErrorCount, ++refused);
  // With errors of the field, for which other meshes do without lengths.
  volume->SetErrorMetricToField();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : { 3.0, nan, HUGE_VAL }) // the coordinate before is 3
  {
    volume->SetInputData(test::Rectilinear(test::BallImage({ 9, 9, 9 }),
      [&](int axis, int i) { return axis == 1 && i == 4 ? wrong : 1.0 * i; }));
    volume->Update();
    EXPECT_EQ(messages->ErrorCount, ++refused) << wrong;
  }
}

TEST(SimulationQuality, HasTheSameAnglesOnStructuredGrids)
{
  const auto image = test::PhantomImage({ 24, 24, 24 }, 10.0);
  const auto grid = test::Structured(image,
    [](double x, double y, double z) -> std::array<double, 3> {
      return { x, y, z };
    });
  for (vtkDataSet* input : { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(grid) })
  {
    vtkNew<vtkIsodiamondIntervalVolume> volume;
    volume->SetInputData(input);
    volume->SetIsorange(50.0, 1000.0);
    volume->SimulationQualityOn();
    volume->Update();
    EXPECT_GT(volume->GetSmallestDihedralAngle(), 15.0);
    EXPECT_LT(volume->GetLargestDihedralAngle(), 165.0);
  }
}

// Values that stand for missing ones are so far from all others that both surfaces lie on each
// other wherever the field meets them: no angle can be good there, and trying takes ever longer.
// Where cells are many times larger than the smallest ones, surfaces have to move farther, too.
TEST(SimulationQuality, HasTheSameAnglesWhereCellsGrow)
{
  const auto image = test::MakeImage({ 13, 13, 13 },
    [](double x, double y, double z)
    { return std::sin(2.1 * x + 1) * std::cos(1.7 * y) + std::sin(1.9 * z) * std::cos(1.3 * x); });
  for (const double growth : { 1.1, 1.15, 1.0 / 1.1 })
  {
    const auto volume = Ball(image, 0.0);
    volume->SetInputData(test::Rectilinear(
      image, [&](int /*axis*/, int i) { return (std::pow(growth, i) - 1.0) / (growth - 1.0); }));
    volume->Update();
    EXPECT_GE(volume->GetSmallestDihedralAngle(), 15.0) << growth;
    EXPECT_LE(volume->GetLargestDihedralAngle(), 165.0) << growth;
  }
}

TEST(SimulationQuality, DoesNotTryForeverBesideMissingValues)
{
  constexpr int n = 12;
  const auto image = test::MakeImage({ n, n, n },
    [](double x, double y, double z)
    {
      const auto at = [](double i) { return 2.0 * i / (n - 1) - 1.0; };
      const bool isMissing = at(z) < -0.5 + 0.3 * std::sin(3.0 * at(x)) * std::cos(2.0 * at(y));
      return isMissing
        ? -9999.0
        : 20.0 + 10.0 * std::sin(2.0 * at(x)) + 8.0 * std::cos(3.0 * at(y)) - 5.0 * at(z);
    });
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(image);
  volume->SetIsorange(15.0, 25.0);
  volume->SetErrorTolerance(1.0);
  volume->Update();
  const vtkIdType plain = volume->GetOutput()->GetNumberOfCells();
  EXPECT_GT(plain, 2000);
  volume->SimulationQualityOn();
  volume->Update();
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 0.5 * plain);
  EXPECT_LT(volume->GetOutput()->GetNumberOfCells(), 0.7 * plain); // 0.78 after many attempts
}
