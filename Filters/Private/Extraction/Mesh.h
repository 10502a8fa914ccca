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
#include <functional>
#include <optional>
#include <string>
#include <vector>

class vtkCellArray;
class vtkPoints;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace isodiamond
{
class KnownChanges;
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
  /** Of such tetrahedra: diamonds that have to be refined because surfaces are too far away. If
   *  there are any, the mesh is not done. */
  std::vector<isodiamond::Place> FarDiamonds;
  /** The same where nothing can be refined: the vertices that have to be pinned, each once, as
   *  PackedPoint(). */
  std::vector<std::uint64_t> TightVertices;
  /** Vertices around bad tetrahedra, if any vertices are pinned. */
  std::vector<std::uint64_t> BadVertices;

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
  bool ForSimulation = false;                      ///< see Stuff.h; interval volumes only
  double DistanceTolerance = 0.0; ///< the least tolerated distance from full resolution
  /** The same in a triangle or tetrahedron, given its corners in the world; empty to not
   *  measure. */
  std::function<double(const isodiamond::Vector* corners, int count)> ToleranceIn = nullptr;
  isodiamond::KnownChanges* Known = nullptr; ///< see StuffMesh()
  bool GetsCoarser = true;                   ///< whether tolerances are used, or only measured
  bool MayRefine = true;                     ///< whether FarDiamonds are looked for
  bool MayPin = true;                        ///< whether TightVertices are looked for
  std::vector<std::uint64_t> Pinned = {};    ///< see isodiamond::Pin()
  bool KeepsInside = false;                  ///< whether points on no surface stay
  /** The volume that a mesh not for simulations has at the whole tolerance; none if the mesh does
   *  not get coarser. */
  std::optional<double> VolumeAtTolerance = {};
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

}

#endif
