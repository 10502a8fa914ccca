// SPDX-License-Identifier: BSD-3-Clause
// vtkIsodiamondContour against vtkFlyingEdges3D, on every kind of image geometry.
#include "FilterTestTools.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

vtkSmartPointer<vtkPolyData> Contour(vtkImageData* image, double isovalue, double tolerance = 0.0)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, isovalue);
  contour->SetErrorTolerance(tolerance);
  contour->Update();
  return contour->GetOutput();
}

vtkSmartPointer<vtkPolyData> FlyingEdges(vtkImageData* image, double isovalue)
{
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, isovalue);
  contour->Update();
  return contour->GetOutput();
}

void ExpectSameSurfaceAsFlyingEdges(vtkImageData* image, double voxel)
{
  const vtkSmartPointer<vtkPolyData> ours = Contour(image, 0.0);
  const vtkSmartPointer<vtkPolyData> theirs = FlyingEdges(image, 0.0);
  EXPECT_EQ(test::BoundaryEdges(ours), 0);
  EXPECT_LT(test::LargestDistance(theirs, ours), 0.3 * voxel);
  EXPECT_LT(test::LargestDistance(ours, theirs), 0.3 * voxel);
  EXPECT_NEAR(test::Area(ours), test::Area(theirs), 0.05 * test::Area(theirs));
  const double volume = test::SixVolume(theirs);
  EXPECT_NEAR(test::SixVolume(ours), volume, 0.02 * std::fabs(volume));
  double a[6];
  double b[6];
  ours->GetBounds(a);
  theirs->GetBounds(b);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(a[i], b[i], 0.3 * voxel);
  }
}

}

TEST(Contour, EqualsFlyingEdgesOnAPlainImage)
{
  ExpectSameSurfaceAsFlyingEdges(test::BallImage({ 33, 33, 33 }), 1.0);
}

TEST(Contour, IsTheSameOfSamplesOfAnyType)
{
  // Values on both sides of zero, or, for unsigned types, of half their range (32 bits at most).
  const auto image = test::BallImage({ 12, 12, 12 });
  const auto ofType = [&](int type)
  {
    const auto samples = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    const int bits = std::min(8 * samples->GetDataTypeSize(), 32);
    const double middle = samples->GetDataTypeMin() == 0.0 ? std::ldexp(1.0, bits - 1) : 0.0;
    samples->SetName("samples");
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double value = 100.0 * image->GetPointData()->GetScalars()->GetTuple1(i);
      samples->InsertNextTuple1(middle + std::floor(vtkMath::ClampValue(value, -100.0, 100.0)));
    }
    vtkNew<vtkImageData> copy;
    copy->CopyStructure(image);
    copy->GetPointData()->SetScalars(samples);
    return test::SortedTriangles(Contour(copy, middle + 0.5));
  };
  const test::Triangles expected = ofType(VTK_DOUBLE);
  ASSERT_FALSE(expected.empty());
  for (const int type : { VTK_FLOAT, VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT,
         VTK_UNSIGNED_SHORT, VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE })
  {
    EXPECT_EQ(ofType(type), expected) << vtkImageScalarTypeNameMacro(type);
  }
}

TEST(Contour, HonoursOriginSpacingExtentAndDirection)
{
  const vtkSmartPointer<vtkImageData> image = test::BallImage({ 30, 37, 25 });
  image->SetExtent(5, 34, -7, 29, 100, 124);
  image->SetOrigin(-3.0, 20.0, 7.5);
  image->SetSpacing(0.5, 0.75, 1.25);
  ExpectSameSurfaceAsFlyingEdges(image, 1.25);
  // A rotation about an oblique axis.
  vtkNew<vtkMatrix3x3> direction;
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const double rotation[9] = { c, -s, 0, s * 0.6, c * 0.6, -0.8, s * 0.8, c * 0.8, 0.6 };
  direction->DeepCopy(rotation);
  image->SetDirectionMatrix(direction);
  ExpectSameSurfaceAsFlyingEdges(image, 1.25);
}

// At coordinates of maps: floats that are 5 million are half a voxel apart.
TEST(Contour, IsTheSameFarFromTheOrigin)
{
  const auto image = test::BallImage({ 30, 37, 25 });
  image->SetOrigin(0.0, 0.0, 0.0);
  image->SetSpacing(1.0, 1.0, 1.0);
  const double far[3] = { 500000.0, -5400000.0, 250.0 };
  for (const bool simplify : { false, true })
  {
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(image);
    contour->SetValue(0, 0.0);
    contour->SetErrorTolerance(simplify ? 1.0 : 0.0);
    contour->SetSimplify(simplify);
    image->SetOrigin(0.0, 0.0, 0.0);
    contour->Update();
    vtkNew<vtkPolyData> near;
    near->DeepCopy(contour->GetOutput());
    ASSERT_EQ(near->GetPoints()->GetDataType(), VTK_FLOAT);
    image->SetOrigin(far);
    contour->Update();
    vtkPolyData* moved = contour->GetOutput();
    ASSERT_EQ(moved->GetPoints()->GetDataType(), VTK_DOUBLE);
    ASSERT_GT(moved->GetNumberOfPoints(), 10);
    ASSERT_EQ(moved->GetNumberOfPoints(), near->GetNumberOfPoints());
    ASSERT_EQ(moved->GetNumberOfPolys(), near->GetNumberOfPolys());
    for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
    {
      double a[3];
      double b[3];
      moved->GetPoint(i, a);
      near->GetPoint(i, b);
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(a[axis] - far[axis], b[axis], 1e-5) << i;
      }
    }
  }
}

TEST(Contour, MirroredImagesKeepNormalsTowardLowerValues)
{
  const vtkSmartPointer<vtkImageData> image = test::BallImage({ 17, 17, 17 });
  const double plain = test::SixVolume(Contour(image, 0.0));
  EXPECT_GT(plain, 0.0); // values are high inside the ball
  const double mirror[9] = { -1, 0, 0, 0, 1, 0, 0, 0, 1 };
  vtkNew<vtkMatrix3x3> direction;
  direction->DeepCopy(mirror);
  image->SetDirectionMatrix(direction);
  EXPECT_NEAR(test::SixVolume(Contour(image, 0.0)), plain, 1e-3 * plain);
}

TEST(Contour, NormalsAreUnitVectorsAlongTheTriangles)
{
  const vtkSmartPointer<vtkImageData> image = test::BallImage({ 33, 29, 37 });
  image->SetSpacing(1.0, 0.5, 2.0);
  const vtkSmartPointer<vtkPolyData> surface = Contour(image, 0.0);
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  const vtkSmartPointer<vtkPolyData> theirs = FlyingEdges(image, 0.0);
  std::vector<double> angles;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double n[3];
    double theirNormal[3];
    normals->GetTuple(i, n);
    ASSERT_NEAR(vtkMath::Norm(n), 1.0, 1e-5);
    theirs->GetPointData()->GetNormals()->GetTuple(
      theirs->FindPoint(surface->GetPoint(i)), theirNormal);
    angles.push_back(vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(n, theirNormal)));
  }
  // Their nearest point is up to a voxel away, so only the median is close.
  std::sort(angles.begin(), angles.end());
  EXPECT_LT(angles[angles.size() / 2], 5.0);
  EXPECT_LT(angles.back(), 60.0);
}

TEST(Contour, HasTheAttributesOfAContourFilter)
{
  const vtkSmartPointer<vtkImageData> image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetNumberOfContours(2);
  contour->SetValue(0, -0.2);
  contour->SetValue(1, 0.2);
  contour->Update();
  vtkPolyData* output = contour->GetOutput();
  EXPECT_EQ(output->GetNumberOfCells(),
    Contour(image, -0.2)->GetNumberOfCells() + Contour(image, 0.2)->GetNumberOfCells());
  double range[2];
  ASSERT_NE(output->GetPointData()->GetArray("density"), nullptr);
  output->GetPointData()->GetArray("density")->GetRange(range);
  EXPECT_FLOAT_EQ(range[0], -0.2);
  EXPECT_FLOAT_EQ(range[1], 0.2);
  ASSERT_NE(output->GetCellData()->GetArray("Level"), nullptr);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->GenerateValues(3, -0.3, 0.3);
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfContours(), 3);
  EXPECT_EQ(contour->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
}

TEST(Contour, PassesFieldDataOn)
{
  const vtkSmartPointer<vtkImageData> image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkDoubleArray> note;
  note->SetName("note");
  note->InsertNextValue(3.0);
  image->GetFieldData()->AddArray(note);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  for (const int isovalues : { 0, 1, 2 })
  {
    contour->SetNumberOfContours(isovalues);
    for (int i = 0; i < isovalues; ++i)
    {
      contour->SetValue(i, 0.1 * i);
    }
    contour->Update();
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells() > 0, isovalues > 0);
    EXPECT_NE(contour->GetOutput()->GetFieldData()->GetArray("note"), nullptr) << isovalues;
  }
}

TEST(Contour, BuildsOnlyWhatChanged)
{
  vtkSmartPointer<vtkImageData> image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
  const vtkIdType full = contour->GetOutput()->GetNumberOfCells();
  contour->SetErrorTolerance(0.05);
  contour->Update();
  EXPECT_LT(contour->GetOutput()->GetNumberOfCells(), full);
  EXPECT_EQ(contour->GetNumberOfBuilds(), 1);
  contour->SetValue(1, 0.1); // one more isovalue: one more build
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 2);
  contour->CloseBoundaryOn(); // another volume
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 4);
  image->GetPointData()->GetScalars()->SetTuple1(2456, 50.0);
  image->GetPointData()->GetScalars()->Modified();
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 6);
  contour->SetInputData(test::BallImage({ 16, 16, 16 }));
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 8);
  // Other ways to build, with either metric; what was built is kept.
  contour->SetNumberOfContours(1);
  vtkIdType builds = 8;
  const auto expectBuild = [&](vtkIdType expected)
  {
    contour->Update();
    builds += expected;
    EXPECT_EQ(contour->GetNumberOfBuilds(), builds);
  };
  for (const int metric : { vtkIsodiamondHierarchy::FIELD, vtkIsodiamondHierarchy::DISTANCE })
  {
    contour->SetErrorMetric(metric);
    expectBuild(metric == vtkIsodiamondHierarchy::FIELD ? 1 : 0);
    contour->PreserveTopologyOff();
    expectBuild(1);
    contour->SetMinimumPieceSize(5);
    expectBuild(1);
    contour->PreserveTopologyOn();
    expectBuild(1);
    contour->SetMinimumPieceSize(0);
    expectBuild(0);
  }
}

TEST(Contour, StaysInsideOfTheImageUnlessClosed)
{
  // What is above the isovalue reaches the boundary: open surfaces end there, closed ones do not.
  for (const std::array<int, 3>& dims :
    std::vector<std::array<int, 3>>{ { 2, 2, 2 }, { 64, 64, 64 }, { 65, 65, 65 }, { 100, 37, 53 } })
  {
    const vtkSmartPointer<vtkImageData> image = test::MakeImage(dims,
      [](double x, double y, double z) { return 1.0 + std::sin(0.4 * x + 0.3 * y) + 0.01 * z; });
    for (const double tolerance : { 0.0, 0.3, 1e9 })
    {
      const vtkSmartPointer<vtkPolyData> open = Contour(image, 1.1, tolerance);
      double bounds[6];
      open->GetBounds(bounds);
      for (int axis = 0; axis < 3 && open->GetNumberOfCells() > 0; ++axis)
      {
        EXPECT_GE(bounds[2 * axis], 0.0);
        EXPECT_LE(bounds[2 * axis + 1], dims[axis] - 1.0);
      }
      vtkNew<vtkIsodiamondContour> closed;
      closed->SetInputData(image);
      closed->SetValue(0, 1.1);
      closed->SetErrorTolerance(tolerance);
      closed->CloseBoundaryOn();
      closed->Update();
      EXPECT_EQ(test::BoundaryEdges(closed->GetOutput()), 0);
      if (tolerance == 0.0)
      {
        EXPECT_GT(test::SixVolume(closed->GetOutput()), 0.0);
        closed->GetOutput()->GetBounds(bounds);
        for (int axis = 0; axis < 3; ++axis)
        {
          EXPECT_GE(bounds[2 * axis], -1.0);
          EXPECT_LE(bounds[2 * axis + 1], dims[axis]);
        }
      }
    }
  }
}

TEST(Contour, OneAndTwoStepsGiveTheSameBytesOnAnyNumberOfThreads)
{
  const vtkSmartPointer<vtkImageData> image = test::BallImage({ 50, 41, 45 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->SetErrorTolerance(0.01);
  contour->SetNumberOfThreads(1);
  contour->Update();
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetErrorMetricToDistance();
  builder->PreserveTopologyOn();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetErrorTolerance(0.01);
  for (const int threads : { 1, 2, 7 })
  {
    builder->SetNumberOfThreads(threads);
    extractor->SetNumberOfThreads(threads);
    extractor->Update();
    vtkPoints* ours = extractor->GetOutput()->GetPoints();
    vtkPoints* expected = contour->GetOutput()->GetPoints();
    ASSERT_EQ(ours->GetNumberOfPoints(), expected->GetNumberOfPoints());
    const auto* a = static_cast<float*>(ours->GetVoidPointer(0));
    const auto* b = static_cast<float*>(expected->GetVoidPointer(0));
    EXPECT_TRUE(std::equal(a, a + 3 * ours->GetNumberOfPoints(), b));
    vtkDataArray* c = extractor->GetOutput()->GetCells()->GetConnectivityArray();
    vtkDataArray* d = contour->GetOutput()->GetPolys()->GetConnectivityArray();
    ASSERT_EQ(c->GetNumberOfTuples(), d->GetNumberOfTuples());
    for (vtkIdType i = 0; i < c->GetNumberOfTuples(); ++i)
    {
      ASSERT_EQ(c->GetTuple1(i), d->GetTuple1(i));
    }
  }
}
