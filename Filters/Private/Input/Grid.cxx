// SPDX-License-Identifier: BSD-3-Clause
#include "Private/Input/Grid.h"

#include "Private/Common/Arrays.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace vtkIsodiamond
{
namespace
{

/** @throws std::invalid_argument if a position would be nowhere */
isodiamond::AffineMap IndexToWorld(vtkImageData* image, int padding)
{
  isodiamond::AffineMap map;
  int extent[6];
  double spacing[3];
  double origin[3];
  image->GetExtent(extent);
  image->GetSpacing(spacing);
  image->GetOrigin(origin);
  for (int i = 0; i < 3; ++i)
  {
    map.Rows[i][3] = origin[i];
    for (int j = 0; j < 3; ++j)
    {
      map.Rows[i][j] = image->GetDirectionMatrix()->GetElement(i, j) * spacing[j];
      map.Rows[i][3] += map.Rows[i][j] * (extent[2 * j] - padding);
    }
    if (!std::all_of(map.Rows[i].begin(), map.Rows[i].end(),
          [](double number) { return std::isfinite(number); }))
    {
      throw std::invalid_argument("The image's origin, spacing and direction have to be finite.");
    }
  }
  return map;
}

/** Whether coordinates are as evenly spaced as their rounding allows. */
bool AreEven(const std::vector<double>& coordinates)
{
  const double first = coordinates.front();
  const double spacing = (coordinates.back() - first) / static_cast<double>(coordinates.size() - 1);
  const double slack = 1e-6 * std::fabs(spacing) + 1e-12 * std::fabs(first);
  for (std::size_t i = 0; i < coordinates.size(); ++i)
  {
    if (!(std::fabs(coordinates[i] - (first + static_cast<double>(i) * spacing)) <= slack))
    {
      return false;
    }
  }
  return true;
}

isodiamond::GridGeometry GeometryOf(vtkRectilinearGrid* grid, int padding)
{
  const std::array<vtkDataArray*, 3> arrays = { grid->GetXCoordinates(), grid->GetYCoordinates(),
    grid->GetZCoordinates() };
  const std::array<int, 3> dimensions = DimensionsOf(grid);
  isodiamond::AxisCoordinates axes;
  isodiamond::AffineMap map;
  bool even = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkDataArray* array = arrays[axis];
    if (!array || array->GetNumberOfTuples() != dimensions[axis])
    {
      throw std::invalid_argument("The grid does not have one coordinate for each sample.");
    }
    for (int i = 0; i < dimensions[axis]; ++i)
    {
      axes[axis].push_back(array->GetComponent(i, 0));
    }
    even = even && AreEven(axes[axis]);
    const double spacing =
      (axes[axis].back() - axes[axis].front()) / static_cast<double>(dimensions[axis] - 1);
    map.Rows[axis] = { 0.0, 0.0, 0.0, axes[axis].front() - padding * spacing };
    map.Rows[axis][axis] = spacing;
  }
  return even ? isodiamond::GridGeometry(map) : isodiamond::GridGeometry(std::move(axes), padding);
}

Geometry GeometryOf(vtkStructuredGrid* grid, int padding)
{
  vtkPoints* points = grid->GetPoints();
  const std::array<int, 3> dimensions = DimensionsOf(grid);
  if (!points || points->GetNumberOfPoints() != grid->GetNumberOfPoints())
  {
    throw std::invalid_argument("The grid does not have one position for each sample.");
  }
  Geometry geometry;
  geometry.Positions = InRow(points->GetData());
  const int type = geometry.Positions->GetDataType();
  if (type != VTK_FLOAT && type != VTK_DOUBLE)
  {
    geometry.Positions = vtkSmartPointer<vtkDoubleArray>::New();
    geometry.Positions->SetNumberOfComponents(3);
    AllocateTuples(geometry.Positions, points->GetNumberOfPoints());
    geometry.Positions->DeepCopy(points->GetData());
  }
  isodiamond::SamplePositions positions;
  positions.Dimensions = dimensions;
  const void* values = geometry.Positions->GetVoidPointer(0);
  if (geometry.Positions->GetDataType() == VTK_FLOAT)
  {
    positions.Coordinates = static_cast<const float*>(values);
  }
  else
  {
    positions.Coordinates = static_cast<const double*>(values);
  }
  geometry.World = isodiamond::GridGeometry(positions, padding);
  return geometry;
}

/** Calls body(cell, its index) for the cells of a padded grid that are the grid's own. */
template <typename Body>
void ForEachOwnCell(const std::array<int, 3>& samples, int padding, Body&& body)
{
  const std::array<int, 3> cells = { samples[0] - 1 + 2 * padding, samples[1] - 1 + 2 * padding,
    samples[2] - 1 + 2 * padding };
  for (int z = 0; z < samples[2] - 1; ++z)
  {
    for (int y = 0; y < samples[1] - 1; ++y)
    {
      for (int x = 0; x < samples[0] - 1; ++x)
      {
        const vtkIdType padded =
          (vtkIdType{ z + padding } * cells[1] + y + padding) * cells[0] + x + padding;
        body(isodiamond::Point{ x, y, z }, padded);
      }
    }
  }
}

}

std::vector<vtkDataSet*> LeavesOf(vtkDataObject* data)
{
  std::vector<vtkDataSet*> leaves;
  if (vtkDataSet* single = vtkDataSet::SafeDownCast(data))
  {
    leaves.push_back(single);
  }
  else if (vtkCompositeDataSet* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      if (vtkDataSet* leaf = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()))
      {
        leaves.push_back(leaf);
      }
    }
  }
  return leaves;
}

std::array<int, 3> DimensionsOf(vtkDataSet* grid)
{
  std::array<int, 3> dimensions{};
  if (vtkImageData* image = vtkImageData::SafeDownCast(grid))
  {
    image->GetDimensions(dimensions.data());
  }
  else if (vtkRectilinearGrid* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    rectilinear->GetDimensions(dimensions.data());
  }
  else if (vtkStructuredGrid* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    structured->GetDimensions(dimensions.data());
  }
  return dimensions;
}

double DiagonalOf(vtkDataSet* grid)
{
  vtkImageData* image = vtkImageData::SafeDownCast(grid);
  if (!image)
  {
    return grid->GetLength();
  }
  const std::array<int, 3> dimensions = DimensionsOf(image);
  const isodiamond::AffineMap world = IndexToWorld(image, 0);
  std::array<double, 3> diagonal{};
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      diagonal[i] += world.Rows[i][j] * (dimensions[j] - 1);
    }
  }
  return std::hypot(diagonal[0], diagonal[1], diagonal[2]);
}

Geometry GeometryOf(vtkDataSet* grid, int padding)
{
  if (vtkStructuredGrid* structured = vtkStructuredGrid::SafeDownCast(grid))
  {
    return GeometryOf(structured, padding);
  }
  Geometry geometry;
  if (vtkRectilinearGrid* rectilinear = vtkRectilinearGrid::SafeDownCast(grid))
  {
    geometry.World = GeometryOf(rectilinear, padding);
  }
  else
  {
    geometry.World = IndexToWorld(vtkImageData::SafeDownCast(grid), padding);
  }
  return geometry;
}

double VoxelOf(vtkDataSet* grid)
{
  const std::array<int, 3> dimensions = DimensionsOf(grid);
  const bool hasCells =
    std::all_of(dimensions.begin(), dimensions.end(), [](int samples) { return samples > 1; });
  if (!hasCells)
  {
    return 0.0;
  }
  try
  {
    return GeometryOf(grid, 0).World.SmallestStep();
  }
  catch (const std::invalid_argument&) // coordinates that do not fit the grid
  {
    return 0.0;
  }
}

void CheckGhosts(vtkUnsignedCharArray* ghosts, vtkIdType count)
{
  if (ghosts && (ghosts->GetNumberOfComponents() != 1 || ghosts->GetNumberOfTuples() != count))
  {
    throw std::invalid_argument("The grid's ghost array \"" +
      std::string(vtkDataSetAttributes::GhostArrayName()) +
      "\" does not have one value for each cell or point.");
  }
}

isodiamond::HiddenCells HiddenCellsOf(vtkDataSet* grid, int padding)
{
  vtkUnsignedCharArray* cellGhosts = grid->GetCellGhostArray();
  vtkUnsignedCharArray* pointGhosts = grid->GetPointGhostArray();
  if (!cellGhosts && !pointGhosts)
  {
    return {};
  }
  CheckGhosts(cellGhosts, grid->GetNumberOfCells());
  CheckGhosts(pointGhosts, grid->GetNumberOfPoints());
  constexpr int hiddenCell = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL |
    vtkDataSetAttributes::DUPLICATECELL;
  const std::array<int, 3> samples = DimensionsOf(grid);
  const std::array<int, 3> cells = { samples[0] - 1 + 2 * padding, samples[1] - 1 + 2 * padding,
    samples[2] - 1 + 2 * padding };
  std::vector<std::uint8_t> hidden(static_cast<std::size_t>(cells[0]) * cells[1] * cells[2]);
  vtkIdType cellId = 0;
  ForEachOwnCell(samples, padding,
    [&](const isodiamond::Point& cell, vtkIdType padded)
    {
      bool isHidden = cellGhosts && (cellGhosts->GetValue(cellId) & hiddenCell) != 0;
      for (int corner = 0; pointGhosts && corner < 8; ++corner)
      {
        const vtkIdType sample =
          (vtkIdType{ cell[2] + (corner >> 2) } * samples[1] + cell[1] + ((corner >> 1) & 1)) *
            samples[0] +
          cell[0] + (corner & 1);
        isHidden =
          isHidden || (pointGhosts->GetValue(sample) & vtkDataSetAttributes::HIDDENPOINT) != 0;
      }
      hidden[padded] = isHidden ? 1 : 0;
      ++cellId;
    });
  return { std::move(hidden), cells };
}

}
