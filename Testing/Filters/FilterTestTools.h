// SPDX-License-Identifier: BSD-3-Clause
#ifndef FilterTestTools_h
#define FilterTestTools_h

#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkPointSet.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkCellArray;
class vtkPolyData;

/** Images, meshes and caught errors that the tests of the filters share. */
namespace test
{

/** An image with the float point scalars "density" = function(x, y, z) of sample indices. */
vtkSmartPointer<vtkImageData> MakeImage(
  const std::array<int, 3>& dims, const std::function<double(double, double, double)>& function);

/** A bumpy ball: density falls from the middle, about 0 on its surface, well inside the image. */
vtkSmartPointer<vtkImageData> BallImage(const std::array<int, 3>& dims);

/** Like a scan of a cast part: a block with bores and thin walls, its edges blurred over two
 * voxels, 100 inside and 0 outside, with noise. Sharp edges have large field errors and little
 * shape. */
vtkSmartPointer<vtkImageData> PhantomImage(const std::array<int, 3>& dims, double noise);

/** The same samples with a coordinate place(axis, index) for each index on each axis. */
vtkSmartPointer<vtkRectilinearGrid> Rectilinear(
  vtkImageData* image, const std::function<double(int, int)>& place);

/** Coordinates that grow along x by a constant factor, fall along y, and are of three sizes in turn
 *  along z: cells between 0.4 and 4 in a grid of about 40 samples on each axis. */
double UnevenPlace(int axis, int index);

/** A uint8 volume of the folder that the environment's ISODIAMONDS_DATA_DIR names; null without it.
 */
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

/** Largest distance of a mesh's points to another mesh. */
double LargestDistance(vtkPolyData* from, vtkPolyData* to);

/** What is not the same, to the bit, of two data sets: points, cells, arrays. Empty if nothing. */
std::string Difference(vtkDataSet* a, vtkDataSet* b);

/** Number of edges with one triangle. */
vtkIdType BoundaryEdges(vtkPolyData* mesh);

}

#endif
