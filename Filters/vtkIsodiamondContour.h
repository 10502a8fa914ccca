// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsodiamondContour
 * @brief   isosurfaces of an image at an error tolerance, in one step
 *
 * A drop-in for a contour filter: vtkImageData in, vtkPolyData of triangles out, with an error
 * tolerance in addition. The filter keeps one minimal isodiamond hierarchy per isovalue; a new
 * tolerance or region of interest only extracts again. A new input, array, isovalue, boundary
 * option or error metric, other isovertices or features, and with the distance metric another
 * spacing or direction, build what is missing.
 *
 * Point data: the isovalue under the input array's name (ComputeScalars), "Normals" toward lower
 * values from the full-resolution gradient (ComputeNormals). Cell data: "Level", see
 * vtkIsodiamondExtractor.
 *
 * The whole extent of the input is requested. In parallel the first piece holds the surface, the
 * others are empty.
 *
 * Weiss & De Floriani, "Isodiamond Hierarchies", IEEE TVCG 2010.
 *
 * @sa vtkIsodiamondBuilder vtkIsodiamondExtractor vtkContourFilter
 */

#ifndef vtkIsodiamondContour_h
#define vtkIsodiamondContour_h

#include "vtkContourValues.h"           // for the inline methods
#include "vtkIsodiamondFiltersModule.h" // for export macro
#include "vtkIsodiamondHierarchy.h"     // for the metrics
#include "vtkNew.h"                     // for the contour values
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for the result of a helper

#include <memory> // for the cache

namespace vtkIsodiamond
{
class Cache;
struct Query;
struct InputArray;
struct Volume;
}

class VTKISODIAMONDFILTERS_EXPORT vtkIsodiamondContour : public vtkPolyDataAlgorithm
{
public:
  static vtkIsodiamondContour* New();
  vtkTypeMacro(vtkIsodiamondContour, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The isovalues, in field units, as in vtkContourFilter. Default: none, so that the output is
   * empty until one is set.
   */
  void SetValue(int i, double value) { this->ContourValues->SetValue(i, value); }
  double GetValue(int i) { return this->ContourValues->GetValue(i); }
  double* GetValues() { return this->ContourValues->GetValues(); }
  void GetValues(double* values) { this->ContourValues->GetValues(values); }
  void SetNumberOfContours(int number) { this->ContourValues->SetNumberOfContours(number); }
  vtkIdType GetNumberOfContours() { return this->ContourValues->GetNumberOfContours(); }
  void GenerateValues(int number, double range[2])
  {
    this->ContourValues->GenerateValues(number, range);
  }
  void GenerateValues(int number, double first, double last)
  {
    this->ContourValues->GenerateValues(number, first, last);
  }
  ///@}

  ///@{
  /**
   * The error that is tolerated, in world units by the distance metric and in field units by the
   * field metric; 0 is full resolution. Negative values and NaN are errors. Default: 0.
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

  /** Tolerances that are worth trying: up to 2 % of the image's diagonal by the distance metric, to
   *  the extent of the array's values by the field metric; {0, 1} while there is no input. */
  double* GetErrorToleranceRange() VTK_SIZEHINT(2);

  ///@{
  /**
   * Point normals from the gradient of the full-resolution field. Default: on.
   */
  vtkSetMacro(ComputeNormals, vtkTypeBool);
  vtkGetMacro(ComputeNormals, vtkTypeBool);
  vtkBooleanMacro(ComputeNormals, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The isovalue as point scalars. Default: on.
   */
  vtkSetMacro(ComputeScalars, vtkTypeBool);
  vtkGetMacro(ComputeScalars, vtkTypeBool);
  vtkBooleanMacro(ComputeScalars, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Close surfaces at the image's boundary, see vtkIsodiamondBuilder. Default: off.
   */
  vtkSetMacro(CloseBoundary, bool);
  vtkGetMacro(CloseBoundary, bool);
  vtkBooleanMacro(CloseBoundary, bool);
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

  vtkMTimeType GetMTime() override;

protected:
  vtkIsodiamondContour();
  ~vtkIsodiamondContour() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkNew<vtkContourValues> ContourValues;
  double ErrorTolerance = 0.0;
  int ErrorMetric = vtkIsodiamondHierarchy::DISTANCE;
  bool ExactIsovertices = true;
  bool PreserveFeatures = true;
  bool UseRegionOfInterest = false;
  double RegionOfInterest[6] = { 0.0, 1.0, 0.0, 1.0, 0.0, 1.0 };
  double OutsideErrorTolerance = VTK_DOUBLE_MAX;
  vtkTypeBool ComputeNormals = 1;
  vtkTypeBool ComputeScalars = 1;
  bool CloseBoundary = false;
  int NumberOfThreads = 0;
  double ErrorToleranceRange[2] = { 0.0, 1.0 };

private:
  vtkIsodiamondContour(const vtkIsodiamondContour&) = delete;
  void operator=(const vtkIsodiamondContour&) = delete;

  vtkIsodiamond::InputArray FindInputArray(vtkDataObject* input);

  /** What the properties ask of a hierarchy. */
  vtkIsodiamond::Query GetQuery() const;

  /** The surface of one isovalue; builds its hierarchy if there is none yet. */
  vtkSmartPointer<vtkPolyData> ExtractContour(
    const vtkIsodiamond::Volume& volume, const vtkIsodiamond::Query& query, double isovalue);

  std::unique_ptr<vtkIsodiamond::Cache> Hierarchies;
};

#endif
