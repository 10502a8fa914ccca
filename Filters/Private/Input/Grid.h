// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Grid_h
#define vtkIsodiamond_Grid_h

#include "Field/GridGeometry.h"
#include "Field/HiddenCells.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkDataSet;
class vtkUnsignedCharArray;

/**
 * @file Grid.h
 * VTK's structured data sets as grids: images, rectilinear grids and structured grids.
 */
namespace vtkIsodiamond
{

/** The data sets in a composite one, or the given one itself. */
std::vector<vtkDataSet*> LeavesOf(vtkDataObject* data);

/** Samples on each axis; all 0 if the data set is none of these. */
std::array<int, 3> DimensionsOf(vtkDataSet* grid);

/** The length of a grid's diagonal in the world: of an image between its first and last sample,
 * else that of its bounds. */
double DiagonalOf(vtkDataSet* grid);

/** The smallest spacing of an image or rectilinear grid, and about the mean one of a structured
 *  grid, on the axis where it is least; 0 for all else, and if coordinates are missing. */
double VoxelOf(vtkDataSet* grid);

/** Where a grid's samples are in the world. */
struct Geometry
{
  isodiamond::GridGeometry World = isodiamond::AffineMap();
  vtkSmartPointer<vtkDataArray> Positions; ///< the array that World views, if any
};

/**
 * The geometry of a grid of 2 or more samples on each axis. A rectilinear grid with even spacing
 * counts as affine.
 *
 * @param padding layers of samples around the grid
 * @throws std::invalid_argument for a grid without positions
 */
Geometry GeometryOf(vtkDataSet* grid, int padding);

/** Checks a ghost array, which may be null. @param count of the grid's cells or points
 *  @throws std::invalid_argument unless it has one value for each */
void CheckGhosts(vtkUnsignedCharArray* ghosts, vtkIdType count);

/** Blanked cells, cells at blanked points, and ghosts. @param padding as above */
isodiamond::HiddenCells HiddenCellsOf(vtkDataSet* grid, int padding);

}

#endif
