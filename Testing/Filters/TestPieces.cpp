// SPDX-License-Identifier: BSD-3-Clause
// What each of several processes gets: shares that together are the whole.
#include "FilterTestTools.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDiamondMesh.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIsodiamondBuilder.h"
#include "vtkIsodiamondContour.h"
#include "vtkIsodiamondExtractor.h"
#include "vtkIsodiamondIntervalVolume.h"
#include "vtkIsodiamondPoints.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace
{

/** A cell: its type, its corners with their point data, and its cell data. */
using Cell = std::vector<double>;

void Append(vtkDataSetAttributes* data, vtkIdType id, Cell& cell)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    const double* tuple = array->GetTuple(id);
    cell.insert(cell.end(), tuple, tuple + array->GetNumberOfComponents());
  }
}

/** Adds a mesh's cells in their order. Expects each of its points to be used by one. */
void AddCells(vtkDataSet* mesh, std::vector<Cell>& cells)
{
  std::set<vtkIdType> used;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    Cell cell{ static_cast<double>(mesh->GetCellType(i)) };
    mesh->GetCellPoints(i, ids);
    for (const vtkIdType id : *ids)
    {
      used.insert(id);
      const double* point = mesh->GetPoint(id);
      cell.insert(cell.end(), point, point + 3);
      Append(mesh->GetPointData(), id, cell);
    }
    Append(mesh->GetCellData(), i, cell);
    cells.push_back(std::move(cell));
  }
  EXPECT_EQ(static_cast<vtkIdType>(used.size()), mesh->GetNumberOfPoints());
}

/** Names, types, sizes and roles of a mesh's arrays. */
std::string Arrays(vtkDataSet* mesh)
{
  std::string text;
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(mesh->GetPointData()),
         static_cast<vtkDataSetAttributes*>(mesh->GetCellData()) })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = data->GetArray(i);
      text += std::string(array->GetName()) + " " + array->GetDataTypeAsString() + " " +
        std::to_string(array->GetNumberOfComponents()) + " " +
        std::to_string(data->IsArrayAnAttribute(i)) + "\n";
    }
  }
  return text + vtkPointSet::SafeDownCast(mesh)->GetPoints()->GetData()->GetDataTypeAsString();
}

/** The cells of a mesh that no piece has had yet. */
class CellsLeft
{
public:
  explicit CellsLeft(const std::vector<Cell>& cells)
  {
    for (const Cell& cell : cells)
    {
      const int number = static_cast<int>(this->Numbers.size());
      EXPECT_TRUE(this->Numbers.emplace(cell, number).second) << "a cell twice";
    }
  }

  /** Takes a piece's cells. @return whether they were left, and are in the whole mesh's order */
  bool Take(const std::vector<Cell>& piece)
  {
    int last = -1;
    return std::all_of(piece.begin(), piece.end(),
      [&](const Cell& cell)
      {
        const auto found = this->Numbers.find(cell);
        if (found == this->Numbers.end() || found->second < last)
        {
          return false;
        }
        last = found->second;
        this->Numbers.erase(found);
        return true;
      });
  }

  bool AreTaken() const { return this->Numbers.empty(); }

private:
  std::map<Cell, int> Numbers;
};

/** How a mesh is cut into pieces. */
enum class Cut
{
  ByBricks,
  Evenly ///< its cells in their order, into pieces that differ by at most one
};

/** Checks a piece of an evenly cut mesh. */
void ExpectNumbers(
  const std::vector<Cell>& own, const std::vector<Cell>& cells, int piece, int pieces)
{
  const std::size_t share = cells.size() / pieces;
  EXPECT_GE(own.size(), share);
  EXPECT_LE(own.size(), share + 1);
  const std::vector<Cell> expected(cells.begin() + cells.size() * piece / pieces,
    cells.begin() + cells.size() * (piece + 1) / pieces);
  EXPECT_TRUE(own == expected) << "piece " << piece << " of " << pieces;
}

/** Expects all pieces of a filter's mesh together to have each of its cells once. */
void ExpectShares(vtkAlgorithm* filter, int pieces, Cut cut)
{
  filter->UpdatePiece(0, 1, 0);
  const auto whole = vtkSmartPointer<vtkDataSet>::Take(
    vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0))->NewInstance());
  whole->DeepCopy(filter->GetOutputDataObject(0));
  ASSERT_GT(whole->GetNumberOfCells(), 0);
  std::vector<Cell> cells;
  AddCells(whole, cells);
  CellsLeft left(cells);
  for (int piece = 0; piece < pieces; ++piece)
  {
    filter->UpdatePiece(piece, pieces, 0);
    vtkDataSet* mesh = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    EXPECT_EQ(Arrays(mesh), Arrays(whole));
    for (int i = 0; i < mesh->GetPointData()->GetNumberOfArrays(); ++i)
    {
      EXPECT_EQ(mesh->GetPointData()->GetArray(i)->GetNumberOfTuples(), mesh->GetNumberOfPoints());
    }
    for (int i = 0; i < mesh->GetCellData()->GetNumberOfArrays(); ++i)
    {
      EXPECT_EQ(mesh->GetCellData()->GetArray(i)->GetNumberOfTuples(), mesh->GetNumberOfCells());
    }
    std::vector<Cell> own;
    AddCells(mesh, own);
    EXPECT_TRUE(left.Take(own)) << "piece " << piece << " of " << pieces << ": " << own.size()
                                << " cells";
    if (cut == Cut::Evenly)
    {
      ExpectNumbers(own, cells, piece, pieces);
    }
  }
  EXPECT_TRUE(left.AreTaken());
}

void ExpectShares(vtkAlgorithm* filter, Cut cut = Cut::ByBricks)
{
  for (const int pieces : { 1, 2, 3, 7 })
  {
    ExpectShares(filter, pieces, cut);
  }
}

/** The ball with another array beside its density. */
vtkSmartPointer<vtkImageData> BallWithMore()
{
  const auto image = test::BallImage({ 33, 29, 31 });
  vtkNew<vtkDoubleArray> more;
  more->SetName("more");
  more->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    more->InsertNextTuple2(0.5 * i, -1.0 * (i % 7));
  }
  image->GetPointData()->AddArray(more);
  return image;
}

/** Uniform at two tolerances, then with a region of interest. */
template <typename Check>
void ForQueries(vtkIsodiamondAlgorithm* filter, const Check& check)
{
  for (const double tolerance : { 0.0, 0.5 })
  {
    filter->SetErrorTolerance(tolerance);
    check();
  }
  filter->SetErrorTolerance(0.0);
  filter->UseRegionOfInterestOn();
  filter->SetRegionOfInterest(3.0, 14.0, 5.0, 12.0, 0.0, 20.0);
  check();
}

}

TEST(Pieces, Contour)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(BallWithMore());
  contour->SetValue(0, 0.0);
  contour->ComputeGradientsOn();
  ForQueries(contour, [&] { ExpectShares(contour); });
  contour->SimplifyOn();
  contour->SetErrorTolerance(0.5);
  ExpectShares(contour, Cut::Evenly);
  contour->SimplifyOff();
  contour->SetValue(1, 0.2);
  contour->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  ExpectShares(contour);
}

TEST(Pieces, IntervalVolume)
{
  vtkNew<vtkIsodiamondIntervalVolume> volume;
  volume->SetInputData(BallWithMore());
  volume->SetIsorange(0.0, 0.3);
  ForQueries(volume, [&] { ExpectShares(volume); });
  volume->SimulationQualityOn();
  ExpectShares(volume, Cut::Evenly);
}

TEST(Pieces, OfAHierarchy)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(BallWithMore());
  builder->SetErrorMetricToDistance();
  builder->AddPointArray("more");
  for (const int shape :
    { vtkIsodiamondHierarchy::ISOSURFACE, vtkIsodiamondHierarchy::INTERVAL_VOLUME })
  {
    builder->SetShape(shape);
    builder->SetIsorange(0.0, 0.3);
    vtkNew<vtkIsodiamondExtractor> extractor;
    extractor->SetInputConnection(builder->GetOutputPort());
    ForQueries(extractor, [&] { ExpectShares(extractor); });
    vtkNew<vtkDiamondMesh> tetrahedra;
    tetrahedra->SetInputConnection(builder->GetOutputPort());
    ForQueries(tetrahedra, [&] { ExpectShares(tetrahedra, Cut::Evenly); });
    vtkNew<vtkIsodiamondPoints> points;
    points->SetInputConnection(builder->GetOutputPort());
    ExpectShares(points, Cut::Evenly);
  }
}

TEST(Pieces, HiddenCellsAreInNone)
{
  const auto image = BallWithMore();
  image->AllocateCellGhostArray();
  for (int i = 0; i < 20; ++i)
  {
    image->GetCellGhostArray()->SetValue(
      32 * 28 * 4 + 32 * 14 + i, vtkDataSetAttributes::HIDDENCELL);
  }
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  ExpectShares(contour, Cut::Evenly);
}

// Only about: they are cut before any cells are counted.
TEST(Pieces, AreAboutAsLarge)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::MakeImage({ 97, 81, 89 },
    [](double x, double y, double z)
    {
      return std::sin(0.3 * x) * std::cos(0.3 * y) + std::sin(0.3 * y) * std::cos(0.3 * z) +
        std::sin(0.3 * z) * std::cos(0.3 * x);
    }));
  contour->SetValue(0, 0.1);
  contour->SetNumberOfThreads(2);
  for (const double tolerance : { 0.0, 0.05, 0.2, 0.5 })
  {
    contour->SetErrorTolerance(tolerance);
    contour->UpdatePiece(0, 1, 0);
    const vtkIdType count = contour->GetOutput()->GetNumberOfCells();
    ASSERT_GT(count, 1000);
    for (const int pieces : { 2, 3, 4 })
    {
      vtkIdType sum = 0;
      for (int piece = 0; piece < pieces; ++piece)
      {
        contour->UpdatePiece(piece, pieces, 0);
        const vtkIdType cells = contour->GetOutput()->GetNumberOfCells();
        EXPECT_LT(cells, 1.25 * count / pieces)
          << tolerance << ": " << piece << " of " << pieces << " of " << count;
        sum += cells;
      }
      EXPECT_EQ(sum, count) << tolerance << ": " << pieces;
    }
  }
}

TEST(Pieces, MoreThanCells)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::MakeImage({ 3, 3, 3 },
    [](double x, double y, double z) { return x == 1.0 && y == 1.0 && z == 1.0 ? 1.0 : 0.0; }));
  contour->SetValue(0, 0.5);
  contour->Update();
  ExpectShares(
    contour, static_cast<int>(contour->GetOutput()->GetNumberOfCells()) + 5, Cut::ByBricks);
}

TEST(Pieces, OfNothing)
{
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputData(test::BallImage({ 9, 9, 9 }));
  contour->SetValue(0, 1000.0);
  const auto messages = test::Watch(contour);
  for (const int piece : { 0, 1, 2 })
  {
    contour->UpdatePiece(piece, 3, 0);
    EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
    EXPECT_NE(contour->GetOutput()->GetPointData()->GetArray("density"), nullptr);
  }
  EXPECT_EQ(messages->ErrorCount, 0) << messages->Errors;
}

TEST(Pieces, EveryPieceHasTheHierarchyAndTheFirstItsOutline)
{
  vtkNew<vtkIsodiamondBuilder> builder;
  builder->SetInputData(BallWithMore());
  builder->Update();
  const vtkSmartPointer<vtkDataArray> records =
    builder->GetOutput()->GetFieldData()->GetArray("IsodiamondRecords");
  ASSERT_NE(records, nullptr);
  for (const int piece : { 0, 1, 2 })
  {
    builder->UpdatePiece(piece, 3, 0);
    // Not built again, but the same array.
    EXPECT_EQ(builder->GetOutput()->GetFieldData()->GetArray("IsodiamondRecords"), records);
    EXPECT_EQ(builder->GetOutput()->GetNumberOfCells(), piece == 0 ? 12 : 0);
    EXPECT_EQ(builder->GetOutput()->GetNumberOfPoints(), piece == 0 ? 8 : 0);
    EXPECT_GT(builder->GetHierarchy()->GetNumberOfActiveIsodiamonds(), 0);
  }
  builder->SetIsovalue(0.1);
  builder->UpdatePiece(1, 3, 0);
  EXPECT_NE(builder->GetOutput()->GetFieldData()->GetArray("IsodiamondRecords"), records);
  EXPECT_EQ(builder->GetHierarchy()->GetIsovalue(), 0.1);
}

TEST(Pieces, OfEveryBlock)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, test::BallImage({ 17, 17, 17 }));
  blocks->SetBlock(1, test::BallImage({ 21, 19, 15 }));
  const auto cellsOf = [&](unsigned int block, int piece, int pieces)
  {
    vtkNew<vtkIsodiamondContour> contour;
    contour->SetInputDataObject(blocks);
    contour->SetValue(0, 0.0);
    contour->UpdatePiece(piece, pieces, 0);
    auto* output = vtkMultiBlockDataSet::SafeDownCast(contour->GetOutputDataObject(0));
    std::vector<Cell> cells;
    AddCells(vtkDataSet::SafeDownCast(output->GetBlock(block)), cells);
    return cells;
  };
  for (const unsigned int block : { 0U, 1U })
  {
    const std::vector<Cell> whole = cellsOf(block, 0, 1);
    EXPECT_GT(whole.size(), 100U);
    CellsLeft left(whole);
    for (const int piece : { 0, 1, 2 })
    {
      const std::vector<Cell> cells = cellsOf(block, piece, 3);
      EXPECT_LE(cells.size(), whole.size() / 2);
      EXPECT_TRUE(left.Take(cells));
    }
    EXPECT_TRUE(left.AreTaken());
  }
}

TEST(Pieces, PartOfAVolumeIsAnError)
{
  vtkNew<vtkTrivialProducer> simulation;
  simulation->SetOutput(test::BallImage({ 17, 17, 17 }));
  simulation->SetWholeExtent(0, 16, 0, 16, 0, 32);
  vtkNew<vtkIsodiamondContour> contour;
  contour->SetInputConnection(simulation->GetOutputPort());
  contour->SetValue(0, 0.0);
  const auto messages = test::Watch(contour);
  contour->UpdatePiece(0, 2, 0);
  EXPECT_EQ(messages->ErrorCount, 1);
  EXPECT_NE(messages->Errors.find("every process needs the whole volume"), std::string::npos);
  EXPECT_EQ(contour->GetOutput()->GetNumberOfCells(), 0);
}
