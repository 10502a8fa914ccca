// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondIntervalVolume
 * @brief   the part of an image between two values as tetrahedra, in one step
 *
 * vtkImageData in, vtkUnstructuredGrid of tetrahedra out: the region lower <= field <= upper, at an
 * error tolerance. Neighbours share whole faces, all volumes are positive, and every face of one
 * tetrahedron alone lies on the lower surface, the upper surface or the image's boundary. The
 * filter keeps its minimal isodiamond hierarchy; a new tolerance only extracts again. A new input,
 * array or isorange builds a new one, and so does the first interior tolerance.
 *
 * Point data: the field's value under the input array's name, and `Surface`; cell data: `Level`;
 * see vtkIsodiamondExtractor. Points are doubles: rounded to floats, the thinnest tetrahedra could
 * turn over.
 *
 * The whole extent of the input is requested. In parallel the first piece holds the volume, the
 * others are empty.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010.
 *
 * @sa vtkIsodiamondBuilder vtkIsodiamondExtractor vtkIsodiamondContour
 */

#ifndef vtkIsodiamondIntervalVolume_h
#define vtkIsodiamondIntervalVolume_h

#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondHierarchy.h"     // for the metrics
#include "vtkUnstructuredGridAlgorithm.h"

#include <memory> // for the cache

namespace vtkIsodiamond
{
class Cache;
struct Query;
struct InputArray;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondIntervalVolume : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkIsodiamondIntervalVolume* New();
  vtkTypeMacro(vtkIsodiamondIntervalVolume, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isorange [lower, upper], in field units, its ends included. An end may be infinite, or
   * beyond the data's range: an open side. A range outside of the data's gives an empty volume;
   * lower >= upper and NaN are errors. Default: [0, 1].
   */
  vtkSetVector2Macro(Isorange, double);
  vtkGetVector2Macro(Isorange, double);
  ///@}

  ///@{
  /**
   * The error that is tolerated where the surfaces are, in world units by the distance metric and
   * in field units by the field metric; 0 is full resolution. Negative values and NaN are errors.
   * Default: 0.
   */
  vtkSetMacro(ErrorTolerance, double);
  vtkGetMacro(ErrorTolerance, double);
  ///@}

  ///@{
  /**
   * How the error of a tolerance is measured. *Distance*: in world units, from the full-resolution
   * surface to the mesh; no vertex of the one is farther from the other than the tolerance. *Field*
   * (the paper's): in field units, between the field and its linear interpolant. Default:
   * distance.
   */
  vtkSetClampMacro(
    ErrorMetric, int, vtkIsodiamondHierarchy::FIELD, vtkIsodiamondHierarchy::DISTANCE);
  vtkGetMacro(ErrorMetric, int);
  void SetErrorMetricToField() { this->SetErrorMetric(vtkIsodiamondHierarchy::FIELD); }
  void SetErrorMetricToDistance() { this->SetErrorMetric(vtkIsodiamondHierarchy::DISTANCE); }
  ///@}

  ///@{
  /**
   * Put every vertex on the full-resolution surface, to 1/256 of its lattice edge (2/256 where an
   * edge carries both surfaces of an interval volume). Off, vertices lie where the field would
   * cross the isovalue if it were linear along the edge, as in the paper; at full resolution both
   * are the same. Default: on.
   */
  vtkSetMacro(ExactIsovertices, bool);
  vtkGetMacro(ExactIsovertices, bool);
  vtkBooleanMacro(ExactIsovertices, bool);
  ///@}

  ///@{
  /**
   * With the distance metric, keep every piece of the surface at any tolerance. Off, pieces that
   * are thinner than the tolerance may vanish, and the promise of the tolerance with them. Default:
   * on.
   */
  vtkSetMacro(PreserveFeatures, bool);
  vtkGetMacro(PreserveFeatures, bool);
  vtkBooleanMacro(PreserveFeatures, bool);
  ///@}

  ///@{
  /**
   * Finer in a region of interest: ErrorTolerance holds in the closed box RegionOfInterest (xmin,
   * xmax, ymin, ymax, zmin, zmax, in the world), OutsideErrorTolerance elsewhere, and everywhere if
   * it is smaller; in the units of ErrorTolerance, negative values are errors. Position is the
   * box's lowest corner. A new region only extracts again. See vtkIsodiamondExtractor. Defaults:
   * off, the unit cube, VTK_DOUBLE_MAX.
   */
  vtkSetMacro(UseRegionOfInterest, bool);
  vtkGetMacro(UseRegionOfInterest, bool);
  vtkBooleanMacro(UseRegionOfInterest, bool);
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
  vtkSetMacro(OutsideErrorTolerance, double);
  vtkGetMacro(OutsideErrorTolerance, double);
  ///@}

  ///@{
  /**
   * The error that is tolerated inside, in field units. No field error is greater than the extent
   * of the array's values; from there on the inside is as coarse as its surfaces let it be.
   * Negative values and NaN are errors. Default: VTK_DOUBLE_MAX.
   */
  vtkSetMacro(InteriorTolerance, double);
  vtkGetMacro(InteriorTolerance, double);
  ///@}

  ///@{
  /**
   * Tolerances that are worth trying: up to 2 % of the image's diagonal by the distance metric, to
   * the extent of the array's values by the field metric and inside. While there is no input {0,
   * 1}, and {0, VTK_DOUBLE_MAX} for the interior.
   */
  double* GetErrorToleranceRange() VTK_SIZEHINT(2);
  double* GetInteriorToleranceRange() VTK_SIZEHINT(2);
  ///@}

  ///@{
  /**
   * Threads to use; 0 for all cores. The result does not depend on it. Default: 0.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  /** How many hierarchies this filter has built so far. */
  vtkIdType GetNumberOfBuilds();

protected:
  vtkIsodiamondIntervalVolume();
  ~vtkIsodiamondIntervalVolume() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  double Isorange[2] = { 0.0, 1.0 };
  double ErrorTolerance = 0.0;
  int ErrorMetric = vtkIsodiamondHierarchy::DISTANCE;
  bool ExactIsovertices = true;
  bool PreserveFeatures = true;
  bool UseRegionOfInterest = false;
  double RegionOfInterest[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  double OutsideErrorTolerance = VTK_DOUBLE_MAX;
  double InteriorTolerance = VTK_DOUBLE_MAX;
  int NumberOfThreads = 0;
  double ErrorToleranceRange[2] = { 0.0, 1.0 };
  double InteriorToleranceRange[2] = { 0.0, VTK_DOUBLE_MAX };

private:
  vtkIsodiamondIntervalVolume(const vtkIsodiamondIntervalVolume&) = delete;
  void operator=(const vtkIsodiamondIntervalVolume&) = delete;

  vtkIsodiamond::InputArray FindInputArray(vtkDataObject* input);

  /** What the properties ask of a hierarchy. */
  vtkIsodiamond::Query GetQuery() const;
  vtkDataObject* FindInput();

  std::unique_ptr<vtkIsodiamond::Cache> Hierarchies;
};

#endif
