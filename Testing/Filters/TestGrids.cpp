// SPDX-License-Identifier: BSD-3-Clause
// Every kind of input against the same image, or against VTK's own contour of it.
#include "FilterTestTools.h"

#include "vtkCellData.h"
#include "vtkContourFilter.h"
#include "vtkDataSetAttributes.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondHierarchy.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkUniformGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

vtkSmartPointer<vtkPolyData> Contour(
  vtkDataSet* grid, double isovalue, double tolerance = 0.0, bool close = false)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, isovalue);
  contour->SetErrorMetricToField();
  contour->SetErrorTolerance(tolerance);
  contour->SetCloseBoundary(close);
  contour->Update();
  return contour->GetOutput();
}

/** Expects our surface of a grid to be VTK's of the same grid, within a part of a voxel. */
void ExpectSameAsContourFilter(vtkDataSet* grid, double voxel)
{
  vtkNew<vtkContourFilter> filter;
  filter->SetInputData(grid);
  filter->SetValue(0, 0.0);
  filter->Update();
  vtkPolyData* theirs = filter->GetOutput();
  const auto ours = Contour(grid, 0.0);
  ASSERT_GT(theirs->GetNumberOfCells(), 100);
  EXPECT_LT(test::LargestDistance(theirs, ours), 0.3 * voxel);
  EXPECT_LT(test::LargestDistance(ours, theirs), 0.3 * voxel);
  EXPECT_EQ(test::BoundaryEdges(ours), 0);
  EXPECT_NEAR(test::Area(ours), test::Area(theirs), 0.05 * test::Area(theirs));
  // VTK's normals point to lower values unless the grid mirrors; ours always, so out of the ball.
  EXPECT_NEAR(
    test::SixVolume(ours), std::fabs(test::SixVolume(theirs)), 0.05 * test::SixVolume(ours));
  for (const double tolerance : { 0.05, 0.2, 1e9 })
  {
    EXPECT_EQ(test::BoundaryEdges(Contour(grid, 0.0, tolerance)), 0) << tolerance;
  }
}

/** The area of a mesh. Expects no triangle to have its centre in a box. */
double AreaOutside(vtkPolyData* mesh, const std::array<double, 6>& box)
{
  double area = 0.0;
  for (const auto& triangle : test::SortedTriangles(mesh))
  {
    bool inside = true;
    double u[3];
    double v[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double centre = (triangle[0][axis] + triangle[1][axis] + triangle[2][axis]) / 3.0;
      inside = inside && centre > box[2 * axis] && centre < box[2 * axis + 1];
      u[axis] = triangle[1][axis] - triangle[0][axis];
      v[axis] = triangle[2][axis] - triangle[0][axis];
    }
    EXPECT_FALSE(inside);
    area += 0.5 *
      std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
  }
  return area;
}

}

TEST(Grids, EvenRectilinearGridsAreImages)
{
  const auto image = test::BallImage({ 20, 17, 23 });
  image->SetOrigin(1.0, 2.0, 3.0);
  image->SetSpacing(0.5, 0.25, 2.0);
  const auto grid = test::Rectilinear(image,
    [&](int axis, int i) { return image->GetOrigin()[axis] + i * image->GetSpacing()[axis]; });
  for (const double tolerance : { 0.0, 0.2 })
  {
    vtkNew<vtkIsodiamondContour> contour; // with the distance metric, too
    contour->SetValue(0, 0.0);
    contour->SetErrorTolerance(tolerance);
    contour->SetInputData(image);
    contour->Update();
    const auto expected = test::SortedTriangles(contour->GetOutput());
    contour->SetInputData(grid);
    contour->Update();
    EXPECT_EQ(test::SortedTriangles(contour->GetOutput()), expected);
    EXPECT_FALSE(expected.empty());
  }
}

TEST(Grids, UnevenRectilinearGridsHaveTheSurfaceOfTheContourFilter)
{
  const auto image = test::BallImage({ 25, 21, 23 });
  const auto grid = test::Rectilinear(
    image, [](int axis, int i) { return axis == 1 ? -0.8 * i : i + 0.02 * i * i; }); // y mirrors
  ExpectSameAsContourFilter(grid, 2.0);
}

TEST(Grids, StructuredGridsHaveTheSurfaceOfTheContourFilter)
{
  const auto image = test::BallImage({ 25, 21, 23 });
  ExpectSameAsContourFilter(test::Structured(image, test::BentPlace), 1.0);
  // Mirrored, with points in double precision.
  const auto mirrored = test::Structured(image,
    [](double x, double y, double z)
    {
      const auto p = test::BentPlace(x, y, z);
      return std::array<double, 3>{ p[0], p[1], -p[2] };
    });
  vtkNew<vtkPoints> doubles;
  doubles->SetDataTypeToDouble();
  doubles->DeepCopy(mirrored->GetPoints());
  mirrored->SetPoints(doubles);
  ExpectSameAsContourFilter(mirrored, 1.0);
}

TEST(Grids, StraightStructuredGridsHaveNormalsAndVolumesOfTheImage)
{
  const auto image = test::BallImage({ 17, 19, 21 });
  const auto grid = test::Structured(image,
    [](double x, double y, double z) {
      return std::array<double, 3>{ x, y, z };
    });
  const auto expected = Contour(image, 0.0, 0.05, true);
  const auto surface = Contour(grid, 0.0, 0.05, true);
  ASSERT_EQ(surface->GetNumberOfPoints(), expected->GetNumberOfPoints());
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(surface->GetPoint(i)[axis], expected->GetPoint(i)[axis], 1e-5);
      EXPECT_NEAR(surface->GetPointData()->GetNormals()->GetComponent(i, axis),
        expected->GetPointData()->GetNormals()->GetComponent(i, axis), 1e-5);
    }
  }
  for (vtkDataSet* input : { static_cast<vtkDataSet*>(image), static_cast<vtkDataSet*>(grid) })
  {
    vtkNew<vtkIsodiamondIntervalVolume> volume;
    volume->SetInputData(input);
    volume->SetIsorange(-0.1, 0.2);
    volume->Update();
    EXPECT_GT(volume->GetOutput()->GetNumberOfCells(), 1000);
  }
}

TEST(Grids, ClosedSurfacesOfBentGridsAreClosed)
{
  const auto image = test::MakeImage({ 12, 12, 12 },
    [](double x, double y, double z) { return 1.0 + std::sin(0.7 * x) + std::cos(0.5 * y + z); });
  const auto bent = test::Structured(image, test::BentPlace);
  const auto uneven = test::Rectilinear(image, [](int, int i) { return i * (1 + 0.1 * i); });
  for (vtkDataSet* grid : { static_cast<vtkDataSet*>(bent), static_cast<vtkDataSet*>(uneven) })
  {
    EXPECT_GT(test::BoundaryEdges(Contour(grid, 1.0)), 0);
    EXPECT_EQ(test::BoundaryEdges(Contour(grid, 1.0, 0.0, true)), 0);
    EXPECT_EQ(test::BoundaryEdges(Contour(grid, 1.0, 0.5, true)), 0);
  }
}

TEST(Grids, RegionsOfInterestOfBentGridsAreOfTheWorld)
{
  const auto image = test::BallImage({ 33, 33, 33 });
  const auto bent = test::Structured(image, test::BentPlace);
  const auto uneven = test::Rectilinear(image, [](int, int i) { return i * (1 + 0.05 * i); });
  for (vtkDataSet* grid : { static_cast<vtkDataSet*>(bent), static_cast<vtkDataSet*>(uneven) })
  {
    double bounds[6];
    const auto full = Contour(grid, 0.0);
    full->GetBounds(bounds);
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(grid);
    contour->SetValue(0, 0.0);
    contour->UseRegionOfInterestOn();
    const double middle[3] = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
      0.5 * (bounds[4] + bounds[5]) };
    contour->SetRegionOfInterest(bounds[0], middle[0], bounds[2], middle[1], bounds[4], middle[2]);
    contour->Update();
    vtkPolyData* part = contour->GetOutput();
    EXPECT_EQ(test::BoundaryEdges(part), 0);
    EXPECT_LT(part->GetNumberOfCells(), full->GetNumberOfCells());
    // Every triangle of full resolution in the region is there.
    const auto all = test::SortedTriangles(part);
    int inRegion = 0;
    for (const auto& triangle : test::SortedTriangles(full))
    {
      bool inside = true;
      for (const auto& corner : triangle)
      {
        inside = inside && corner[0] < middle[0] && corner[1] < middle[1] && corner[2] < middle[2];
      }
      if (inside)
      {
        ++inRegion;
        EXPECT_TRUE(std::binary_search(all.begin(), all.end(), triangle));
      }
    }
    EXPECT_GT(inRegion, 50);
  }
}

TEST(Grids, BlankedCellsAreInHierarchiesWithAWarning)
{
  for (const bool isBlanked : { false, true })
  {
    vtkNew<vtkUniformGrid> grid;
    grid->ShallowCopy(test::BallImage({ 9, 9, 9 }));
    if (isBlanked)
    {
      grid->BlankCell(100);
    }
    vtkNew<vtkIsodiamondBuilder> builder;
    builder->SetInputData(grid);
    auto messages = test::Watch(builder);
    builder->Update();
    EXPECT_EQ(messages->WarningCount, isBlanked ? 1 : 0);
    EXPECT_EQ(messages->Warnings.find("Blanked") != std::string::npos, isBlanked);
    EXPECT_GT(builder->GetHierarchy()->GetNumberOfActiveIsodiamonds(), 0);
  }
}

TEST(Grids, BlankedAndGhostCellsHaveNoSurface)
{
  const auto image = test::BallImage({ 24, 24, 24 });
  const auto full = Contour(image, 0.0);
  // A box of cells, [8, 12) x [0, 23) x [0, 23): blanked, with blanked points, or ghosts.
  const std::array<double, 6> box = { 8, 12, 0, 23, 0, 23 };
  const auto inBox = [&](int x) { return x >= 8 && x < 12; };
  vtkNew<vtkUniformGrid> blankedCells;
  blankedCells->ShallowCopy(image);
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    if (inBox(static_cast<int>(cell % 23)))
    {
      blankedCells->BlankCell(cell);
    }
  }
  vtkNew<vtkUniformGrid> blankedPoints; // inside the same box: its cells are hidden with them
  blankedPoints->ShallowCopy(image);
  for (vtkIdType point = 0; point < image->GetNumberOfPoints(); ++point)
  {
    const int x = static_cast<int>(point % 24);
    if (x > 8 && x < 12)
    {
      blankedPoints->BlankPoint(point);
    }
  }
  vtkNew<vtkImageData> ghosts;
  ghosts->ShallowCopy(image);
  vtkNew<vtkUnsignedCharArray> types;
  types->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType cell = 0; cell < image->GetNumberOfCells(); ++cell)
  {
    types->InsertNextValue(
      inBox(static_cast<int>(cell % 23)) ? vtkDataSetAttributes::DUPLICATECELL : 0);
  }
  ghosts->GetCellData()->AddArray(types);
  double area = 0.0; // of the surface at full resolution, elsewhere
  for (const auto& triangle : test::SortedTriangles(full))
  {
    const double x = (triangle[0][0] + triangle[1][0] + triangle[2][0]) / 3.0;
    if (x < 8.0 || x > 12.0)
    {
      double u[3];
      double v[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        u[axis] = triangle[1][axis] - triangle[0][axis];
        v[axis] = triangle[2][axis] - triangle[0][axis];
      }
      area += 0.5 *
        std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    }
  }
  for (vtkDataSet* grid : { static_cast<vtkDataSet*>(blankedCells.Get()),
         static_cast<vtkDataSet*>(blankedPoints.Get()), static_cast<vtkDataSet*>(ghosts.Get()) })
  {
    for (const double tolerance : { 0.0, 0.1, 1e9 })
    {
      const auto surface = Contour(grid, 0.0, tolerance);
      const double rest = AreaOutside(surface, box);
      EXPECT_GT(surface->GetNumberOfCells(), 0);
      EXPECT_EQ(
        surface->GetPointData()->GetNormals()->GetNumberOfTuples(), surface->GetNumberOfPoints());
      if (tolerance == 0.0)
      {
        EXPECT_NEAR(rest, area, 1e-6 * area);
      }
      else if (tolerance < 1.0)
      {
        EXPECT_NEAR(rest, area, 0.2 * area);
        EXPECT_LT(surface->GetNumberOfCells(), full->GetNumberOfCells());
      }
    }
    vtkNew<vtkIsodiamondIntervalVolume> volume; // the inside is left out, too
    volume->SetInputData(grid);
    volume->SetIsorange(-1e9, 1e9);
    volume->SetErrorTolerance(1e9);
    volume->Update();
    double sum = 0.0;
    for (vtkIdType i = 0; i < volume->GetOutput()->GetNumberOfCells(); ++i)
    {
      vtkCell* tetrahedron = volume->GetOutput()->GetCell(i);
      double p[4][3];
      for (int corner = 0; corner < 4; ++corner)
      {
        tetrahedron->GetPoints()->GetPoint(corner, p[corner]);
      }
      const double six = std::fabs((p[1][0] - p[0][0]) *
          ((p[2][1] - p[0][1]) * (p[3][2] - p[0][2]) - (p[2][2] - p[0][2]) * (p[3][1] - p[0][1])) -
        (p[1][1] - p[0][1]) *
          ((p[2][0] - p[0][0]) * (p[3][2] - p[0][2]) - (p[2][2] - p[0][2]) * (p[3][0] - p[0][0])) +
        (p[1][2] - p[0][2]) *
          ((p[2][0] - p[0][0]) * (p[3][1] - p[0][1]) - (p[2][1] - p[0][1]) * (p[3][0] - p[0][0])));
      sum += six / 6.0;
    }
    EXPECT_NEAR(sum, (23.0 - 4.0) * 23.0 * 23.0, 1e-6 * sum);
  }
}

TEST(Grids, BlocksOfACompositeAreWorkedOnOneByOneAndKept)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int i = 0; i < 3; ++i)
  {
    const auto image = test::BallImage({ 15 + i, 15, 15 });
    image->SetOrigin(20.0 * i, 0.0, 0.0);
    blocks->SetBlock(i, image);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(blocks);
  contour->SetValue(0, 0.0);
  for (const double tolerance : { 0.0, 0.3 })
  {
    contour->SetErrorTolerance(tolerance);
    contour->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(contour->GetOutputDataObject(0));
    ASSERT_NE(output, nullptr);
    for (int i = 0; i < 3; ++i)
    {
      vtkNew<vtkIsodiamondContour> alone;
      alone->SetInputData(blocks->GetBlock(i));
      alone->SetValue(0, 0.0);
      alone->SetErrorTolerance(tolerance);
      alone->Update();
      EXPECT_EQ(test::SortedTriangles(vtkPolyData::SafeDownCast(output->GetBlock(i))),
        test::SortedTriangles(alone->GetOutput()));
    }
  }
  EXPECT_EQ(contour->GetNumberOfBuilds(), 3); // not again for the second tolerance
}

TEST(Grids, BlocksWithoutTheArrayHaveNoMesh)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int i = 0; i < 3; ++i)
  {
    const auto image = test::BallImage({ 15, 15, 15 });
    image->GetPointData()->GetScalars()->SetName(i == 1 ? "other" : "ball");
    blocks->SetBlock(i, image);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(blocks);
  contour->SetValue(0, 0.0);
  const auto cellsOf = [&](const char* array)
  {
    contour->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
    contour->Update();
    auto* output = vtkMultiBlockDataSet::SafeDownCast(contour->GetOutputDataObject(0));
    std::vector<vtkIdType> cells;
    for (unsigned int i = 0; i < 3; ++i)
    {
      auto* mesh = vtkPolyData::SafeDownCast(output->GetBlock(i));
      cells.push_back(mesh ? mesh->GetNumberOfCells() : -1);
    }
    return cells;
  };
  const vtkIdType all = Contour(test::BallImage({ 15, 15, 15 }), 0.0)->GetNumberOfCells();
  const auto messages = test::Watch(contour);
  EXPECT_EQ(cellsOf("ball"), (std::vector<vtkIdType>{ all, 0, all }));
  EXPECT_EQ(messages->Errors, "");
  EXPECT_EQ(cellsOf("other"), (std::vector<vtkIdType>{ 0, all, 0 }));
  EXPECT_EQ(messages->Errors, "");
  EXPECT_EQ(cellsOf("nobody's"), (std::vector<vtkIdType>{ 0, 0, 0 }));
  EXPECT_EQ(messages->ErrorCount, 3);
}

TEST(Grids, PartitionsAreWorkedOnOneByOne)
{
  vtkNew<vtkPartitionedDataSet> partitions;
  vtkIdType expected = 0;
  for (unsigned int i = 0; i < 2; ++i)
  {
    const auto image = test::BallImage({ 15 + static_cast<int>(i), 15, 15 });
    partitions->SetPartition(i, image);
    expected += Contour(image, 0.0)->GetNumberOfCells();
  }
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, partitions);
  for (vtkDataObject* input :
    { static_cast<vtkDataObject*>(partitions), static_cast<vtkDataObject*>(collection) })
  {
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputData(input);
    contour->SetValue(0, 0.0);
    contour->Update();
    auto* output = vtkCompositeDataSet::SafeDownCast(contour->GetOutputDataObject(0));
    ASSERT_NE(output, nullptr);
    EXPECT_EQ(output->GetNumberOfCells(), expected);
    EXPECT_EQ(contour->GetNumberOfBuilds(), 2);
  }
}

TEST(Grids, HierarchiesAreKnownByContentAndKeptWithinTheCache)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetValue(0, 0.0);
  const auto show = [&](int size)
  {
    contour->SetInputData(test::BallImage({ size, 16, 16 })); // a new array each time
    contour->Update();
  };
  show(16);
  show(17);
  show(16);
  EXPECT_EQ(contour->GetNumberOfBuilds(), 2);
  EXPECT_EQ(contour->GetNumberOfCachedHierarchies(), 2);
  // The size counts besides what was used last, so one of these two may be as large as it is.
  const auto large = test::BallImage({ 300, 200, 200 });
  contour->SetCacheSize(2);
  contour->SetInputData(large);
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 3);
  show(16);
  EXPECT_EQ(contour->GetNumberOfBuilds(), 3);
  show(17);
  show(16);
  EXPECT_EQ(contour->GetNumberOfBuilds(), 3);
  EXPECT_EQ(contour->GetNumberOfCachedHierarchies(), 2);
  contour->SetCacheSize(0); // only what was used last
  show(16);
  EXPECT_EQ(contour->GetNumberOfCachedHierarchies(), 1);
  show(17);
  EXPECT_EQ(contour->GetNumberOfBuilds(), 4);
  EXPECT_EQ(contour->GetNumberOfCachedHierarchies(), 1);
  contour->SetValue(1, 0.1);
  contour->SetValue(2, -0.1);
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 6); // those of one execution are kept together
  EXPECT_EQ(contour->GetNumberOfCachedHierarchies(), 3);
  contour->SetValue(2, -0.2);
  contour->Update();
  EXPECT_EQ(contour->GetNumberOfBuilds(), 7);
}

// Who writes into an array may mark only the grid as modified; and a source that fills the same
// array again marks nothing.
TEST(Grids, ArraysThatWereWrittenIntoAreReadAgain)
{
  const auto image = test::BallImage({ 16, 16, 16 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(image);
  builder->SetIsovalue(0.0);
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  extractor->SetOutputTypeToPolyData();
  const auto expectAsNew = [&]
  {
    vtkNew<vtkIsodiamondContour> fresh;
    fresh->SetInputData(image);
    fresh->SetValue(0, 0.0);
    fresh->Update();
    contour->Update();
    extractor->Update();
    EXPECT_EQ(
      test::SortedTriangles(contour->GetOutput()), test::SortedTriangles(fresh->GetOutput()));
    EXPECT_EQ(extractor->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL),
      fresh->GetOutput()->GetNumberOfCells());
  };
  const auto write = [&]
  {
    vtkDataArray* array = image->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      array->SetComponent(i, 0, array->GetComponent(i, 0) + 0.15);
    }
  };
  expectAsNew();
  write();
  image->Modified();
  expectAsNew();
  write();
  image->DataHasBeenGenerated();
  contour->Modified();
  builder->GetInputAlgorithm()->Modified(); // the executive does so where a source has run
  expectAsNew();
}

TEST(Grids, BlocksTellTheLargestToleranceThatTheyAchieve)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, test::PhantomImage({ 24, 24, 24 }, 2.0));
  blocks->SetBlock(1, test::BallImage({ 5, 5, 5 }));
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(blocks);
  contour->SetValue(0, 0.0);
  contour->SetTargetNumberOfTriangles(500);
  contour->Update();
  double largest = 0.0;
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkIsodiamondContour> alone;
    alone->SetInputData(blocks->GetBlock(i));
    alone->SetValue(0, 0.0);
    alone->SetTargetNumberOfTriangles(500);
    alone->Update();
    largest = std::max(largest, alone->GetAchievedTolerance());
    EXPECT_EQ(i == 0, alone->GetAchievedTolerance() > 0.0);
  }
  EXPECT_EQ(contour->GetAchievedTolerance(), largest);
}
