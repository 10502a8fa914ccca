// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondAlgorithm
 * @brief   base of all filters that extract meshes: tolerances, a region of interest, a viewpoint
 *
 * Where several of these are used, the greatest of a place's tolerances holds: ErrorTolerance
 * inside the region of interest or OutsideErrorTolerance outside it, or what PixelTolerance amounts
 * to at its distance from the viewpoint, if that is more.
 *
 * @sa vtkIsodiamondExtractor vtkIsodiamondContour vtkIsodiamondIntervalVolume vtkDiamondMesh
 */

#ifndef vtkIsodiamondAlgorithm_h
#define vtkIsodiamondAlgorithm_h

#include "vtkAlgorithm.h"
#include "vtkIsodiamondFiltersModule.h" // for export macro

#include <memory>

class vtkDataObject;
namespace vtkIsodiamond
{
struct CountedTolerance;
struct Mesh;
class InputShares;
struct Share;
struct WorldQuery;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondAlgorithm : public vtkAlgorithm
{
public:
  vtkTypeMacro(vtkIsodiamondAlgorithm, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The tolerated error, in the units of the metric. *Distance*: world units; no point of the mesh
   * is farther than this from the full-resolution surface, and no vertex of that surface is farther
   * from the mesh. *Field* (the paper's): field units;
   * at every sample in a tetrahedron that carries the surface, the field and its interpolant differ
   * by no more than this. 0 is full resolution, infinity the coarsest mesh. Negative values and NaN
   * are errors. Default: 0.
   */
  vtkSetMacro(ErrorTolerance, double);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * If not 0, this replaces ErrorTolerance with the smallest tolerance that gives no more triangles
   * (tetrahedra for an interval volume) than this, over all isovalues together; if none does, you
   * get the mesh with the fewest and a warning. With composite inputs it applies to each block.
   * With a region of interest, a viewpoint or hidden cells, and for an HD, the tolerance is found
   * by up to 16 queries; with Simplify or SimulationQuality, where coarser meshes can have more
   * cells, by making some ten meshes. Default: 0.
   */
  vtkSetClampMacro(TargetNumberOfTriangles, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetNumberOfTriangles, vtkIdType);
  ///@}

  /** The tolerance of the last mesh: ErrorTolerance, or the one that TargetNumberOfTriangles led
   *  to, which is then in the mesh's field data, too; of several blocks, the largest. 0 before the
   *  first one and after an error. */
  vtkGetMacro(AchievedTolerance, double);

  ///@{
  /**
   * Cells for simulations. They take much longer to make than the mesh alone. Default: off.
   *
   * Tetrahedra of an interval volume: vertices near a surface move onto it before anything is cut,
   * and what is still bad is improved, so that dihedral angles lie between 15 and 165 degrees
   * wherever possible. Points on surfaces stay where they are, or vanish; a few, where a surface
   * nearly touches itself, move by at most a quarter of their edge. Pieces, holes and tunnels stay,
   * and tetrahedra remain positive and conforming. With the distance metric the mesh starts at 0.65
   * of the tolerance and is then made as coarse as the full tolerance allows. The tolerance holds,
   * measured both ways; in noise, at a voxel and less, it is exceeded in a few places, where cells
   * at full resolution cannot get finer and keeping it would leave bad angles. With an interior
   * tolerance, points inside stay. It takes longer if spacings differ greatly between the axes.
   *
   * Triangles of an isosurface: the mesh is simplified as by Simplify, with the same promise, but
   * no new triangle has an angle below 15 degrees, unless one that it replaces had a smaller one.
   * Where the tolerance leaves no room, some such triangles stay. The mesh may always move away by
   * a quarter of the smallest spacing, even if the tolerance is less, or 0. Needs the distance
   * metric.
   */
  vtkSetMacro(SimulationQuality, bool);
  vtkGetMacro(SimulationQuality, bool);
  vtkBooleanMacro(SimulationQuality, bool);
  ///@}

  ///@{
  /** The smallest and the largest dihedral angle of the last mesh with SimulationQuality, in
   *  degrees; with composite inputs, of all blocks. Each mesh has its own in its field data, under
   *  these names. 0 if there is no such mesh. */
  vtkGetMacro(SmallestDihedralAngle, double);
  vtkGetMacro(LargestDihedralAngle, double);
  ///@}

  /** By how much surfaces of the last tetrahedra with SimulationQuality are at most farther away
   *  than ErrorTolerance, in world units; with composite inputs, in the worst block. An upper
   *  bound, but hardly more than it is. Mostly 0; more in noise, where good angles leave no choice,
   *  and at a tolerance of 0, where vertices have to move as well. NaN where it is not measured:
   *  with the field metric unless the tolerance is 0, and where an edge has more than two
   * triangles. Each of the two surfaces counts for itself. Else each mesh has its own in its field
   * data, under this name. 0 if there is no such mesh. */
  vtkGetMacro(ToleranceExcess, double);

  ///@{
  /**
   * Whether ErrorTolerance (and InteriorTolerance, where there is one) holds in the region of
   * interest only, and OutsideErrorTolerance elsewhere. Default: off.
   */
  vtkSetMacro(UseRegionOfInterest, bool);
  vtkGetMacro(UseRegionOfInterest, bool);
  vtkBooleanMacro(UseRegionOfInterest, bool);
  ///@}

  ///@{
  /**
   * The region of interest: a closed box along the world's axes (xmin, xmax, ymin, ymax, zmin,
   * zmax), whatever the image's direction. The mesh in it is the one that ErrorTolerance (or
   * OutsideErrorTolerance, if that is smaller) gives everywhere; outside, it is as coarse as
   * OutsideErrorTolerance and conformity allow. Bounds may be infinite; a box with a minimum
   * greater than its maximum is empty. The position is the lowest corner; setting it keeps the
   * size, and setting the size keeps the position. Default: the unit cube [0, 1]^3.
   */
  vtkSetVector6Macro(RegionOfInterest, double);
  vtkGetVector6Macro(RegionOfInterest, double);
  void SetRegionOfInterestPosition(double x, double y, double z);
  void SetRegionOfInterestPosition(const double position[3])
  {
    this->SetRegionOfInterestPosition(position[0], position[1], position[2]);
  }
  void SetRegionOfInterestSize(double x, double y, double z);
  void SetRegionOfInterestSize(const double size[3])
  {
    this->SetRegionOfInterestSize(size[0], size[1], size[2]);
  }
  ///@}

  ///@{
  /**
   * The tolerated error outside the region of interest, in the units of ErrorTolerance. 0 means
   * automatic: four times ErrorTolerance or one voxel (the smallest spacing; with the field metric,
   * 1 % of the extent of the values), whichever is more. Negative values and NaN are errors while
   * the region is used. Default: VTK_DOUBLE_MAX, which acts as infinity.
   */
  vtkSetMacro(OutsideErrorTolerance, double);
  vtkGetMacro(OutsideErrorTolerance, double);
  ///@}

  ///@{
  /**
   * Makes the mesh coarser with the distance from a viewpoint: mesh and full-resolution surface, as
   * ErrorTolerance compares them, are no farther apart than PixelTolerance pixels, seen from
   * ViewPosition by a perspective camera with a view ViewAngle degrees and ViewHeight pixels high,
   * or than ErrorTolerance, whichever is more. This holds in all directions, so turning the camera
   * needs no new mesh. Needs the distance metric. Defaults: off; (0, 0, 1), 30 degrees, 1000
   * pixels, 1 pixel. ViewAngle must be more than 0 and less than 180, ViewHeight more than 0,
   * PixelTolerance at least 0.
   */
  vtkSetMacro(ViewDependent, bool);
  vtkGetMacro(ViewDependent, bool);
  vtkBooleanMacro(ViewDependent, bool);
  vtkSetVector3Macro(ViewPosition, double);
  vtkGetVector3Macro(ViewPosition, double);
  vtkSetMacro(ViewAngle, double);
  vtkGetMacro(ViewAngle, double);
  vtkSetMacro(ViewHeight, double);
  vtkGetMacro(ViewHeight, double);
  vtkSetMacro(PixelTolerance, double);
  vtkGetMacro(PixelTolerance, double);
  ///@}

  ///@{
  /**
   * The precision of the output's points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION: double for tetrahedra, as rounding to single precision could turn the
   * thinnest over; single for triangles, unless that could not tell places apart that are a 256th
   * of a voxel from each other, as at coordinates of 16,384 voxels and more; on a curvilinear
   * grid, that of its points. Default: DEFAULT_PRECISION.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Whether points and cells have global ids, "GlobalPointIds" and "GlobalCellIds": their numbers
   * in the mesh that one process would make for all isovalues, so that the shares of several
   * processes can be put together. In composite inputs each block is numbered on its own.
   * Default: off.
   */
  vtkSetMacro(GenerateGlobalIds, bool);
  vtkGetMacro(GenerateGlobalIds, bool);
  vtkBooleanMacro(GenerateGlobalIds, bool);
  ///@}

  ///@{
  /**
   * Threads to use; 0 for all cores. The result does not depend on it. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** Error tolerances worth trying: with the distance metric, up to 2 % of the grid's diagonal;
   *  with the field metric, up to the extent of the field's values, beyond which a tolerance
   *  changes nothing. {0, 1} while there is no input. */
  virtual double* GetErrorToleranceRange() VTK_SIZEHINT(2) = 0;

  ///@{
  /** Sets an input without a pipeline. */
  void SetInputData(vtkDataObject* input) { this->SetInputDataObject(0, input); }
  void SetInputData(int port, vtkDataObject* input) { this->SetInputDataObject(port, input); }
  ///@}

  /** The input, or null. */
  vtkDataObject* GetInput();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkIsodiamondAlgorithm();
  ~vtkIsodiamondAlgorithm() override;

  /** Notes the requested piece of the output. */
  int ModifyRequest(vtkInformation* request, int when) override;
  /** Requests the whole input. */
  virtual int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  virtual int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  /** What the properties ask of a hierarchy. @throws std::invalid_argument if they make no sense */
  virtual vtkIsodiamond::WorldQuery GetQuery() const;

  /** Puts the tolerance of a mesh where users can see it, and warns if it was found for a target
   *  that the mesh exceeds. */
  void NoteTolerance(
    double tolerance, const vtkIsodiamond::CountedTolerance* aimed, vtkDataObject* output);

  /** What was noted of a mesh counts no more: it has not been completed. */
  void ForgetMesh();

  /** Puts the angles and distances of a mesh for simulations where users can see them. */
  void NoteQuality(const vtkIsodiamond::Mesh& mesh, vtkDataObject* output);

  /** The share of the mesh of the input, or the block, at hand. */
  vtkIsodiamond::Share GetShare();

  double ErrorTolerance = 0.0;
  bool GenerateGlobalIds = false;
  bool SimulationQuality = false;
  double SmallestDihedralAngle = 0.0;
  double LargestDihedralAngle = 0.0;
  double ToleranceExcess = 0.0;
  vtkIdType TargetNumberOfTriangles = 0;
  bool UseRegionOfInterest = false;
  double RegionOfInterest[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  double OutsideErrorTolerance = VTK_DOUBLE_MAX;
  bool ViewDependent = false;
  double ViewPosition[3] = { 0.0, 0.0, 1.0 };
  double ViewAngle = 30.0;
  double ViewHeight = 1000.0;
  double PixelTolerance = 1.0;
  int OutputPointsPrecision = DEFAULT_PRECISION;
  int NumberOfThreads = 0;
  double ErrorToleranceRange[2] = { 0.0, 1.0 };
  double AchievedTolerance = 0.0;
  std::unique_ptr<vtkIsodiamond::InputShares> Shares; ///< of what is requested

private:
  vtkIsodiamondAlgorithm(const vtkIsodiamondAlgorithm&) = delete;
  void operator=(const vtkIsodiamondAlgorithm&) = delete;
};

#endif
