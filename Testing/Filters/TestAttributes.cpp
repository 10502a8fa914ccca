// SPDX-License-Identifier: BSD-3-Clause
// Data at the points of meshes: other arrays against VTK's probe, gradients against calculus.
#include "FilterTestTools.h"

#include "vtkCellData.h"
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
#include "vtkProbeFilter.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShortArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

/** The ball with a vector array "flow" (the active vectors) and a wild short array "count". */
vtkSmartPointer<vtkImageData> ImageWithArrays()
{
  const auto image = test::BallImage({ 25, 21, 23 });
  image->SetSpacing(0.5, 1.0, 0.8);
  image->SetOrigin(3.0, -2.0, 10.0);
  const vtkIdType count = image->GetNumberOfPoints();
  vtkNew<vtkFloatArray> flow;
  flow->SetName("flow");
  flow->SetNumberOfComponents(3);
  vtkNew<vtkShortArray> counts;
  counts->SetName("count");
  for (vtkIdType i = 0; i < count; ++i)
  {
    flow->InsertNextTuple3(std::sin(0.1 * i), std::cos(0.07 * i), 1e-3 * i);
    counts->InsertNextValue(static_cast<short>((i * 7919) % 2000 - 1000));
  }
  image->GetPointData()->SetVectors(flow);
  image->GetPointData()->AddArray(counts);
  return image;
}

/** A copy with each component in an array of its own: values are not in a row. */
template <typename T>
vtkSmartPointer<vtkDataArray> AsStructureOfArrays(vtkDataArray* array)
{
  const auto copy = vtkSmartPointer<vtkSOADataArrayTemplate<T>>::New();
  copy->SetName(array->GetName());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(array->GetNumberOfTuples());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    copy->SetTuple(i, array->GetTuple(i));
  }
  return copy;
}

/** Expects a mesh to have what VTK's probe finds in an image at the mesh's points. */
void ExpectProbed(vtkPointSet* mesh, vtkImageData* image, const char* name, double tolerance)
{
  vtkNew<vtkPolyData> points; // only the geometry, for the probe
  points->SetPoints(mesh->GetPoints());
  vtkNew<vtkProbeFilter> probe;
  vtkNew<vtkImageData> asDoubles; // the probe would give integers for integers
  asDoubles->ShallowCopy(image);
  vtkDataArray* array = image->GetPointData()->GetArray(name);
  vtkNew<vtkFloatArray> copy;
  copy->DeepCopy(array);
  asDoubles->GetPointData()->AddArray(copy);
  probe->SetInputData(points);
  probe->SetSourceData(asDoubles);
  probe->Update();
  vtkDataArray* theirs = probe->GetOutput()->GetPointData()->GetArray(name);
  vtkDataArray* ours = mesh->GetPointData()->GetArray(name);
  ASSERT_NE(ours, nullptr) << name;
  ASSERT_EQ(ours->GetNumberOfTuples(), mesh->GetNumberOfPoints());
  ASSERT_EQ(ours->GetNumberOfComponents(), array->GetNumberOfComponents());
  ASSERT_GE(mesh->GetNumberOfPoints(), 100);
  double worst = 0.0;
  for (vtkIdType i = 0; i < ours->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < ours->GetNumberOfComponents(); ++c)
    {
      worst = std::max(worst, std::fabs(ours->GetComponent(i, c) - theirs->GetComponent(i, c)));
    }
  }
  EXPECT_LE(worst, tolerance) << name;
}

}

TEST(Attributes, ArraysOfAnyLayoutGiveTheSameMesh)
{
  const auto image = ImageWithArrays();
  vtkPointData* arrays = image->GetPointData();
  vtkNew<vtkImageData> other;
  other->CopyStructure(image);
  other->GetPointData()->SetScalars(AsStructureOfArrays<float>(arrays->GetScalars()));
  other->GetPointData()->SetVectors(AsStructureOfArrays<float>(arrays->GetVectors()));
  other->GetPointData()->AddArray(AsStructureOfArrays<short>(arrays->GetArray("count")));
  ASSERT_FALSE(other->GetPointData()->GetScalars()->HasStandardMemoryLayout());

  const auto meshOf = [](vtkImageData* input)
  {
    vtkNew<vtkIsodiamondContour> contour; // a new one each time: it keeps what it has built
    contour->SetInputData(input);
    contour->SetValue(0, 0.0);
    contour->SetErrorTolerance(0.2);
    contour->Update();
    return vtkSmartPointer<vtkPolyData>(contour->GetOutput());
  };
  const auto expected = meshOf(image);
  ASSERT_GT(expected->GetNumberOfCells(), 0);
  ASSERT_NE(expected->GetPointData()->GetArray("flow"), nullptr);
  ASSERT_NE(expected->GetPointData()->GetArray("count"), nullptr);
  EXPECT_EQ(test::Difference(expected, meshOf(other)), "");
}

TEST(Attributes, OfAnArrayWithoutNameCanBeReadFromAFile)
{
  const auto image = test::BallImage({ 12, 12, 12 });
  image->GetPointData()->GetScalars()->SetName(nullptr);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->SetValue(1, 0.2);
  contour->Update();
  const std::string file = std::string(TEMPORARY_FOLDER) + "/unnamed.vtp";
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(contour->GetOutputPort());
  writer->SetDataModeToBinary(); // what VTK writes by default newer parsers refuse
  writer->SetFileName(file.c_str());
  writer->Write();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  const auto messages = test::Watch(reader);
  reader->Update();
  EXPECT_EQ(messages->Errors, "");
  vtkDataArray* values = reader->GetOutput()->GetPointData()->GetScalars();
  ASSERT_NE(values, nullptr);
  ASSERT_EQ(values->GetNumberOfTuples(), contour->GetOutput()->GetNumberOfPoints());
  EXPECT_FLOAT_EQ(values->GetRange()[0], 0.0F);
  EXPECT_FLOAT_EQ(values->GetRange()[1], 0.2F);
}

TEST(Attributes, OtherArraysAreWhatTheProbeFinds)
{
  const auto image = ImageWithArrays();
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  for (const double tolerance : { 0.0, 0.4, 2.0 })
  {
    contour->SetErrorTolerance(tolerance);
    contour->Update();
    ExpectProbed(contour->GetOutput(), image, "flow", 1e-5);
    ExpectProbed(contour->GetOutput(), image, "count", 1e-3); // of 2000: floats have 24 bits
  }
  EXPECT_EQ(contour->GetOutput()->GetPointData()->GetVectors(),
    contour->GetOutput()->GetPointData()->GetArray("flow"));
  // Positions as floats are off by half their last bit, values by that times the slope.
  contour->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  contour->Update();
  ExpectProbed(contour->GetOutput(), image, "count", 2000 * 2e-5);
  contour->InterpolateAttributesOff();
  contour->Update();
  EXPECT_FALSE(contour->GetOutput()->GetPointData()->HasArray("flow"));
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(image);
  volume->SetIsorange(-0.1, 0.3);
  volume->SetErrorTolerance(0.3);
  volume->Update();
  ExpectProbed(volume->GetOutput(), image, "flow", 1e-5);
}

TEST(Attributes, CapsHaveTheValuesOfTheBoundary)
{
  const auto image = test::MakeImage({ 9, 9, 9 }, [](double, double, double) { return 1.0; });
  image->GetPointData()->GetScalars()->SetTuple1(0, 0.0); // the minimum, for the padding
  vtkNew<vtkFloatArray> x;
  x->SetName("x");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    x->InsertNextValue(static_cast<float>(image->GetPoint(i)[0]));
  }
  image->GetPointData()->AddArray(x);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.5);
  contour->CloseBoundaryOn();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  ASSERT_LT(surface->GetBounds()[0], 0.0);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(surface->GetPointData()->GetArray("x")->GetTuple1(i),
      std::clamp(surface->GetPoint(i)[0], 0.0, 8.0), 1e-5);
  }
}

TEST(Attributes, GradientsAreTheFieldsAndNormalsPointAgainstThem)
{
  // Central differences of a quadratic function are exact, and linear between samples.
  const auto image = test::MakeImage({ 17, 17, 17 },
    [](double x, double y, double z)
    { return (x - 8) * (x - 8) + 2 * (y - 7) * (y - 7) + z * 3.0; });
  image->SetSpacing(0.5, 1.0, 2.0);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 40.0);
  contour->ComputeGradientsOn();
  contour->Update();
  vtkPolyData* surface = contour->GetOutput();
  vtkDataArray* gradients = surface->GetPointData()->GetArray("Gradient");
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  ASSERT_NE(gradients, nullptr);
  ASSERT_NE(normals, nullptr);
  int inner = 0;
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    const double* p = surface->GetPoint(i);
    const double x = p[0] / 0.5;
    const double y = p[1];
    const double z = p[2] / 2.0;
    if (std::min({ x, y, z }) < 1.0 || std::max({ x, y, z }) > 15.0)
    {
      continue; // differences at the boundary are one-sided
    }
    ++inner;
    const double expected[3] = { 2 * (x - 8) / 0.5, 4 * (y - 7), 1.5 };
    const double length = std::hypot(expected[0], expected[1], expected[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(gradients->GetComponent(i, axis), expected[axis], 1e-4 * length);
      EXPECT_NEAR(normals->GetComponent(i, axis), -expected[axis] / length, 1e-4);
    }
  }
  EXPECT_GT(inner, 100);
}

TEST(Attributes, AreKeptApartFromTheFilterOwnArrays)
{
  // Arrays of the input with names that the output uses itself, and one that is nearly such.
  const auto image = test::BallImage({ 17, 17, 17 });
  for (const char* name : { "Normals", "vtkGhostType2", "Level" })
  {
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfValues(image->GetNumberOfPoints());
    array->Fill(7.0);
    image->GetPointData()->AddArray(array);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->Update();
  vtkPointData* data = contour->GetOutput()->GetPointData();
  EXPECT_EQ(data->GetArray("Normals")->GetNumberOfComponents(), 3);
  EXPECT_EQ(data->GetArray("Level")->GetTuple1(0), 7.0); // the filter's own is of the cells
  EXPECT_EQ(contour->GetOutput()->GetCellData()->GetArray("Level")->GetTuple1(0), 4.0);
  EXPECT_EQ(data->GetNumberOfArrays(), 4); // density, too
}

TEST(Attributes, HierarchiesCarryTheArraysThatTheyAreAskedFor)
{
  const auto image = ImageWithArrays();
  for (const bool isVolume : { false, true })
  {
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(image);
    builder->SetErrorMetricToDistance();
    builder->SetIsovalue(0.0);
    builder->SetIsorange(-0.1, 0.3);
    if (isVolume)
    {
      builder->SetShapeToIntervalVolume();
    }
    builder->Update();
    const vtkIdType plain = builder->GetHierarchy()->GetStorageSize();
    builder->AddPointArray("flow");
    builder->AddPointArray("count");
    builder->ComputeNormalsOn();
    builder->Update();
    EXPECT_GE(builder->GetHierarchy()->GetStorageSize(),
      plain + 28 * builder->GetHierarchy()->GetNumberOfIsovertices());
    // Through a file, too.
    const std::string file = std::string(TEMPORARY_FOLDER) + "/attributes.vtp";
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputConnection(builder->GetOutputPort());
    writer->SetDataModeToBinary();
    writer->SetFileName(file.c_str());
    writer->Write();
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    vtkNew<vtkIsodiamondExtractor> extractor;
    extractor->SetInputConnection(reader->GetOutputPort());
    extractor->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    for (const double tolerance : { 0.0, 0.5 })
    {
      extractor->SetErrorTolerance(tolerance);
      extractor->Update();
      ExpectProbed(extractor->GetOutput(), image, "flow", 1e-5);
      ExpectProbed(extractor->GetOutput(), image, "count", 1e-3);
      ASSERT_NE(extractor->GetOutput()->GetPointData()->GetNormals(), nullptr);
    }
    builder->AddPointArray("nowhere");
    const auto messages = test::Watch(builder);
    builder->Update();
    EXPECT_NE(messages->Errors.find("nowhere"), std::string::npos) << messages->Errors;
  }
}

TEST(Attributes, AHierarchyWithArraysOfAnotherSizeIsDamaged)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(ImageWithArrays());
  builder->AddPointArray("flow");
  builder->Update();
  vtkNew<vtkPolyData> damaged;
  damaged->ShallowCopy(builder->GetOutput());
  vtkNew<vtkFloatArray> shorter;
  shorter->DeepCopy(damaged->GetFieldData()->GetArray("IsodiamondPointData:flow"));
  shorter->SetNumberOfTuples(shorter->GetNumberOfTuples() - 1);
  damaged->GetFieldData()->AddArray(shorter);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputData(damaged);
  const auto messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_NE(messages->Errors.find("IsodiamondPointData:flow"), std::string::npos);
  EXPECT_EQ(extractor->GetOutput()->GetNumberOfPoints(), 0);
}
