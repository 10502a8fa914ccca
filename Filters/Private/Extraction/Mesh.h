// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkIsodiamond_Mesh_h
#define vtkIsodiamond_Mesh_h

#include "Private/Common/Task.h"
#include "Private/Extraction/Share.h"
#include "Private/Input/PointData.h"
#include "Refinement/RefinedSet.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

class vtkCellArray;
class vtkPoints;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace isodiamond
{
class IntervalExtraction;
}

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
  /** The numbers of points and cells counted: of the whole mesh, if a share has ids of that. */
  std::array<vtkIdType, 2> CountedSize{};
  /** The smallest and the largest angle, in degrees, of tetrahedra for simulations. */
  std::optional<std::array<double, 2>> DihedralAngles;
  /** By how much more than tolerated surfaces of such tetrahedra are away (ToleranceExcess.h), if
   *  that is measured. */
  std::optional<double> ToleranceExcess;

  /** Hands the mesh to a data set. */
  void Give(vtkPolyData* triangles) const;
  void Give(vtkUnstructuredGrid* output, bool isVolume) const;
};

/** What is wanted of a mesh. */
struct MeshOptions
{
  const isodiamond::GridGeometry& World;
  std::string ArrayName;        ///< the name that the field's values get; Scalars if empty
  bool WithValues = true;       ///< whether a surface's points get them
  bool ValuesAreScalars = true; ///< whether these are then the active scalars
  /** A vtkAlgorithm::DesiredOutputPrecision; by default doubles for tetrahedra, the thinnest of
   *  which would be inverted if rounded to floats, and for triangles where these do not fit floats.
   */
  int PointsPrecision = vtkAlgorithm::DEFAULT_PRECISION;
  PointDataMaker MorePointData = nullptr;
  const isodiamond::HiddenCells* Hidden = nullptr; ///< what lies in them is left out
  Share Wanted = {};                               ///< what is wanted of the mesh
  bool WithThresholds = false; ///< whether triangles get ThresholdsArray; all must be wanted
  /** Whether thresholds give errors: else all that is known of a mesh's is that they are
   *  tolerated. */
  bool AreErrorsKnown = true;
};

/** One unsigned short per triangle: SurfaceExtraction::WriteThresholds(). */
inline constexpr const char* ThresholdsArray = "IsodiamondThresholds";

/** Extracts a mesh, or a share of it: then no more than the share is written, unless cells have to
 *  be left out or moved first. Runs in the calling thread's vtkSMPTools scope. */
Mesh ExtractMesh(const isodiamond::RefinedSet& refined, const MeshOptions& options, Task& task);

/** The points of an extraction's mesh with all their data, and no cells: what other cells may be
 *  made of. */
Mesh ExtractPoints(const isodiamond::IntervalExtraction& extraction,
  const isodiamond::IsodiamondHierarchy& hierarchy, const MeshOptions& options);

}

#endif
