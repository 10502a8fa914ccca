// SPDX-License-Identifier: BSD-3-Clause
// The distance metric: its promise, checked with VTK's cell locator for all vertices, on analytic,
// noisy and real volumes; what it can do and what it refuses.
#include "FilterTestTools.h"

#include "vtkAlgorithmOutput.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <random>

namespace
{

/** Distances from the points of one mesh to another mesh. */
struct Deviation
{
  double Mean = 0.0;
  double Largest = 0.0;
};

/** Calls body(point, its distance from a mesh) for each point. */
template <typename Body>
void ForEachDistance(vtkPointSet* from, vtkPolyData* to, const Body& body)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(to);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType i = 0; i < from->GetNumberOfPoints(); ++i)
  {
    double closest[3];
    vtkIdType cellId = 0;
    int subId = 0;
    double squared = 0.0;
    const double* const point = from->GetPoint(i);
    locator->FindClosestPoint(point, closest, cell, cellId, subId, squared);
    body(point, std::sqrt(squared));
  }
}

Deviation DeviationOf(vtkPointSet* from, vtkPolyData* to)
{
  Deviation deviation;
  ForEachDistance(from, to,
    [&](const double*, double distance)
    {
      deviation.Mean += distance / from->GetNumberOfPoints();
      deviation.Largest = std::max(deviation.Largest, distance);
    });
  return deviation;
}

/** By how much points are farther from a mesh than is tolerated of each, at most. */
double Excess(
  vtkPointSet* from, vtkPolyData* to, const std::function<double(const double*)>& tolerated)
{
  double excess = 0.0;
  ForEachDistance(from, to,
    [&](const double* point, double distance)
    { excess = std::max(excess, distance - tolerated(point)); });
  return excess;
}

/** What distance may come from rounding alone, for float coordinates as large as the bounds. */
double Rounding(vtkDataSet* data)
{
  double bounds[6];
  data->GetBounds(bounds);
  double largest = 0.0;
  for (const double bound : bounds)
  {
    largest = std::max(largest, std::fabs(bound));
  }
  return 4e-7 * largest;
}

/** Points on a mesh's triangles, no more than a step apart; farther apart, and on some triangles
 *  only, where these would be too many. */
vtkSmartPointer<vtkPolyData> SamplesOf(vtkPolyData* mesh, double step)
{
  constexpr double most = 6000.0;
  const double area = test::Area(mesh);
  const double apart = std::max(step, std::sqrt(2.0 * area / most));
  const vtkIdType stride = 1 + static_cast<vtkIdType>(3 * mesh->GetNumberOfCells() / most);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); cell += stride)
  {
    const vtkIdType* corners = nullptr;
    vtkIdType count = 0;
    mesh->GetCellPoints(cell, count, corners);
    double p[3][3];
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      mesh->GetPoint(corners[i], p[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      longest = std::max(longest, std::sqrt(vtkMath::Distance2BetweenPoints(p[i], p[(i + 1) % 3])));
    }
    const int parts = std::max(1, static_cast<int>(std::ceil(longest / apart)));
    for (int i = 0; i <= parts; ++i)
    {
      for (int j = 0; j <= parts - i; ++j)
      {
        double at[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          at[axis] = ((parts - i - j) * p[0][axis] + i * p[1][axis] + j * p[2][axis]) / parts;
        }
        points->InsertNextPoint(at);
      }
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  return result;
}

/** The largest deviation of the way back: from points on a mesh to full resolution. */
double DeviationBack(vtkPolyData* mesh, vtkPolyData* full, double voxel)
{
  return DeviationOf(SamplesOf(mesh, voxel / 8.0), full).Largest;
}

/** @param grid an image or a rectilinear grid @param voxel about the length of its cells */
void ExpectPromiseOfContour(vtkDataSet* grid, double isovalue, double voxel, bool close = false)
{
  vtkNew<vtkIsodiamondContour> contour;
  vtkNew<vtkIsodiamondContour> onlyOne;
  onlyOne->OneToleranceOn();
  for (vtkIsodiamondContour* filter : { contour.Get(), onlyOne.Get() })
  {
    filter->SetInputData(grid);
    filter->SetValue(0, isovalue);
    filter->SetCloseBoundary(close);
    filter->ComputeNormalsOff();
    filter->Update();
  }
  vtkNew<vtkPolyData> full;
  full->DeepCopy(contour->GetOutput());
  ASSERT_GT(full->GetNumberOfPoints(), 100);
  vtkIdType previous = full->GetNumberOfCells();
  for (const double inVoxels : { 0.1, 0.25, 0.5, 1.0, 2.0, 8.0 })
  {
    const double tolerance = inVoxels * voxel;
    for (vtkIsodiamondContour* filter : { contour.Get(), onlyOne.Get() })
    {
      filter->SetErrorTolerance(tolerance);
      filter->Update();
      if (filter == onlyOne && inVoxels != 0.25 && inVoxels != 1.0)
      {
        continue; // measuring takes long
      }
      EXPECT_LE(DeviationOf(full, filter->GetOutput()).Largest, tolerance + Rounding(full))
        << "tolerance " << inVoxels << " voxels";
      EXPECT_LE(DeviationBack(filter->GetOutput(), full, voxel), tolerance + Rounding(full))
        << "back, tolerance " << inVoxels << " voxels";
    }
    const vtkIdType cells = contour->GetOutput()->GetNumberOfCells();
    EXPECT_LE(cells, previous);
    EXPECT_LE(onlyOne->GetOutput()->GetNumberOfCells(), 1.02 * cells);
    previous = cells;
  }
  EXPECT_LT(previous, full->GetNumberOfCells());
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
  EXPECT_EQ(onlyOne->GetNumberOfBuilds(), 1);
}

/** One surface of an interval volume: faces of only one tetrahedron, with all corners on it. */
vtkSmartPointer<vtkPolyData> SurfaceOf(vtkUnstructuredGrid* volume, int surface)
{
  vtkDataArray* surfaces = volume->GetPointData()->GetArray("Surface");
  std::map<std::array<vtkIdType, 3>, int> faces;
  for (vtkIdType i = 0; i < volume->GetNumberOfCells(); ++i)
  {
    const vtkIdType* points = nullptr;
    vtkIdType count = 0;
    volume->GetCellPoints(i, count, points);
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      std::array<vtkIdType, 3> face{};
      bool onSurface = true;
      for (int j = 0, k = 0; j < 4; ++j)
      {
        if (j != opposite)
        {
          onSurface = onSurface && surfaces->GetTuple1(points[j]) == surface;
          face[k++] = points[j];
        }
      }
      std::sort(face.begin(), face.end());
      if (onSurface)
      {
        ++faces[face];
      }
    }
  }
  vtkNew<vtkCellArray> triangles;
  for (const auto& [face, count] : faces)
  {
    if (count == 1)
    {
      triangles->InsertNextCell(3, face.data());
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(volume->GetPoints());
  result->SetPolys(triangles);
  return result;
}

/** The points of a volume that lie on one of its surfaces. */
vtkSmartPointer<vtkPolyData> PointsOn(vtkUnstructuredGrid* volume, int surface)
{
  vtkDataArray* surfaces = volume->GetPointData()->GetArray("Surface");
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < volume->GetNumberOfPoints(); ++i)
  {
    if (surfaces->GetTuple1(i) == surface)
    {
      points->InsertNextPoint(volume->GetPoint(i));
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  return result;
}

/** Expects a grid's surface at full resolution, but none within a distance: an error that says a
 *  word. */
void ExpectOnlyFieldMetric(vtkDataSet* grid, const char* word)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 0.0);
  const auto messages = test::Watch(contour);
  contour->Update(); // full resolution needs no distances
  EXPECT_EQ(messages->ErrorCount, 0);
  EXPECT_GT(contour->GetOutput()->GetNumberOfPoints(), 0);
  contour->SetErrorTolerance(0.5);
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find(word), std::string::npos) << messages->Errors;
  EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
  contour->SetErrorMetricToField();
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_GT(contour->GetOutput()->GetNumberOfPoints(), 0);
}

}

TEST(Distance, IsAPromiseOnAnalyticVolumes)
{
  ExpectPromiseOfContour(test::BallImage({ 41, 41, 41 }), 0.0, 1.0);
  ExpectPromiseOfContour(test::BallImage({ 37, 22, 50 }), 0.1, 1.0);
  ExpectPromiseOfContour(test::PhantomImage({ 60, 60, 60 }, 0.0), 50.0, 1.0);
}

TEST(Distance, IsAPromiseOnNoisyVolumes)
{
  ExpectPromiseOfContour(test::PhantomImage({ 48, 48, 48 }, 12.0), 50.0, 1.0);
  std::mt19937 random(1);
  ExpectPromiseOfContour(
    test::MakeImage({ 23, 18, 20 }, [&](double, double, double) { return random() % 256; }), 180.0,
    1.0);
}

TEST(Distance, IsAPromiseInTheWorld)
{
  const auto image = test::PhantomImage({ 44, 44, 44 }, 5.0);
  image->SetSpacing(0.4, 0.9, 2.5);
  image->SetOrigin(-3.0, 7.0, 1.0);
  ExpectPromiseOfContour(image, 50.0, 0.9);
  // Oblique: a rotation about (1, 2, 3).
  const double c = std::cos(0.7);
  const double s = std::sin(0.7) / std::sqrt(14.0);
  vtkNew<vtkMatrix3x3> direction;
  const double axis[3] = { 1.0, 2.0, 3.0 };
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const int k = 3 - i - j;
      const double turn = i == j ? c : (j == (i + 1) % 3 ? -s : s) * axis[k];
      direction->SetElement(i, j, turn + (1.0 - c) * axis[i] * axis[j] / 14.0);
    }
  }
  image->SetDirectionMatrix(direction);
  ExpectPromiseOfContour(image, 50.0, 0.9);
}

TEST(Distance, IsAPromiseOnUnevenGrids)
{
  for (const auto& image : { test::BallImage({ 41, 38, 43 }),
         test::MakeImage({ 40, 33, 45 },
           [](double x, double y, double z)
           { return std::sin(0.3 * x) * std::cos(0.2 * y) + std::sin(0.25 * z + 0.1 * y); }) })
  {
    const auto uneven = test::Rectilinear(image, test::UnevenPlace);
    ExpectPromiseOfContour(uneven, 0.1, 1.0);
    ExpectPromiseOfContour(uneven, 0.1, 1.0, true);
  }
  ExpectPromiseOfContour(
    test::Rectilinear(test::PhantomImage({ 42, 42, 42 }, 5.0), test::UnevenPlace), 50.0, 1.0);
}

TEST(Distance, IsAPromiseOnStructuredGrids)
{
  const auto waves = test::MakeImage({ 40, 33, 45 },
    [](double x, double y, double z)
    { return std::sin(0.3 * x) * std::cos(0.2 * y) + std::sin(0.25 * z + 0.1 * y); });
  ExpectPromiseOfContour(test::Structured(waves, test::BentPlace), 0.1, 0.7);
  ExpectPromiseOfContour(test::Structured(waves, test::BentPlace), 0.1, 0.7, true);
  // All around an axis, on which samples coincide.
  const auto wound = [](double x, double y, double z) -> std::array<double, 3>
  {
    const double angle = 2.0 * vtkMath::Pi() * x / 39.0;
    return { y * std::cos(angle), y * std::sin(angle), z };
  };
  ExpectPromiseOfContour(test::Structured(waves, wound), 0.1, 1.0);
  ExpectPromiseOfContour(
    test::Structured(test::PhantomImage({ 40, 40, 40 }, 5.0), test::BentPlace), 50.0, 0.7);
}

TEST(Distance, IsAPromiseOfClosedBoundaries)
{
  const auto image = test::MakeImage({ 40, 33, 45 },
    [](double x, double y, double z)
    { return std::sin(0.3 * x) * std::cos(0.2 * y) + std::sin(0.25 * z + 0.1 * y); });
  ExpectPromiseOfContour(image, 0.1, 1.0, true);
  image->SetSpacing(0.4, 0.9, 2.5);
  ExpectPromiseOfContour(image, 0.1, 0.9, true);
}

// If ISODIAMONDS_LONG is set, with 129 samples on each axis, too.
TEST(Distance, IsAPromiseOnNoisyWaves)
{
  std::vector<int> sizes = { 33, 65 };
  if (std::getenv("ISODIAMONDS_LONG") != nullptr)
  {
    sizes.push_back(129);
  }
  for (const int size : sizes)
  {
    std::mt19937 random(size);
    std::uniform_real_distribution<double> noise(-0.35, 0.35);
    ExpectPromiseOfContour(test::MakeImage({ size, size, size },
                             [&](double x, double y, double z) {
                               return std::sin(0.3 * x) + std::sin(0.21 * y + 0.1 * x) +
                                 std::cos(0.17 * z) + noise(random);
                             }),
      0.2, 1.0);
  }
}

TEST(Distance, IsAPromiseOnSampleVolumes)
{
  const auto tooth = test::SampleVolume("tooth_103x94x161_uint8.raw", { 103, 94, 161 });
  const auto fuel = test::SampleVolume("fuel_64x64x64_uint8.raw", { 64, 64, 64 });
  if (!tooth || !fuel)
  {
    GTEST_SKIP() << "ISODIAMONDS_DATA_DIR does not hold the tooth and the fuel";
  }
  tooth->SetSpacing(0.25, 0.25, 0.5);
  ExpectPromiseOfContour(tooth, 120.0, 0.25);
  ExpectPromiseOfContour(fuel, 11.4, 1.0);
}

TEST(Distance, IsAPromiseOnBothSurfacesOfIntervalVolumes)
{
  const auto ball = test::BallImage({ 33, 30, 36 });
  const auto phantom = test::PhantomImage({ 40, 40, 40 }, 8.0);
  ball->SetSpacing(1.0, 0.5, 1.5);
  phantom->SetSpacing(1.0, 0.5, 1.5);
  const auto uneven = test::Rectilinear(ball, test::UnevenPlace);
  for (vtkDataSet* grid : { static_cast<vtkDataSet*>(ball), static_cast<vtkDataSet*>(phantom),
         static_cast<vtkDataSet*>(uneven) })
  {
    double range[2];
    grid->GetScalarRange(range);
    vtkNew<vtkIsodiamondIntervalVolume> volume;
    volume->SetInputData(grid);
    volume->SetIsorange(
      range[0] + 0.45 * (range[1] - range[0]), range[0] + 0.8 * (range[1] - range[0]));
    volume->Update();
    vtkNew<vtkUnstructuredGrid> full;
    full->DeepCopy(volume->GetOutput());
    for (const double tolerance : { 0.1, 0.3, 1.0, 4.0 })
    {
      volume->SetErrorTolerance(tolerance);
      volume->Update();
      EXPECT_LT(volume->GetOutput()->GetNumberOfCells(), full->GetNumberOfCells());
      for (const int surface : { -1, 1 })
      {
        const auto points = PointsOn(full, surface);
        ASSERT_GT(points->GetNumberOfPoints(), 100);
        const auto mesh = SurfaceOf(volume->GetOutput(), surface);
        EXPECT_LE(DeviationOf(points, mesh).Largest, tolerance + Rounding(full));
        EXPECT_LE(DeviationBack(mesh, SurfaceOf(full, surface), 1.0), tolerance + Rounding(full));
      }
    }
  }
}

// The mesh depends on the properties alone, not on what the filter knows already.
TEST(Distance, OfOneToleranceDoesNotDependOnOthers)
{
  const auto image = test::PhantomImage({ 40, 36, 44 }, 5.0);
  vtkNew<vtkIsodiamondContour> known;
  known->SetInputData(image);
  known->SetValue(0, 50.0);
  known->SetErrorTolerance(0.5);
  known->Update(); // measures all errors
  vtkNew<vtkPolyData> ofAll;
  ofAll->DeepCopy(known->GetOutput());
  EXPECT_NE(ofAll->GetFieldData()->GetNumberOfArrays(), 0);
  for (const bool simplify : { false, true })
  {
    known->SetSimplify(simplify);
    known->OneToleranceOn();
    for (const double tolerance : { 1.0, 0.3, 0.5 })
    {
      SCOPED_TRACE(tolerance);
      known->SetErrorTolerance(tolerance);
      known->Update();
      vtkNew<vtkIsodiamondContour> fresh;
      fresh->SetInputData(image);
      fresh->SetValue(0, 50.0);
      fresh->SetSimplify(simplify);
      fresh->SetErrorTolerance(tolerance);
      fresh->OneToleranceOn();
      fresh->Update();
      EXPECT_EQ(test::Difference(known->GetOutput(), fresh->GetOutput()), "");
      EXPECT_EQ(fresh->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0); // no table
    }
  }
  EXPECT_EQ(known->GetNumberOfBuilds(), 2);
  known->SimplifyOff();
  known->OneToleranceOff();
  known->Update();
  EXPECT_EQ(known->GetNumberOfBuilds(), 2);
  EXPECT_EQ(test::Difference(known->GetOutput(), ofAll), "");
}

// With a region of interest, or from a viewpoint, the tolerance of each place holds there.
TEST(Distance, OfOneToleranceHoldsWhereItIsAskedFor)
{
  const auto image = test::PhantomImage({ 40, 40, 40 }, 5.0);
  vtkNew<vtkIsodiamondContour> all;
  vtkNew<vtkIsodiamondContour> one;
  vtkNew<vtkIsodiamondContour> fresh;
  const double bounds[6] = { 5.0, 18.0, -1.0, 40.0, 5.0, 25.0 };
  const double eye[3] = { -20.0, 20.0, 20.0 };
  for (vtkIsodiamondContour* filter : { all.Get(), one.Get(), fresh.Get() })
  {
    filter->SetInputData(image);
    filter->SetValue(0, 50.0);
    filter->ComputeNormalsOff();
    filter->SetOneTolerance(filter != all);
  }
  one->Update();
  vtkNew<vtkPolyData> full;
  full->DeepCopy(one->GetOutput());
  const auto update = [&]
  {
    all->Update();
    one->Update();
    EXPECT_LT(one->GetOutput()->GetNumberOfCells(), 0.9 * full->GetNumberOfCells());
    EXPECT_LE(one->GetOutput()->GetNumberOfCells(), 1.02 * all->GetOutput()->GetNumberOfCells());
    EXPECT_GE(one->GetOutput()->GetNumberOfCells(), 0.8 * all->GetOutput()->GetNumberOfCells());
  };
  const auto expectWithin = [&](const std::function<double(const double*)>& tolerated)
  {
    vtkPolyData* const mesh = one->GetOutput();
    EXPECT_LE(Excess(full, mesh, tolerated), Rounding(full));
    EXPECT_LE(Excess(SamplesOf(mesh, 0.125), full, tolerated), Rounding(full)) << "back";
  };
  const vtkBoundingBox box(bounds);
  using Pair = std::pair<double, double>;
  for (const auto& tolerances : { Pair{ 2.0, 0.5 }, Pair{ 0.0, 2.0 }, Pair{ 0.3, 2.0 } })
  {
    const double inside = tolerances.first;
    const double outside = tolerances.second;
    for (vtkIsodiamondContour* filter : { all.Get(), one.Get(), fresh.Get() })
    {
      filter->UseRegionOfInterestOn();
      filter->SetRegionOfInterest(bounds);
      filter->SetErrorTolerance(inside);
      filter->SetOutsideErrorTolerance(outside);
    }
    update();
    expectWithin(
      [&](const double* x) { return box.ContainsPoint(x) ? std::min(inside, outside) : outside; });
  }
  // The box stays where it is in the world; the image does not.
  image->SetOrigin(4.0, 0.0, 0.0);
  fresh->Update();
  one->Update();
  EXPECT_EQ(test::Difference(one->GetOutput(), fresh->GetOutput()), "");
  image->SetOrigin(0.0, 0.0, 0.0);
  for (vtkIsodiamondContour* filter : { all.Get(), one.Get() })
  {
    filter->UseRegionOfInterestOff();
    filter->ViewDependentOn();
    filter->SetViewPosition(eye[0], eye[1], eye[2]);
    filter->SetViewAngle(30.0);
    filter->SetViewHeight(1000);
    filter->SetPixelTolerance(40.0);
  }
  update();
  const double perDistance = 40.0 * 2.0 * std::tan(vtkMath::RadiansFromDegrees(15.0)) / 1000.0;
  expectWithin([&](const double* x)
    { return std::max(0.3, perDistance * std::sqrt(vtkMath::Distance2BetweenPoints(x, eye))); });
  EXPECT_EQ(one->GetNumberOfBuilds(), 1);
}

TEST(Distance, OfOneToleranceMayBeInfinite)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::PhantomImage({ 20, 20, 20 }, 5.0));
  contour->SetValue(0, 50.0);
  contour->SimplifyOn();
  contour->SetErrorTolerance(HUGE_VAL);
  contour->Update();
  const vtkIdType simple = contour->GetOutput()->GetNumberOfCells();
  contour->OneToleranceOn();
  contour->Update();
  EXPECT_LE(contour->GetOutput()->GetNumberOfCells(), 1.1 * static_cast<double>(simple));
}

TEST(Distance, OfOneToleranceIsThatOfAllWhereAllAreNeeded)
{
  const auto image = test::PhantomImage({ 30, 30, 30 }, 5.0);
  vtkNew<vtkIsodiamondContour> contour;
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  contour->SetValue(0, 50.0);
  volume->SetIsorange(50.0, 110.0);
  const auto expectSame = [&](vtkIsodiamondVolumeAlgorithm* filter, const char* what)
  {
    filter->SetInputData(image);
    filter->OneToleranceOff();
    filter->Update();
    const vtkSmartPointer<vtkDataSet> all = vtkSmartPointer<vtkDataSet>::Take(
      vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->NewInstance());
    all->DeepCopy(filter->GetOutputDataObject(0));
    filter->OneToleranceOn();
    filter->Update();
    EXPECT_GT(all->GetNumberOfCells(), 100) << what;
    EXPECT_EQ(test::Difference(vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0)), all), "")
      << what;
  };
  contour->SetErrorTolerance(1.0);
  contour->SetTargetNumberOfTriangles(1000);
  expectSame(contour, "a target");
  contour->SetTargetNumberOfTriangles(0);
  contour->SetErrorMetricToField();
  expectSame(contour, "the field metric");
  volume->SetErrorTolerance(0.5);
  volume->SetInteriorTolerance(20.0);
  expectSame(volume, "an interior tolerance");
  volume->UseInteriorToleranceOff();
  volume->SimulationQualityOn();
  expectSame(volume, "tetrahedra for simulations");
  volume->SimulationQualityOff();
  image->AllocateCellGhostArray()->SetValue(
    15 + 29 * (15 + 29 * 15), vtkDataSetAttributes::HIDDENCELL);
  expectSame(volume, "hidden cells");
}

TEST(Distance, SimplifiesSharpEdgesThatTheFieldMetricKeeps)
{
  const auto image = test::PhantomImage({ 80, 80, 80 }, 2.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->Update();
  vtkNew<vtkPolyData> full;
  full->DeepCopy(contour->GetOutput());
  contour->SetErrorTolerance(0.5);
  contour->Update();
  const vtkIdType triangles = contour->GetOutput()->GetNumberOfCells();
  const Deviation distance = DeviationOf(full, contour->GetOutput());
  EXPECT_LT(triangles, full->GetNumberOfCells() / 4);
  // Even with no fewer triangles, the field metric's mesh is farther away.
  contour->SetErrorMetricToField();
  contour->SetErrorTolerance(100.0);
  while (contour->Update(), contour->GetOutput()->GetNumberOfCells() < triangles)
  {
    contour->SetErrorTolerance(0.9 * contour->GetErrorTolerance());
  }
  const Deviation field = DeviationOf(full, contour->GetOutput());
  EXPECT_GT(field.Largest, distance.Largest);
}

TEST(Distance, KeepsThinFeaturesUnlessToldOtherwise)
{
  // A ball, and a speck of one sample beside it.
  const auto image = test::MakeImage({ 33, 33, 33 },
    [](double x, double y, double z)
    {
      const double ball =
        8.0 - std::sqrt((x - 12) * (x - 12) + (y - 16) * (y - 16) + (z - 16) * (z - 16));
      return x == 27 && y == 16 && z == 17 ? 1.0 : ball;
    });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->PreserveTopologyOff();  // or the speck would stay anyway
  contour->SetErrorTolerance(5.0); // the speck is thinner than this, but farther from the ball
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetBounds()[1], 26.0);
  contour->PreserveFeaturesOff();
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 2);
  EXPECT_LT(contour->GetOutput()->GetBounds()[1], 26.0);
  contour->SetErrorTolerance(0.01); // only what is thinner than the tolerance goes
  contour->Update();
  EXPECT_GT(contour->GetOutput()->GetBounds()[1], 26.0);
}

TEST(Distance, LinearIsoverticesLeaveTheSurfaceExactOnesDoNot)
{
  const auto image = test::PhantomImage({ 40, 40, 40 }, 2.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 50.0);
  contour->SetErrorMetricToField();
  contour->Update();
  vtkNew<vtkPolyData> full;
  full->DeepCopy(contour->GetOutput());
  contour->SetErrorTolerance(10.0);
  contour->Update();
  const double exact = DeviationOf(contour->GetOutput(), full).Largest;
  // One step of a coefficient on the mesh's longest edge, which is of its coarsest level.
  double levels[2];
  contour->GetOutput()->GetCellData()->GetArray("Level")->GetRange(levels);
  EXPECT_LE(exact, std::sqrt(3.0) * std::pow(2.0, 6 - levels[0]) / 256);
  contour->ExactIsoverticesOff();
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 2);
  EXPECT_GT(DeviationOf(contour->GetOutput(), full).Largest, 5 * exact);
}

TEST(Distance, NeedsAnIsovalue)
{
  const auto image = test::BallImage({ 9, 9, 9 });
  vtkNew<vtkIsodiamondBuilder> diamonds;
  diamonds->SetInputData(image);
  diamonds->SetModelToHierarchyOfDiamonds();
  diamonds->SetErrorMetricToDistance();
  const auto messages = test::Watch(diamonds);
  diamonds->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("field metric"), std::string::npos);
  EXPECT_EQ(diamonds->GetOutput()->GetNumberOfPoints(), 0);
  // Other models built from an HD can have it: they only need its samples.
  diamonds->SetErrorMetricToField();
  vtkNew<vtkIsodiamondBuilder> minimal[2];
  for (int i = 0; i < 2; ++i)
  {
    minimal[i]->SetErrorMetricToDistance();
    minimal[i]->SetShape(vtkIsodiamondHierarchy::ISOSURFACE);
  }
  minimal[0]->SetInputConnection(diamonds->GetOutputPort());
  minimal[1]->SetInputData(image);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetErrorTolerance(0.3);
  test::Triangles triangles[2];
  for (int i = 0; i < 2; ++i)
  {
    extractor->SetInputConnection(minimal[i]->GetOutputPort());
    extractor->Update();
    EXPECT_EQ(minimal[i]->GetHierarchy()->GetErrorMetric(), vtkIsodiamondHierarchy::DISTANCE);
    triangles[i] = test::SortedTriangles(extractor->GetOutput());
  }
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_FALSE(triangles[0].empty());
  EXPECT_TRUE(triangles[0] == triangles[1]);
}

TEST(Distance, NeedsAWorldWithLengths)
{
  const auto image = test::BallImage({ 9, 9, 9 });
  image->SetSpacing(1.0, 0.0, 1.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  const auto messages = test::Watch(contour);
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Distance, NeedsCoordinatesThatRiseOrFall)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : { 7.0, 6.5, nan, -HUGE_VAL }) // the coordinate before is 7
  {
    ExpectOnlyFieldMetric(
      test::Rectilinear(
        image, [&](int axis, int i) { return axis == 1 && i == 8 ? bad : i + 0.0 * axis; }),
      "field metric");
  }
}

TEST(Distance, NeedsPositionsThatAreFinite)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  for (const double bad : { std::numeric_limits<double>::quiet_NaN(), HUGE_VAL })
  {
    ExpectOnlyFieldMetric(test::Structured(image,
                            [bad](double x, double y, double z) -> std::array<double, 3> {
                              return { x + y + z > 0.0 ? x : bad, y, z };
                            }), // far from the surface
      "finite");
  }
}

TEST(Distance, BuildsAgainOnlyForWhatMatters)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  vtkIdType expected = 1;
  const auto expectBuilds = [&](vtkIdType more)
  {
    expected += more;
    contour->Update();
    EXPECT_EQ(contour->GetNumberOfBuilds(), expected);
  };
  expectBuilds(0);
  contour->SetErrorTolerance(0.5);
  expectBuilds(0);
  contour->UseRegionOfInterestOn();
  contour->SetRegionOfInterest(0, 8, 0, 8, 0, 8);
  contour->SetOutsideErrorTolerance(2.0);
  expectBuilds(0);
  image->SetOrigin(5.0, 5.0, 5.0); // lengths are the same
  expectBuilds(0);
  image->SetSpacing(2.0, 1.0, 1.0);
  expectBuilds(1);
  contour->PreserveFeaturesOff();
  expectBuilds(1);
  contour->ExactIsoverticesOff();
  expectBuilds(1);
  contour->SetErrorMetricToField();
  expectBuilds(1);
  contour->PreserveFeaturesOn(); // means nothing to the field metric
  image->SetSpacing(1.0, 1.0, 1.0);
  expectBuilds(0);
  contour->SetValue(0, 0.05);
  expectBuilds(1);
  contour->SetErrorMetricToDistance();
  contour->SetInputData(test::Rectilinear(image, test::UnevenPlace));
  expectBuilds(1);
  contour->SetInputData(test::Rectilinear(image, test::UnevenPlace));
  expectBuilds(0);
  contour->SetInputData(test::Rectilinear(
    image, [](int axis, int i) { return test::UnevenPlace(axis, i) + (i == 16 ? 0.1 : 0.0); }));
  expectBuilds(1);
  contour->SetInputData(test::Structured(image, test::BentPlace));
  expectBuilds(1);
  const auto bent = test::Structured(image, test::BentPlace);
  contour->SetInputData(bent);
  expectBuilds(0);
  bent->GetPoints()->SetPoint(100, 0.0, 0.0, 0.0);
  bent->GetPoints()->Modified();
  bent->Modified();
  expectBuilds(1);
  contour->SetErrorMetricToField(); // to which places mean nothing
  expectBuilds(0);
  contour->SetErrorMetricToDistance();
  expectBuilds(0);
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(image);
  volume->SetIsorange(0.0, 1.0);
  volume->Update();
  volume->SetErrorTolerance(1.0);
  volume->UseRegionOfInterestOn();
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfBuilds(), 1);
  volume->SetErrorMetricToField();
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfBuilds(), 2);
}
