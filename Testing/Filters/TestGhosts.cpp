// SPDX-License-Identifier: BSD-3-Clause
// Cells of other shares around a process's own, and ids that are the same in all processes.
#include "FilterTestTools.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDiamondMesh.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace
{

/** A cell's corners, as global ids. */
using Corners = std::vector<vtkIdType>;

vtkIdType GlobalId(vtkDataSetAttributes* data, vtkIdType id)
{
  return vtkIdTypeArray::SafeDownCast(data->GetGlobalIds())->GetValue(id);
}

Corners CornersOf(vtkDataSet* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  Corners corners;
  for (const vtkIdType id : *ids)
  {
    corners.push_back(GlobalId(mesh->GetPointData(), id));
  }
  return corners;
}

/** The numbers of the cells around some: those that share a point with them, then with those, and
 *  so on for each level. */
std::set<vtkIdType> CellsAround(
  const std::vector<Corners>& cells, const std::set<vtkIdType>& some, int levels)
{
  std::set<vtkIdType> all = some;
  for (int level = 0; level < levels; ++level)
  {
    std::set<vtkIdType> points;
    for (const vtkIdType cell : all)
    {
      points.insert(cells[cell].begin(), cells[cell].end());
    }
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      const bool touches = std::any_of(cells[cell].begin(), cells[cell].end(),
        [&](vtkIdType point) { return points.count(point) > 0; });
      if (touches)
      {
        all.insert(static_cast<vtkIdType>(cell));
      }
    }
  }
  for (const vtkIdType cell : some)
  {
    all.erase(cell);
  }
  return all;
}

/** Pieces with ghosts, against the whole. */
void ExpectGhosts(vtkIsodiamondAlgorithm* filter, int pieces, int levels)
{
  filter->GenerateGlobalIdsOn();
  filter->UpdatePiece(0, 1, 0);
  const auto whole = vtkSmartPointer<vtkDataSet>::Take(
    vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->NewInstance());
  whole->DeepCopy(filter->GetOutputDataObject(0));
  ASSERT_GT(whole->GetNumberOfCells(), pieces);
  EXPECT_EQ(whole->GetCellGhostArray(), nullptr);
  std::vector<Corners> cells;
  for (vtkIdType cell = 0; cell < whole->GetNumberOfCells(); ++cell)
  {
    EXPECT_EQ(GlobalId(whole->GetCellData(), cell), cell);
    cells.push_back(CornersOf(whole, cell));
  }
  for (vtkIdType point = 0; point < whole->GetNumberOfPoints(); ++point)
  {
    EXPECT_EQ(GlobalId(whole->GetPointData(), point), point);
  }
  std::map<vtkIdType, int> cellOwners;
  std::map<vtkIdType, int> pointOwners;
  for (int piece = 0; piece < pieces; ++piece)
  {
    filter->UpdatePiece(piece, pieces, levels);
    vtkDataSet* mesh = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    vtkUnsignedCharArray* cellMarks = mesh->GetCellGhostArray();
    vtkUnsignedCharArray* pointMarks = mesh->GetPointGhostArray();
    ASSERT_NE(cellMarks, nullptr);
    ASSERT_NE(pointMarks, nullptr);
    std::set<vtkIdType> own;
    std::set<vtkIdType> ghosts;
    for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
    {
      const vtkIdType id = GlobalId(mesh->GetCellData(), cell);
      EXPECT_EQ(CornersOf(mesh, cell), cells[id]);
      const bool isGhost = (cellMarks->GetValue(cell) & vtkDataSetAttributes::DUPLICATECELL) != 0;
      EXPECT_TRUE((isGhost ? ghosts : own).insert(id).second);
      cellOwners[id] += isGhost ? 0 : 1;
      if (vtkDataArray* level = mesh->GetCellData()->GetArray("Level"))
      {
        EXPECT_EQ(level->GetTuple1(cell), whole->GetCellData()->GetArray("Level")->GetTuple1(id));
      }
    }
    EXPECT_EQ(ghosts, CellsAround(cells, own, levels)) << "piece " << piece << " of " << pieces;
    for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point)
    {
      const vtkIdType id = GlobalId(mesh->GetPointData(), point);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(mesh->GetPoint(point)[axis], whole->GetPoint(id)[axis]);
      }
      const bool isDuplicate = pointMarks->GetValue(point) != 0;
      EXPECT_TRUE(
        !isDuplicate || pointMarks->GetValue(point) == vtkDataSetAttributes::DUPLICATEPOINT);
      pointOwners[id] += isDuplicate ? 0 : 1;
    }
  }
  // Each cell and each point has one owner.
  EXPECT_EQ(static_cast<vtkIdType>(cellOwners.size()), whole->GetNumberOfCells());
  EXPECT_EQ(static_cast<vtkIdType>(pointOwners.size()), whole->GetNumberOfPoints());
  for (const std::map<vtkIdType, int>& owners : { cellOwners, pointOwners })
  {
    EXPECT_TRUE(std::all_of(
      owners.begin(), owners.end(), [](const auto& owner) { return owner.second == 1; }));
  }
}

void ExpectGhosts(vtkIsodiamondAlgorithm* filter)
{
  ExpectGhosts(filter, 3, 1);
  ExpectGhosts(filter, 5, 2);
}

}

TEST(Ghosts, OfContours)
{
  const auto image = test::BallImage({ 17, 15, 16 });
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  ExpectGhosts(contour);
  contour->SetErrorTolerance(0.4);
  ExpectGhosts(contour);
  contour->SimplifyOn();
  ExpectGhosts(contour);
  contour->SimplifyOff();
  contour->SetValue(1, 0.2);
  ExpectGhosts(contour);
}

TEST(Ghosts, AroundHiddenCells)
{
  const auto image = test::BallImage({ 17, 15, 16 });
  image->AllocateCellGhostArray();
  for (int i = 0; i < 8; ++i)
  {
    image->GetCellGhostArray()->SetValue(
      16 * 14 * 8 + 16 * 7 + i, vtkDataSetAttributes::HIDDENCELL);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  ExpectGhosts(contour);
}

TEST(Ghosts, OfIntervalVolumes)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(test::BallImage({ 11, 13, 12 }));
  volume->SetIsorange(0.0, 0.3);
  ExpectGhosts(volume);
  volume->SetErrorTolerance(0.5);
  ExpectGhosts(volume);
  volume->SimulationQualityOn();
  ExpectGhosts(volume);
}

TEST(Ghosts, OfAHierarchy)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(test::BallImage({ 17, 15, 16 }));
  builder->SetErrorMetricToDistance();
  vtkNew<vtkIsodiamondExtractor> extractor;
  extractor->SetInputConnection(builder->GetOutputPort());
  ExpectGhosts(extractor);
  extractor->SetErrorTolerance(0.4);
  ExpectGhosts(extractor);
  vtkNew<vtkDiamondMesh> tetrahedra;
  tetrahedra->SetInputConnection(builder->GetOutputPort());
  ExpectGhosts(tetrahedra);
}

TEST(Ghosts, OfOneProcessAreNone)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::BallImage({ 17, 15, 16 }));
  contour->SetValue(0, 0.0);
  contour->UpdatePiece(0, 1, 2);
  EXPECT_GT(contour->GetOutput()->GetNumberOfCells(), 100);
  EXPECT_EQ(contour->GetOutput()->GetCellGhostArray(), nullptr);
  EXPECT_EQ(contour->GetOutput()->GetPointData()->GetGlobalIds(), nullptr);
}
