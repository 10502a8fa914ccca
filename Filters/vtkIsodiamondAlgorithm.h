// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondAlgorithm
 * @brief   what all filters have that extract meshes: tolerances, a region of interest, a viewpoint
 *
 * Where more than one of them is used, a place has the greatest of its tolerances: inside of the
 * region of interest ErrorTolerance, outside OutsideErrorTolerance, and from a viewpoint what
 * PixelTolerance comes to at its distance, if that is more.
 *
 * @sa vtkIsodiamondExtractor vtkIsodiamondContour vtkIsodiamondIntervalVolume vtkDiamondMesh
 */

#ifndef vtkIsodiamondAlgorithm_h
#define vtkIsodiamondAlgorithm_h

#include "vtkAlgorithm.h"
#include "vtkIsodiamondFiltersModule.h" // for export macro

class vtkDataObject;
namespace vtkIsodiamond
{
struct CountedTolerance;
struct Mesh;
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
   * The error that is tolerated, in the units of the metric. *Distance*: world units; no vertex of
   * the full-resolution surface is farther from the mesh. *Field* (the paper's): field units; at
   * every sample in a tetrahedron that carries the surface, field and interpolant differ by no
   * more. 0 is full resolution; infinity the coarsest. Negative values and NaN are errors. Default:
   * 0.
   */
  vtkSetMacro(ErrorTolerance, double);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * If it is not 0, ErrorTolerance does not count, but what comes of this: the least tolerance with
   * no more triangles (tetrahedra, of an interval volume) than this, in the sum over isovalues, or
   * the coarsest mesh and a warning. Of composite inputs each block has as many. With a region of
   * interest or a viewpoint, and of an HD, the tolerance is found in 14 queries; with
   * SimulationQuality by making some meshes. Default: 0.
   */
  vtkSetClampMacro(TargetNumberOfTriangles, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(TargetNumberOfTriangles, vtkIdType);
  ///@}

  /** The tolerance of the last mesh: ErrorTolerance, or what TargetNumberOfTriangles led to, which
   *  the mesh then has in its field data, too. 0 before the first one and after an error. */
  vtkGetMacro(AchievedTolerance, double);

  ///@{
  /**
   * Cells for simulations. Making them takes much longer than the mesh alone. Default: off.
   *
   * Tetrahedra of an interval volume: vertices that are near to a surface move onto it before
   * anything is cut, and what is still bad is improved, so that dihedral angles lie between 15 and
   * 165 degrees wherever possible. Points on surfaces stay where they are, or go; a few, where a
   * surface nearly touches itself, move by a quarter of their edge at most. Pieces, holes and
   * tunnels stay, and tetrahedra positive and conforming. By the distance metric the mesh begins at
   * 0.65 of the tolerance and is made as coarse as all of it allows, which holds, measured
   * both ways, but for cells of full resolution, which move their part of a surface by up to a
   * voxel; with an interior tolerance points inside stay. With spacings that differ much between
   * the axes it takes longer.
   *
   * Triangles of an isosurface: it is simplified as by Simplify, with the same promise, but no new
   * triangle has an angle below 15 degrees, unless one that it replaces had a smaller one. Where
   * the tolerance leaves no room some of these stay. The mesh may always get a quarter of the
   * smallest spacing away, even if the tolerance is less, or 0. Needs the distance metric.
   */
  vtkSetMacro(SimulationQuality, bool);
  vtkGetMacro(SimulationQuality, bool);
  vtkBooleanMacro(SimulationQuality, bool);
  ///@}

  ///@{
  /** The smallest and the largest dihedral angle of the last mesh with SimulationQuality, in
   * degrees; of composite inputs of all blocks. Each mesh has its own in the field data, under
   * these names. 0 without one. */
  vtkGetMacro(SmallestDihedralAngle, double);
  vtkGetMacro(LargestDihedralAngle, double);
  ///@}

  ///@{
  /**
   * Whether ErrorTolerance, and InteriorTolerance where there is one, hold in the region of
   * interest only, and OutsideErrorTolerance elsewhere. Default: off.
   */
  vtkSetMacro(UseRegionOfInterest, bool);
  vtkGetMacro(UseRegionOfInterest, bool);
  vtkBooleanMacro(UseRegionOfInterest, bool);
  ///@}

  ///@{
  /**
   * The region of interest, a closed box along the world's axes (xmin, xmax, ymin, ymax, zmin,
   * zmax), whatever the image's direction. In it the mesh is the uniform one of ErrorTolerance (or
   * of OutsideErrorTolerance, should that be smaller), outside as coarse as OutsideErrorTolerance
   * and conformity let it be. Bounds may be infinite; a box with a minimum greater than its maximum
   * is empty. Position is its lowest corner; setting it keeps the size, setting the size keeps the
   * position. Default: the unit cube [0, 1]^3.
   */
  vtkSetVector6Macro(RegionOfInterest, double);
  vtkGetVector6Macro(RegionOfInterest, double);
  void SetRegionOfInterestPosition(double x, double y, double z);
  void SetRegionOfInterestPosition(double position[3])
  {
    this->SetRegionOfInterestPosition(position[0], position[1], position[2]);
  }
  void SetRegionOfInterestSize(double x, double y, double z);
  void SetRegionOfInterestSize(double size[3])
  {
    this->SetRegionOfInterestSize(size[0], size[1], size[2]);
  }
  ///@}

  ///@{
  /**
   * The error that is tolerated outside of the region of interest, in the units of ErrorTolerance.
   * 0 chooses it: four times ErrorTolerance, or one voxel (the smallest spacing; by the field
   * metric 1 % of the extent of the values), whichever is more. Negative values and NaN are errors
   * while the region is used. Default: VTK_DOUBLE_MAX, as good as infinity.
   */
  vtkSetMacro(OutsideErrorTolerance, double);
  vtkGetMacro(OutsideErrorTolerance, double);
  ///@}

  ///@{
  /**
   * Coarser with the distance from a viewpoint: no vertex of the full-resolution surface is farther
   * from the mesh than PixelTolerance pixels, seen from ViewPosition by a camera with perspective,
   * ViewAngle degrees high on ViewHeight pixels, or than ErrorTolerance, whichever is more. That
   * holds in all directions, so turning the camera needs no new mesh. Needs the distance metric.
   * Defaults: off; at (0, 0, 1), 30 degrees, 1000 pixels, 1 pixel. ViewAngle is to be more than 0
   * and less than 180, ViewHeight more than 0, PixelTolerance at least 0.
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
   * Of the output's points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION, which is single for triangles and double for tetrahedra: rounded to single
   * precision, the thinnest could turn over. Default: DEFAULT_PRECISION.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

  ///@{
  /**
   * Whether points and cells have global ids, "GlobalPointIds" and "GlobalCellIds": their numbers
   * in the mesh that one process would make, of all isovalues; so the shares of several processes
   * can be put together. Of composite inputs each block counts for itself. Default: off.
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

  /** Error tolerances that are worth trying: by the distance metric up to 2 % of the grid's
   *  diagonal; by the field metric up to the extent of the field's values, beyond which a tolerance
   *  changes nothing. {0, 1} while there is no input. */
  virtual double* GetErrorToleranceRange() VTK_SIZEHINT(2) = 0;

  ///@{
  /** An input without a pipeline. */
  void SetInputData(vtkDataObject* input) { this->SetInputDataObject(0, input); }
  void SetInputData(int port, vtkDataObject* input) { this->SetInputDataObject(port, input); }
  ///@}

  /** The input, or null. */
  vtkDataObject* GetInput();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

protected:
  vtkIsodiamondAlgorithm();
  ~vtkIsodiamondAlgorithm() override = default;

  /** Notes the piece of the output that is asked for. */
  int ModifyRequest(vtkInformation* request, int when) override;
  /** Asks for the whole input. */
  virtual int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  virtual int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  /** What the properties ask of a hierarchy. @throws std::invalid_argument if they make no sense */
  virtual vtkIsodiamond::WorldQuery GetQuery() const;

  /** Puts the tolerance of a mesh where users can see it, and warns if it was a target's and has
   *  more cells. */
  void NoteTolerance(
    double tolerance, const vtkIsodiamond::CountedTolerance* aimed, vtkDataObject* output);

  /** Puts the angles of a mesh for simulations where users can see them. */
  void NoteDihedralAngles(const vtkIsodiamond::Mesh& mesh, vtkDataObject* output);

  /** The share of a mesh that is asked for. */
  vtkIsodiamond::Share GetShare() const;

  double ErrorTolerance = 0.0;
  bool GenerateGlobalIds = false;
  bool SimulationQuality = false;
  double SmallestDihedralAngle = 0.0;
  double LargestDihedralAngle = 0.0;
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
  int Piece[3] = { 0, 1, 0 }; ///< asked for: its number, how many, ghost levels

private:
  vtkIsodiamondAlgorithm(const vtkIsodiamondAlgorithm&) = delete;
  void operator=(const vtkIsodiamondAlgorithm&) = delete;
};

#endif
