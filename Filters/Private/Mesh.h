// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Mesh_h
#define vtkIsodiamond_Mesh_h

#include "Private/Piece.h"
#include "Private/PointData.h"
#include "Private/Task.h"
#include "Refinement/RefinedSet.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkCellArray;
class vtkPoints;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace vtkIsodiamond
{

/** A mesh as VTK arrays: triangles of an isosurface, tetrahedra of an interval volume. */
struct Mesh
{
  vtkSmartPointer<vtkPoints> Points;   ///< world positions
  vtkSmartPointer<vtkCellArray> Cells; ///< 32-bit storage where ids fit and all are kept
  vtkSmartPointer<vtkPointData> PointData = vtkSmartPointer<vtkPointData>::New();
  /** "Level". */
  vtkSmartPointer<vtkCellData> CellData = vtkSmartPointer<vtkCellData>::New();
  /** Points and cells that were counted: of the whole mesh, if a share has ids of that. */
  std::array<vtkIdType, 2> CountedSize{};
  /** The smallest and the largest, in degrees, of tetrahedra for simulations. */
  std::optional<std::array<double, 2>> DihedralAngles;
  /** Of such tetrahedra: diamonds that have to be refined, for surfaces are too far away. The mesh
   *  is not done then. */
  std::vector<isodiamond::Place> FarDiamonds;

  /** Hands it to a data set. */
  void Give(vtkPolyData* triangles) const;
  void Give(vtkUnstructuredGrid* output, bool isVolume) const;
};

/** What is wanted of a mesh. */
struct MeshOptions
{
  const isodiamond::GridGeometry& World;
  std::string ArrayName;        ///< the field's values get it
  bool WithValues = true;       ///< whether a surface's points have them
  bool ValuesAreScalars = true; ///< whether they are the active scalars then
  /** A vtkAlgorithm::DesiredOutputPrecision; by default floats for triangles, doubles for
   *  tetrahedra: rounded to floats, the thinnest would turn over. */
  int PointsPrecision = vtkAlgorithm::DEFAULT_PRECISION;
  PointDataMaker MorePointData = nullptr;
  const isodiamond::HiddenCells* Hidden = nullptr; ///< what lies in them is left out
  Share Wanted = {};                               ///< what of the mesh
  bool ForSimulation = false;                      ///< see Stuff.h; of an interval volume
  double DistanceTolerance = 0.0; ///< the least that it may be away from full resolution
  /** The same in a triangle or tetrahedron, by its corners in the world; none to not measure. */
  std::function<double(const isodiamond::Vector* corners, int count)> ToleranceIn = nullptr;
  bool MayRefine = true;       ///< whether FarDiamonds are looked at
  bool KeepsInside = false;    ///< whether points on no surface stay
  bool WithThresholds = false; ///< whether triangles have ThresholdsArray; all of them are wanted
  /** Whether thresholds tell errors: else it is known only that those of a mesh are tolerated. */
  bool AreErrorsKnown = true;
};

/** By triangle, unsigned short: SurfaceExtraction::WriteThresholds(). */
inline constexpr const char* ThresholdsArray = "IsodiamondThresholds";

/** Extracts a mesh, or a share of it: of that no more is written than there is in it, unless cells
 *  have to be left out or moved first. Runs in the calling thread's vtkSMPTools scope. */
Mesh ExtractMesh(const isodiamond::RefinedSet& refined, const MeshOptions& options, Task& task);

}

#endif
