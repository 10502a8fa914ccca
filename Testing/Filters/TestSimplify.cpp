// SPDX-License-Identifier: BSD-3-Clause
// Simplified surfaces: the tolerance of each place, topology, what points carry, and refusals.
#include "FilterTestTools.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellLocator.h"
#include "vtkCellType.h"
#include "vtkFeatureEdges.h"
#include "vtkFieldData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataConnectivityFilter.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace
{

vtkSmartPointer<vtkImageData> Image()
{
  return test::PhantomImage({ 32, 28, 30 }, 6.0);
}

/** Values between 0 and 1. */
vtkSmartPointer<vtkImageData> NoiseImage(int size, unsigned seed)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(size, size, size);
  image->AllocateScalars(VTK_FLOAT, 1);
  std::mt19937 random(seed);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    values->SetComponent(i, 0, static_cast<double>(random()) / random.max());
  }
  return image;
}

vtkSmartPointer<vtkIsodiamondContour> MakeContour(vtkDataSet* grid)
{
  auto contour = vtkSmartPointer<vtkIsodiamondContour>::New();
  contour->SetInputData(grid);
  contour->SetValue(0, 50.0);
  return contour;
}

vtkSmartPointer<vtkPolyData> Update(vtkIsodiamondContour* contour)
{
  contour->Update();
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(contour->GetOutput());
  return copy;
}

vtkSmartPointer<vtkPolyData> Full(vtkDataSet* grid)
{
  return Update(MakeContour(grid));
}

/** By how much a mesh's points, and points on its triangles, are farther from another mesh than is
 *  tolerated there, at most. */
double Excess(
  vtkPolyData* from, vtkPolyData* to, const std::function<double(const double[3])>& tolerance)
{
  vtkNew<vtkCellLocator> locator;
  locator->SetDataSet(to);
  locator->BuildLocator();
  double worst = -std::numeric_limits<double>::infinity();
  const auto look = [&](const double place[3])
  {
    double nearest[3];
    vtkIdType cell = 0;
    int sub = 0;
    double squared = 0.0;
    locator->FindClosestPoint(place, nearest, cell, sub, squared);
    worst = std::max(worst, std::sqrt(squared) - tolerance(place));
  };
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  for (vtkIdType i = 0; i < from->GetNumberOfCells(); ++i)
  {
    from->GetPolys()->GetCellAtId(i, size, ids);
    double corners[3][3];
    for (int k = 0; k < 3; ++k)
    {
      from->GetPoint(ids[k], corners[k]);
    }
    constexpr int parts = 3;
    for (int a = 0; a <= parts; ++a)
    {
      for (int b = 0; a + b <= parts; ++b)
      {
        double place[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          place[axis] =
            (a * corners[0][axis] + b * corners[1][axis] + (parts - a - b) * corners[2][axis]) /
            parts;
        }
        look(place);
      }
    }
  }
  return worst;
}

struct Shape
{
  int Pieces = 0;
  vtkIdType Euler = 0;
  vtkIdType BorderEdges = 0;
  vtkIdType NonManifoldEdges = 0;

  explicit Shape(vtkPolyData* mesh)
  {
    vtkNew<vtkPolyDataConnectivityFilter> pieces;
    pieces->SetInputData(mesh);
    pieces->SetExtractionModeToAllRegions();
    pieces->Update();
    this->Pieces = pieces->GetNumberOfExtractedRegions();
    const auto edges = [&](bool border, bool nonManifold, bool manifold)
    {
      vtkNew<vtkFeatureEdges> filter;
      filter->SetInputData(mesh);
      filter->SetBoundaryEdges(border);
      filter->SetNonManifoldEdges(nonManifold);
      filter->SetManifoldEdges(manifold);
      filter->FeatureEdgesOff();
      filter->Update();
      return filter->GetOutput()->GetNumberOfCells();
    };
    this->BorderEdges = edges(true, false, false);
    this->NonManifoldEdges = edges(false, true, false);
    this->Euler = mesh->GetNumberOfPoints() - edges(true, true, true) + mesh->GetNumberOfCells();
  }
};

void ExpectSameShape(vtkPolyData* mesh, vtkPolyData* full)
{
  const Shape is(mesh);
  const Shape was(full);
  EXPECT_EQ(is.Pieces, was.Pieces);
  EXPECT_EQ(is.Euler, was.Euler);
  EXPECT_EQ(is.NonManifoldEdges, 0);
}

/** Expects a contour to have far fewer triangles with Simplify, within the tolerance both ways, and
 *  the shape of full resolution. @return the simplified mesh */
vtkSmartPointer<vtkPolyData> ExpectSimplified(
  vtkIsodiamondContour* contour, vtkPolyData* full, double tolerance)
{
  contour->SetErrorTolerance(tolerance);
  contour->SimplifyOff();
  const auto plain = Update(contour);
  contour->SimplifyOn();
  const auto simple = Update(contour);
  EXPECT_LT(simple->GetNumberOfCells(), 0.6 * plain->GetNumberOfCells());
  const auto everywhere = [&](const double[3]) { return tolerance * (1.0 + 1e-6); };
  EXPECT_LE(Excess(full, simple, everywhere), 0.0);
  EXPECT_LE(Excess(simple, full, everywhere), 0.0);
  ExpectSameShape(simple, full);
  return simple;
}

}

TEST(Simplify, KeepsToleranceAndTopology)
{
  const auto image = Image();
  image->SetSpacing(0.5, 0.5, 0.75);
  const auto full = Full(image);
  const auto contour = MakeContour(image);
  for (const double tolerance : { 0.2, 0.5 })
  {
    SCOPED_TRACE(tolerance);
    const auto simple = ExpectSimplified(contour, full, tolerance);
    // Its points are those of the mesh at a part of the tolerance, with their data; no levels.
    EXPECT_EQ(
      simple->GetPointData()->GetNormals()->GetNumberOfTuples(), simple->GetNumberOfPoints());
    EXPECT_EQ(simple->GetCellData()->GetNumberOfArrays(), 0);
    contour->SimplifyOff();
    contour->SetErrorTolerance(std::min(0.3, 0.4 * tolerance / 0.5) * tolerance);
    const auto finer = Update(contour);
    EXPECT_LE(simple->GetNumberOfPoints(), finer->GetNumberOfPoints());
    EXPECT_LE(test::LargestDistance(simple, finer), 1e-6);
  }
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
}

TEST(Simplify, KeepsToleranceAndTopologyOnStructuredGrids)
{
  const auto grid = test::Structured(Image(), test::BentPlace);
  const auto full = Full(grid);
  const auto contour = MakeContour(grid);
  for (const double tolerance : { 0.2, 0.5 })
  {
    SCOPED_TRACE(tolerance);
    ExpectSimplified(contour, full, tolerance);
  }
}

// A triangle may move by what the error of its diamond leaves of the tolerance. If each could use
// all of it, these surfaces would be up to a twentieth too far away, one only with OneTolerance.
TEST(Simplify, AddsUpWithTheErrorsOfTheHierarchy)
{
  for (const int seed : { 16, 24, 50 })
  {
    const auto image = test::MakeImage({ 18, 18, 18 },
      [&](double x, double y, double z)
      {
        const double phase = 1.7 * seed;
        return std::sin(0.61 * x + 0.2 * y + phase) + std::sin(0.57 * y - 0.3 * z + 2.0 * phase) +
          std::sin(0.53 * z + 0.25 * x + 3.0 * phase) + std::sin(0.9 * (x - y + z) + phase);
      });
    const auto contour = MakeContour(image);
    contour->SetValue(0, 0.0);
    const auto full = Update(contour);
    contour->SimplifyOn();
    contour->SetErrorTolerance(1.0);
    for (const bool isOnly : { false, true })
    {
      SCOPED_TRACE(std::to_string(seed) + (isOnly ? ", one tolerance" : ""));
      contour->SetOneTolerance(isOnly);
      const auto simple = Update(contour);
      const auto everywhere = [&](const double[3]) { return 1.0 + 1e-6; };
      EXPECT_LE(Excess(full, simple, everywhere), 0.0);
      EXPECT_LE(Excess(simple, full, everywhere), 0.0);
    }
  }
}

// On a noisy ball: how far normals are from the right ones, compared with the gradients at the same
// points.
TEST(Simplify, NormalsAreMeans)
{
  const auto image = test::MakeImage({ 28, 28, 28 },
    [](double x, double y, double z)
    {
      const double noise = std::sin(31.0 * x + 57.0 * y + 83.0 * z * z);
      return 9.0 - std::hypot(x - 13.5, y - 13.5, z - 13.5) + 0.3 * noise;
    });
  const auto contour = MakeContour(image);
  contour->SetValue(0, 0.0);
  contour->ComputeGradientsOn();
  contour->SetErrorTolerance(1.0);
  for (const bool isSimple : { false, true })
  {
    SCOPED_TRACE(isSimple);
    contour->SetSimplify(isSimple);
    const auto mesh = Update(contour);
    vtkDataArray* const normals = mesh->GetPointData()->GetNormals();
    vtkDataArray* const gradients = mesh->GetPointData()->GetArray("Gradient");
    ASSERT_TRUE(normals && gradients);
    double ofNormals = 0.0;
    double ofGradients = 0.0;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      std::array<double, 3> radial;
      std::array<double, 3> normal;
      std::array<double, 3> gradient;
      mesh->GetPoint(i, radial.data());
      normals->GetTuple(i, normal.data());
      gradients->GetTuple(i, gradient.data());
      for (double& coordinate : radial)
      {
        coordinate -= 13.5;
      }
      EXPECT_NEAR(vtkMath::Norm(normal.data()), 1.0, 1e-5);
      vtkMath::Normalize(radial.data());
      vtkMath::Normalize(gradient.data());
      ofNormals += 1.0 - vtkMath::Dot(normal, radial);
      ofGradients += 1.0 + vtkMath::Dot(gradient, radial);
    }
    if (isSimple)
    {
      EXPECT_LT(ofNormals, 0.7 * ofGradients);
    }
    else
    {
      EXPECT_NEAR(ofNormals, ofGradients, 1e-4 * ofGradients);
    }
  }
}

TEST(Simplify, ToleranceOfEachPlace)
{
  const auto image = Image();
  const auto full = Full(image);
  const auto contour = MakeContour(image);
  contour->SetErrorTolerance(0.25);
  contour->UseRegionOfInterestOn();
  contour->SetRegionOfInterest(0, 14, 0, 28, 0, 15);
  contour->SetOutsideErrorTolerance(1.5);
  const auto plain = Update(contour);
  contour->SimplifyOn();
  const auto simple = Update(contour);
  EXPECT_LT(simple->GetNumberOfCells(), 0.7 * plain->GetNumberOfCells());
  const auto local = [](const double place[3])
  { return (place[0] <= 14 && place[2] <= 15 ? 0.25 : 1.5) + 1e-6; };
  EXPECT_LE(Excess(full, simple, local), 0.0);
  EXPECT_LE(Excess(simple, full, local), 0.0);
  ExpectSameShape(simple, full);
  contour->UseRegionOfInterestOff();
  contour->ViewDependentOn();
  contour->SetViewPosition(-40, 14, 14);
  contour->SetViewHeight(100);
  contour->SetPixelTolerance(1.0);
  const auto seen = Update(contour);
  const double perDistance = 2.0 * std::tan(vtkMath::RadiansFromDegrees(15.0)) / 100;
  const auto fromView = [&](const double place[3])
  {
    const double eye[3] = { -40, 14, 14 };
    // A triangle has the tolerance of its point nearest to the eye.
    const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(place, eye));
    return std::max(0.25, perDistance * distance) + 1e-6;
  };
  EXPECT_LE(Excess(full, seen, fromView), 0.0);
  EXPECT_LE(Excess(seen, full, fromView), 0.0);
}

// What is outside may be moved far, but not into the box.
TEST(Simplify, KeepsTheToleranceInABoxBesideAMuchLargerOne)
{
  constexpr double insideTolerance = 0.05;
  double worst = -1.0;
  for (const unsigned seed :
    { 1U, 2U, 3U, 4U, 60U, 197U, 496U, 527U, 589U }) // the last five went in
  {
    const auto image = NoiseImage(5, seed);
    const auto contour = MakeContour(image);
    contour->SetValue(0, 0.5);
    const auto full = Update(contour);
    contour->SetErrorTolerance(insideTolerance);
    contour->UseRegionOfInterestOn();
    contour->SetRegionOfInterest(-1, 1.6, -1, 7, -1, 7);
    contour->SetOutsideErrorTolerance(5.0);
    contour->SimplifyOn();
    const auto simple = Update(contour);
    const auto local = [](const double place[3])
    { return place[0] <= 1.6 ? insideTolerance + 1e-6 : 100.0; };
    worst = std::max({ worst, Excess(full, simple, local), Excess(simple, full, local) });
  }
  EXPECT_LE(worst, 0.0);
}

TEST(Simplify, SeveralIsovaluesHiddenCellsAndCaps)
{
  const auto image = Image();
  image->AllocatePointGhostArray();
  image->GetPointGhostArray()->SetValue(
    image->GetNumberOfPoints() / 2, vtkDataSetAttributes::HIDDENPOINT);
  const auto contour = MakeContour(image);
  contour->SetValue(1, 30.0);
  contour->CloseBoundaryOn();
  const auto full = Update(contour);
  contour->SetErrorTolerance(0.6);
  const auto plain = Update(contour);
  contour->SimplifyOn();
  const auto simple = Update(contour);
  EXPECT_LT(simple->GetNumberOfCells(), 0.6 * plain->GetNumberOfCells());
  ExpectSameShape(simple, full);
  EXPECT_EQ(Shape(simple).BorderEdges, Shape(plain).BorderEdges);
  double range[2];
  simple->GetPointData()->GetArray("density")->GetRange(range);
  EXPECT_EQ(range[0], 30.0);
  EXPECT_EQ(range[1], 50.0);
}

TEST(Simplify, GoesAlongTheBoundary)
{
  // A surface that goes on beyond the image, which has an origin and a spacing.
  const auto image = test::MakeImage({ 24, 22, 20 },
    [](double x, double y, double z) { return std::sin(0.3 * x) + std::cos(0.25 * y) + 0.2 * z; });
  image->SetSpacing(0.4, 0.5, 0.6);
  image->SetOrigin(3, -2, 1);
  const auto contour = MakeContour(image);
  contour->SetValue(0, 1.5);
  const auto full = Update(contour);
  contour->SetErrorTolerance(0.4);
  const auto plain = Update(contour);
  contour->SimplifyOn();
  const auto simple = Update(contour);
  EXPECT_LT(2 * Shape(simple).BorderEdges, Shape(plain).BorderEdges);
  ExpectSameShape(simple, full);
  EXPECT_EQ(
    simple->GetPointData()->GetNumberOfArrays(), plain->GetPointData()->GetNumberOfArrays());
  const auto everywhere = [](const double[3]) { return 0.4 * (1.0 + 1e-6); };
  EXPECT_LE(Excess(full, simple, everywhere), 0.0);
  EXPECT_LE(Excess(simple, full, everywhere), 0.0);
  vtkNew<vtkFeatureEdges> border;
  border->SetInputData(simple);
  border->FeatureEdgesOff();
  border->Update();
  double bounds[6];
  image->GetBounds(bounds);
  const vtkIdType edges = border->GetOutput()->GetNumberOfCells();
  ASSERT_GT(edges, 0);
  for (vtkIdType i = 0; i < edges; ++i)
  {
    double ends[6];
    border->GetOutput()->GetCell(i)->GetBounds(ends);
    bool isOnFace = false;
    for (int k = 0; k < 6; ++k)
    {
      const double face = bounds[k];
      isOnFace = isOnFace ||
        (std::abs(ends[k - k % 2] - face) < 1e-5 && std::abs(ends[k - k % 2 + 1] - face) < 1e-5);
    }
    EXPECT_TRUE(isOnFace) << "edge " << i;
  }
}

TEST(Simplify, HasATargetToo)
{
  const auto image = Image();
  const auto full = Full(image);
  const vtkIdType target = full->GetNumberOfCells() / 10;
  const auto contour = MakeContour(image);
  contour->SetTargetNumberOfTriangles(target);
  contour->Update();
  const double plain = contour->GetAchievedTolerance();
  contour->SimplifyOn();
  const auto simple = Update(contour);
  EXPECT_LE(simple->GetNumberOfCells(), target);
  EXPECT_GT(simple->GetNumberOfCells(), 0.9 * target);
  const double achieved = contour->GetAchievedTolerance();
  EXPECT_LT(achieved, 0.8 * plain);
  const auto everywhere = [&](const double[3]) { return achieved * (1.0 + 1e-6); };
  EXPECT_LE(Excess(full, simple, everywhere), 0.0);
  EXPECT_LE(Excess(simple, full, everywhere), 0.0);
  // The same in two steps.
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetIsovalue(50.0);
  builder->SetErrorMetricToDistance();
  builder->PreserveTopologyOn();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetOutputTypeToPolyData();
  extractor->SimplifyOn();
  extractor->SetErrorTolerance(achieved);
  extractor->Update();
  EXPECT_EQ(test::SortedTriangles(extractor->GetPolyDataOutput()), test::SortedTriangles(simple));
  extractor->SetTargetNumberOfTriangles(target);
  extractor->Update();
  EXPECT_EQ(extractor->GetAchievedTolerance(), achieved);
}

TEST(Simplify, SaysWhatItCannot)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  const auto contour = MakeContour(image);
  contour->SetValue(0, 0.0);
  contour->SimplifyOn();
  auto messages = test::Watch(contour);
  const auto full = Update(contour); // nothing to simplify at tolerance 0
  EXPECT_EQ(messages->ErrorCount, 0);
  contour->SimplifyOff();
  EXPECT_EQ(test::SortedTriangles(full), test::SortedTriangles(Update(contour)));
  contour->SimplifyOn();
  contour->SetErrorTolerance(0.1);
  contour->SetErrorMetricToField();
  contour->Update();
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("distance metric"), std::string::npos);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetErrorMetricToDistance();
  builder->SetShapeToIntervalVolume();
  builder->SetIsorange(-0.2, 0.2);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetErrorTolerance(0.1);
  extractor->SimplifyOn();
  auto heard = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(heard->ErrorCount, 1);
  EXPECT_NE(heard->Errors.find("isosurfaces"), std::string::npos);
  // Its shape is what it was built for, whatever is asked: it gets a warning, and the same error.
  extractor->SetShapeToIsosurface();
  extractor->Update();
  EXPECT_EQ(heard->ErrorCount, 2);
  EXPECT_EQ(heard->WarningCount, 1);
  extractor->SimplifyOff();
  extractor->SimulationQualityOn();
  extractor->Update();
  EXPECT_EQ(heard->ErrorCount, 2);
  EXPECT_GT(extractor->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(extractor->GetOutput()->GetCellType(0), VTK_TETRA);
}
