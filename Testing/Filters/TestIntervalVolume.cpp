// SPDX-License-Identifier: BSD-3-Clause
// Interval volumes as VTK data: arrays, geometry, caching, models, files, bad ranges.
#include "FilterTestTools.h"

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTetra.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/** The sum of the cells' volumes; every cell must be a tetrahedron of positive volume. */
double PositiveVolume(vtkUnstructuredGrid* mesh)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    EXPECT_EQ(mesh->GetCellType(i), VTK_TETRA);
    vtkIdList* ids = mesh->GetCell(i)->GetPointIds();
    double p[4][3];
    for (int corner = 0; corner < 4; ++corner)
    {
      mesh->GetPoint(ids->GetId(corner), p[corner]);
    }
    const double volume = vtkTetra::ComputeVolume(p[0], p[1], p[2], p[3]);
    EXPECT_GT(volume, 0.0);
    sum += volume;
  }
  return sum;
}

/** Tetrahedra by the positions of their corners, sorted. */
std::vector<std::array<std::array<double, 3>, 4>> SortedTetrahedra(vtkUnstructuredGrid* mesh)
{
  std::vector<std::array<std::array<double, 3>, 4>> all;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    std::array<std::array<double, 3>, 4> corners{};
    for (int corner = 0; corner < 4; ++corner)
    {
      mesh->GetPoint(mesh->GetCell(i)->GetPointId(corner), corners[corner].data());
    }
    std::sort(corners.begin(), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

vtkSmartPointer<vtkIsodiamondIntervalVolume> MakeVolume(
  vtkDataSet* grid, double lower, double upper)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(grid);
  volume->SetIsorange(lower, upper);
  return volume.GetPointer();
}

}

TEST(IntervalVolume, TellsValuesAndSurfacesOfItsPoints)
{
  const auto image = test::BallImage({ 25, 25, 25 });
  const auto volume = MakeVolume(image, 0.0, 0.25);
  volume->Update();
  vtkUnstructuredGrid* mesh = volume->GetOutput();
  ASSERT_GT(mesh->GetNumberOfCells(), 1000);
  vtkDataArray* values = mesh->GetPointData()->GetScalars();
  vtkDataArray* surfaces = mesh->GetPointData()->GetArray("Surface");
  ASSERT_NE(values, nullptr);
  ASSERT_NE(surfaces, nullptr);
  EXPECT_STREQ(values->GetName(), "density");
  EXPECT_EQ(mesh->GetCellData()->GetArray("Level")->GetNumberOfTuples(), mesh->GetNumberOfCells());
  std::array<int, 3> counts{};
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const int surface = static_cast<int>(surfaces->GetTuple1(i));
    ++counts.at(surface + 1);
    if (surface == 0)
    {
      const vtkIdType sample = image->FindPoint(mesh->GetPoint(i));
      double at[3];
      image->GetPoint(sample, at);
      EXPECT_EQ(std::hypot(at[0] - mesh->GetPoint(i)[0], at[1] - mesh->GetPoint(i)[1],
                  at[2] - mesh->GetPoint(i)[2]),
        0.0);
      EXPECT_EQ(values->GetTuple1(i), image->GetPointData()->GetScalars()->GetTuple1(sample));
    }
    else
    {
      EXPECT_EQ(values->GetTuple1(i), surface < 0 ? 0.0 : 0.25);
    }
  }
  EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 100);
}

TEST(IntervalVolume, KeepsPositiveVolumesInTheWorld)
{
  const auto image = test::BallImage({ 17, 20, 18 });
  const auto plain = MakeVolume(image, 0.0, Infinity);
  plain->Update();
  const double volume = PositiveVolume(plain->GetOutput());
  EXPECT_GT(volume, 500.0);
  vtkNew<vtkMatrix3x3> mirror;
  mirror->SetElement(0, 0, -1.0);
  image->SetDirectionMatrix(mirror);
  image->SetSpacing(0.5, 2.0, 3.0);
  image->SetOrigin(7.0, -4.0, 1.0);
  const auto mirrored = MakeVolume(image, 0.0, Infinity);
  mirrored->Update();
  EXPECT_NEAR(PositiveVolume(mirrored->GetOutput()), 3.0 * volume, 1e-3 * volume);
  // Far from the origin, where floats could not keep the points apart.
  image->SetOrigin(1e6, 2e6, 3e6);
  const auto far = MakeVolume(image, 0.0, Infinity);
  far->Update();
  EXPECT_NEAR(PositiveVolume(far->GetOutput()), 3.0 * volume, 1e-3 * volume);
}

// A tolerance that is greater than the extent of all other values still refines there.
TEST(IntervalVolume, InteriorOfInfiniteValuesDoesNotDependOnWhatCameBefore)
{
  const auto image = test::MakeImage({ 24, 24, 24 },
    [](double x, double y, double z)
    { return x == 18.0 && y == 12.0 && z == 12.0 ? Infinity : x / 24.0; });
  const auto make = [&]
  {
    const auto volume = MakeVolume(image, 0.3, Infinity);
    volume->SetErrorTolerance(1e9);
    return volume;
  };
  const auto fresh = make();
  fresh->Update();
  const vtkIdType coarse = fresh->GetOutput()->GetNumberOfCells();
  fresh->SetInteriorTolerance(1.0);
  fresh->Update();
  EXPECT_GT(fresh->GetOutput()->GetNumberOfCells(), coarse);
  const auto used = make();
  used->SetInteriorTolerance(0.01);
  used->Update();
  used->SetInteriorTolerance(1.0);
  used->Update();
  EXPECT_EQ(test::Difference(used->GetOutput(), fresh->GetOutput()), "");
}

// Long edges are not straight there: isovertices on them could turn tetrahedra over.
TEST(IntervalVolume, KeepsPositiveVolumesOnUnevenGrids)
{
  const auto image = test::MakeImage({ 65, 65, 65 },
    [](double x, double y, double z)
    { return 20.0 - std::hypot(x - 32.0, y - 32.0, z - 32.0) + std::sin(0.5 * x); });
  unsigned state = 1;
  std::array<double, 3> last{};
  std::array<std::array<double, 65>, 3> places{};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (double& place : places[axis])
    {
      place = last[axis];
      state = state * 1664525U + 1013904223U;
      last[axis] += 0.2 + 1.8 * ((state >> 8) % 1000) / 1000.0;
    }
  }
  const auto grid =
    test::Rectilinear(image, [&](int axis, int index) { return places[axis][index]; });
  for (const bool isOne : { false, true })
  {
    const auto volume = MakeVolume(grid, 0.0, Infinity);
    volume->SetOneTolerance(isOne);
    for (const double tolerance : { 0.5, 1.0, 2.0, 8.0 })
    {
      volume->SetErrorTolerance(tolerance);
      volume->Update();
      PositiveVolume(volume->GetOutput());
    }
  }
}

// Values far beyond the range put isovertices next to the lattice's vertices; with a spacing that
// is no power of two, every coordinate is rounded.
TEST(IntervalVolume, KeepsThinTetrahedraPositive)
{
  unsigned state = 1;
  const auto image = test::MakeImage({ 20, 20, 20 },
    [&state](double, double, double)
    {
      state = state * 1664525U + 1013904223U;
      const double spread = (state >> 8) % 3 == 0 ? 1000.0 : 0.5;
      return 0.5 + spread * ((state >> 10) % 1000 / 500.0 - 1.0);
    });
  for (const double spacing : { 0.3, 0.7 })
  {
    image->SetSpacing(spacing, spacing, spacing);
    image->SetOrigin(600.0, -600.0, 300.0);
    const auto volume = MakeVolume(image, 0.3, 0.7);
    volume->Update();
    EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 10000);
    PositiveVolume(volume->GetOutput());
  }
}

TEST(IntervalVolume, HasNoEmptyTetrahedraForIntegersOnItsEnds)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkUnsignedCharArray> bytes;
  bytes->SetName("bytes");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    bytes->InsertNextValue(static_cast<unsigned char>(i * i % 7));
  }
  image->GetPointData()->SetScalars(bytes);
  for (const double tolerance : { 0.0, 2.0, 5.0, Infinity })
  {
    const auto volume = MakeVolume(image, 2, 4);
    volume->SetErrorTolerance(tolerance);
    volume->Update();
    EXPECT_GT(PositiveVolume(volume->GetOutput()), 0.0);
    EXPECT_EQ(volume->GetOutput()->GetPointData()->GetScalars()->GetDataType(), VTK_FLOAT);
  }
}

TEST(IntervalVolume, BuildsOnceForAllTolerances)
{
  const auto volume = MakeVolume(test::BallImage({ 33, 33, 33 }), 0.0, Infinity);
  volume->Update();
  const vtkIdType full = volume->GetOutput()->GetNumberOfCells();
  volume->SetErrorTolerance(0.1);
  volume->Update();
  const vtkIdType coarse = volume->GetOutput()->GetNumberOfCells();
  EXPECT_LT(coarse, full);
  EXPECT_EQ(volume->GetNumberOfBuilds(), 1);
  volume->SetInteriorTolerance(0.01); // the first of these needs another build
  volume->Update();
  EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), coarse);
  EXPECT_EQ(volume->GetNumberOfBuilds(), 2);
  volume->SetInteriorTolerance(VTK_DOUBLE_MAX);
  volume->Update();
  EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), coarse);
  EXPECT_EQ(volume->GetNumberOfBuilds(), 2);
  volume->SetIsorange(0.1, Infinity);
  volume->Update();
  EXPECT_EQ(volume->GetNumberOfBuilds(), 3);
}

TEST(IntervalVolume, ComesFromAllModelsAndFiles)
{
  const auto image = test::BallImage({ 20, 17, 25 });
  const auto expected = [&](double interior)
  {
    const auto volume = MakeVolume(image, -0.1, 0.2);
    volume->SetErrorMetricToField();
    volume->SetErrorTolerance(0.03);
    volume->SetInteriorTolerance(interior);
    volume->Update();
    return SortedTetrahedra(volume->GetOutput());
  };
  for (const int model : { vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS,
         vtkIsodiamondHierarchy::RELEVANT, vtkIsodiamondHierarchy::MINIMAL })
  {
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(image);
    builder->SetModel(model);
    builder->SetShapeToIntervalVolume();
    builder->SetIsorange(-0.1, 0.2);
    builder->RefineInteriorOn();
    builder->PreserveTopologyOn();
    builder->Update();
    EXPECT_EQ(builder->GetHierarchy()->GetShape(), vtkIsodiamondHierarchy::INTERVAL_VOLUME);
    double isorange[2];
    builder->GetHierarchy()->GetIsorange(isorange);
    EXPECT_EQ(isorange[0], -0.1);
    EXPECT_EQ(isorange[1], 0.2);
    const std::string path = std::string(TEMPORARY_FOLDER) + "/interval.vtp";
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(path.c_str());
    writer->SetDataModeToBinary(); // see README.md on files
    writer->SetInputConnection(builder->GetOutputPort());
    writer->Write();
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    for (vtkAlgorithm* source :
      { static_cast<vtkAlgorithm*>(builder), static_cast<vtkAlgorithm*>(reader) })
    {
      vtkNew<vtkIsodiamondExtractor> extractor;
      extractor->SetInputConnection(source->GetOutputPort());
      extractor->SetErrorTolerance(0.03);
      extractor->SetPreserveTopology(model == vtkIsodiamondHierarchy::HIERARCHY_OF_DIAMONDS);
      for (const double interior : { VTK_DOUBLE_MAX, 0.02 })
      {
        extractor->SetInteriorTolerance(interior);
        extractor->Update();
        EXPECT_TRUE(SortedTetrahedra(extractor->GetOutput()) == expected(interior));
      }
    }
  }
}

TEST(IntervalVolume, OneHierarchyOfDiamondsAnswersBothShapes)
{
  const auto image = test::BallImage({ 17, 17, 17 });
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetModelToHierarchyOfDiamonds();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->Update();
  EXPECT_EQ(extractor->GetOutput()->GetCellType(0), VTK_TRIANGLE);
  for (const double lower : { -0.3, 0.0, 0.2 })
  {
    extractor->SetShapeToIntervalVolume();
    extractor->SetIsorange(lower, lower + 0.2);
    extractor->Update();
    const auto volume = MakeVolume(image, lower, lower + 0.2);
    volume->Update();
    EXPECT_TRUE(SortedTetrahedra(extractor->GetOutput()) == SortedTetrahedra(volume->GetOutput()));
  }
  // RI and MI warn once of what they cannot do; it has no effect.
  builder->SetModelToMinimal();
  builder->SetIsovalue(0.0);
  const auto messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_EQ(messages->ErrorCount, 0);
  EXPECT_EQ(extractor->GetOutput()->GetCellType(0), VTK_TRIANGLE);
}

TEST(IntervalVolume, WarnsOfAnInteriorToleranceThatCannotBeHeld)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 9, 9, 9 }));
  builder->SetShapeToIntervalVolume();
  builder->SetIsorange(0.0, 9.0);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetInteriorTolerance(0.01);
  const auto messages = test::Watch(extractor);
  extractor->Update();
  EXPECT_EQ(messages->WarningCount, 1);
  EXPECT_NE(messages->Warnings.find("RefineInterior"), std::string::npos);
  EXPECT_GT(extractor->GetOutput()->GetNumberOfCells(), 0);
}

TEST(IntervalVolume, RefusesRangesThatAreNone)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::array<double, 2>& range :
    std::vector<std::array<double, 2>>{ { 1.0, 0.0 }, { 0.5, 0.5 }, { nan, 1.0 }, { 0.0, nan } })
  {
    const auto volume = MakeVolume(test::BallImage({ 9, 9, 9 }), range[0], range[1]);
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(test::BallImage({ 9, 9, 9 }));
    builder->SetShapeToIntervalVolume();
    builder->SetIsorange(range[0], range[1]);
    for (vtkAlgorithm* filter :
      { static_cast<vtkAlgorithm*>(volume), static_cast<vtkAlgorithm*>(builder) })
    {
      const auto messages = test::Watch(filter);
      filter->Update();
      EXPECT_EQ(messages->ErrorCount, 1);
      EXPECT_NE(messages->Errors.find("isorange"), std::string::npos);
      EXPECT_EQ(vtkPointSet::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfPoints(), 0);
    }
  }
  // Outside the data: empty, no error.
  for (const double lower : { -100.0, 100.0 })
  {
    const auto volume = MakeVolume(test::BallImage({ 9, 9, 9 }), lower, lower + 1.0);
    const auto messages = test::Watch(volume);
    volume->Update();
    EXPECT_EQ(messages->ErrorCount + messages->WarningCount, 0);
    EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_NE(volume->GetOutput()->GetPointData()->GetArray("density"), nullptr);
  }
  // Beyond the data on both sides: the whole box.
  const auto all = MakeVolume(test::BallImage({ 9, 9, 9 }), -100.0, 100.0);
  all->SetErrorTolerance(Infinity);
  all->Update();
  EXPECT_NEAR(PositiveVolume(all->GetOutput()), 512.0, 1e-9);
}

TEST(IntervalVolume, RefusesInteriorTolerances)
{
  for (const double tolerance : { -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    const auto volume = MakeVolume(test::BallImage({ 9, 9, 9 }), 0.0, 1.0);
    volume->SetInteriorTolerance(tolerance);
    const auto messages = test::Watch(volume);
    volume->Update();
    EXPECT_EQ(messages->ErrorCount, 1);
    EXPECT_NE(messages->Errors.find("tolerance"), std::string::npos);
    EXPECT_EQ(volume->GetOutput()->GetNumberOfCells(), 0);
  }
}
