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
#include "vtkUnstructuredGridAlgorithm.h"

#include <memory> // for the cache

namespace vtkIsodiamond
{
class Cache;
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
   * The error that is tolerated where the surfaces are, in field units; 0 is full resolution.
   * Negative values and NaN are errors. Default: 0.
   */
  vtkSetMacro(ErrorTolerance, double);
  vtkGetMacro(ErrorTolerance, double);
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
   * From 0 to the extent of the array's values, beyond which a tolerance changes nothing. While
   * there is no array {0, 1}, and {0, VTK_DOUBLE_MAX} for the interior.
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
  double InteriorTolerance = VTK_DOUBLE_MAX;
  int NumberOfThreads = 0;
  double ErrorToleranceRange[2] = { 0.0, 1.0 };
  double InteriorToleranceRange[2] = { 0.0, VTK_DOUBLE_MAX };

private:
  vtkIsodiamondIntervalVolume(const vtkIsodiamondIntervalVolume&) = delete;
  void operator=(const vtkIsodiamondIntervalVolume&) = delete;

  vtkIsodiamond::InputArray FindInputArray(vtkDataObject* input);
  vtkDataObject* FindInput();

  std::unique_ptr<vtkIsodiamond::Cache> Hierarchies;
};

#endif
