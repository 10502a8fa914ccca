// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterTestTools_h
#define FilterTestTools_h

#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkCellArray;
class vtkPolyData;

/** What the filters' tests share: images, measures of meshes, caught errors. */
namespace test
{

/** An image whose float point scalars "density" are function(x, y, z) of the samples' indices. */
vtkSmartPointer<vtkImageData> MakeImage(
  const std::array<int, 3>& dims, const std::function<double(double, double, double)>& function);

/** A bumpy ball, well inside the image: density falls from its middle to about 0 on its surface. */
vtkSmartPointer<vtkImageData> BallImage(const std::array<int, 3>& dims);

/** Like a scan of a cast part: a block with bores and thin walls, its edges blurred over two
 * voxels, 100 inside and 0 outside, with noise. Such sharp edges have large field errors where the
 * shape is simple. */
vtkSmartPointer<vtkImageData> PhantomImage(const std::array<int, 3>& dims, double noise);

/** An image's samples as a rectilinear grid with the coordinates place(axis, index). */
vtkSmartPointer<vtkRectilinearGrid> Rectilinear(
  vtkImageData* image, const std::function<double(int, int)>& place);

/** Coordinates for Rectilinear(): cells grow along x by a constant factor, coordinates fall along
 *  y, and cells have three sizes in turn along z. In a grid of about 40 samples on each axis they
 *  are between 0.4 and 4 long. */
double UnevenPlace(int axis, int index);

/** An image's samples as a structured grid, at place(x, y, z) of their indices. */
vtkSmartPointer<vtkStructuredGrid> Structured(
  vtkImageData* image, const std::function<std::array<double, 3>(double, double, double)>& place);

/** Positions for Structured(): around an axis, farther apart away from it, and slanted. */
std::array<double, 3> BentPlace(double x, double y, double z);

/** A uint8 volume from the folder in the environment variable ISODIAMONDS_DATA_DIR; null if it is
 *  not there. */
vtkSmartPointer<vtkImageData> SampleVolume(const char* name, const std::array<int, 3>& dims);

/** Collects the errors and warnings of an algorithm instead of printing them. */
class Messages : public vtkCommand
{
public:
  vtkTypeMacro(Messages, vtkCommand);
  static Messages* New() { return new Messages; }
  void Execute(vtkObject* caller, unsigned long event, void* data) override;

  std::string Errors;
  int ErrorCount = 0;
  std::string Warnings;
  int WarningCount = 0;
};
vtkSmartPointer<Messages> Watch(vtkAlgorithm* algorithm);

/** Six times the volume that a closed surface encloses, positive if normals point outward. */
double SixVolume(vtkPointSet* mesh);
double Area(vtkPointSet* mesh);

/** The triangles of a mesh as positions, sorted: equal for the same surface in any order. */
using Triangles = std::vector<std::array<std::array<double, 3>, 3>>;
Triangles SortedTriangles(vtkPointSet* mesh);

/** The largest distance from a mesh's points to another mesh. */
double LargestDistance(vtkPolyData* from, vtkPolyData* to);

/** What differs, to the bit, between two data sets: points, cells, arrays. Empty if nothing. */
std::string Difference(vtkDataSet* a, vtkDataSet* b);

/** Number of edges that do not have exactly two triangles. */
vtkIdType BoundaryEdges(vtkPolyData* mesh);

}

#endif
